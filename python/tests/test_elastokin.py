"""Tests of the Python package on the decks of the library: python -m unittest discover python/tests"""

import copy
import importlib.util
import math
import multiprocessing
import pickle
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np

import elastokin
from elastokin import Model

INPUT = Path(__file__).resolve().parents[2] / "input"
AXLE = INPUT / "mcpherson_axle" / "mcpherson_axle.nml"
CORNER = INPUT / "mcpherson" / "mcpherson.nml"
PATH = "bushing.lca_front.kt(1)"


def toe(model: Model) -> float:
    """Sum of the toe of a model; for other processes and threads."""
    return float(model.solve("parallel_travel", ["left_toe_deg"])["left_toe_deg"].sum())


class Opening(unittest.TestCase):
    def test_a_file_and_its_text_are_the_same_model(self) -> None:
        with Model.from_file(AXLE) as a, Model.from_text(AXLE.read_text(), str(AXLE)) as b:
            self.assertEqual((a.name, a.checksum, a.wheels, a.cases), (b.name, b.checksum, b.wheels, b.cases))
            self.assertEqual(a.wheels, 2)
            self.assertIn("mcpherson_axle", repr(a))

    def test_a_missing_file_is_a_file_error(self) -> None:
        with self.assertRaisesRegex(elastokin.FileError, "no_such.nml"):
            Model.from_file("no_such.nml")

    def test_all_mistakes_of_a_deck_are_listed_with_their_lines(self) -> None:
        with self.assertRaises(elastokin.DeckError) as caught:
            Model.from_text("&model name = 'a', length = 'furlong' /\n&spring name = 's', rte = 3 /\n", "wrong.nml")
        self.assertIn("wrong.nml:1:", str(caught.exception))
        self.assertIn("wrong.nml:2:", str(caught.exception))

    def test_a_closed_model_raises_an_error(self) -> None:
        model = Model.from_file(CORNER)
        model.close()
        model.close()
        self.assertIn("closed", repr(model))
        with self.assertRaisesRegex(elastokin.UsageError, "closed"):
            model.solve()

    def test_a_model_is_not_made_without_a_deck(self) -> None:
        with self.assertRaises(TypeError):
            Model()


    def bad_corner(self) -> str:
        """The corner without its spring, with its contact point 20 mm below the ground."""
        text = CORNER.read_text()
        for old, new in (("\n&spring", "\n! &spring"), ("\n        rate = 30.0, preload", "\n! rate = 30.0, preload"),
                         ("0.0, -750.0, -310.0", "0.0, -750.0, -330.0")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        return text

    def test_a_model_with_remarks_warns_once(self) -> None:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            model = Model.from_text(self.bad_corner(), str(CORNER))
            copies = [model.copy(), pickle.loads(pickle.dumps(model))]
            model.solve("wheel_travel_sweep", columns=["toe_deg"])
        ours = [w for w in caught if issubclass(w.category, elastokin.ModelWarning)]
        self.assertEqual(len(ours), 1)
        self.assertEqual(ours[0].filename, __file__)
        self.assertEqual(str(ours[0].message), "\n".join(model.remarks))
        self.assertEqual(len(model.remarks), 2)
        self.assertIn("contact point", model.remarks[0])
        self.assertTrue(model.remarks[1].startswith("the deck has no spring"))
        self.assertEqual(copies[0].remarks, model.remarks)

    def test_a_sound_model_has_no_remarks_and_no_warning(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with Model.from_file(AXLE) as model:
                self.assertEqual(model.remarks, [])
                model["wheel.left.radius"] = 250
                self.assertTrue(model.remarks)

    def test_a_warning_may_be_an_error(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error", elastokin.ModelWarning)
            with self.assertRaisesRegex(elastokin.ModelWarning, "no spring"):
                Model.from_text(self.bad_corner(), str(CORNER))


class Numbers(unittest.TestCase):
    def setUp(self) -> None:
        self.model = Model.from_file(AXLE)

    def tearDown(self) -> None:
        self.model.close()

    def test_a_number_is_read_and_changed_in_the_unit_of_the_deck(self) -> None:
        self.assertEqual(self.model[PATH], 700.0)
        self.model[PATH] = 500
        self.assertEqual(self.model[PATH], 500.0)

    def test_both_sides_of_a_mirrored_axle_are_changed(self) -> None:
        self.model[PATH] = 500
        changed = [p for p, number in self.model.parameters.items() if "lca_front.kt(1)" in p]
        self.assertGreaterEqual(len(changed), 1)
        for path in changed:
            self.assertEqual(self.model[path], 500.0, path)

    def test_text_scales_and_shifts(self) -> None:
        self.model[PATH] = "*1.5"
        self.assertAlmostEqual(self.model[PATH], 1050.0, places=9)
        self.model["point.tie_rod_inner.z"] = "+2"
        self.assertAlmostEqual(self.model["point.tie_rod_inner.z"], -62.0, places=9)

    def test_a_path_with_different_numbers_is_nan(self) -> None:
        self.assertTrue(math.isnan(self.model["bushing.*.kt(1)"]))

    def test_an_unknown_path_is_a_usage_error(self) -> None:
        with self.assertRaisesRegex(elastokin.UsageError, "no_such"):
            self.model["bushing.no_such.kt(1)"] = 3
        with self.assertRaises(elastokin.UsageError):
            self.model["bushing.no_such.kt(1)"]
        self.assertNotIn("bushing.no_such.kt(1)", self.model)
        self.assertIn(PATH, self.model)

    def test_a_value_outside_its_range_is_a_deck_error(self) -> None:
        before, checksum = self.model.x, self.model.checksum
        for path, value in (("wheel.left.radius", -1), ("wheel.left.radius", "*-1"), ("spring.coil.rate", -5), ("spring.right_coil.rate", -5)):
            with self.assertRaisesRegex(elastokin.DeckError, "radius|rate"):
                self.model[path] = value
        x = before.copy()
        x[list(self.model.parameters.paths).index("spring.left_coil.rate")] = -5
        with self.assertRaisesRegex(elastokin.DeckError, "spring.left_coil.rate=-5: "):
            self.model.x = x
        np.testing.assert_array_equal(self.model.x, before)
        self.assertEqual(self.model.checksum, checksum)
        self.assertTrue(self.model.solve("parallel_travel", ["left_toe_deg"]).converged)

    def test_deleting_takes_a_change_back_and_keeps_the_others(self) -> None:
        before = self.model.checksum
        self.model[PATH] = 500
        self.model["spring.coil.rate"] = 40
        del self.model[PATH]
        self.assertEqual((self.model[PATH], self.model["spring.coil.rate"]), (700.0, 40.0))
        with self.assertRaises(KeyError):
            del self.model[PATH]
        self.model.reset()
        self.assertEqual(self.model.checksum, before)

    def test_parameters_are_a_mapping_with_units(self) -> None:
        parameters = self.model.parameters
        self.assertEqual(len(parameters), self.model.x.size)
        self.assertEqual(list(self.model), list(parameters))
        path = next(p for p in parameters if p.endswith("lca_front.kt(1)"))
        self.assertEqual((parameters[path].value, parameters[path].unit, parameters[path].is_given), (700.0, "N/mm", True))
        self.assertEqual(parameters.paths[parameters.index(path)], path)
        with self.assertRaises(KeyError):
            parameters["no_such"]

    def test_common_paths_lead_to_both_sides(self) -> None:
        pairs = self.model.parameters.common_paths
        self.assertEqual(pairs["spring.coil.rate"], ("spring.left_coil.rate", "spring.right_coil.rate"))
        self.assertGreater(len(pairs), 100)
        for path, (left, right) in pairs.items():
            self.assertEqual(self.model[path], self.model[left], path)
            self.assertEqual(abs(self.model[path]), abs(self.model[right]), path)
        self.assertEqual(Model.from_file(CORNER).parameters.common_paths, {})

    def test_wrong_types_and_counts_are_told_in_terms_of_python(self) -> None:
        calls = {
            "a path must be a str, found int": lambda: self.model[3],
            "the name of a K&C metric must be a str, found list": lambda: self.model.numbers(["left_bump_toe"]),
            "needs at least one name": lambda: self.model.numbers(),
            "the name of a case must be a str, found int": lambda: self.model.solve(3),
            "the name of a column must be a str, found int": lambda: self.model.solve("roll", columns=[3]),
            "a deck must be a str, found bytes": lambda: Model.from_text(b"&model /"),
        }
        for words, call in calls.items():
            with self.assertRaisesRegex(TypeError, words):
                call()
        with self.assertRaises(TypeError):
            self.model[3] = 1.0
        with self.assertRaisesRegex(ValueError, f"x needs {self.model.x.size} numbers.*found 3"):
            self.model.x = [1, 2, 3]

    def test_a_nul_in_a_text_is_refused(self) -> None:
        for call in (
            lambda: Model.from_file(f"{AXLE}\0b"), lambda: Model.from_text(AXLE.read_text() + "\0", str(AXLE)),
            lambda: Model.from_text(AXLE.read_text(), f"{AXLE}\0"), lambda: self.model[PATH + "\0x"],
            lambda: self.model.numbers("left_bump_toe\0"), lambda: self.model.solve("roll\0"),
            lambda: self.model.solve("roll", columns=["left_toe_deg\0"]),
        ):
            with self.assertRaisesRegex(elastokin.UsageError, "NUL"):
                call()
        with self.assertRaisesRegex(elastokin.UsageError, "NUL"):
            self.model["spring.coil.rate"] = "30\0 0"
        self.assertNotIn(PATH + "\0", self.model)

    def test_all_numbers_are_an_array(self) -> None:
        x = self.model.x.copy()
        k = next(k for k, p in enumerate(self.model.parameters.paths) if p.endswith("lca_front.kt(1)"))
        x[k] = 600.0
        self.model.x = x
        np.testing.assert_array_equal(self.model.x, x)
        self.assertEqual(self.model[self.model.parameters.paths[k]], 600.0)
        with self.assertRaises(ValueError):
            self.model.x[0] = 1.0
        with self.assertRaises(elastokin.UsageError):
            self.model.x = x[:-1]


class Solving(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.model = Model.from_file(AXLE)

    def setUp(self) -> None:
        self.model.reset()

    def test_a_result_has_columns_units_and_values(self) -> None:
        result = self.model.solve("parallel_travel")
        self.assertEqual(result.values.shape, (len(result), len(result.columns)))
        self.assertTrue(result.converged)
        self.assertEqual((result.units["left_toe_deg"], result.titles["left_toe_deg"]), ("deg", "Toe"))
        self.assertTrue(result.signs["left_toe_deg"].startswith("+"))
        np.testing.assert_array_equal(result["left_toe_deg"], result.values[:, result.columns.index("left_toe_deg")])
        self.assertEqual(result["left_wheel_travel_mm"][[0, -1]].round(9).tolist(), [-80.0, 80.0])
        with self.assertRaisesRegex(elastokin.UsageError, "no_such"):
            result["no_such"]
        self.assertIn("parallel_travel", repr(result))

    def test_selected_columns_have_the_values_of_all_columns(self) -> None:
        every = self.model.solve("parallel_travel")
        some = self.model.solve("parallel_travel", columns=["left_toe_deg", "left_bump_steer_deg_per_m"])
        self.assertLess(len(some.columns), 12)
        self.assertEqual(some.columns[:2], ("state", "factor"))
        for name in some.columns:
            np.testing.assert_array_equal(some[name], every[name], name)

    def test_a_result_stays_readable_after_a_text_is_set(self) -> None:
        result = self.model.solve("parallel_travel", columns=["left_toe_deg"])
        first = result.compliance(3)
        self.model["spring.coil.rate"] = "*1.1"
        self.assertEqual(result.compliance(4).shape, first.shape)
        self.assertEqual(result.derivatives("left_toe_deg", PATH, 3).values.shape, (1, 1))

    def test_a_change_changes_the_result_and_the_checksum_but_not_the_earlier_result(self) -> None:
        before = self.model.solve("parallel_travel")
        checksum = self.model.checksum
        kept = before.values.copy()
        self.model[PATH] = 500
        after = self.model.solve("parallel_travel")
        self.assertNotEqual(self.model.checksum, checksum)
        self.assertFalse(np.array_equal(before["left_toe_deg"], after["left_toe_deg"]))
        np.testing.assert_array_equal(before.values, kept)

    def test_a_result_can_have_the_definitions_of_another_program(self) -> None:
        own = self.model.solve("parallel_travel")
        lotus = self.model.solve("parallel_travel", definitions="lotus")
        trail = own["left_caster_trail_mm"] * np.cos(np.radians(own["left_caster_deg"]))
        np.testing.assert_allclose(lotus["left Mechanical Trail (grnd) [mm]"], trail, rtol=0, atol=1e-11)
        self.assertEqual("mm", lotus.units["left Castor Trail (hub) [mm]"])
        self.assertEqual("Castor Trail (hub)", lotus.titles["left Castor Trail (hub) [mm]"])
        self.assertEqual("axis aft of the centre", lotus.signs["left Castor Trail (hub) [mm]"])
        self.assertEqual("", lotus.units["converged"])
        names = ["left Castor Trail (hub) [mm]", "left_spindle_offset_mm"]
        found = lotus.derivatives(names, ["point.left_lower_ball_joint.x"], 10)
        self.assertGreater(abs(found.values[1, 0]), 0.1)
        self.assertAlmostEqual(-found.values[1, 0], found.values[0, 0], delta=1e-9)
        with self.assertRaisesRegex(elastokin.UsageError, "left Castor Trail"):
            lotus.derivatives("left Castor Trail", "point.left_lower_ball_joint.x", 10)
        self.assertIn("left_toe_deg", self.model.solve("parallel_travel"))
        with self.assertRaisesRegex(elastokin.UsageError, "did you mean 'lotus'"):
            self.model.solve("parallel_travel", definitions="lotos")
        with self.assertRaises(elastokin.UsageError):
            self.model.solve("parallel_travel", ["left_toe_deg"], definitions="lotus")

    def test_unknown_cases_and_columns_are_usage_errors(self) -> None:
        with self.assertRaisesRegex(elastokin.UsageError, "no_such"):
            self.model.solve("no_such")
        with self.assertRaisesRegex(elastokin.UsageError, "no_such"):
            self.model.solve("parallel_travel", columns=["no_such"])

    def test_cases_are_those_of_the_deck_and_then_the_standard_tests(self) -> None:
        cases, own = self.model.cases, self.model.deck_cases
        self.assertEqual(cases[: len(own)], own)
        self.assertEqual(own[0], "parallel_travel")
        self.assertEqual(self.model.solve(columns=["left_toe_deg"]).case, "parallel_travel")

    def test_states_that_do_not_converge_are_nan_with_a_warning(self) -> None:
        far = AXLE.read_text().replace("&case test = 'parallel_travel', from = -80.0,   to = 80.0 /",
                                       "&case test = 'parallel_travel', from = -80.0, to = 600.0 /")
        self.assertNotEqual(far, AXLE.read_text())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", elastokin.ModelWarning)
            model = Model.from_text(far, str(AXLE))
        with model:
            with self.assertWarns(elastokin.ConvergenceWarning):
                result = model.solve("parallel_travel", columns=["left_toe_deg"])
        self.assertFalse(result.converged)
        self.assertEqual(result.status, 4)
        lost = result["converged"] != 1
        self.assertTrue(0 < lost.sum() < len(result))
        self.assertTrue(np.isnan(result["left_toe_deg"][lost]).all() and not np.isnan(result["left_toe_deg"][~lost]).any())
        self.assertIn("not converged", repr(result))
        self.assertTrue(result.remarks)

    def test_the_compliance_matrix_is_symmetric_and_stays_with_its_result(self) -> None:
        result = self.model.solve("parallel_travel", columns=["left_toe_deg"])
        matrix = result.compliance(0)
        self.assertEqual(matrix.shape, (12, 12))
        np.testing.assert_allclose(matrix, matrix.T, atol=1e-9 * np.abs(matrix).max())
        np.testing.assert_array_equal(result.compliance(-len(result)), matrix)
        kept = self.model.solve("parallel_travel", columns=["left_toe_deg"], compliance=True)
        self.model.solve("roll", columns=["left_toe_deg"])
        np.testing.assert_array_equal(kept.compliance(0), matrix)
        np.testing.assert_array_equal(result.compliance(0), matrix)
        with self.assertRaisesRegex(elastokin.UsageError, "another case"):
            result.compliance(1)
        with self.assertRaises(IndexError):
            kept.compliance(len(kept))

    def test_derivatives_are_those_of_changed_models(self) -> None:
        column, number, step = "left_toe_deg", "point.tie_rod_inner.z", 0.1
        result = self.model.solve("parallel_travel", columns=[column])
        found = result.derivatives([column, "patch_left_y_by_left_fy_mm_per_kn"], [number, "bushing.lca_front.kt(1)"], 3)
        self.assertEqual(found.values.shape, (2, 2))
        self.assertLess(found.errors[0, 0], 1e-6 * abs(found.values[0, 0]))
        ends = []
        for sign in (-1, 1):
            other = self.model.copy()
            other[number] = other[number] + sign * step
            ends.append(other.solve("parallel_travel", columns=[column])[column][3])
        self.assertAlmostEqual(found.values[0, 0], (ends[1] - ends[0]) / (2 * step), delta=1e-5 * abs(found.values[0, 0]))
        with self.assertRaisesRegex(elastokin.UsageError, "left_to_deg"):
            result.derivatives("left_to_deg", number, 3)
        self.model[number] = self.model[number] + 1.0
        self.model.numbers("left_wheel_rate")
        with self.assertRaisesRegex(elastokin.UsageError, "solve again"):
            result.derivatives(column, number, 3)

    def test_the_last_result_can_be_pickled(self) -> None:
        result = pickle.loads(pickle.dumps(self.model.solve("parallel_travel", columns=["left_toe_deg"], compliance=True)))
        self.assertEqual(result.compliance(3).shape, (12, 12))

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "no pandas")
    def test_a_data_frame_has_the_columns(self) -> None:
        result = self.model.solve("parallel_travel", columns=["left_toe_deg"])
        frame = result.to_dataframe()
        self.assertEqual(tuple(frame.columns), result.columns)
        np.testing.assert_array_equal(frame["left_toe_deg"], result["left_toe_deg"])

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "no xarray")
    def test_a_dataset_has_units(self) -> None:
        result = self.model.solve("parallel_travel", columns=["left_toe_deg"])
        dataset = result.to_xarray()
        self.assertEqual(dataset["left_toe_deg"].attrs["units"], "deg")
        np.testing.assert_array_equal(dataset["left_toe_deg"], result["left_toe_deg"])


class KeyNumbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.model = Model.from_file(AXLE)

    def test_key_numbers_by_name(self) -> None:
        numbers = self.model.numbers("left_bump_toe", "left_wheel_rate")
        self.assertEqual(list(numbers), ["left_bump_toe", "left_wheel_rate"])
        self.assertAlmostEqual(numbers["left_wheel_rate"], 31.34, delta=0.05)      # README of the deck: 31.3 N/mm
        with self.assertRaisesRegex(elastokin.UsageError, "no_such"):
            self.model.numbers("no_such")

    def test_all_key_numbers_contain_those_by_name(self) -> None:
        every = self.model.key_numbers()
        self.assertGreater(len(every), 50)
        self.assertEqual(every["left_bump_toe"], self.model.numbers("left_bump_toe")["left_bump_toe"])
        self.assertEqual(set(every), set(self.model.number_units))
        self.assertEqual(set(every), set(self.model.number_definitions))

    def test_a_key_number_that_lost_states_is_nan_with_a_warning_that_names_it(self) -> None:
        far = AXLE.read_text().replace("from = -75.0,   to = 75.0 /", "from = -75.0, to = 700.0 /")
        self.assertNotEqual(far, AXLE.read_text())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", elastokin.ModelWarning)
            model = Model.from_text(far, str(AXLE))
        with model, self.assertWarnsRegex(elastokin.ConvergenceWarning, "no value of smallest_turning_circle_m$"):
            numbers = model.numbers("smallest_turning_circle_m", "left_bump_toe")
        self.assertTrue(math.isnan(numbers["smallest_turning_circle_m"]))
        self.assertEqual(numbers["left_bump_toe"], self.model.numbers("left_bump_toe")["left_bump_toe"])

    def test_the_last_solution_is_not_changed(self) -> None:
        result = self.model.solve("parallel_travel", columns=["left_toe_deg"])
        self.model.numbers("left_braking_deflection")
        self.assertEqual(result.compliance(0).shape, (12, 12))


class Copies(unittest.TestCase):
    def changed(self) -> Model:
        model = Model.from_file(AXLE)
        model.x = model.x * 1.0
        model[PATH] = 500
        model["spring.coil.rate"] = "*1.1"
        model["spring.coil.rate"] = "*1.1"
        return model

    def test_copies_and_pickles_have_the_changes(self) -> None:
        model = self.changed()
        for other in (model.copy(), copy.copy(model), copy.deepcopy(model), pickle.loads(pickle.dumps(model))):
            self.assertEqual(other.checksum, model.checksum)
            np.testing.assert_array_equal(other.x, model.x)
            del other[PATH]
            self.assertEqual(other[PATH], 700.0)
        self.assertEqual(model[PATH], 500.0)

    def test_a_copy_is_what_was_opened_whatever_became_of_the_files(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            parts, deck = Path(folder) / "parts.nml", Path(folder) / "deck.nml"
            text = CORNER.read_text()
            first = text.index("&point")
            head, body = text[:first], text[first:]
            self.assertIn("rate = ", body)
            parts.write_text(body)
            deck.write_text(head + "\n&include file = 'parts.nml' /\n")
            model = Model.from_file(deck)
            model["spring.coil.rate"] = "*1.1"
            wanted = model.checksum, model.x.tolist()
            state = pickle.dumps(model)
            for change in (lambda: parts.write_text(body.replace("rate = ", "rate = 1")), parts.unlink, deck.unlink):
                change()
                for other in (model.copy(), copy.copy(model), copy.deepcopy(model), pickle.loads(state), pickle.loads(pickle.dumps(model))):
                    self.assertEqual((other.checksum, other.x.tolist()), wanted)
                    del other["spring.coil.rate"]
                    other["spring.coil.rate"] = "*1.1"          # the deck is parsed again, from what was opened
                    self.assertEqual((other.checksum, other.x.tolist()), wanted)
            model["spring.coil.rate"] = "*1.1"
            self.assertNotEqual(model.checksum, wanted[0])

    def test_the_deck_as_it_was_used_gives_the_same_numbers(self) -> None:
        model = self.changed()
        text = model.deck
        self.assertIn("set: bushing.lca_front.kt(1)=500", text)
        other = Model.from_text(text, "elsewhere/deck.nml")
        self.assertEqual(toe(other), toe(model))
        np.testing.assert_array_equal(other.solve("roll").values, model.solve("roll").values)
        model["case.roll.to"] = model["case.roll.from"]
        with self.assertRaises(elastokin.DeckError):
            model.deck

    def test_processes_give_the_same_numbers(self) -> None:
        model = self.changed()
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            self.assertEqual(pool.apply(toe, (model,)), toe(model))

    def test_threads_give_the_same_numbers(self) -> None:
        model = self.changed()
        wanted = toe(model)
        found: list[float] = []
        models = [model, model, model.copy(), model.copy()]       # two threads share a model
        threads = [threading.Thread(target=lambda m=m: found.extend(toe(m) for _ in range(10))) for m in models]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, 40 * [wanted])


if __name__ == "__main__":
    with warnings.catch_warnings():
        unittest.main()
