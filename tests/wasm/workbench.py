"""elastokin.html in headless Chromium, from file:// and without a network, for the tests of this folder. Requires playwright (PyPI) and a
Chromium in the path.
"""
import math
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

patient = 120000     # ms: the machine may be busy


class Workbench:
    """The page, what it wrote to the console and requested, and the failures of the test."""

    def __init__(self, page_file, shots=None):
        self.file, self.shots = Path(page_file).resolve(), shots and Path(shots)
        self.failures, self.messages, self.requests, self.clicks = [], [], [], 0
        self.tool = sync_playwright().start()
        program = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
        self.browser = self.tool.chromium.launch(executable_path=program, args=["--no-sandbox"])
        self.context = self.browser.new_context(viewport={"width": 1280, "height": 900}, accept_downloads=True)
        self.open()

    def open(self):
        """Opens the page; resolves when its program can run."""
        page = self.page = self.context.new_page()
        page.on("console", lambda m: self.messages.append(m.text))
        page.on("pageerror", lambda e: self.messages.append(str(e)))
        page.on("request", lambda r: None if r.url.startswith(("file:", "blob:", "data:", "about:")) else self.requests.append(r.url))
        page.on("dialog", lambda d: d.accept())
        page.goto(self.file.as_uri())
        self.status, self.keys = page.locator("#status"), page.keyboard
        expect(self.status).not_to_contain_text("unpacked", timeout=patient)

    def require(self, is_good, text):
        if not is_good:
            self.failures.append(text)

    def said(self, text):
        expect(self.status).to_contain_text(text, timeout=patient)

    def text(self):
        return self.page.evaluate("elastokin.text()")

    def deck(self, name):
        self.page.select_option("#library", name)
        self.said("check: done")

    def put_text(self, text):
        """Replaces the text of the editor, by the keyboard and the clipboard."""
        self.page.focus("#text")
        self.keys.press("Control+a")
        self.page.evaluate("""(text) => {
          const data = new DataTransfer();
          data.setData("text/plain", text);
          document.getElementById("text").dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
        }""", text)

    def drop(self, files):
        """Drops files on the page, name -> text."""
        data = self.page.evaluate_handle("""(files) => {
          const data = new DataTransfer();
          for (const [name, text] of Object.entries(files)) data.items.add(new File([text], name));
          return data;
        }""", files)
        self.page.dispatch_event("body", "drop", {"dataTransfer": data})

    def curves(self):
        """The curves as drawn, when they belong to the document."""
        end = time.monotonic() + patient / 1000     # the page allows no eval, which wait_for_function needs
        while time.monotonic() < end:
            found = self.page.evaluate("elastokin.curves()")
            if found["isCurrent"] and found.get("columns"):
                return found
            time.sleep(0.02)
        raise TimeoutError("no curves")

    def is_bad(self):
        """Whether the page says that the document could not be solved."""
        return self.page.locator("#said").get_attribute("class") == "bad"

    def shot(self, name):
        if self.shots:
            self.shots.mkdir(parents=True, exist_ok=True)
            self.page.screenshot(path=self.shots / f"{name}.png")

    def end(self, words):
        """Closes the browser, prints the failures and `words`, and ends with status 1 after a failure."""
        self.browser.close()
        self.tool.stop()
        self.require(not self.messages, f"the page wrote to the console: {self.messages[:3]}")
        self.require(not self.requests, f"the page requested {self.requests[:3]}")
        for line in self.failures:
            print(f"FAILED: {line}")
        print(f"{words}, {len(self.failures)} failures")
        sys.exit(bool(self.failures))


def native_curves(program, files, deck, test, settings=""):
    """The columns of a test by the native program, name -> numbers, or None; of files, name -> text, with settings as in a --set-file."""
    with tempfile.TemporaryDirectory() as work:
        for name, text in files.items():
            (Path(work) / name).write_text(text)
        (Path(work) / "changes.set").write_text(settings)
        words = [Path(program).resolve(), "run", deck, "--case", test, "--increments", "20", "--set-file", "changes.set", "--out", "out", "--quiet"]
        subprocess.run(words, cwd=work, text=True, capture_output=True)
        found = list(Path(work).glob("out/*.csv"))
        if not found:
            return None
        rows = [line.split(",") for line in found[0].read_text().splitlines() if line and not line.startswith("#")]
        return {name: [float(row[k] or "nan") for row in rows[1:]] for k, name in enumerate(rows[0])}


def difference(drawn, wanted):
    """The largest difference of columns, relative to the largest number of the column (at least 1), and the name of this column."""
    worst = (0.0, "")
    for name, values in drawn.items():
        numbers, values = wanted[name], [math.nan if value is None else value for value in values]
        if len(numbers) != len(values):
            return math.inf, name
        scale = max([1.0, *(abs(number) for number in numbers if number == number)])
        for number, value in zip(numbers, values):
            one = 0.0 if number != number and value != value else abs(number - value) / scale
            worst = max(worst, (math.inf if one != one else one, name))
    return worst
