#!/usr/bin/env python3
"""check_site.py FOLDER [PICTURES]: opens every page of a built site in headless Chromium, 1400 and 390 pixels wide, from a server of this machine.

Status 1 if a page writes to the console, asks another server for anything, misses a file or is wider than the window; or if the search finds nothing.
Where the tutorial contains the workbench, it must solve the deck of the tutorial, also in a page from file://.
With PICTURES some pages are saved there as PNG. Requires playwright (PyPI) and chromium.
"""
import functools
import http.server
import shutil
import sys
import threading
from pathlib import Path

from playwright.sync_api import sync_playwright

site = Path(sys.argv[1]).resolve()
pictures = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
shown = ["index.html", "tutorial.html", "gallery.html", "conventions.html", "joints.html", "input/index.html", "theory/kkt.html"]


class Server(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=site))
threading.Thread(target=server.serve_forever, daemon=True).start()
home = f"http://127.0.0.1:{server.server_port}/"
pages = sorted(str(path.relative_to(site)) for path in site.rglob("*.html"))
pages = [page for page in pages if not page.startswith("reports/") and page != "404.html"]
wrong = []

browser_path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
with sync_playwright() as play:
    browser = play.chromium.launch(executable_path=browser_path, args=["--no-sandbox"])
    for width, height in (1400, 900), (390, 844):
        tab = browser.new_page(viewport={"width": width, "height": height})
        here = ""
        tab.on("console", lambda message: message.type in ("error", "warning") and wrong.append(f"{here}: console: {message.text}"))
        tab.on("pageerror", lambda error: wrong.append(f"{here}: {error}"))
        tab.on("request", lambda request: request.url.startswith((home, "data:", "blob:")) or wrong.append(f"{here}: requests {request.url}"))
        tab.on("response", lambda response: response.status < 400 or wrong.append(f"{here}: {response.status} {response.url}"))
        for here in pages:
            tab.goto(home + here)
            needs = tab.evaluate("document.documentElement.scrollWidth")
            if needs > width:
                wrong.append(f"{here}: needs {needs} pixels of {width}")
            if tab.locator("h1").count() < 1:
                wrong.append(f"{here}: no heading")
            if pictures and here in shown:
                pictures.mkdir(parents=True, exist_ok=True)
                tab.screenshot(path=pictures / f"{here.replace('/', '_')[:-5]}_{width}.png")
        here = "search.html"
        tab.goto(home + here + "?q=ackermann")
        tab.wait_for_selector("#mkdocs-search-results article", timeout=20000)
        found = tab.locator("#mkdocs-search-results article").count()
    if (site / "workbench.html").exists():
        for here in home + "tutorial.html", (site / "tutorial.html").as_uri():
            tab = browser.new_page(viewport={"width": 1400, "height": 900})
            tab.on("console", lambda message: message.type in ("error", "warning") and wrong.append(f"{here}: console: {message.text}"))
            tab.goto(here)
            tab.locator("iframe.workbench").scroll_into_view_if_needed()
            frame = tab.frame_locator("iframe.workbench")
            frame.locator("#status.good").wait_for(timeout=120000)
            frame.locator("[data-tab=points]").click()
            frame.locator("#charts figure").nth(5).wait_for(timeout=120000)
            if frame.locator("#deck").input_value() != "front.nml" or frame.locator("#file option").count() != 2:
                wrong.append(f"{here}: the workbench does not contain the deck of the tutorial")
            if pictures:
                tab.screenshot(path=pictures / "tutorial_workbench.png")
            tab.close()
    browser.close()
server.shutdown()

print(*wrong, sep="\n")
print(f"remark: {len(pages)} pages, the search finds {found} places for 'ackermann'")
sys.exit(1 if wrong or not found else 0)
