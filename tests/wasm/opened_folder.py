#!/usr/bin/env python3
"""opened_folder.py PYTHON FOLDER: the page that `PYTHON -m elastokin.workbench` makes of a folder, in headless Chromium (needs
playwright). PYTHON is that of an environment with the wheel for all systems. Exit status 1 with a line per failure.
"""
import shutil
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

top = Path(__file__).resolve().parents[2]
python, folder = sys.argv[1], Path(sys.argv[2]).resolve()
shutil.rmtree(folder, ignore_errors=True)
(folder / "decks/axle").mkdir(parents=True)
(folder / "decks/.git").mkdir()
failures, patient = [], 120000
axle = (top / "input/mcpherson_axle/mcpherson_axle.nml").read_text()
(folder / "decks/axle/axle.nml").write_text(axle + "! </script> ends nothing\n")
(folder / "decks/a_first.nml").write_text((top / "input/mcpherson/mcpherson.nml").read_text())
(folder / "decks/.git/hidden.nml").write_text("&model name = 'hidden' /\n")
(folder / "decks/picture.png").write_bytes(b"\x89PNG")


def require(is_good, text):
    if not is_good:
        failures.append(text)


def page_for(*words):
    made = subprocess.run([python, "-m", "elastokin.workbench", *map(str, words), "--write", folder / "page.html"], text=True, capture_output=True)
    require(made.returncode == 0 and made.stdout.strip() == str(folder / "page.html"), f"workbench {words}: {made.stdout} {made.stderr}")
    return (folder / "page.html").as_uri()


with sync_playwright() as tool:
    program = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
    browser = tool.chromium.launch(executable_path=program, args=["--no-sandbox"])
    context = browser.new_context()
    context.on("dialog", lambda d: d.accept())

    def opened(address, deck):
        page = context.new_page()
        page.goto(address)
        expect(page.locator("#deck")).to_have_value(deck, timeout=patient)
        expect(page.locator("#status")).to_contain_text("check: done", timeout=patient)
        return page

    page = opened(page_for(folder / "decks"), "a_first.nml")
    names = page.locator("#file option").all_inner_texts()
    require(names == ["a_first.nml", "axle/axle.nml"], f"the document of a folder is {names}")
    page = opened(page_for(folder / "decks/axle/axle.nml"), "axle.nml")
    require(page.evaluate("elastokin.text()") == (folder / "decks/axle/axle.nml").read_text(), "the text of the deck is another one")
    # an edited document stays; one that was not edited is that of the folder
    page.get_by_text("'mcpherson_axle'", exact=True).first.dblclick()
    page.keyboard.type("edited")
    expect(page.locator("#status")).to_contain_text("check: done", timeout=patient)
    page.close()
    page = opened((folder / "page.html").as_uri(), "axle.nml")
    require("name = 'edited'" in page.evaluate("elastokin.text()"), "an edited document was lost")
    browser.close()
wrong = subprocess.run([python, "-m", "elastokin.workbench", folder / "none"], text=True, capture_output=True)
require(wrong.returncode == 1 and "there is no such folder or deck" in wrong.stderr, f"a folder that does not exist: {wrong}")
for text in failures:
    print(f"FAILED: {text}")
print(f"the workbench of a folder: {len(failures)} failures")
sys.exit(bool(failures))
