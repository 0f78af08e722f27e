// The page of a report: its tests with their charts, the filter, and another report's data laid over it.

// What the charts of one test share.
class Test {
  constructor(own, section) {
    Object.assign(this, { data: own, section, other: null, cursor: null, snapped: null, zoom: null, hidden: new Set() });
    this.charts = own.charts.map((c) => [document.getElementById(c.id), c]).filter(([figure]) => figure)
      .map(([figure, c]) => new Chart(this, figure, c));
    this.frame = 0;
  }

  redraw() { for (const chart of this.charts) if (chart.is_drawn) chart.draw(); }

  move(x, chart) {
    const curve = chart.curves[0], k = x === null ? -1 : nearest(curve.x, curve.y, x);
    this.cursor = x;
    this.snapped = k < 0 ? x : curve.x[k];
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      for (const one of this.charts) if (one.is_drawn && one.is_visible) one.show_cursor();
    });
  }

  step(step, chart) {
    const { x, y } = chart.curves[0], order = x.map((_, k) => k).filter((k) => x[k] !== null && y[k] !== null).sort((a, b) => x[a] - x[b]);
    const at = order.indexOf(this.cursor === null ? this.data.design : nearest(x, y, this.cursor));
    this.move(x[order[Math.min(order.length - 1, Math.max(0, at + step))]], chart);
  }

  toggle(name) {
    this.hidden.has(name) ? this.hidden.delete(name) : this.hidden.add(name);
    const label = document.activeElement && document.activeElement.textContent, figure = document.activeElement.closest("figure");
    this.redraw();
    if (figure) [...figure.querySelectorAll("button")].find((b) => label.startsWith(b.firstChild.nextSibling.textContent))?.focus();
  }

  zoom_to(ends) { this.zoom = ends; this.redraw(); }

  zoom_in() {
    const xs = Object.values(this.data.x)[0].filter((x) => x !== null), [a, b] = this.zoom || [Math.min(...xs), Math.max(...xs)];
    const middle = this.snapped ?? (a + b) / 2;
    this.zoom_to([Math.max(a, middle - (b - a) / 4), Math.min(b, middle + (b - a) / 4)]);
  }
}

const tests = (data.tests || []).map((own) => [own, document.getElementById(`test-${own.name}`)]).filter(([, section]) => section)
  .map(([own, section]) => new Test(own, section));
const charts = tests.flatMap((t) => t.charts), of_figure = new Map(charts.map((c) => [c.figure, c]));

// A chart is drawn when it comes into view for the first time.
const watcher = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    const chart = of_figure.get(entry.target);
    chart.is_visible = entry.isIntersecting;
    if (chart.is_visible && !chart.is_drawn) chart.draw();
    else if (chart.is_visible) chart.show_cursor();
    if (chart.is_visible && !page.dataset.firstChart) page.dataset.firstChart = performance.now().toFixed(0);
  }
}, { rootMargin: "300px" });
for (const chart of charts) watcher.observe(chart.figure);
addEventListener("resize", () => requestAnimationFrame(() => tests.forEach((t) => t.redraw())));
addEventListener("beforeprint", () => {
  for (const chart of charts) if (!chart.is_drawn && !chart.figure.closest("details")) chart.draw();
});

// Controls, in the bar of contents: they need this script, so they are made here.
const bar = document.querySelector("nav"), controls = document.createElement("div"), status = document.createElement("p");
controls.className = "controls";
controls.innerHTML = '<input type="search" aria-label="Filter charts and numbers" placeholder="Filter, e.g. camber">' +
  '<label class="button">Overlay data.json<input type="file" accept=".json,application/json"></label>' +
  '<button type="button" hidden>Remove overlay</button>';
status.setAttribute("role", "status");
bar.append(controls, status);
const [search, choose, remove] = controls.children, file = controls.querySelector("input[type=file]");
choose.hidden = !data.numbers;
controls.hidden = status.hidden = tests.length === 0;

// Charts by their title, numbers by their name; a folded block with a match opens.
search.addEventListener("input", () => {
  const terms = search.value.toLowerCase().split(/\s+/).filter(Boolean), fits = (text) => terms.every((w) => text.toLowerCase().includes(w));
  let found = 0;
  for (const test of tests) {
    let some = 0;
    for (const { figure, description } of test.charts) {
      figure.hidden = !fits(`${description.title} ${test.data.title}`);
      if (!figure.hidden) some++;
    }
    for (const fold of test.section.querySelectorAll("details.more"))
      fold.open = terms.length > 0 && [...fold.querySelectorAll("figure")].some((f) => !f.hidden);
    test.section.hidden = some === 0 && terms.length > 0;
    found += some;
  }
  for (const row of document.querySelectorAll(".cards li, .numbers tbody tr")) row.hidden = !fits(row.textContent);
  for (const table of document.querySelectorAll(".numbers")) table.hidden = ![...table.tBodies[0].rows].some((r) => !r.hidden);
  status.textContent = terms.length ? `${found} ${found === 1 ? "chart" : "charts"} found` : "";
});

// A link to a chart in a fold opens the fold.
addEventListener("hashchange", () => {
  const goal = document.getElementById(location.hash.slice(1)), fold = goal && goal.closest("details.more:not([open])");
  if (fold) { fold.open = true; goal.scrollIntoView(); }
});

// What differs between the decks of this page and of another report.
function changed(other) {
  if (!data.deck || !other.deck) return "";
  const own = new Map(data.deck), rest = new Map(other.deck), same = (a, b) => a === b || (a !== "" && Number(a) === Number(b)), list = [];
  for (const path of new Set([...own.keys(), ...rest.keys()])) {
    if (!same(own.get(path), rest.get(path))) list.push(`${path} ${own.get(path) ?? "not given"} → ${rest.get(path) ?? "not given"}`);
  }
  return list.length ? `Changed in the deck: ${list.slice(0, 6).join("; ")}${list.length > 6 ? `; ${list.length - 6} more` : ""}` : "The decks have the same values";
}

// Another report: its curves beside those of this page, its numbers beside the values.
function overlay(other, name) {
  for (const test of tests) {
    test.other = (other && other.tests.find((t) => t.name === test.data.name)) || null;
    test.redraw();
  }
  document.querySelectorAll(".overlaid").forEach((node) => node.remove());
  for (const place of other ? document.querySelectorAll("[data-number]") : []) {
    const number = other.numbers.find((n) => n.name === place.dataset.number);
    if (!number) continue;
    const node = document.createElement("span");
    node.className = "overlaid";
    node.textContent = `${shown(number.left)}${"right" in number && number.right !== number.left ? ` | ${shown(number.right)}` : ""}`;
    place.append(node);
  }
  remove.hidden = !other;
  status.textContent = other ? `Dotted: ${name}. ${changed(other)}` : "";
}

async function take(chosen) {
  if (!data.numbers) return;
  try {
    const other = JSON.parse(await chosen.text());
    if (other.format !== data.format) throw new Error("it is not the data.json of a report of this version");
    overlay(other, `${other.title} (${chosen.name})`);
  } catch (problem) {
    status.textContent = `${chosen.name} cannot be overlaid: ${problem.message}`;
  }
}
file.addEventListener("change", () => { if (file.files[0]) take(file.files[0]); file.value = ""; });
remove.addEventListener("click", () => overlay(null));
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  if (event.dataTransfer.files[0]) take(event.dataTransfer.files[0]);
});
