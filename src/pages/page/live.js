// Other rates: the numbers and curves that are linear in the compliance matrix, for the rates that the reader gives, at the states as
// they stand: C' = C − Gᵀ (I + E A)⁻¹ E G, with A and the factors of G in the data (equation C.19 of the theory).

const live = data.live, factor_of = live.rates.map(() => 1), rate_inputs = [], found = new Map();

// (I + E A)⁻¹ E of the laws that are changed; A: the lower triangle, or the whole matrix.
function gain(a, changes, laws) {
  const m = changes.length, n = laws.length, is_whole = a.length === m * m, rows = [];
  const at = (i, j) => a[is_whole ? i * m + j : i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i];
  for (let i = 0; i < n; i++) {
    const row = new Float64Array(2 * n), change = changes[laws[i]];
    for (let j = 0; j < n; j++) row[j] = (i === j ? 1 : 0) + change * at(laws[i], laws[j]);
    row[n + i] = change;
    rows.push(row);
  }
  for (let k = 0; k < n; k++) {
    let p = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[p][k])) p = i;
    [rows[k], rows[p]] = [rows[p], rows[k]];
    const pivot = rows[k][k];
    for (let j = k; j < 2 * n; j++) rows[k][j] /= pivot;
    for (let i = 0; i < n; i++) {
      const f = rows[i][k];
      if (i !== k && f !== 0) for (let j = k; j < 2 * n; j++) rows[i][j] -= f * rows[k][j];
    }
  }
  return rows.map((row) => row.subarray(n));
}

// −ρᵀ M β
function change_of(matrix, laws, read, load) {
  let sum = 0;
  for (let i = 0; i < laws.length; i++) {
    let x = 0;
    for (let j = 0; j < laws.length; j++) x += matrix[i][j] * load[laws[j]];
    sum -= read[laws[i]] * x;
  }
  return sum;
}

function numbers_of(text) { return new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer); }

// The numbers of a test, unpacked: of the design state a list, of the others 32-bit numbers as base64.
function unpack(test) {
  const m = test.of_law.length, n = test.is_whole ? m * m : m * (m + 1) / 2;
  test.states = test.states.map((state) => {
    if (state === null) return null;
    const list = typeof state === "string" ? numbers_of(state) : state;
    let end = 0;
    const next = (many) => list.slice(end, end += many);
    return { values: next(test.columns.length), self: test.has_self && next(n), held: test.has_held && next(n),
      vectors: Array.from({ length: test.vectors }, () => next(m)) };
  });
  test.is_unpacked = true;
}

// Relative changes of laws, and the laws that change.
function changes_of_laws(of_law) {
  const changes = of_law.map((k) => factor_of[k] - 1);
  return [changes, changes.map((_, k) => k).filter((k) => changes[k] !== 0)];
}

function changes_of(test) {
  if (!test.is_unpacked) unpack(test);
  return changes_of_laws(test.of_law);
}

// The columns of a state for these rates.
function values_of(test, state, changes, laws) {
  const free = state.self && gain(state.self, changes, laws), held = state.held && gain(state.held, changes, laws);
  return test.columns.map((column, c) => {
    const value = state.values[c];
    const change = change_of(column.is_held ? held : free, laws, state.vectors[column.read], state.vectors[column.load]);
    return column.is_inverse ? 1 / (1 / value + change) : value + change;
  });
}

// How far the wheel centres would move at a shown state until they were in equilibrium again: [mm, deg], to first order.
function settling(test, text) {
  const list = numbers_of(text), m = test.ends_of_law.length, [changes, laws] = changes_of_laws(test.ends_of_law);
  const matrix = gain(list.subarray(0, m * m), changes, laws), load = list.subarray(m * m, m * m + m), moves = [];
  for (let at = m * m + m; at < list.length; at += m) moves.push(change_of(matrix, laws, list.subarray(at, at + m), load));
  const size = (at) => Math.hypot(...moves.slice(at, at + 3)), wheels = moves.length / 6;
  const most = (first) => Math.max(...Array.from({ length: wheels }, (_, w) => size(6 * w + first)));
  return [1e3 * most(0), 180 / Math.PI * most(3)];
}

