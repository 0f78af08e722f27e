"""Opens the pages of studies in headless Chromium: width, contrast, axe-core, console, requests, paper.

    study_in_a_browser.py PAGE.html... [--shots DIR]

Requires playwright and axe-playwright-python (PyPI) and a Chromium in the path. Prints what it measured; exit status 1 with a line
per failure.
"""
import re, sys
from pathlib import Path
from playwright.sync_api import sync_playwright
from browser import contrast, new_page, start, violations

arguments = sys.argv[1:]
shots = Path(arguments.pop()) if "--shots" in arguments else None
pages, failures = [Path(name).resolve() for name in arguments if name != "--shots"], []

with sync_playwright() as tool:
    browser = start(tool)
    for file in pages:
        def expect(is_good, text):
            if not is_good:
                failures.append(f"{file}: {text}")

        messages, requests, worst = [], [], {}
        for width in (1400, 800, 390):
            for scheme in ("light", "dark"):
                page = new_page(browser, file, width, scheme, messages, requests)
                needs = page.evaluate("document.documentElement.scrollWidth")
                expect(needs <= width, f"needs {needs} pixels on a screen {width} pixels wide")
                if shots:
                    page.screenshot(path=str(shots / f"{file.stem}_{width}_{scheme}.png"))
                page.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
                if width == 1400:
                    worst[scheme] = page.evaluate(contrast)
                    expect(worst[scheme][0] >= 4.5, f"contrast {worst[scheme][0]:.2f} ({scheme}): {worst[scheme][1]}")
                serious = violations(page)
                expect(not serious, f"axe-core at {width} pixels: {serious[:5]}")
                page.close()
        page = new_page(browser, file, 1400, "light", messages, requests)
        paper = len(re.findall(rb"/Type\s*/Page[^s]", page.pdf(format="A4")))
        page.close()
        expect(not messages, f"console: {messages[:3]}")
        expect(all(r == file.as_uri() or r.startswith("data:") for r in requests), f"requests: {sorted(set(requests))[:5]}")
        print(f"{file.name}: {file.stat().st_size / 1e3:.0f} kB, {paper} pages on paper, contrast "
              + ", ".join(f"{ratio:.1f} {scheme}" for scheme, (ratio, _) in worst.items()))
    browser.close()

for text in failures:
    print(f"FAILED {text}")
sys.exit(1 if failures else 0)
