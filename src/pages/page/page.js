// The page of a report: its tests with their charts, the filter, and another report's data laid over it.

const paper_width = 250;       // of a chart of the first screen, on paper

// What the charts of one test share.
class Test {
  constructor(own, section) {
    // cursor: abscissa at the pointer, at: abscissa in the field, reference: abscissa of the state from which differences are counted
    Object.assign(this, { data: own, section, other: null, cursor: null, snapped: null, at: null, reference: null, zoom: null, hidden: new Set() });
    this.charts = own.charts.flatMap((c) => (figures_of.get(c.id) || []).map((figure) => new Chart(this, figure, c)));
    this.frame = 0;
    this.add_field();
  }

  // The field "value at" above the first chart of the section. States that do not form a path have none.
  add_field() {
    const first = this.charts.find(({ figure, description }) => this.section.contains(figure) && !description.points);
    if (!first) return;
    const row = document.createElement("p"), label = document.createElement("label"), input = document.createElement("input");
    row.className = "value-at not-printed";
    Object.assign(input, { type: "number", step: "any" });
    label.append("Value at ", input, ` ${this.data.label.replace(/ +/g, " ")}`);
    this.note = document.createElement("output");       // read out when it changes
    row.append(label, this.note, Object.assign(document.createElement("small"), { textContent: "A click in a chart sets the reference of Δref." }));
    input.addEventListener("input", () => this.read_at(input.value === "" ? null : Number(input.value)));
    first.figure.parentNode.before(row);
  }

  // The value of the field: of a state, or between two states an interpolation, which the page says.
  read_at(x) {
    this.at = x;
    const { curves } = this.charts.find(({ is_drawn }) => is_drawn) || { curves: [] };
    const read = x === null || !curves.length ? [] : curves.map((curve) => reading(curve.x, curve.y, x));
    this.note.textContent = !read.length ? "" : read.every((one) => one === null) ? "outside the states of the test"
      : read.some((one) => one && one.is_between) ? "between two states: ≈ interpolated linearly" : "a state of the test";
    this.show();
  }

  // A click sets the reference; a click on the same state removes it.
  refer(x) {
    this.reference = x === this.reference ? null : x;
    this.show();
  }

  show() {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      for (const one of this.charts) if (one.is_drawn && one.is_visible) one.show_cursor();
    });
  }

  redraw() { for (const chart of this.charts) if (chart.is_drawn) chart.draw(); }

  move(x, chart) {
    const curve = chart.curves[0], k = x === null ? -1 : nearest(curve.x, curve.y, x);
    this.cursor = x;
    this.snapped = k < 0 ? x : curve.x[k];
    this.show();
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

  clear() {
    this.reference = null;
    this.zoom_to(null);
  }

  zoom_to(ends) { this.zoom = ends; this.redraw(); }

  zoom_in() {
    const xs = Object.values(this.data.x)[0].filter((x) => x !== null), [a, b] = this.zoom || [Math.min(...xs), Math.max(...xs)];
    const middle = this.snapped ?? (a + b) / 2;
    this.zoom_to([Math.max(a, middle - (b - a) / 4), Math.min(b, middle + (b - a) / 4)]);
  }
}

// The places of each chart: in the section of its test, and perhaps on the first screen.
const figures_of = new Map();
for (const figure of document.querySelectorAll("[data-chart]"))
  figures_of.set(figure.dataset.chart, [...figures_of.get(figure.dataset.chart) || [], figure]);
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
// On paper, four charts of the first screen are beside each other, whatever the width of the screen.
addEventListener("beforeprint", () => {
  for (const chart of charts) {
    if (chart.figure.closest(".first")) chart.draw(paper_width);
    else if (!chart.is_drawn && !chart.figure.closest("details")) chart.draw();
  }
});
addEventListener("afterprint", () => { for (const chart of charts) if (chart.figure.closest(".first")) chart.draw(); });

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
  page.classList.toggle("is-filtered", terms.length > 0);
  for (const test of tests) {
    for (const { figure, description } of test.charts) {
      figure.hidden = !fits(`${description.title} ${test.data.title}`);
      if (!figure.hidden && test.section.contains(figure)) found++;
    }
  }
  for (const row of document.querySelectorAll(".cards li, .numbers tbody tr")) row.hidden = !fits(row.textContent);
  for (const table of document.querySelectorAll(".numbers")) table.hidden = ![...table.tBodies[0].rows].some((r) => !r.hidden);
  // only what has a match is shown: a section, a fold in it, and the numbers of the summary
  const has_hit = (part) => [...part.querySelectorAll("figure.live, .cards li, .numbers tbody tr")].some((one) => !one.hidden && !one.closest(".first"));
  for (const section of document.querySelectorAll("main > section")) section.hidden = terms.length > 0 && !has_hit(section);
  for (const fold of document.querySelectorAll("details.more")) {
    if (fold.querySelector("figure.live")) fold.open = terms.length > 0 && has_hit(fold);
    fold.hidden = terms.length > 0 && !has_hit(fold);
  }
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
