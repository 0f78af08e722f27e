"""Opens the page of `report --live` in headless Chromium, moves sliders, and runs the program with the same rates.

    live_rates_in_a_browser.py PROGRAM DECK FOLDER [--shots DIR] [path=value ...]

FOLDER receives the reports, of the deck with the settings. Where the page states that it is exact at design, its numbers must be those
of the program to 1e-9; where it states a deviation from runs, to this deviation; otherwise to 1e-3, and to 2e-2 at the height of the deck if its wheels settle under its loads. Requires playwright (PyPI) and a Chromium in the path. Prints what it measured; exit status
1 with a line per failure.
"""
import json, re, shlex, shutil, subprocess, sys
from pathlib import Path
from playwright.sync_api import sync_playwright
from browser import contrast

program, deck, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3]).resolve()
rest = sys.argv[4:]
shots = Path(rest[1]) if rest[:1] == ["--shots"] else None
own_settings = [word for setting in rest[2 if shots else 0:] for word in ("--set", setting)]
sliders, failures = 5, []


def expect(is_good, text):
    if not is_good:
        failures.append(text)


def report(name, *options):
    subprocess.run([program, "report", deck, "--no-plots", "--quiet", "--out", folder / name, *own_settings, *options],
                   check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / name / "data.json").read_text())


# Times of a redraw while a slider moves, in ms, charts in view: the fastest, a quarter of all within, the median. The quarter is
# that of a machine that other programs use at times
redraw = """() => new Promise((done) => {
  const slider = document.getElementById('rate-0'), times = [];
  let k = 0;
  const step = () => {
    slider.value = ((k * 7) % 200 - 100) / 100 + 0.005;
    const start = performance.now();
    slider.dispatchEvent(new Event('input'));
    times.push(performance.now() - start);
    if (++k < 60) return requestAnimationFrame(step);
    times.sort((a, b) => a - b);
    done([times[0], times[15], times[30]]);
  };
  step();
})"""

