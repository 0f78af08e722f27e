"""Opens the page of a comparison in headless Chromium and uses it: hover, legend, filter, folds, print.

    comparison_in_a_browser.py FOLDER REPORT_A REPORT_B [--shots DIR]

FOLDER has compare.html and its tables. Requires playwright (PyPI) and a Chromium in the path. Prints what it measured; exit
status 1 with a line per failure.
"""
import json, re, sys
from pathlib import Path
from playwright.sync_api import sync_playwright
from browser import contrast, hover, new_page, number, start, table, violations

folder, *reports = (Path(name).resolve() for name in sys.argv[1:4])
shots = Path(sys.argv[5]) if len(sys.argv) > 5 else None
page_file, failures = folder / "compare.html", []
text = page_file.read_text()
data = json.loads(text.split('<script type="application/json" id="data">', 1)[1].split("</script>", 1)[0])
numbers, curves = table(folder / "number-differences.csv"), table(folder / "curve-differences.csv")


def expect(is_good, text):
    if not is_good:
        failures.append(text)


def chart_on(page, verdict):
    """A chart of the first test with two curves and this verdict, in view."""
    test = data["tests"][0]
    names = {c["quantity"] for c in curves if c["test"] == test["name"] and c["verdict"] == verdict}
    chart = next(c for c in test["charts"] if not c.get("level") and c["id"][len(test["name"]) + 1:] in names
                 and page.locator(f'[id="{c["id"]}"]').is_visible() and (verdict == "same" or len(c["curves"]) == 2))
    page.locator(f'[id="{chart["id"]}"]').scroll_into_view_if_needed()
    page.wait_for_selector(f'[id="{chart["id"]}"] svg.chart')
    return test, chart


with sync_playwright() as tool:
    browser = start(tool)
    messages, requests = [], []
    page = new_page(browser, page_file, 1400, "light", messages, requests)
    size = page_file.stat().st_size
    expect(size < 1.5e6, f"compare.html has {size} bytes")
    # what was changed and its largest consequence are seen without scrolling
    for part, where in (("change", "#changed tbody tr"), ("consequence", "#results tbody tr")):
        top = page.locator(where).first.bounding_box()["y"]
        expect(top < 900, f"the first {part} is {top:.0f} pixels from the top")
    started = page.evaluate("performance.timing.domContentLoadedEventEnd - performance.timing.navigationStart")
    print(f"loaded after {started} ms, the largest change {top:.0f} pixels from the top")
    head = page.locator("#changed").inner_text()
    for row in table(folder / "deck-differences.csv"):
        expect(row["path"] in head and row["b"] in head, f"{row['path']} is not among what was changed")
    said = page.locator("#results p b").all_inner_texts()
    expect(re.fullmatch(r"\d+ of \d+ K&C metrics and gradients changed by more than 1 %", said[0]), f"verdict: {said}")
    # each row has the values of a row of the CSV files, and the rows are sorted by their change there
    rows = page.locator("#results table", has_text="change %").first.locator("tbody tr").all()
    cells = [row.locator("td").all_inner_texts() for row in rows]
    words = {cell[4] for cell in cells if not re.match("[−\\d]", cell[4])}
    expect(words <= {"from 0", "opposite sign"}, f"in the column of percentages: {words}")
    kept = [[float(row[name]) for name in ("a", "b", "change")] for row in numbers + table(folder / "differences.csv") if row["change"]]
    last = float("inf")
    for cell in cells:
        near = [abs(change) for a, b, change in kept
                if all(abs(value - number(text)) <= 6e-5 + 6e-4 * abs(value) for value, text in ((a, cell[1]), (b, cell[2])))]
        below = [change for change in near if change <= last * (1 + 1e-9)]
        expect(below and max(below) > 0.01, f"not in the CSV files, or not sorted by change ({last}): {cell}, {near}")
        last = max(below, default=last)

    # hover: the values of both reports, and their difference
    test, chart = chart_on(page, "changed")
    read = hover(page, chart["id"], 0.8)
    x = number(page.locator(f'[id="{chart["id"]}"] svg.chart text').last.inner_html().rsplit(": ", 1)[1])
    found = []
    for report, curve, words in zip(reports, chart["curves"], read):
        near = min(table(report / Path(test["file"]).name), key=lambda row: abs(float(row[curve["x"].removeprefix("B ")]) - x))
        value = float(near[curve["y"].removeprefix("B ")])
        found.append(value)
        expect(abs(value - number(words.split(" ")[0])) <= 1e-4 * max(1, abs(value)), f"{curve['y']} at {x}: {words}, {value} in the CSV")
    expect("Δ" not in read[0] and "Δ" in read[1], f"difference at the cursor: {read}")
    expect(abs(number(read[1].split("Δ ")[1]) - (found[1] - found[0])) <= 1e-3, f"difference at the cursor: {read}, of {found}")
    print(f"hover on {chart['id']} at {x}: {read}")

    # the legend hides and shows a curve
    drawn, button = page.locator(f'[id="{chart["id"]}"] path.curve'), page.locator(f'[id="{chart["id"]}"] .keys button').first
    button.click()
    expect(drawn.count() == 1, "the legend does not hide a curve")
    button.click()
    expect(drawn.count() == 2, "the legend does not show a curve again")

    # charts without a change are folded
    unchanged = page.locator("details.more:has(figure)", has_text="without a change")
    expect(unchanged.count() > 0 and not unchanged.first.locator("figure").first.is_visible(), "what did not change is not folded")

    # a link of the summary opens the fold of its chart
    goal = unchanged.first.locator("figure").first.get_attribute("id")
    page.evaluate("(id) => { location.hash = id; }", goal)
    page.wait_for_selector(f'[id="{goal}"] svg.chart')
    expect(page.locator("#results td a").count() > 0, "the charts that changed most are not linked")

    # filter, also in folds
    page.fill("input[type=search]", "camber")
    titles = page.locator("figure.live:visible figcaption b").all_inner_texts()
    expect(titles and all("camber" in t.lower() for t in titles), f"the filter for camber shows {titles[:9]}")
    rows = page.locator(".numbers tbody tr:visible").all_inner_texts()
    expect(rows and all("camber" in t.lower() for t in rows), f"the filter for camber shows {rows[:3]}")
    page.fill("input[type=search]", "")
    expect(not page.get_by_text("Overlay data.json").is_visible(), "a comparison offers an overlay")
    worst = {"light": page.evaluate(contrast)}
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
            if shots:
                page.screenshot(path=str(shots / f"top_{width}_{scheme}.png"))
            chart_on(page, "changed")
            page.wait_for_timeout(200)
            if scheme == "dark":
                worst["dark"] = min(worst.get("dark", [99, ""]), page.evaluate(contrast))
            if shots:
                page.screenshot(path=str(shots / f"charts_{width}_{scheme}.png"))
            page.close()
    browser.close()

for scheme, (ratio, node) in worst.items():
    expect(ratio >= 4.5, f"contrast {ratio:.2f} ({scheme}): {node}")
expect(not messages, f"console: {messages[:3]}")
expect(all(r == page_file.as_uri() or r.startswith("data:") for r in requests), f"requests: {sorted(set(requests))[:5]}")
print(f"comparison: {size / 1e3:.0f} kB, {said[0]}, {pages} pages on paper, {len(serious)} serious by axe-core, contrast "
      + ", ".join(f"{ratio:.1f} {scheme}" for scheme, (ratio, _) in worst.items()))
for text in failures:
    print(f"FAILED {page_file}: {text}")
sys.exit(1 if failures else 0)
