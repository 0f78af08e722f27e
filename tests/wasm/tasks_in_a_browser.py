"""Ten tasks of a newcomer in elastokin.html in headless Chromium, by its own controls: clicks and keys only.

    tasks_in_a_browser.py PAGE PROGRAM FOLDER [--shots DIR]

The tasks were written down before the scripts, in the words of somebody who knows suspensions and has never seen the page. Each begins with
the page as opened. The clicks and keys of each are printed; a list counts as two clicks, a field as one. The result is compared with the
native program. FOLDER receives downloads. Exit status 1 with a line per failure, or if a task takes more clicks than its limit.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import expect

from workbench import Workbench, difference, native_curves, patient

top = Path(__file__).resolve().parents[2]
native, folder = Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
folder.mkdir(parents=True, exist_ok=True)
axle = (top / "input/mcpherson_axle/mcpherson_axle.nml").read_text()
tasks = []


def task(words, limit):
    """Adds a task: its words, and how many clicks it may take."""
    def add(script):
        tasks.append((words, limit, script))
        return script
    return add


class Hand(Workbench):
    """The page, with a count of clicks and keys."""

    def click(self, selector):
        self.clicks += 1
        self.page.click(selector)

    def choose(self, selector, value):
        self.clicks += 2
        self.page.select_option(selector, value)

    def press(self, key, times=1):
        for _ in range(times):
            self.typed += 1
            self.keys.press(key)

    def type(self, letters):
        self.typed += len(letters)
        self.keys.type(letters)

    def write(self, selector, letters):
        """Clicks into a field, replaces its content and enters it."""
        self.click(selector)
        self.press("Control+a")
        self.type(letters)
        self.press("Enter")

    def begin(self):
        """Opens the McPherson axle with its points and curves."""
        self.choose("#library", "mcpherson_axle")
        self.said("check: done")
        self.click("[data-tab=points]")
        self.curves()

    def free(self, path):
        self.click(f"[data-free='{path}']")

    def find(self):
        """Presses Solve, and puts the numbers found into the deck."""
        self.click("#solve")
        expect(self.page.locator("#accept")).to_be_enabled(timeout=patient)
        self.require("not reached" not in self.page.inner_text("#answer"), f"solve: {self.page.inner_text('#answer')[:200]}")
        self.click("#accept")
        self.curves()

    def download(self, selector):
        with self.page.expect_download() as loaded:
            self.click(selector)
        path = folder / loaded.value.suggested_filename
        loaded.value.save_as(path)
        return path


def number(text, name, settings=""):
    """A K&C metric by the native program."""
    (folder / "deck.nml").write_text(text)
    (folder / "settings.set").write_text(settings)
    found = subprocess.run([native, "run", folder / "deck.nml", "--responses", name, "--set-file", folder / "settings.set", "--quiet"],
                           text=True, capture_output=True, check=True)
    return float(found.stdout.split()[0])


def table_of(command, ending, *words):
    """A table that the native program writes for the axle, as rows by heading."""
    subprocess.run([native, command, top / "input/mcpherson_axle/mcpherson_axle.nml", *words, "--out", folder / command, "--quiet"],
                   capture_output=True, check=True)
    lines = [line.split(",") for line in next((folder / command).glob(f"*{ending}")).read_text().splitlines() if not line.startswith("#")]
    return [dict(zip(lines[0], row)) for row in lines[1:]]


@task("See how toe changes with wheel travel on the McPherson axle, and read it at 40 mm of bump", 6)
def read_toe(hand):
    hand.begin()
    hand.click("#state")
    for _ in range(60):
        text = hand.page.inner_text("#state-text")
        if text == "at wheel_travel_mm 40":
            break
        found = re.search(r"(−?[\d.]+)$", text)
        hand.press("ArrowRight" if not found or float(found[1].replace("−", "-")) < 40 else "ArrowLeft")
    wanted = native_curves(native, {"a.nml": axle}, "a.nml", "parallel_travel")
    value = wanted["left_toe_deg"][wanted["factor"].index(40.0)]
    shown = hand.page.locator("#charts figcaption").first.inner_text()
    hand.require(f"{value:.4g}".replace("-", "−") in shown, f"toe is {value}, the chart says {shown}")


@task("Make bump steer zero", 12)
def zero_bump_steer(hand):
    before = number(axle, "left_bump_toe")
    hand.begin()
    hand.choose("#key-number", "left_bump_toe")
    hand.write("[aria-label='wanted value of left_bump_toe']", "0")
    hand.free("point.tie_rod_outer.z")
    hand.find()
    after = number(hand.text(), "left_bump_toe")
    hand.require(abs(after) < 1e-6 < abs(before), f"bump steer was {before} and is {after}")


@task("What makes the lateral force steer the wheel?", 10)
def lateral_force_steer(hand):
    name = "left_lateral_in_load_held_steer_deg_per_kn"
    hand.begin()
    hand.choose("#quantity", name.removeprefix("left_"))
    hand.curves()
    hand.choose("#asked", name)
    hand.click("#parts")
    expect(hand.page.locator("#answer table tr")).to_have_count(16, timeout=patient)
    rows = table_of("explain", "_contributions.csv", "--case", "parallel_travel", "--of", name, "--at", "0")
    largest = max(rows, key=lambda row: abs(float(row["value"])))
    shown = hand.page.locator("#answer table tr").nth(1).inner_text()
    hand.require(shown.startswith(f"{largest['row']}.{largest['part']}"), f"the largest part is {largest['row']}.{largest['part']}, the page says {shown}")


@task("I need a wheel rate of 35 N/mm", 12)
def wheel_rate(hand):
    hand.begin()
    hand.choose("#key-number", "left_wheel_rate_n_per_mm")
    hand.write("[aria-label='wanted value of left_wheel_rate_n_per_mm']", "35")
    hand.free("spring.coil.rate")
    hand.find()
    found = number(hand.text(), "left_wheel_rate_n_per_mm")
    hand.require(abs(found - 35) < 1e-5, f"the wheel rate is {found}")
    hand.require("29.77" not in re.search(r"&spring[^/]*", hand.text()).group(), "the spring of the deck is unchanged")


@task("Which point moves toe most in bump?", 10)
def movers(hand):
    hand.begin()
    hand.click("#state")
    hand.press("End")
    hand.choose("#asked", "left_toe_deg")
    hand.click("#movers")
    expect(hand.page.locator("#answer table")).to_have_count(2, timeout=patient)
    rows = [row for row in table_of("derivatives", "_derivatives.csv", "--case", "parallel_travel", "--of", "left_toe_deg", "--at", "80")
            if row["number"].startswith("point.")]
    sizes = {}
    for row in rows:
        sizes.setdefault(row["number"].split(".")[1], []).append(float(row["derivative"]))
    wanted = max(sizes, key=lambda name: sum(one * one for one in sizes[name]))
    shown = hand.page.locator("#answer table tr").nth(1).locator("th").inner_text()
    hand.require(shown == wanted, f"the point is {wanted}, the page says {shown}")


@task("What happens to lateral force steer if the front bushing of the arm is half as stiff? Keep the present curves to compare", 10)
def softer_bushing(hand):
    hand.begin()
    hand.choose("#test", "lateral_force")
    before = hand.curves()
    hand.click("#baseline")
    hand.write("[aria-label='bushing.lca_front.kt(2)']", "225")
    after = hand.curves()
    settings = "bushing.lca_front.kt(2) = 225\n"
    wanted = native_curves(native, {"a.nml": axle}, "a.nml", "lateral_force", settings)
    error, name = difference({"left_toe_deg": after["columns"]["left_toe_deg"]}, wanted)
    hand.require(error <= 1e-9, f"toe differs by {error}")
    most = max(abs(a - b) for a, b in zip(after["columns"]["left_toe_deg"], before["columns"]["left_toe_deg"]))
    shown = hand.page.locator("#charts figcaption").first.inner_text()
    hand.require(f"{most:.4g}" in shown, f"toe changes by {most} at most, the page says {shown}")


@task("Somebody typed &sprng in my deck: find the error and mend it", 3)
def mend(hand):
    hand.drop({"mine.nml": axle.replace("&spring ", "&sprng ", 1)})
    hand.said("error in the deck")
    hand.click("#messages button")
    hand.require(hand.page.evaluate("editor.state.sliceDoc(editor.state.selection.main.from, editor.state.selection.main.to)").startswith("&sprng"),
                 "the message does not lead to its line")
    hand.press("Home")
    hand.press("ArrowRight", 4)
    hand.type("i")
    hand.said("check: done")
    hand.require(hand.text() == axle, "the deck is not that without the error")


@task("Put the roll centre 80 mm above the ground, and leave bump steer as it is", 16)
def roll_centre(hand):
    before = number(axle, "left_bump_toe")
    hand.begin()
    hand.choose("#key-number", "roll_centre_height_mm")
    hand.write("[aria-label='wanted value of roll_centre_height_mm']", "80")
    hand.choose("#key-number", "left_bump_toe")
    hand.free("point.lower_ball_joint.z")
    hand.free("point.tie_rod_outer.z")
    hand.click("#solve")
    expect(hand.page.locator("#answer")).to_contain_text("point.tie_rod_outer.z is at its lower bound", timeout=patient)
    hand.write("[aria-label='point.tie_rod_outer.z from']", "-95")      # as the answer advises
    hand.find()
    found = number(hand.text(), "roll_centre_height_mm"), number(hand.text(), "left_bump_toe")
    hand.require(abs(found[0] - 80) < 1e-4 and abs(found[1] - before) < 1e-5, f"roll centre and bump steer are {found}, bump steer was {before}")


@task("Move the outer end of the tie rod 5 mm up and take the change home as settings for the command line", 7)
def settings_home(hand):
    hand.begin()
    box = hand.page.locator("circle[aria-label='tie_rod_outer, Side view']").bounding_box()      # another point lies above
    hand.clicks += 1
    hand.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    hand.press("ArrowUp", 5)
    drawn = hand.curves()
    settings = hand.download("#changes").read_text()
    wanted = native_curves(native, {"a.nml": axle}, "a.nml", "parallel_travel", settings)
    hand.require("point.tie_rod_outer.z = -50.0" in settings, f"the settings are {settings}")
    error, name = difference({"left_toe_deg": drawn["columns"]["left_toe_deg"]}, wanted)
    hand.require(error <= 1e-9, f"toe differs by {error}")


@task("Start from a new double wishbone, raise its spring rate by 10 % and send my boss the report", 10)
def new_deck(hand):
    hand.choose("#new", "double_wishbone")
    hand.said("check: done")
    hand.click("[data-tab=points]")
    hand.curves()
    field = "[aria-label='spring.coil.rate']"
    rate = float(hand.page.input_value(field))
    hand.write(field, f"{1.1 * rate:.6g}")
    hand.curves()
    hand.click("[data-command=report]")
    hand.said("report: done")
    page = hand.download("#save-page").read_text()
    made = subprocess.run([native, "new", "double_wishbone"], text=True, capture_output=True, check=True).stdout
    wanted = number(made, "left_wheel_rate_n_per_mm", f"spring.coil.rate = {1.1 * rate:.6g}\n")
    hand.require("<html" in page and f"{wanted:.4g}" in page, f"the report does not contain the wheel rate {wanted:.4g}")


hand = Hand(sys.argv[1], sys.argv[5] if sys.argv[4:5] == ["--shots"] else None)
total = 0
for k, (words, limit, script) in enumerate(tasks, 1):
    hand.page.evaluate("localStorage.clear()")
    hand.page.evaluate("files.clear()")      # a page that is closed stores its document
    hand.page.close()
    hand.open()
    hand.clicks = hand.typed = 0
    before = len(hand.failures)
    try:
        script(hand)
    except Exception as error:      # the other tasks are tried, too
        hand.failures.append(f"task {k}: {str(error)[:300]}")
    hand.shot(f"task_{k}")
    hand.require(hand.clicks <= limit, f"task {k} takes {hand.clicks} clicks, more than {limit}")
    total += hand.clicks
    print(f"task {k}: {hand.clicks} clicks, {hand.typed} keys{'' if len(hand.failures) == before else ', FAILED'}: {words}")
hand.end(f"{len(tasks)} tasks, {total} clicks")