function element(tag, className, text) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  if (text !== undefined) node.textContent = text;
  return node;
}

// A number of both wheels; that of the left one if they are the same, or opposite, to the digits shown.
function pair(left, right) {
  if (left === undefined || right === undefined || shown(left) === shown(right)) return shown(left ?? right);
  return shown(left) === shown(-right) ? shown(left) : `${shown(left)} | ${shown(right)}`;
}

// The numbers: in the table of this section, and beside those of the deck on the page.
function show_numbers(values, is_changed) {
  const deck = live.design.states[0].values;
  for (const number of live.numbers) {
    const { row, spots } = found.get(number), side = (list, name) => name in number ? list[number[name]] : undefined;
    const left = side(values, "left"), right = side(values, "right"), was = side(deck, "left") ?? side(deck, "right");
    row.cells[2].textContent = is_changed ? pair(left, right) : "–";
    row.cells[3].textContent = is_changed && Math.abs(was) > 1e-9 ? `${shown(Math.round(1e3 * ((left ?? right) / was - 1)) / 10)} %` : "–";
    row.dataset.left = left ?? "";
    row.dataset.right = right ?? "";
    for (const place of spots) {
      const unit = place.parentNode.matches("td") ? "" : ` ${number.unit}`;
      place.textContent = `${pair(left, right)}${unit}${number.beside === number.name ? "" : " at design"}`;
      place.hidden = !is_changed;
      place.parentNode.classList.toggle("has-what-if", is_changed);
    }
  }
}

// The curves of columns of a test, computed when a chart needs them: `follow` of the test, see Chart.
function compute(own) {
  const test = test_of(own), { y } = test.data, [changes, laws] = changes_of(own), is_changed = page.classList.contains("is-what-if");
  const states = own.states.map((state) => state && values_of(own, state, changes, laws));
  own.is_stale = false;
  for (const [c, { name }] of own.columns.entries()) {
    if (!(name in y)) continue;
    test.deck[name] ||= y[name];
    y[name] = is_changed ? test.deck[name].map((v, k) => v === null || !states[k] ? v : states[k][c]) : test.deck[name];
    if (!is_changed) delete test.deck[name];
  }
}

function test_of(own) { return tests.find((t) => t.data.name === own.name); }

// The curves that follow; a chart out of sight is drawn when it comes into view.
function show_curves(is_changed) {
  for (const own of live.tests) own.is_stale = true;
  for (const chart of followers) {
    chart.figure.classList.toggle("has-what-if", is_changed);
    if (chart.is_visible) update(chart);
    else chart.is_drawn = false;
  }
}

// Draws the curves of a chart again, and all of it only if its axes change.
function update(chart) {
  const { test, curves } = chart;
  test.follow();
  const is_known = chart.is_drawn && curves.every((c) => c.deck && c.column in test.deck);
  if (is_known) for (const curve of curves) curve.y = test.data.y[curve.column];
  if (!is_known || chart.axes().some((end, k) => end !== chart.ends[k])) return chart.draw(chart.is_drawn ? chart.width : undefined);
  for (const curve of curves) {
    curve.path?.setAttribute("d", chart.path_of(curve));
    curve.ring?.setAttribute("cy", chart.to_y(curve.y[test.data.design]));
  }
  if (test.cursor !== null || test.at !== null) chart.show_cursor();
}

// The measured deviation of the numbers from runs at the ends of the sliders.
function deviation() {
  const { count, failed, deviation: share, column } = live.reruns ?? { count: 0, failed: 0, deviation: 0 };
  if (count === failed) return "How much the numbers then differ was not measured.";
  const digit = 10 ** (Math.floor(Math.log10(100 * share)) - 1), percent = Number((Math.ceil(100 * share / digit) * digit).toPrecision(2));
  return `In ${count - failed} runs with rates of 0.1 and 10 times those of the deck (each rate alone, all together, alternating, and a search), ` +
    (share > 0 ? `a number of the table differed by at most ${percent} % (${column}).` : "no number of the table differed.") +
    (failed > 0 ? ` In ${failed} further runs no preloads hold the axle.` : "");
}