data = report("deck", "--live", str(sliders + 3))
page_file = folder / "deck" / "report.html"
print(f"{deck.name}: {len(data['live']['rates'])} rates, page of {page_file.stat().st_size / 1e3:.0f} kB")
messages, requests = [], []
with sync_playwright() as tool:
    program_of_pages = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
    browser = tool.chromium.launch(executable_path=program_of_pages, args=["--no-sandbox"])

    def open_page(width, scheme="light"):
        page = browser.new_page(viewport={"width": width, "height": 900}, color_scheme=scheme)
        page.on("console", lambda m: messages.append(m.text))
        page.on("pageerror", lambda e: messages.append(str(e)))
        page.on("request", lambda r: requests.append(r.url))
        page.goto(page_file.as_uri())
        return page

    page = open_page(1400)
    marked = ".changed:visible, figure.has-what-if, .what-if:visible"
    expect(page.locator(marked).count() == 0, "an unchanged page is marked")
    rows = page.locator("#what-if tbody tr")
    deck_texts = rows.all_inner_texts()
    count = min(sliders, len(data["live"]["rates"]))
    # by the keyboard: from the first slider with Tab (slider, number, slider …), up or down with the arrows
    page.locator("#rate-0").focus()
    for k in range(count):
        here = page.evaluate("document.activeElement.id")
        expect(here == f"rate-{k}", f"Tab does not reach slider {k}, but {here!r}")
        for _ in range(8 + 5 * k):
            page.keyboard.press("ArrowLeft" if k % 2 else "ArrowRight")
        page.keyboard.press("Tab")
        page.keyboard.press("Tab")
    # a number beyond the slider
    number = page.locator("#what-if input[type=number]").first
    number.fill(str(20 * data["live"]["rates"][0]["value"]))
    number.press("Enter")
    page.wait_for_timeout(300)
    statement = page.locator("#what-if li").first.inner_text()
    reruns = data["live"].get("reruns")
    limit = 1e-9 if "exact. A run" in statement else reruns["deviation"] if reruns else 1e-3
    expect(not reruns or " runs with rates of 0.1 and 10 times" in statement, f"no measured deviation: {statement}")
    settings = shlex.split(page.locator("#what-if code").inner_text())
    expect(page.locator(".what-if:visible").count() >= 2, "the changed page is not marked at its top and beside its contents")
    expect(page.locator(".cards .changed:visible, .numbers .changed:visible").count() > 0, "no number beside those of the deck")
    changed = {row.get_attribute("data-name"): (row.get_attribute("data-left"), row.get_attribute("data-right")) for row in rows.all()}

    # a deck whose wheels settle under its loads: the page says that the start moves. Its numbers are those at the former height, but for the
    # change of the state there, which the page gives to first order
    start = json.loads((folder / "deck" / "key_numbers.json").read_text()).get("start_state", "")
    settles = "all tests start where the wheels settle" in start
    expect(settles == ("its tests would start where the wheels settle" in statement), f"start state '{start}', but: {statement}")
    if settles:
        limit = 2e-2
        settings += ["--set", "model.start_height=" + re.search(r"settle under them, (-?[0-9.]+) mm", start)[1]]
    again = report("rerun", *settings)
    numbers = {n["name"]: n for n in again["numbers"]}
    before = {n["name"]: n for n in data["numbers"]}
    worst, moved = (0.0, ""), 0
    for name, sides in changed.items():
        for side, text in zip(("left", "right"), sides):
            if not text:
                continue
            is_value, was = numbers[name][side], before[name][side]
            worst = max(worst, (abs(float(text) - is_value) / max(abs(is_value), 1e-6), f"{name}, {side}"))
            moved += abs(is_value - was) > 1e-3 * abs(was)
    expect(moved > 3, f"only {moved} numbers changed")
    expect(worst[0] < limit, f"{worst[1]}: {worst[0]:.1e} from the program")
    print(f"{count} rates changed, {moved} numbers by more than 0.1 %: within {worst[0]:.1e} of the program ({worst[1]})")
    print(statement)

    # the curves: at design those of the program
    figure = page.locator("#what-if figure.live").last
    if figure.count():
        figure.scroll_into_view_if_needed()
        figure.locator("svg.chart").focus()
        page.keyboard.press("ArrowRight")
        page.keyboard.press("ArrowLeft")
        page.wait_for_timeout(150)
        read = figure.locator(".keys output").first.inner_text()
        test = next(t for t in again["tests"] if t["name"] == data["live"]["tests"][0]["name"])
        chart = next(c for c in test["charts"] if f"live-{c['id']}" == figure.get_attribute("id"))
        value = test["y"][chart["curves"][0]["y"]][test["design"]]
        expect("deck" in read, f"the deck is not beside the changed value: {read}")
        expect(abs(float(read.split(",")[0].replace("−", "-")) - value) <= max((limit if settles else 1e-4) * abs(value), 6e-5),
               f"{chart['id']} at design: {read} on the page, {value} by the program")
        expect(figure.locator("path.curve.deck").count() > 0, "the curve of the deck is not drawn")
        print(f"{chart['id']} at design: {read}; {value} by the program")
    least, quarter, median = page.evaluate(redraw)
    print(f"redraw: median {median:.1f} ms, a quarter within {quarter:.1f} ms, fastest {least:.1f} ms")
    expect(quarter < 5, f"{quarter:.1f} ms per redraw")
    page.wait_for_timeout(200)
    worst_contrast = page.evaluate(contrast)
    expect(worst_contrast[0] >= 4.5, f"contrast {worst_contrast}")

    page.get_by_role("button", name="Reset all rates").press("Enter")
    page.wait_for_timeout(300)
    expect(page.locator(marked).count() == 0, "a page whose rates were reset is marked")
    expect(rows.all_inner_texts() == deck_texts, "the numbers do not return to those of the deck")
    page.close()

    for width, scheme in ((1400, "dark"), (800, "light"), (390, "light"), (390, "dark")):
        page = open_page(width, scheme)
        page.locator("#rate-0").press("PageUp")
        page.wait_for_timeout(300)
        needs = page.evaluate("document.documentElement.scrollWidth")
        expect(needs <= width, f"needs {needs} pixels on a screen {width} pixels wide")
        worst_contrast = page.evaluate(contrast)
        expect(worst_contrast[0] >= 4.5, f"contrast {worst_contrast} ({scheme})")
        if shots:
            page.screenshot(path=str(shots / f"live_top_{width}_{scheme}.png"))
            page.evaluate("document.getElementById('what-if').scrollIntoView()")
            page.screenshot(path=str(shots / f"live_{width}_{scheme}.png"))
        page.close()
    browser.close()

expect(not messages, f"console: {messages[:3]}")
expect(all(r == page_file.as_uri() or r.startswith("data:") for r in requests), f"requests: {sorted(set(requests))[:5]}")
for text in failures:
    print(f"FAILED {deck}: {text}")
sys.exit(1 if failures else 0)
