"""Opens the page of a report in headless Chromium and uses it: first screen, hover, reference, value at, legend, zoom, overlay, filter, print.

    report_in_a_browser.py FOLDER OTHER_DATA [--shots DIR]

FOLDER has report.html, data.json and the tables; OTHER_DATA is the data.json of another report of the same tests. Requires
playwright and axe-playwright-python (PyPI) and a Chromium in the path. Prints what it measured; exit status 1 with a line per failure.
"""
import json, re, sys, tempfile
from pathlib import Path
from playwright.sync_api import sync_playwright
from browser import contrast, hover, new_page, number, start, table, violations

folder, other = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
shots = Path(sys.argv[4]) if len(sys.argv) > 4 else None
page_file, failures = folder / "report.html", []
data = json.loads((folder / "data.json").read_text())


def expect(is_good, text):
    if not is_good:
        failures.append(text)


# Time per frame while the cursor moves over a chart, in ms: the mean and the slowest tenth
frames = """(id) => new Promise((done) => {
  const root = document.querySelector(`[id="${id}"] svg.chart`), box = root.getBoundingClientRect(), times = [], work = [];
  let k = 0, last = performance.now();
  const step = (now) => {
    times.push(now - last); last = now;
    const at = performance.now();
    root.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + 60 + (k * 7) % (box.width - 80), clientY: box.top + 50, bubbles: true }));
    work.push(performance.now() - at);
    if (++k < 90) return requestAnimationFrame(step);
    times.sort((a, b) => a - b); done([times[45], times[81]]);
  };
  requestAnimationFrame(step);
})"""


def first_chart(page):
    chart = next(c for c in data["tests"][0]["charts"] if not c.get("level"))
    page.locator(f'[id="{chart["id"]}"]').scroll_into_view_if_needed()
    page.wait_for_selector(f'[id="{chart["id"]}"] svg.chart')
    return chart