// How far the numbers are those of a rerun.
function exactness() {
  const about = ([mm, deg]) => `about ${Number(mm.toPrecision(2))} mm and ${Number(deg.toPrecision(2))}°`, list = [];
  const at_design = settling(live.design, live.design.ends[0]);
  const is_still = Math.max(...at_design) < 1e-6, has_bushing = live.rates.some((r, k) => factor_of[k] !== 1 && r.group === "bushing");
  if (!is_still) list.push(`Numbers of the table, at design: exact for the state of the deck. A run with these rates would find another state; ` +
    `the wheel centre would move by ${about(at_design)}, to first order` + (live.balance === "spring" ? " before the springs are balanced again." :
      live.balance === "height" ? " before the rig holds the height again." :
        live.balance === "loads" ? ", at the height of the deck's start state; its tests would start where the wheels settle, at another height." : "."));
  else if (live.balance === "all" && has_bushing) list.push(`Numbers of the table, at design: exact for the forces in the deck's parts. A run ` +
    "with these rates finds the same position, but balance = 'all' then distributes the preloads of the bushings in another way, " +
    `which changes their geometric stiffness. ${deviation()}`);
  else list.push(`Numbers of the table, at design: exact. A run of the deck with these rates finds the same state and the same numbers.`);
  for (const own of live.tests.filter((t) => t.ends)) {
    const ends = own.ends.map((end) => settling(own, end));
    const { title } = test_of(own).data, most = [0, 1].map((k) => Math.max(...ends.map((e) => e[k])));
    if (Math.max(...most) < 1e-6) list.push(`${title}: the marked curves are exact.`);
    else list.push(`${title}: the marked curves are exact for the states of the deck. At the ends of the range a run with these ` +
      `rates would find the wheel centre elsewhere by ${about(most)}, to first order.`);
  }
  list.push("Everything without the mark is of the deck: kinematics, fitted slopes, loads, pictures.");
  return list;
}

// Everything for the present rates; statements that need not follow a moving slider come when it rests.
function follow() {
  const start = performance.now(), changed = live.rates.filter((_, k) => factor_of[k] !== 1), is_changed = changed.length > 0;
  const [changes, laws] = changes_of(live.design);
  page.classList.toggle("is-what-if", is_changed);
  show_numbers(values_of(live.design, live.design.states[0], changes, laws), is_changed);
  show_curves(is_changed);
  const count = `${changed.length} of ${live.rates.length} rates`;
  note.hidden = short.hidden = !is_changed;
  short.firstChild.textContent = `What if: ${count} changed`;
  outcome.hidden = !is_changed;
  clearTimeout(rest);
  rest = setTimeout(conclude, 100);
  page.dataset.redraw = (performance.now() - start).toFixed(2);
}

function conclude() {
  const changed = live.rates.filter((_, k) => factor_of[k] !== 1);
  if (changed.length) {
    const texts = live.rates.map((r, k) => `${label_of(r)} ${shown(r.value)} → ${shown(r.value * factor_of[k])} ${r.unit}`);
    note.firstChild.textContent = `What if: ${changed.length} of ${live.rates.length} rates changed. Numbers and curves marked “what if” are not those of the deck.`;
    note.children[1].textContent = texts.filter((_, k) => factor_of[k] !== 1).join("; ");
    exact.replaceChildren(...exactness().map((text) => element("li", "", text)));
    settings.textContent = live.rates.flatMap((r, k) => factor_of[k] === 1 ? [] :
      r.paths.map((path) => `--set "${path}=*${factor_of[k]}"`)).join(" ");
  }
}

function label_of(rate) { return rate.part === "rate" ? rate.name : `${rate.name} ${rate.part}`; }

// A rate, given by its slider or as a number; both show it.
function set_rate(k, value) {
  const { value: own, unit } = live.rates[k], { slider, number, output } = rate_inputs[k];
  factor_of[k] = value / own;
  slider.value = Math.log10(factor_of[k]);
  number.value = value;
  output.textContent = `× ${shown(Number(factor_of[k].toPrecision(3)))}`;
  slider.setAttribute("aria-valuetext", `${value} ${unit}, ${factor_of[k].toFixed(2)} times the deck`);
}

