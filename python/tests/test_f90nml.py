"""A deck is a Fortran namelist file: f90nml reads every deck and writes it back as the same model. Skipped without f90nml."""

import importlib.util
import shutil
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

from elastokin import Model

HAS_F90NML = importlib.util.find_spec("f90nml") is not None
if HAS_F90NML:
    import f90nml

TOP = Path(__file__).resolve().parents[2]
# decks, and parts that they include; the files of examples are maps of channels, which belong to no deck
FILES = sorted(path for place in ("input/*", "examples/**", "studies/*") for path in TOP.glob(f"{place}/*.nml"))


def solved(deck: Path) -> dict[str, np.ndarray]:
    """The tables of all cases of a deck; of a deck without cases the table of its first standard test."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with Model.from_file(deck) as model:
            return {case: model.solve(case).values for case in model.deck_cases or model.cases[:1]}


@unittest.skipUnless(HAS_F90NML, "no f90nml")
class Namelists(unittest.TestCase):
    def test_f90nml_writes_every_deck_back_as_the_same_model(self) -> None:
        decks = 0
        for folder in sorted({path.parent for path in FILES}):
            with tempfile.TemporaryDirectory() as place, self.subTest(folder=str(folder.relative_to(TOP))):
                written = Path(place) / folder.name
                shutil.copytree(folder, written)
                for path in written.glob("*.nml"):
                    before = f90nml.read(path)
                    before.write(path, force=True)
                    self.assertEqual(f90nml.read(path), before)
                for path in sorted(folder.glob("*.nml")):
                    if "\n&model" not in path.read_text():
                        continue  # a study, a map or a part of a deck
                    decks += 1
                    tables, again = solved(path), solved(written / path.name)
                    self.assertEqual(tables.keys(), again.keys())
                    for case, values in tables.items():
                        self.assertGreater(values.size, 0)
                        np.testing.assert_array_equal(again[case], values, f"{path} {case}")
        self.assertGreaterEqual(decks, 14)


if __name__ == "__main__":
    unittest.main()