with sync_playwright() as tool:
    browser = start(tool)
    messages, requests = [], []
    page = new_page(browser, page_file, 1400, "light", messages, requests)
    chart = first_chart(page)
    size = page_file.stat().st_size
    started = page.evaluate("performance.timing.domContentLoadedEventEnd - performance.timing.navigationStart")
    expect(size < 1e6, f"report.html has {size} bytes")
    print(f"size {size / 1e3:.0f} kB, loaded after {started} ms")
    # the first number of the summary is seen without scrolling
    top = page.evaluate("""() => { const found = [...document.querySelectorAll('#summary dd, #summary .value')]
      .find((n) => /[0-9]/.test(n.innerText)); return found ? found.getBoundingClientRect().top + scrollY : 1e9; }""")
    lines = page.locator("#summary .verdicts dd").count()
    print(f"first number {top:.0f} pixels from the top, {lines} lines of verdict")
    expect(top < 600, f"the first number is {top:.0f} pixels from the top")
    expect(lines >= 8, f"{lines} lines of verdict")

    # the first screen: the 3-D picture and four charts with axes, which link to their places in the sections; so do the cards
    page.set_viewport_size({"width": 1400, "height": 1180})
    page.evaluate("scrollTo(0, 0)")
    first = page.locator("#summary .first figure")
    page.wait_for_function("document.querySelectorAll('#summary .first svg.chart').length === 4")
    for part in [page.locator("#summary .beside img"), *first.all()]:
        box = part.bounding_box()
        expect(box["y"] > 0 and box["y"] + box["height"] < 1180, f"not on the first screen: {box}")
    ids = [figure.get_attribute("data-chart") for figure in first.all()]
    expect(ids == [f"parallel_travel_{q}" for q in ("toe_deg", "camber_deg")] + ["lateral_force_steer_deg", "parallel_travel_vertical_force_n"],
           f"charts of the first screen: {ids}")
    links = page.locator("#summary .first b a, .cards .name a").evaluate_all("(all) => all.map((a) => a.hash.slice(1))")
    charts = {c["id"] for t in data["tests"] for c in t["charts"] if not c.get("level")}
    expect(links[:4] == ids and set(links) <= charts, f"links of the first screen: {sorted(set(links) - charts)}")
    page.set_viewport_size({"width": 1400, "height": 900})
    # a test with the force aft of the contact point is a fold of its pair, which a link to one of its charts opens
    trail = page.locator("#test-lateral_force #test-lateral_force_trail")
    expect(trail.count() == 1 and not trail.evaluate("(fold) => fold.open"), "the test 30 mm aft is not folded into its pair")
    page.evaluate("location.hash = 'lateral_force_trail_steer_deg'")
    page.wait_for_selector('[id="lateral_force_trail_steer_deg"] svg.chart')
    page.evaluate("location.hash = ''")
    chart = first_chart(page)

    # the curve of each card is that of the columns in the table of the test, without the states in which a stop is in contact
    sparks = 0
    for own in (n for n in data["numbers"] if "curve" in n):
        curve = own["curve"]
        test = next(t for t in data["tests"] if t["name"] == curve["test"])
        states = list(enumerate(table(folder / test["file"])))[curve["first"]:curve["last"] + 1]
        good = [(k, row) for k, row in states if row["converged"] == "1"]
        free = [row for k, row in good if not any(c["first"] <= k <= c["last"] for c in test.get("contacts", []))]
        rows = free if len(free) > 4 else [row for _, row in good]
        sides = [(k, [float(row[y]) for row in rows]) for k, y in enumerate(curve["y"], 1) if y]
        low, high = min(min(ys) for _, ys in sides), max(max(ys) for _, ys in sides)
        if high - low < curve.get("span", 0.06 * max(abs(low), abs(high), 0.02)):
            continue
        for k, ys in sides:
            line = page.locator(f'.cards [data-number="{own["name"]}"] polyline.c{k}').get_attribute("points")
            drawn, wanted = [float(point.split(",")[1]) for point in line.split()], [27 - 24 * (y - low) / (high - low) for y in ys]
            expect(len(drawn) == len(wanted) and max(abs(a - b) for a, b in zip(drawn, wanted)) < 0.03, f"the curve of {own['name']} is not that of its table")
            sparks += 1
    expect(sparks > 5, f"{sparks} curves of cards")
    # without script: the lines of the assessment, and each K&C metric with its value and its name
    plain = browser.new_context(java_script_enabled=False).new_page()
    plain.goto(page_file.as_uri())
    words = plain.locator("main").inner_text()
    for own in data["numbers"]:
        values = [own["shown"]] if isinstance(own["shown"], str) else own["shown"]
        expect(f"Name: {own['name']}" in words and " | ".join(values) in words, f"without script, {own['name']} {values} is missing")
    missing = [line for line in page.locator("#summary .verdicts dd").all_inner_texts() if line not in words]
    expect(not missing, f"without script: {missing} are missing")
    print(f"{sparks} curves of cards; without script, {len(data['numbers'])} K&C metrics as text")
    plain.close()

    # hover: the values of the state in the table of the test
    test, read = data["tests"][0], hover(page, chart["id"], 0.8)
    rows, label = table(folder / test["file"]), page.locator(f'[id="{chart["id"]}"] svg.chart text').last.inner_html()
    expect(len(read) == len(chart["curves"]) and all(read), f"no value at the cursor: {read}")
    x = number(label.rsplit(": ", 1)[1])
    for curve, text in zip(chart["curves"], read):
        near = min(rows, key=lambda row: abs(float(row[curve["x"]]) - x))
        expect(abs(float(near[curve["y"]]) - number(text)) <= 1e-4 * max(1, abs(float(near[curve["y"]]))),
               f"{curve['y']} at {x}: {text} on the page, {near[curve['y']]} in {test['file']}")
    print(f"hover at {x}: {read}")
    # the cursor is common to the charts of a test
    marked = page.locator(f'#test-{test["name"]} svg.chart .hair[visibility=visible]').count()
    expect(marked > 1, f"the cursor is in {marked} chart")

    # a click sets the reference, from which the differences at the cursor are counted; a second click there removes it
    place, own_chart = data["tests"][0], f'[id="{chart["id"]}"]'
    left = chart["curves"][0]
    states = sorted((x, y) for x, y in zip(place["x"][left["x"]], place["y"][left["y"]]) if x is not None and y is not None)
    box = page.locator(f"{own_chart} svg.chart").bounding_box()
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 80)
    read = hover(page, chart["id"], 0.8)[0]
    label = page.locator(f"{own_chart} svg.chart text").last.inner_html()
    base, there = (dict(states)[min((x for x, _ in states), key=lambda x: abs(x - number(text)))]
                   for text in (label.split(",")[0].removeprefix("reference "), label.rsplit(": ", 1)[1]))
    expect(abs(number(read.split("Δref ")[1]) - (there - base)) <= 1e-3 * max(1, abs(there)), f"reference: {read}, {there} and {base} in the data")
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 80)
    expect("Δref" not in hover(page, chart["id"], 0.8)[0], "a second click does not remove the reference")
    page.mouse.move(5, 5)
    # a value at a state is that of the state; between two states it is called an interpolation
    (x0, y0), (x1, y1) = states[len(states) // 2], states[len(states) // 2 + 1]
    for x, y, words, sign in ((x0, y0, "a state of the test", ""), ((x0 + x1) / 2, (y0 + y1) / 2, "interpolated", "≈ "), (1e6, None, "outside", "")):
        page.fill(f"#test-{place['name']} .value-at input", repr(x))
        page.wait_for_timeout(120)
        read, said = page.locator(f"{own_chart} .keys output").first.inner_text(), page.locator(f"#test-{place['name']} .value-at output").inner_text()
        expect(words in said, f"value at {x}: {said}")
        expect(read == "" if y is None else read.startswith(sign) and abs(number(read.removeprefix(sign)) - y) <= 1e-4 * max(1, abs(y)),
               f"value at {x}: {read}, {y} in the data")
    page.fill(f"#test-{place['name']} .value-at input", "")

    # a click on the legend hides the curve, a second shows it
    curves, button = page.locator(f'[id="{chart["id"]}"] path.curve'), page.locator(f'[id="{chart["id"]}"] .keys button').first
    before = curves.count()
    button.click()
    expect(curves.count() == before - 1, "the legend does not hide a curve")
    button.click()
    expect(curves.count() == before, "the legend does not show a curve again")

    # zoom by dragging, and back
    box = page.locator(f'[id="{chart["id"]}"] svg.chart').bounding_box()
    wide = page.locator(f'[id="{chart["id"]}"] path.curve').first.get_attribute("d")
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 90)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 90, steps=4)
    page.mouse.up()
    expect(page.locator(f'[id="{chart["id"]}"] path.curve').first.get_attribute("d") != wide, "a drag does not zoom")
    page.mouse.dblclick(box["x"] + 0.5 * box["width"], box["y"] + 90)
    expect(page.locator(f'[id="{chart["id"]}"] path.curve').first.get_attribute("d") == wide, "a double click does not zoom back")
    # the keyboard moves the cursor
    page.mouse.move(5, 5)
    page.locator(f'[id="{chart["id"]}"] svg.chart').focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_timeout(120)
    expect(page.locator(f'[id="{chart["id"]}"] .keys output').first.inner_text() != "", "an arrow key does not move the cursor")

    mean, slow = min(page.evaluate(frames, chart["id"]) for _ in range(3))        # the machine has other work
    print(f"cursor: {mean:.1f} ms per frame, nine of ten within {slow:.1f} ms")
    expect(mean < 40, f"{mean:.1f} ms per frame while the cursor moves")

    # overlay
    page.set_input_files("input[type=file]", str(other))
    page.wait_for_selector(f'[id="{chart["id"]}"] path.curve.other')
    expect(curves.count() == 2 * before, f"{curves.count()} curves with another report, {2 * before} expected")
    read = hover(page, chart["id"], 0.8)
    expect(all("Δ" in text for text in read), f"no difference at the cursor: {read}")
    print(f"overlay: {read}")
    said, mine, theirs = page.locator("[role=status]").inner_text(), dict(data["deck"]), dict(json.loads(other.read_text())["deck"])
    steps = [f"{path} {mine[path]} → {theirs[path]}" for path in mine if mine[path] != theirs[path]]
    expect(steps and steps[0] in said, f"the overlay does not say what was changed: {said}")
    if shots:
        page.screenshot(path=str(shots / "overlay.png"))
    wrong = Path(tempfile.mkdtemp()) / "wrong.json"
    wrong.write_text("{}")
    page.set_input_files("input[type=file]", str(wrong))
    page.locator("[role=status]", has_text="cannot be overlaid").wait_for()      # a function would need eval, which the page forbids
    page.get_by_text("Remove overlay").click()
    expect(curves.count() == before, "the overlay is not removed")

    # the turntable: a drag turns it, a slider takes a state of the travel, in which the wheel centre is where the table has it
    space, canvas = data["turntable"], page.locator("#turntable canvas")
    canvas.scroll_into_view_if_needed()
    page.wait_for_timeout(100)
    drawn = [canvas.screenshot()]
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + 300, box["y"] + 150)
    page.mouse.down()
    page.mouse.move(box["x"] + 180, box["y"] + 180, steps=4)
    page.mouse.up()
    page.wait_for_timeout(100)
    drawn.append(canvas.screenshot())
    for m, motion in enumerate(space["motions"]):
        slider = page.locator("#turntable input").nth(2 + m)
        slider.focus()
        page.keyboard.press("End")
        page.wait_for_timeout(100)
        drawn.append(canvas.screenshot())
        own = next(t for t in data["tests"] if t["name"] == motion["test"])
        expect(abs(number(page.locator("#turntable output").nth(2 + m).inner_text()) - motion["values"][-1]) < 1e-3 * abs(motion["values"][-1]),
               f"the turntable does not show {motion['values'][-1]} {motion['label']}")
        if m == 0:
            wheel = page.evaluate("""() => { const own = document.getElementById('turntable').table, last = own.state, line = own.lines.find((l) => l.kind === 'wheel');
              const middle = (state) => { own.state = state; const p = own.points_of(line).slice(1); return [0, 1, 2].map((k) => p.reduce((sum, q) => sum + q[k], 0) / p.length); };
              const from = middle(own.own.motions[0].design), to = middle(last); return to.map((v, k) => v - from[k]); }""")
            rows = table(folder / own["file"])
            near = min(rows, key=lambda row: abs(float(row["left_wheel_travel_mm"]) - motion["values"][-1]))
            wanted = [float(near[f"left_wheel_centre_{axis}_mm"]) for axis in "xyz"]
            print(f"turntable at {motion['values'][-1]:.3f} mm: wheel centre from design {[round(v, 3) for v in wheel]}, table {wanted}")
            expect(max(abs(a - b) for a, b in zip(wheel, wanted)) < 1e-2, f"wheel centre moved by {wheel} on the turntable, {wanted} in the table")
    expect(len(set(drawn)) == len(drawn), "the turntable does not move")
    player, seen = page.locator("#turntable button"), set()
    player.click()
    for _ in range(4):
        page.wait_for_timeout(150)
        seen.add(page.evaluate("(() => { const t = document.getElementById('turntable').table; return `${t.motion} ${t.state}`; })()"))
    player.click()
    still = page.evaluate("document.getElementById('turntable').table.timer")
    expect(len(seen) == 4 and still == 0, f"play shows {seen}, and the timer is {still}")

    # filter
    page.evaluate("scrollTo(0, 0)")
    page.fill("input[type=search]", "ackermann")
    top = min(box["y"] for box in (hit.bounding_box() for hit in page.locator("figure.live:visible, .cards li:visible, .numbers tbody tr:visible").all()))
    expect(0 < top < 900, f"the first match of the filter is {top:.0f} pixels from the top")
    expect(page.locator("#summary .beside:visible, #picture:visible").count() == 0, "the filter shows summary and picture")
    titles = [t.inner_text() for t in page.locator("figure.live:visible figcaption b").all()]
    expect(titles and all("ackermann" in t.lower() for t in titles), f"the filter for ackermann shows {titles}")
    print(f"filter ackermann: {titles}")
    page.fill("input[type=search]", "")
    worst = {"light": page.evaluate(contrast)}
    # every fold open: axe-core passes over what is hidden
    page.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    serious = violations(page)
    expect(not serious, f"axe-core: {serious[:5]}")
    page.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = false; })")

    pdf = page.pdf(format="A4")
    pages = len(re.findall(rb"/Type\s*/Page[^s]", pdf))
    expect(pages <= 10, f"{pages} pages on paper")
    if shots:
        (shots / "print.pdf").write_bytes(pdf)
    page.close()

    for width in (1400, 800, 390):
        for scheme in ("light", "dark"):
            page = new_page(browser, page_file, width, scheme, messages, requests)
            needs = page.evaluate("document.documentElement.scrollWidth")
            expect(needs <= width, f"needs {needs} pixels on a screen {width} pixels wide")
            if width == 390:
                cut = page.evaluate("""() => { const folds = [...document.querySelectorAll('details:not([open])')];
                  folds.forEach((fold) => { fold.open = true; });
                  const cut = [...document.querySelectorAll('.scroll')].filter((box) => box.scrollWidth > box.clientWidth + 1).length;
                  folds.forEach((fold) => { fold.open = false; });
                  return cut; }""")
                expect(cut == 0, f"{cut} tables are cut at {width} pixels")
            page.evaluate("scrollTo(0, 3000)")
            expect(page.locator("input[type=search]").bounding_box()["y"] < 900, f"the contents do not stay at {width} pixels")
            page.evaluate("scrollTo(0, 0)")
            if scheme == "dark" and width == 1400:
                first_chart(page)
                worst["dark"] = page.evaluate(contrast)
            if shots:
                page.screenshot(path=str(shots / f"top_{width}_{scheme}.png"))
                first_chart(page)
                page.wait_for_timeout(300)
                page.screenshot(path=str(shots / f"charts_{width}_{scheme}.png"))
            page.close()

    # from the address to the first chart, where the address shows the first test; the best of three
    first, busy = 1e9, {}
    for _ in range(3):
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        metrics = page.context.new_cdp_session(page)
        metrics.send("Performance.enable")
        page.goto(f'{page_file.as_uri()}#test-{data["tests"][0]["name"]}')
        page.wait_for_selector("svg.chart")
        took = int(page.evaluate("document.documentElement.dataset.firstChart"))
        if took < first:
            first, busy = took, {m["name"]: m["value"] for m in metrics.send("Performance.getMetrics")["metrics"]}
        page.close()
    print(f"up to then the page worked {1e3 * busy['TaskDuration']:.0f} ms, of which {1e3 * busy['ScriptDuration']:.0f} ms script")
    expect(first < 1000, f"first chart after {first} ms")
    browser.close()

for scheme, (ratio, node) in worst.items():
    expect(ratio >= 4.5, f"contrast {ratio:.2f} ({scheme}): {node}")
expect(not messages, f"console: {messages[:3]}")
expect(all(r == page_file.as_uri() or r.startswith("data:") for r in requests), f"requests: {sorted(set(requests))[:5]}")
print(f"first chart after {first} ms, {pages} pages on paper, {len(serious)} serious by axe-core, contrast "
      + ", ".join(f"{ratio:.1f} {scheme}" for scheme, (ratio, _) in worst.items()))
for text in failures:
    print(f"FAILED {page_file}: {text}")
sys.exit(1 if failures else 0)
