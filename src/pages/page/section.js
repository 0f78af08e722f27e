// The sections of a page, made from their data (ek_page): text, facts, warnings, tables, folded blocks, K&C metrics, and the places
// of charts and figures. Every string of the data is escaped here.

const data = JSON.parse(document.getElementById("data").textContent), page = document.documentElement;
const chart_of = new Map((data.tests || []).flatMap((test) => test.charts.map((chart) => [chart.id, { test, ...chart }])));

const escaped = (text) => String(text).replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt()};`);
const span = (look, text) => text ? ` <span class="${look}">${escaped(text)}</span>` : "";
const look_of_verdict = (verdict) => `target ${{ inside: "inside", "at the edge": "edge" }[verdict] || "outside"}`;
const mark = (verdict) => span(look_of_verdict(verdict), verdict);
const small = (text) => text ? ` <small>${escaped(text)}</small>` : "";
const look_of = (name) => name ? ` class="${name}"` : "";

// A table. The first letter of a heading marks a column of numbers ">" or of small print "~". A row is a list of cells or, across the
// table, a heading. A cell is a string or an object.
function table_of({ look, caption, heads, table: rows }) {
  const kinds = heads.map((head) => ({ ">": "n", "~": "s" })[head[0]]);
  const heading = (head, k) => kinds[k] ? head.slice(1) : head;
  const name = (head, k) => `<th scope="col"${kinds[k] === "n" ? look_of("n") : ""}>${escaped(heading(head, k))}</th>`;
  // on a phone a row is a block, in which cells with text have their headings
  const title = (own, k) => k === 0 || own === "" || own.bar !== undefined || ["Value", "Unit", ""].includes(heading(heads[k], k)) ? "" : ` data-head="${escaped(heading(heads[k], k))}"`;
  const cell = (own, k) => own.html || `<td${look_of(own.small === true ? "s" : kinds[k])}${title(own, k)}>${own.bar === undefined ? words_of(own) : bar_of(own.bar)}</td>`;
  const row = (cells) => Array.isArray(cells) ? `<tr>${cells.map(cell).join("")}</tr>`
    : `<tr class="group"><th colspan="${heads.length}" scope="colgroup">${escaped(cells)}</th></tr>`;
  return `<div class="scroll" tabindex="0"><table class="wraps${look ? ` ${look}` : ""}">${caption ? `<caption>${escaped(caption)}</caption>` : ""}` +
    `<thead><tr>${heads.map(name).join("")}</tr></thead><tbody>${rows.map(row).join("")}</tbody></table></div>`;
}

function words_of(cell) {
  const { text = cell, to } = cell;
  return (to ? `<a href="#${escaped(to)}">${escaped(text)}</a>` : escaped(text)) + mark(cell.mark);
}

// A bar from the middle of 200 pixels.
function bar_of(length) {
  return `<svg viewBox="0 0 200 10" style="width:200px;height:10px" aria-hidden="true"><rect x="${100 + Math.min(length, 0)}" ` +
    `width="${Math.abs(length)}" height="10" style="fill:var(--c${length < 0 ? 2 : 1})"/></svg>`;
}

function facts_of(rows, look) {
  return `<dl${look_of(look)}>${rows.map(([name, value, verdict]) => `<div><dt>${escaped(name)}</dt><dd>${escaped(value)}${mark(verdict)}</dd></div>`).join("")}</dl>`;
}

// Charts of tests side by side; on paper, charts with notes are only the first three. Charts of the first screen are drawn there once
// more, and link to their places in the sections of the tests. The values beyond the axis, with a stop in contact, are in the caption.
function places(ids, notes, is_first) {
  return `<div class="charts${notes ? " few" : ""}${is_first ? " first" : ""}">${ids.map((id, k) => {
    const { title, label, test, beyond } = chart_of.get(id), name = is_first ? `<a href="#${id}">${escaped(title)}</a>` : escaped(title);
    return `<figure class="live" id="${is_first ? "first-" : ""}${id}" data-chart="${id}"><figcaption><b>${name}</b>${escaped(label)}` +
      `${is_first ? `, ${escaped(test.title.replace(/^[A-Z]/, (letter) => letter.toLowerCase()))}` : notes ? span("effect", notes[k])
        : test.held && `, ${escaped(test.held)}`}${beyond ? `; with stops ${shown(beyond[0])} … ${shown(beyond[1])}` : ""}</figcaption></figure>`;
  }).join("")}</div>`;
}

// The target of a link to the curve of a K&C metric: its chart, in its test or else in another one, or the section of its test. Toe
// is in the chart of steer where a test has both.
function place_of({ test: name, y }) {
  const is_shown = (curve) => y.includes(curve.y) || y.includes(curve.y.replace("steer_deg", "toe_deg"));
  const own = data.tests.filter((test) => test.name === name);
  const chart = [...own, ...data.tests].flatMap((test) => test.charts).find((one) => !one.level && one.curves.some(is_shown));
  return chart ? chart.id : `test-${name}`;
}

// A value, or the values of the left and the right wheel, as the program prints them.
function printed({ shown }) {
  return Array.isArray(shown) ? `<span title="left">${shown[0]}</span> <i>|</i> <span title="right">${shown[1]}</span>` : shown;
}

const opposite = (number) => number.is_opposite ? small(number.sides) : "";
const band = ({ band: limits, verdict, target }) =>
  limits ? span(look_of_verdict(verdict), `${verdict} ${target ? "target" : "usual"} ${limits}`) : "";

// Formula and condition of a K&C metric, folded, and the numbers that it stands for.
function how(number) {
  const equal = data.numbers.filter(({ instead }) => data.numbers[instead] === number).map((other) => ` ${other.relation} ${escaped(other.title)}: ` +
    `${printed(other)} ${escaped(other.unit)}${opposite(other)} (${escaped(other.condition)}).`);
  return `<details class="how"><summary>how</summary><p>${escaped(number.definition)}. ${escaped(number.condition)}.` +
    `${number.reason ? ` No value: ${escaped(number.reason)}.` : ""}${equal.join("")} Name: <code>${escaped(number.name)}</code></p></details>`;
}

// The curve of a K&C metric over its test, the size of a word, with a dot at design: of the left wheel or of the axle, and that of the
// right wheel behind it.
function spark({ curve }) {
  const test = curve && data.tests.find(({ name }) => name === curve.test);
  if (!test) return "";
  const all = curve.y.map((name, k) => ({ x: test.x[curve.x[k]], y: test.y[name], look: k + 1 })).filter(({ x, y }) => x && y);
  const has_value = (k) => k >= curve.first && k <= curve.last && all.every(({ x, y }) => x[k] !== null && y[k] !== null);
  // without the states in which a stop is in contact, which would scale the curve, unless few are left
  const is_free = (k) => has_value(k) && !(test.contacts || []).some(({ first, last }) => k >= first && k <= last);
  const has_free = all[0] && all[0].x.filter((_, k) => is_free(k)).length > 4;
  const is_good = (_, k) => has_free ? is_free(k) : has_value(k);
  const ends = (key) => all.flatMap((one) => one[key].filter(is_good)).reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const [x0, x1] = ends("x");
  let [y0, y1] = ends("y");
  if (!(x1 > x0)) return "";
  const least = curve.span || Math.max(0.05 * Math.max(Math.abs(y0), Math.abs(y1)), 1e-3);
  if (y1 - y0 < least) [y0, y1] = [(y0 + y1) / 2 - least, (y0 + y1) / 2 + least];
  const at = ({ x, y }, k) => [3 + 114 * (x[k] - x0) / (x1 - x0), 27 - 24 * (y[k] - y0) / (y1 - y0)].map((v) => Number(v.toFixed(2)));
  const states = all[0].x.map((_, k) => k).filter((k) => is_good(0, k));
  const lines = all.map((one) => `<polyline class="c${one.look}" points="${states.map((k) => at(one, k)).join(" ")}"/>`);
  const dot = states.includes(test.design) ? `<path class="at" d="M${at(all[0], test.design).join(" ")}h0"/>` : "";
  return `<svg class="spark" viewBox="0 0 120 30" preserveAspectRatio="none" aria-hidden="true">${lines.reverse().join("")}${dot}</svg>`;
}

const name_of = ({ title }) => escaped(title.replace(" (fitted)", "").replace(/^[a-z]/, (letter) => letter.toUpperCase()));

function card(number) {
  const name = number.curve ? `<a href="#${escaped(place_of(number.curve))}">${name_of(number)}</a>` : name_of(number);
  return `<li data-number="${escaped(number.name)}"><span class="name">${name}</span><span class="value"><b>${printed(number)}</b> ` +
    `${number.unit === "–" ? "" : escaped(number.unit)}${small(number.sides)}</span>${spark(number)}${span("effect", number.effect)}${band(number)}` +
    `${span("held", number.held)}${span("held not-printed", number.parts)}${how(number)}</li>`;
}

// The other K&C metrics: a table for each group.
function tables_of(indices) {
  const groups = new Map();
  for (const number of indices.map((k) => data.numbers[k])) groups.set(number.group, [...groups.get(number.group) || [], number]);
  return [...groups].map(([caption, list]) => table_of({ look: "numbers", caption, heads: ["Quantity", ">Value", "Unit", "~Sign"],
    table: list.map((number) => [{ html: `<th scope="row">${name_of(number)}${span("held", number.held)}${how(number)}</th>` },
      { html: `<td class="n" data-number="${escaped(number.name)}">${printed(number)}${opposite(number)}</td>` }, number.unit,
      { html: `<td class="s">${escaped(number.sign)}${band(number)}</td>` }]) })).join("");
}

// Each kind of block.
const makers = {
  file: ({ p, file }) => `<p>${escaped(p)}<a href="${escaped(file)}">${escaped(file)}</a></p>`,
  p: ({ p }) => `<p>${escaped(p)}</p>`,
  h3: ({ h3 }) => `<h3>${escaped(h3)}</h3>`,
  pre: ({ pre }) => `<pre tabindex="0">${escaped(pre)}</pre>`,
  b: ({ b }) => `<p class="verdict"><b>${escaped(b)}</b></p>`,
  facts: ({ facts: rows }) => facts_of(rows),
  verdicts: ({ verdicts }) => facts_of(verdicts, "verdicts"),
  warnings: ({ warnings, title }) => `<div class="warning" role="note"><strong>${escaped(title)}</strong><ul>` +
    `${warnings.map((text) => `<li>${escaped(text)}</li>`).join("")}</ul></div>`,
  table: table_of,
  beside: ({ beside }) => `<div class="beside">${all_of(beside)}</div>`,
  fold: ({ fold, id, blocks }) => `<details class="more"${id ? ` id="${escaped(id)}"` : ""}><summary>${escaped(fold)}</summary>${all_of(blocks)}</details>`,
  charts: ({ charts, notes, first }) => places(charts, notes, first),
  design: () => '<p class="legend"><span><b></b>design</span></p>',
  figure: ({ figure, caption }) => `<figure class="wide" id="figure-${escaped(figure)}"><figcaption>${escaped(caption)}</figcaption></figure>`,
  picture: ({ picture, labels: [title, caption] }) => `<figure class="drawn wide"><img alt="${escaped(title)}" src="${picture}">` +
    `${caption && `<figcaption>${escaped(caption)}</figcaption>`}</figure>`,
  place: ({ place }) => `<div id=${place}></div>`,
  cards: ({ cards }) => `<ul class="cards">${cards.map((k) => card(data.numbers[k])).join("")}</ul>`,
  numbers: ({ numbers: indices }) => tables_of(indices),
};

function all_of(blocks) {
  return blocks.map((block) => makers[Object.keys(makers).find((kind) => kind in block)](block)).join("");
}

const [before, ...sections] = JSON.parse(document.getElementById("sections").textContent), main = document.querySelector("main");
const link = (id, title) => `<li><a href="#${id}">${title}</a></li>`;
main.insertAdjacentHTML("beforeend", `<nav aria-label="Contents"><ul>${sections.map(({ id, title }) => link(id, escaped(title))).join("")}` +
  `${link("top", "Back to top")}</ul></nav>${all_of(before.blocks)}${sections.map(({ id, title, condition, printed, blocks }) =>
    `<section id=${id}${printed === false ? look_of("not-printed") : ""}><h2>${escaped(title)}${small(condition)}</h2>${all_of(blocks)}</section>`).join("")}`);
if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
