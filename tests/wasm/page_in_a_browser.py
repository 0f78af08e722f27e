"""Uses the controls of elastokin.html in headless Chromium, from file:// and without a network.

    page_in_a_browser.py PAGE FOLDER [--shots DIR]

A deck of the library is opened, checked, run and reported; a mistake is typed, located and undone; files are dropped; a deck that
does not parse, an empty file, a mechanism and a wrong command are reported in the page; a run is stopped; the page is closed and
opened again. Points are dragged, moved by keys and typed: the curves are those of a run with the settings that the page saves, to
1e-9 of the largest value of the column; 2,000 drags leave the memory of program and page as it is; undo gives the text as it was. A number
is asked for: what moves it, what it consists of, and numbers that solve a condition. FOLDER receives downloads. Requires playwright
(PyPI) and a Chromium in the path. Exit status 1 with a line per failure.
"""
import math
import os
import random
import shutil
import sys
import time
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

page_file, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
shots = Path(sys.argv[4]) if sys.argv[3:4] == ["--shots"] else None
folder.mkdir(parents=True, exist_ok=True)
failures, messages, requests = [], [], []
patient = 120000     # ms: the machine may be busy


def require(is_good, text):
    if not is_good:
        failures.append(text)


with sync_playwright() as tool:
    program = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
    browser = tool.chromium.launch(executable_path=program, args=["--no-sandbox"])
    context = browser.new_context(viewport={"width": 1280, "height": 900}, accept_downloads=True)
    page = context.new_page()
    page.on("console", lambda m: messages.append(m.text))
    page.on("pageerror", lambda e: messages.append(str(e)))
    page.on("request", lambda r: requests.append(r.url) if not r.url.startswith(("file:", "blob:", "data:", "about:")) else None)
    page.on("dialog", lambda d: d.accept())
    status = page.locator("#status")

    def shot(name):
        if shots:
            shots.mkdir(parents=True, exist_ok=True)
            page.screenshot(path=shots / f"{name}.png")

    def said(text):
        expect(status).to_contain_text(text, timeout=patient)

    def drop(files):
        """Drops files on the page, name -> text."""
        data = page.evaluate_handle("""(files) => {
          const data = new DataTransfer();
          for (const [name, text] of Object.entries(files)) data.items.add(new File([text], name));
          return data;
        }""", files)
        page.dispatch_event("body", "drop", {"dataTransfer": data})

    def put_text(text):
        """Replaces the text of the editor, by the keyboard and the clipboard."""
        page.focus("#text")
        page.keyboard.press("Control+a")
        page.evaluate("""(text) => {
          const data = new DataTransfer();
          data.setData("text/plain", text);
          document.getElementById("text").dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
        }""", text)

    start = time.monotonic()
    page.goto(page_file.as_uri())
    said("Ready")
    print(f"ready after {time.monotonic() - start:.2f} s")
    require(page.locator("#library option").count() > 14, "the library is not in the page")
    page.select_option("#library", "mcpherson_axle")
    said("check: done")
    expect(page.locator("#messages")).to_contain_text("OK")
    shot("check")

    page.click("[data-command=run]")
    said("run: done")
    require(page.locator("#written option").count() >= 12, "a run of the axle wrote fewer than 12 tables")
    require(page.locator("#table tr").count() > 50, "the table has no rows")
    with page.expect_download() as loaded:
        page.click("#download")
    loaded.value.save_as(folder / "table.csv")
    require((folder / "table.csv").read_text().count("\n") > 50, "the downloaded table is short")
    shot("table")

    page.click("[data-command=report]")
    said("report: done")
    said("Pictures by gnuplot are left out")
    frame = page.frame_locator("#page iframe")
    expect(frame.locator("h1")).to_contain_text("McPherson", timeout=patient)
    require(frame.locator("svg").count() > 20, "the report has no charts")
    shot("report")

    text = page.evaluate("elastokin.text()")
    page.click("[data-tab=messages]")
    put_text(text.replace("&joint", "&jiont", 1))
    said("check: error in the deck")
    expect(page.locator("#messages")).to_contain_text("there is no group &jiont", timeout=patient)
    page.click("#messages button")
    selected = page.evaluate("editor.state.sliceDoc(editor.state.selection.main.from, editor.state.selection.main.to)")
    require(selected.startswith("&jiont"), f"the message leads to '{selected[:40]}'")
    expect(page.locator(".cm-lint-marker-error")).to_have_count(1, timeout=patient)
    shot("mistake")
    put_text(text)
    said("check: done")

    page.fill("#command", "run mcpherson_axle.nml --case steering --increments 20 --out 'my tables'")
    page.click("#line button")
    said("run: done")
    written = page.locator("#written option").all_inner_texts()
    require(written == ["my tables/mcpherson_axle_steering.csv"], f"the command line was not used, it wrote {written[:3]}")
    page.fill("#command", "study nowhere.nml --unknown")
    page.click("#line button")
    said("study: wrong use")

    page.fill("#command", "run mcpherson_axle.nml --increments 5000 --out out")
    page.click("#line button")
    said("run …")
    page.click("#stop")
    said("Stopped")
    require(page.evaluate("elastokin.text()") == text, "the document was lost when a command was stopped")
    page.click("[data-command=check]")
    said("check: done")

    # points and curves
    def curves():
        end = time.monotonic() + patient / 1000     # the page allows no eval, which wait_for_function needs
        while time.monotonic() < end:
            found = page.evaluate("elastokin.curves()")
            if found["isCurrent"] and found.get("columns"):
                return found
            time.sleep(0.02)
        raise TimeoutError("no curves")

    def agrees(what, test="parallel_travel"):
        """The curves are those of a run of the document as opened, with the settings that the page saves."""
        drawn, settings = curves(), page.evaluate("changes()")
        result = page.evaluate("""([text, settings, test]) => elastokin.command(["run", "mcpherson_axle.nml", "--case", test, "--increments",
          "20", "--set-file", "changes.set", "--out", "out"], { "mcpherson_axle.nml": text, "changes.set": settings })""",
          [text, settings, test])
        solved = f"out/mcpherson_axle_{test}.csv" in result["files"]
        is_bad = page.locator("#said").get_attribute("class") == "bad"
        require(solved != is_bad, f"{what}: the page says '{page.inner_text('#said')}', the run {result['status']} {result['messages'][:200]}")
        if not solved:      # the curves are those before, and grey
            require("stale" in (page.locator("#charts").get_attribute("class") or ""), f"{what}: curves of a former document are not grey")
            print(f"{what}: {page.inner_text('#said')[:160]}")
            return settings
        table = [row.split(",") for row in result["files"][f"out/mcpherson_axle_{test}.csv"].split("\n") if row and not row.startswith("#")]
        for name, values in drawn["columns"].items():
            if name in ("iterations", "constraint_error"):      # a rounding can cost an iteration more
                continue
            column = table[0].index(name)
            wanted = [row[column] for row in table[1:]]
            numbers = [float(text or "nan") for text in wanted]      # written with 15 digits, from another order of elimination
            near = 1e-9 * max([1.0, *(abs(number) for number in numbers if number == number)])
            same = len(numbers) == len(values) and all(abs(number - value) <= near or (number != number and value != value)
                                                       for number, value in zip(numbers, values))
            require(same, f"{what}: {name} is not that of the run with {settings.split()}")
        return settings

    page.click("[data-tab=points]")
    expect(page.locator("#charts figure")).to_have_count(6, timeout=patient)
    require(agrees("as opened") == "", "a document that was not changed has changes")
    # a state, and what moves a number there
    page.locator("#state").focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    expect(page.locator("#state-text")).to_have_text("at wheel_travel_mm 40")
    require(page.locator("#charts line.state").count() == 6, "the charts do not show the state")
    # the drawing shows this state: the wheel centre has risen by the travel, and the tie rod has its length
    drawn = page.evaluate("""["wheel_centre", "tie_rod_inner", "tie_rod_outer"].map((name) => positionOf(pointOf(name), pointOf(name).body))""")
    require(abs(drawn[0][2] - 40) < 1e-9, f"the wheel centre is drawn at {drawn[0]}")
    require(abs(math.dist(drawn[1], drawn[2]) - math.hypot(378, 9)) < 1e-9, f"the tie rod is drawn from {drawn[1]} to {drawn[2]}")
    dot = page.locator("circle[aria-label='wheel_centre, Side view']")
    risen = float(dot.get_attribute("cy"))
    page.select_option("#asked", "left_toe_deg")
    page.click("#movers")
    expect(page.locator("#answer table")).to_have_count(2, timeout=patient)
    listed = page.locator("#answer table").first.locator("tr").nth(1).locator("th, td").all_inner_texts()
    arrow = page.locator("#views svg").first.locator(".arrow").first.get_attribute("data-arrow")
    require(listed[0] == "lower_ball_joint", f"toe is moved most by {listed}")
    require(arrow == listed[0], f"the first arrow is at {arrow}, the list begins with {listed[0]}")
    row = curves()["columns"]["factor"].index(40)
    before = curves()["columns"]["left_toe_deg"][row]
    slope = float(listed[4].replace("−", "-"))
    page.fill(f"[aria-label='{listed[0]} z']", str(float(page.input_value(f"[aria-label='{listed[0]} z']")) + 0.1))
    page.press(f"[aria-label='{listed[0]} z']", "Enter")
    moved = (curves()["columns"]["left_toe_deg"][row] - before) / 0.1
    require(abs(moved - slope) < 0.02 * abs(slope), f"0.1 mm of {listed[0]} in z change toe by {moved} deg per mm, the derivative is {slope}")
    require(page.locator("#views .arrow").count() == 0, "arrows of a former document are drawn")
    expect(page.locator("#answer")).to_have_class("bar top stale")
    page.click("#undo")
    page.click("#parts")
    expect(page.locator("#answer")).to_contain_text("responses to loads", timeout=patient)
    page.select_option("#quantity", "lateral_in_load_held_steer_deg_per_kn")
    curves()
    page.select_option("#asked", "left_lateral_in_load_held_steer_deg_per_kn")
    page.click("#parts")
    expect(page.locator("#answer table tr")).to_have_count(16, timeout=patient)
    require("rack_drive.stiffness" in page.inner_text("#answer"), "the stiffness of the rack is no part of the lateral force steer")
    # numbers that give toe at this state another value, and leave the caster
    page.select_option("#asked", "left_toe_deg")
    page.click("#condition")
    page.fill("[aria-label='wanted value of parallel_travel:left_toe_deg@40']", "0.1")
    page.select_option("#key-number", "left_caster_deg")
    page.click("[data-free='point.tie_rod_inner.z']")
    page.click("[data-free='bushing.lca_front.kt(2)']")
    page.click("#solve")
    expect(page.locator("#accept")).to_be_enabled(timeout=patient)
    shot("ask")
    require("reached: left_toe_deg" in page.inner_text("#answer"), f"solve: {page.inner_text('#answer')}")
    require("not reached" not in page.inner_text("#answer"), f"solve: {page.inner_text('#answer')}")
    caster = curves()["columns"]["left_caster_deg"][10]
    page.click("#accept")
    agrees("numbers of solve")
    found = curves()["columns"]
    require(abs(found["left_toe_deg"][row] - 0.1) < 1e-6, f"the numbers of solve give {found['left_toe_deg'][row]}")
    require(abs(found["left_caster_deg"][10] - caster) < 1e-6, "the caster did not stay")
    while page.is_enabled("#undo"):
        page.click("#undo")
    page.click("[aria-label='Remove the chart of lateral_in_load_held_steer_deg_per_kn']")
    page.locator("#state").focus()
    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    expect(page.locator("#state-text")).to_have_text("at design")
    require(float(dot.get_attribute("cy")) > risen + 10, "the drawing does not follow the state")
    # at design, toe is that of the deck whatever the points are: their derivatives are rounding noise, which is no answer
    page.select_option("#asked", "left_toe_deg")
    page.click("#movers")
    expect(page.locator("#answer")).to_contain_text("No point moves left_toe_deg at design.", timeout=patient)
    require(page.locator("#answer table tr").all_inner_texts()[-1].startswith("wheel.left.toe"), page.inner_text("#answer"))
    require(page.locator("#views .arrow").count() == 0, "rounding noise is drawn as arrows")

    page.click("#baseline")
    chance, started, runs = random.Random(51), time.monotonic(), curves()["runs"]
    dots = page.locator("#views circle").count()
    for k in range(10):
        dot = page.locator("#views circle").nth(chance.randrange(dots))
        dot.scroll_into_view_if_needed()
        box = dot.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for m in range(1, 6):
            page.mouse.move(x + m * chance.choice((-1, 1)), y + m * chance.choice((-1, 1)))
        page.mouse.up()
        agrees(f"drag {k}")
        if page.locator("#said").get_attribute("class") == "bad":
            page.click("#undo")
    runs = curves()["runs"] - runs
    print(f"10 drags: {runs} solutions, {runs / (time.monotonic() - started):.1f} a second with the comparisons")
    require(runs >= 10, "curves do not follow a drag")
    require("Δ at most" in page.locator("#charts figcaption").first.inner_text(), "there is no difference from the baseline")
    shot("points")

    # one long drag, a move in every frame of the browser: how many redraws a second; then many drags, each a step of the history: memory
    # of the program, and of the page after its waste was collected
    memory = context.new_cdp_session(page)
    memory.send("Performance.enable")

    def heap():
        memory.send("HeapProfiler.collectGarbage")
        return memory.send("Runtime.getHeapUsage")["usedSize"], {one["name"]: one["value"] for one in memory.send("Performance.getMetrics")["metrics"]}["Nodes"]

    page.evaluate("""() => {
      globalThis.moveBy = async (event, x, y) => {      // resolves when the curves of this position are drawn
        const begun = performance.now(), before = elastokin.curves().runs;
        dispatchEvent(event("pointermove", x, y));
        do await new Promise(requestAnimationFrame);
        while (elastokin.curves().runs === before && !elastokin.curves().isCurrent);
        return performance.now() - begun;
      };
      globalThis.dotOf = () => {
        const dot = document.querySelector("circle[aria-label='tie_rod_outer, Side view']"), box = dot.getBoundingClientRect();
        const at = (kind, x, y) => new PointerEvent(kind, { clientX: box.x + 5 + x, clientY: box.y + 5 + y, bubbles: true, cancelable: true });
        return [dot, at];
      };
    }""")
    moved = page.evaluate("""async () => {
      const [dot, event] = dotOf(), durations = [], gaps = [], start = performance.now(), { runs } = elastokin.curves();
      dot.dispatchEvent(event("pointerdown", 0, 0));
      for (let k = 0; k < 500; k++) {
        gaps.push(await moveBy(event, 6 * Math.sin(k), 6 * Math.cos(1.3 * k)));
        durations.push(elastokin.curves().duration);
      }
      dispatchEvent(event("pointermove", 0, 0));
      dispatchEvent(event("pointerup", 0, 0));
      return { runs: elastokin.curves().runs - runs, seconds: (performance.now() - start) / 1000,
        duration: durations.sort((a, b) => a - b)[250], gap: gaps.sort((a, b) => a - b)[250] };
    }""")
    rate, mean = 1000 / moved["gap"], moved["runs"] / moved["seconds"]      # the median, because other programs run at the same time
    print(f"500 moves of a point: {rate:.1f} redraws a second, {mean:.1f} on average; a solution {moved['duration']:.1f} ms")
    busy = max(1.0, os.getloadavg()[0] / os.cpu_count())
    require(rate * busy >= 20, f"{rate:.1f} redraws a second, fewer than 20, with {busy:.1f} programs for each processor")
    many = """async (count) => {
      for (let k = 0; k < count; k++) {
        const [dot, event] = dotOf();
        dot.dispatchEvent(event("pointerdown", 0, 0));
        await moveBy(event, k % 2 ? -4 : 4, k % 2 ? 4 : -4);      // there and back
        dispatchEvent(event("pointerup", 0, 0));
      }
      return elastokin.curves().bytes;
    }"""
    early, (used, nodes) = page.evaluate(many, 310), heap()      # the history is as long as it gets
    late, (used_late, nodes_late) = page.evaluate(many, 2000), heap()
    print(f"2,000 drags of a point: memory of the program from {early} to {late} bytes, of the page from {used / 1e6:.1f} to {used_late / 1e6:.1f} MB, "
          f"{nodes} to {nodes_late} nodes")
    require(late == early, f"the memory of the program grew from {early} to {late} bytes")
    require(used_late < used + 3e6, f"the memory of the page grew from {used} to {used_late} bytes")
    require(nodes_late < nodes + 2000, f"the page grew from {nodes} to {nodes_late} nodes")
    agrees("after 2,000 drags")
    page.select_option("#library", "mcpherson_axle")      # the history does not reach back so far
    said("check: done")
    page.click("[data-tab=points]")
    before = page.evaluate("elastokin.curves().runs")
    page.evaluate("program.worker.postMessage({ id: -1, solve: null })")     # an error in the worker, as a trap of the program
    page.locator("circle[aria-label='lca_rear, Side view']").focus()
    page.keyboard.press("ArrowDown")
    agrees("in a new instance")
    require(page.evaluate("elastokin.curves().runs") > before, "nothing was solved in a new instance")
    page.keyboard.press("ArrowUp")
    page.click("[data-tab=points]")
    page.fill("[aria-label='tie_rod_outer z']", "-60")
    page.press("[aria-label='tie_rod_outer z']", "Enter")
    page.locator("circle[aria-label='lca_rear, Side view']").focus()
    page.keyboard.press("ArrowUp")
    settings = agrees("typed")
    require("point.tie_rod_outer.z = -60.0" in settings and "point.lca_rear.z = " in settings, f"typed and by key: {settings}")
    rates = page.locator("#rates tr").all_inner_texts()
    require(any("spring.coil.rate" in row and "N/mm" in row for row in rates), f"the table of rates has no unit of the spring: {rates[:3]}")
    require(page.locator("#rates input[aria-label='bushing.lca_rear.kt(2)']").input_value() == "10000.0", "a rate of a bushing is missing")
    fast = page.evaluate("elastokin.curves().openings")
    page.fill("[aria-label='bushing.lca_rear.kt(2)']", "9000")
    page.press("[aria-label='bushing.lca_rear.kt(2)']", "Enter")
    agrees("a rate typed")
    page.locator("[aria-label='spring.coil.rate']").focus()
    page.keyboard.press("ArrowUp")
    settings = agrees("a rate by key")
    require("bushing.lca_rear.kt(2) = 9000.0" in settings and "spring.coil.rate = 30.07" in settings, f"rates: {settings}")
    require(page.evaluate("elastokin.curves().openings") == fast, "a rate opens the model again")
    page.keyboard.press("Control+z")
    require(page.input_value("[aria-label='spring.coil.rate']") == "29.77", "undo does not change the table")
    require("rate = 29.77" in page.evaluate("elastokin.text()"), "undo does not change the text")
    page.keyboard.press("Control+y")
    settings = agrees("a rate again")
    with page.expect_download() as loaded:
        page.click("#changes")
    loaded.value.save_as(folder / "changes.set")
    require((folder / "changes.set").read_text() == settings, "the saved settings are others")
    page.select_option("#test", "steering")
    agrees("another test", "steering")
    put_text(page.evaluate("elastokin.text()").replace("&spring", "&sprong", 1))
    expect(page.locator("#said")).to_have_class("bad", timeout=patient)
    require("sprong" in page.inner_text("#said"), f"a deck that cannot be read: {page.inner_text('#said')}")
    require(page.locator("#charts.stale").count() == 1, "curves of a former document are not grey")
    require("&sprong" in page.evaluate("elastokin.text()"), "the document was lost when it could not be solved")
    shot("not_solved")
    while page.is_enabled("#undo"):
        page.click("#undo")
    require(page.evaluate("elastokin.text()") == text, "undo does not give the text as it was")
    page.click("#redo")
    require(page.evaluate("elastokin.text()") != text, "redo does nothing")
    page.click("#undo")
    expect(page.locator("#said")).not_to_have_class("bad", timeout=patient)
    page.click("[data-tab=messages]")

    drop({"broken.nml": "&model name = 'broken' /\n&point name = 'a' at = 1, 2 /\n", "notes.csv": "a,b\n1,2\n"})
    said("check: error in the deck")
    names = page.locator("#file option").all_inner_texts()
    require(names == ["broken.nml", "notes.csv"], f"after two files were dropped, the document has {names[:3]}")
    drop({"mechanism.nml": "&model name = 'mechanism' /\n&point name = 'a', at = 0, 0, 0 /\n&body name = 'b' /\n"
          "&wheel name = 'w', body = 'b', centre = 'a', contact = 'a', side = 'left' /\n"})
    expect(page.locator("#deck")).to_have_value("mechanism.nml")
    expect(status).to_have_class("bad", timeout=patient)
    drop({"empty.nml": ""})
    expect(page.locator("#file")).to_have_value("empty.nml")
    require("mechanism.nml" in page.locator("#file option").all_inner_texts(), "an empty file replaced the document")

    other = context.new_page()
    page.close()
    other.goto(page_file.as_uri())
    expect(other.locator("#file")).to_have_value("mechanism.nml", timeout=patient)
    browser.close()
require(not messages, f"the page wrote to the console: {messages[:3]}")
require(not requests, f"the page requested {requests[:3]}")
for text in failures:
    print(f"FAILED: {text}")
print(f"the page: {page_file.stat().st_size} bytes, {len(failures)} failures")
sys.exit(bool(failures))