function reset() {
  live.rates.forEach((rate, k) => set_rate(k, rate.value));
  follow();
}

function add_slider(rate, k) {
  const box = element("div", "rate"), name = element("label", "", `${label_of(rate)} `), slider = element("input"), number = element("input");
  const output = element("output");
  name.append(element("small", "", rate.paths.length > 1 ? `${rate.group}, both sides` : rate.group));
  name.htmlFor = slider.id = `rate-${k}`;
  Object.assign(slider, { type: "range", min: -1, max: 1, step: 0.01 });
  Object.assign(number, { type: "number", min: 0, step: "any" });
  number.setAttribute("aria-label", `${label_of(rate)}, ${rate.unit}`);
  slider.addEventListener("input", () => {
    const at = Number(slider.value);
    set_rate(k, at === 0 ? rate.value : Number((rate.value * 10 ** at).toPrecision(4)));
    follow();
  });
  number.addEventListener("change", () => {
    set_rate(k, Number(number.value) > 0 ? Number(number.value) : rate.value);
    follow();
  });
  box.append(name, slider, number, element("span", "", rate.unit), output);
  rate_inputs.push({ slider, number, output });
  return box;
}

function button_of(text) {
  const button = element("button", "", text);
  button.type = "button";
  button.addEventListener("click", reset);
  return button;
}

const room = document.getElementById("rates"), outcome = element("div"), exact = element("ul"), settings = element("code");
const note = element("div", "warning what-if"), short = element("p", "what-if"), panel = element("div", "panel"), sliders = element("div");
let rest = 0;
for (const test of tests) {
  const own = live.tests.filter((t) => test_of(t) === test);
  Object.assign(test, { deck: {}, follow: () => own.filter((t) => t.is_stale).forEach(compute) });
}
unpack(live.design);
const followers = live.tests.flatMap((own) => test_of(own).charts.filter(({ description }) =>
  description.curves.some((c) => own.columns.some(({ name }) => name === c.y))));
sliders.append(...live.rates.map(add_slider), button_of("Reset all rates"));
const scroll = element("div"), deck_values = live.design.states[0].values;
scroll.innerHTML = table_of({ heads: ["At design, left wheel", ">Deck", ">What if", ">Change", "Unit"], table: live.numbers.map((number) =>
  [{ html: `<th scope="row">${escaped(number.title)}</th>` }, pair(deck_values[number.left], deck_values[number.right]), "–", "–", number.unit]) });
for (const [k, number] of live.numbers.entries()) {
  const row = scroll.querySelectorAll("tbody tr")[k];
  const spots = [...document.querySelectorAll(`[data-number="${number.beside}"]`)].map((place) => {
    const node = element("span", "changed");
    (place.querySelector(".value") || place.firstChild).after(node);
    return node;
  });
  row.dataset.name = number.name;
  found.set(number, { row, spots });
}
scroll.firstChild.setAttribute("role", "region");
scroll.firstChild.setAttribute("aria-label", "Numbers at design, of the deck and with other rates");
panel.append(sliders, scroll.firstChild);
sliders.append(outcome);
outcome.append(exact, element("p", "", "To run the deck with these rates: "), settings);
// The charts that follow, of the first test that has some, once more beside the sliders.
const first = live.tests.length > 0 && test_of(live.tests[0]), row_of_charts = element("div", "charts"), beside = [];
for (const { description } of followers.filter((chart) => chart.test === first)) {
  const figure = element("figure", "live"), caption = element("figcaption"), chart = new Chart(first, figure, description);
  figure.id = `live-${description.id}`;
  caption.append(element("b", "", description.title), `${description.label}, ${first.data.title}`);
  figure.append(caption);
  row_of_charts.append(figure);
  first.charts.push(chart);
  beside.push(chart);
  of_figure.set(figure, chart);
  watcher.observe(figure);
}
followers.push(...beside);
room.append(panel, row_of_charts);
note.append(element("strong"), element("p"));
short.append(element("b"), button_of("Reset"));
document.querySelector("main > header").after(note);
bar.append(short);
reset();
