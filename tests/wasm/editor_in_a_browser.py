"""Writes a deck in the editor of elastokin.html, in headless Chromium, from file:// and without a network.

    editor_in_a_browser.py PAGE PROGRAM [--shots DIR]

Completion offers the keys of every group, and the strings of every key that takes only some, as `PROGRAM schema` lists them; names of
points and parts are those of the deck, and those of a study are those of its deck. The meaning of a key is shown with its unit in this deck. A mistake is marked at its key while
it is typed. Text, tables and drawing have one order of undo. Requires playwright (PyPI) and a Chromium in the path. Exit status 1 with a
line per failure.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

page_file, native = Path(sys.argv[1]).resolve(), sys.argv[2]
shots = Path(sys.argv[4]) if sys.argv[3:4] == ["--shots"] else None
failures, messages, requests, patient = [], [], [], 20000
groups = json.loads(subprocess.run([native, "schema"], text=True, capture_output=True, check=True).stdout)["$defs"]


def require(is_good, text):
    if not is_good:
        failures.append(text)


with sync_playwright() as tool:
    program = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
    browser = tool.chromium.launch(executable_path=program, args=["--no-sandbox"])
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.on("console", lambda m: messages.append(m.text))
    page.on("pageerror", lambda e: messages.append(str(e)))
    page.on("request", lambda r: requests.append(r.url) if not r.url.startswith(("file:", "blob:", "data:", "about:")) else None)
    page.on("dialog", lambda d: d.accept())
    keys, status = page.keyboard, page.locator("#status")
    text = lambda: page.evaluate("elastokin.text()")

    def shot(name):
        if shots:
            shots.mkdir(parents=True, exist_ok=True)
            page.screenshot(path=shots / f"{name}.png")

    def at_end(letters):
        """Puts the caret behind the text and types."""
        page.focus("#text")
        keys.press("Control+End")
        keys.type(letters)

    def offered():
        """The words that completion offers, which is asked for; none if it has nothing to offer."""
        keys.press("Escape")
        keys.press("Control+Space")
        box = page.locator(".cm-tooltip-autocomplete li .cm-completionLabel")
        end = time.monotonic() + 3
        while box.count() == 0 and time.monotonic() < end:
            time.sleep(0.02)
        return box.all_inner_texts()

    def deck(name):
        page.select_option("#library", name)
        expect(status).to_contain_text("check: done", timeout=patient)

    page.goto(page_file.as_uri())
    expect(status).to_contain_text("Ready", timeout=patient)
    deck("mcpherson_axle")
    original = text()
    for kind in ("comment", "group", "key", "string", "number"):
        require(page.locator(f"#text .{kind}").count() > 5, f"the text has no colour of a {kind}")
    colours = {page.locator(f"#text .{kind}").first.evaluate("(e) => getComputedStyle(e).color") for kind in ("comment", "group", "key", "string", "number")}
    require(len(colours) == 5, f"the text has the colours {colours}")

    # completion of what the program lists
    at_end("\n&")
    require(sorted(offered()) == sorted(groups), f"the groups offered are {offered()}")
    keys.press("Escape")
    keys.press("Backspace")
    counted = 0
    for group, card in groups.items():
        at_end(f"&{group} ")
        found = offered()
        require(sorted(found) == sorted(card["properties"]), f"&{group}: {set(found) ^ set(card['properties'])} are not offered, or not keys")
        for key, facts in card["properties"].items():
            listed = facts.get("enum") or facts.get("items", {}).get("enum")
            if not listed:
                continue
            counted += 1
            keys.type(f"{key} = '")
            found = offered()
            require(sorted(found) == sorted(listed), f"&{group} {key}: offered are {found}, not {listed}")
            keys.press("Escape")
            for _ in range(len(key) + 4):
                keys.press("Backspace")
        keys.press("Escape")
        for _ in range(len(group) + 2):
            keys.press("Backspace")
    require(counted >= 25, f"only {counted} keys take some strings only")
    require(text() == original + "\n", "the text was not typed as meant")
    named = lambda group: re.findall(rf"(?m)^&{group}\s+name\s*=\s*'(\w+)'", original)
    at_end("&bushing at = '")
    require(sorted(offered()) == sorted(named("point")), f"points offered: {offered()}")
    keys.press("Escape")
    keys.type("lca_rear', bodies = 'lca', '")
    require(sorted(offered()) == sorted([*named("body"), "chassis"]), f"bodies offered: {offered()}")
    keys.press("Escape")
    keys.type("chassis', curve = 'fz=")
    shot("names")
    # a whole group by completion alone: group, keys with quotes, names
    # a whole group by completion alone: group, keys with their quotes, names
    deck("mcpherson_axle")
    for letters in ("\n&bus", " nam", "more', bodi", "lc", "', 'chassis', at", "lca_re", "', kt"):
        at_end(letters) if letters.startswith("\n") else keys.type(letters)
        if not letters.endswith("at"):      # the only key that begins so would be another one
            expect(page.locator(".cm-tooltip-autocomplete")).to_be_visible(timeout=patient)
        time.sleep(0.2)      # the list is not taken in its first moment
        keys.press("Enter")
    keys.type("1, 2, 3 /")
    expect(status).to_contain_text("check: done", timeout=patient)
    require(text().endswith("\n&bushing name = 'more', bodies = 'lca', 'chassis', at = 'lca_rear', kt = 1, 2, 3 /"), f"completed: {text()[-120:]}")
    shot("completed")

    # a study: paths, cases and K&C metrics of its deck, as the program lists them
    study = "&study name = 's', kind = 'grid', deck = 'axle.nml', case = 'roll' /\n"
    data = page.evaluate_handle("""(files) => {
      const data = new DataTransfer();
      for (const [name, text] of Object.entries(files)) data.items.add(new File([text], name));
      return data;
    }""", {"axle.nml": original, "study.nml": study})
    page.dispatch_event("body", "drop", {"dataTransfer": data})
    expect(status).to_contain_text("check: done", timeout=patient)
    page.select_option("#file", "study.nml")
    with tempfile.TemporaryDirectory() as work:
        (Path(work) / "axle.nml").write_text(original)
        listed = json.loads(subprocess.run([Path(native).resolve(), "list", "axle.nml", "--json"], cwd=work, text=True, capture_output=True, check=True).stdout)
    for typed, kind, name in (("&factor path = '", "paths", "path"), ("', case = '", "cases", "name"), ("' /\n&response quantity = '", "numbers", "name")):
        at_end(typed)
        found, wanted = offered(), {one[name] for one in listed[kind]}      # the list shows no more than a hundred at a time
        require(found and set(found) <= wanted and len(found) >= min(len(wanted), 100), f"in a study, {len(found)} {kind} are offered: {set(found) - wanted}")
        keys.press("Escape")

    # what a key means; its unit is that of the deck
    def meaning_of(word, context):
        page.evaluate("([context, word]) => { const at = elastokin.text().lastIndexOf(context) + context.indexOf(word) + 1;"
                      " editor.dispatch({ selection: { anchor: at }, scrollIntoView: true }); }", [context, word])
        time.sleep(0.2)
        place = page.evaluate("(() => { const { left, top, bottom } = editor.coordsAtPos(editor.state.selection.main.head); return [left, (top + bottom) / 2]; })()")
        for k in range(20):
            page.mouse.move(5, 5)
            page.mouse.move(*place)
            page.mouse.move(place[0] + 1, place[1])
            time.sleep(0.5)
            if page.locator(".meaning").count() == 1:
                break
        require(page.locator(".meaning").count() == 1, f"the meaning of {word} is not shown")
        return page.inner_text(".meaning")

    deck("mcpherson_axle")
    at_end("\n&bushing name = 'more', bodies = 'lca', 'chassis', at = 'lca_rear', kt = 1, 2, 3 /")
    found = meaning_of("kt", "kt = 1, 2, 3")
    require("rates along the marker axes" in found and "unit N/mm" in found and "default 0, 0, 0" in found, f"kt means {found}")
    shot("meaning")
    found = meaning_of("lca_rear", "'lca_rear', kt")
    require("43.2, -373.4, -110.0 mm" in found, f"the point is explained by {found}")

    # a mistake is marked while it is typed, at its key, and goes when it is mended
    deck("mcpherson_axle")
    at_end("\n&bushing name = 'more', bodies = 'lca', 'chassis', at = 'lca_rear', kt = 1, 2 /")
    expect(page.locator(".cm-lintRange-error")).to_have_text("kt", timeout=patient)
    require(page.locator(".cm-lint-marker-error").count() == 1, "the line of the mistake has no mark")
    page.locator(".cm-lintRange-error").hover()
    expect(page.locator(".cm-tooltip-lint")).to_contain_text("kt needs 3 values, found 2", timeout=patient)
    shot("mistake")
    keys.press("ArrowLeft")
    keys.press("ArrowLeft")
    keys.type(", 3")
    expect(page.locator(".cm-lintRange-error")).to_have_count(0, timeout=patient)
    expect(status).to_contain_text("check: done", timeout=patient)

    # one order of undo for text, table and drawing
    deck("mcpherson_axle")
    page.click("[data-tab=points]")
    expect(page.locator("#charts figure")).to_have_count(6, timeout=patient)
    steps = [text()]
    at_end("! typed")
    time.sleep(0.6)
    steps.append(text())
    page.fill("[aria-label='tie_rod_outer z']", "-60")
    page.press("[aria-label='tie_rod_outer z']", "Enter")
    steps.append(text())
    page.locator("circle[aria-label='lca_rear, Side view']").focus()
    keys.press("ArrowUp")
    steps.append(text())
    at_end(" more")
    steps.append(text())
    require(len(set(steps)) == 5, "a change of text, table or drawing does not change the text")
    page.focus("#text")
    for wanted in reversed(steps[:-1]):
        keys.press("Control+z")
        require(text() == wanted, "undo in the text does not take back the last change")
    require(page.input_value("[aria-label='tie_rod_outer z']") == "-55.0", "undo in the text does not change the table")
    require(page.is_disabled("#undo"), "undo goes further than the document as opened")
    for wanted in steps[1:]:
        keys.press("Control+y")
        require(text() == wanted, "redo in the text does not give the last change")
    page.click("#undo")
    require(text() == steps[3], "the button undoes another change")

    page.focus("#text")
    keys.press("Control+Home")
    keys.press("Control+f")
    keys.type("rebound_ring")
    keys.press("Enter")
    found = page.evaluate("editor.state.sliceDoc(editor.state.selection.main.from, editor.state.selection.main.to)")
    require(found == "rebound_ring", f"the search found '{found}'")
    shot("search")
    browser.close()
require(not messages, f"the page wrote to the console: {messages[:3]}")
require(not requests, f"the page requested {requests[:3]}")
for line in failures:
    print(f"FAILED: {line}")
print(f"the editor: {len(groups)} groups, {counted} lists of strings, {len(failures)} failures")
sys.exit(bool(failures))
