"""What the scripts that use a page in headless Chromium share (report, comparison and rates)."""
import csv, shutil
from importlib import resources


def number(text):
    return float(text.replace("−", "-"))


def table(path):
    """The rows of a CSV file by the names of its columns."""
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))


def start(tool):
    program = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
    return tool.chromium.launch(executable_path=program, args=["--no-sandbox"])


def new_page(browser, file, width, scheme, messages, requests):
    """Opens a file; console messages and requests are appended to the lists."""
    page = browser.new_page(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page.on("console", lambda m: messages.append(m.text))
    page.on("pageerror", lambda e: messages.append(str(e)))
    page.on("request", lambda r: requests.append(r.url))
    page.goto(file.as_uri())
    return page


def violations(page):
    """What axe-core finds in a page that is serious or critical: a line each."""
    page.evaluate(resources.files("axe_playwright_python").joinpath("axe.min.js").read_text())
    found = page.evaluate("() => axe.run(document, { resultTypes: ['violations'] })")["violations"]
    return [f"{v['id']} ({v['impact']}): {v['nodes'][0]['html'][:120]}" for v in found if v["impact"] in ("serious", "critical")]


def hover(page, id, share):
    """Moves the pointer to a share of a chart's width; the texts of its values there."""
    box = page.locator(f'[id="{id}"] svg.chart').bounding_box()
    page.mouse.move(box["x"] + box["width"] * share, box["y"] + 80)
    page.wait_for_timeout(120)
    return [k.inner_text() for k in page.locator(f'[id="{id}"] .keys output').all()]


# Contrast of every text against what is behind it (WCAG 2), in the page
contrast = """() => {
  const rgba = (text) => { const k = text.match(/[\\d.]+/g).map(Number); return k.length < 4 ? [...k, 1] : k; };
  const light = (c) => { const f = c.slice(0, 3).map((v) => { v /= 255; return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
    return 0.2126 * f[0] + 0.7152 * f[1] + 0.0722 * f[2]; };
  const behind = (node) => { for (; node; node = node.parentElement) { const c = rgba(getComputedStyle(node).backgroundColor);
    if (c[3] > 0.99) return c; } return [255, 255, 255, 1]; };
  let worst = [99, ''];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || node.closest('script,noscript') || !node.getClientRects().length) continue;
    const look = getComputedStyle(node), a = light(rgba(node.closest('svg') ? look.fill : look.color)), b = light(behind(node));
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < worst[0]) worst = [ratio, node.outerHTML.slice(0, 90)];
  }
  return worst;
}"""
