// Points and curves of elastokin.html: the hardpoints of the document as three views and a table (views.js), and the curves of a test
// that follow every change (curves.js). A change is a change of the text, so that text, views, tables and curves are one document. The
// numbers are those of `elastokin run DECK --case TEST --increments 20`, solved anew after each change: in a model that the worker
// keeps open, because only numbers of the deck change while a point is dragged.
const tests = ["parallel_travel", "opposite_travel", "roll", "steering", "lateral_force", "braking", "traction", "aligning_torque"];
const wanted = ["toe_deg", "camber_deg", "caster_deg", "track_change_mm", "wheel_rate_n_per_mm", "roll_centre_height_mm"];
const colours = ["#b5651d", "#7a4fa3", "#1d8a6b", "#a8201a"];
const drawing = "http://www.w3.org/2000/svg";
const bench = {
  points: [], links: [], axes: "x-rear", chosen: "", view: null,       // what is drawn
  opened: new Map(), past: [], future: [], kept: "",                    // the document as opened, and its former texts
  curves: null, baselines: [], shown: null, headings: [],               // { columns: name -> numbers, x: name }
  isRunning: false, isWaiting: false, runs: 0,
};

// ---- the points in the text -----------------------------------------------------------------------

// The groups of a deck: { name, keys: key -> { start, end } }, positions in the text. In `masked`, strings are ×, comments blank.
function groupsOf(text) {
  let masked = "", quote = "";
  for (let k = 0; k < text.length; k++) {
    const c = text[k];
    if (quote) {
      masked += c === quote ? c : c === "\n" ? c : "×";
      if (c === quote || c === "\n") quote = "";
    } else if (c === "!") {
      const end = text.indexOf("\n", k), stop = end < 0 ? text.length : end;
      masked += " ".repeat(stop - k);
      k = stop - 1;
    } else {
      if (c === "'" || c === '"') quote = c;
      masked += c;
    }
  }
  return [...masked.matchAll(/^[ \t]*&(\w+)([^/]*)\//gm)].map((found) => {
    const start = found.index + found[0].length - found[2].length - 1, keys = {};
    const heads = [...found[2].matchAll(/([a-z_]\w*)[ \t]*=/gi)];
    heads.forEach((head, k) => {
      keys[head[1].toLowerCase()] = { start: start + head.index + head[0].length,
        end: start + (k + 1 < heads.length ? heads[k + 1].index : found[2].length) };
    });
    return { name: found[1].toLowerCase(), keys };
  });
}

const stringsOf = (text, key) => key === undefined ? [] :
  [...text.slice(key.start, key.end).matchAll(/'((?:[^']|'')*)'|"([^"]*)"/g)].map((m) => m[1] ?? m[2]);

// The points of a deck with three numbers: { name, at: [{ start, text, value }, …] }, each number with its position in the text.
function pointsOf(text, groups) {
  const points = [];
  for (const { name, keys } of groups) {
    if (name !== "point" || !keys.name || !keys.at) continue;
    const at = numbersOf(text, keys.at);
    if (at.length === 3) points.push({ name: stringsOf(text, keys.name)[0], at });
  }
  return points;
}

// The numbers of a key: { start, text, value }; none if one stands for several (3*0.0)
function numbersOf(text, key) {
  const part = text.slice(key.start, key.end);
  if (part.includes("*")) return [];
  return [...part.matchAll(/[-+]?(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?/gi)]
    .map((m) => ({ start: key.start + m.index, text: m[0], value: Number(m[0].replace(/d/i, "e")) }));
}

// The deck and the files that it includes
function filesOfDeck() {
  const found = [], add = (file) => {
    if (found.includes(file) || !files.has(file)) return;
    found.push(file);
    const text = files.get(file);
    for (const { name, keys } of groupsOf(text)) {
      if (name === "include" && keys.file) add(pathFrom(file, stringsOf(text, keys.file)[0] ?? ""));
    }
  };
  add(deck);
  return found;
}

// A path that a file gives relative to its own folder
function pathFrom(file, path) {
  const parts = file.split("/").slice(0, -1);
  for (const part of path.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== ".") parts.push(part);
  }
  return parts.join("/");
}

// Reads the points of the deck, and the lines between the points of each body.
function readPoints() {
  bench.points = [];
  const of = new Map(), pairs = [];
  const add = (body, point) => {
    if (!body || body === "chassis" || !point) return;
    if (!of.has(body)) of.set(body, new Set());
    of.get(body).add(point);
  };
  for (const file of filesOfDeck()) {
    const text = files.get(file), groups = groupsOf(text);
    bench.points.push(...pointsOf(text, groups).map((point) => ({ file, ...point })));
    for (const { name, keys } of groups) {
      if (name === "model" && keys.axes) bench.axes = stringsOf(text, keys.axes)[0] ?? "x-rear";
      const bodies = stringsOf(text, keys.bodies), ends = stringsOf(text, keys.at);
      if (bodies.length === 2) {
        add(bodies[0], ends[0]);
        add(bodies[1], ends[1] ?? ends[0]);
        if (ends.length === 2) pairs.push([ends[0], ends[1], name]);
      }
      if (name === "wheel") for (const key of ["centre", "contact"]) add(stringsOf(text, keys.body)[0], stringsOf(text, keys[key])[0]);
    }
  }
  const known = new Map(bench.points.map((point) => [point.name, point]));
  bench.links = [...pairs];
  for (const points of of.values()) {
    const list = [...points];
    for (let k = 0; k < list.length; k++) for (let m = k + 1; m < list.length; m++) bench.links.push([list[k], list[m], "body"]);
  }
  bench.links = bench.links.filter(([a, b]) => known.has(a) && known.has(b));
}

const pointOf = (name) => bench.points.find((point) => point.name === name);

// Writes coordinates of a point into the text of its file; undo takes the text before `remember`.
function movePoint(name, values) {
  const point = pointOf(name);
  let text = files.get(point.file);
  for (let k = 2; k >= 0; k--) {
    const { start, text: old, value } = point.at[k];
    if (values[k] === undefined || values[k] === value) continue;
    const number = String(Number(values[k].toPrecision(12))), form = /\.|e/i.test(number) ? number : `${number}.0`;
    text = text.slice(0, start) + form + text.slice(start + old.length);
  }
  if (text === files.get(point.file)) return;
  files.set(point.file, text);
  isEdited = true;
  if (point.file === shown) {
    const at = element("text").scrollTop;
    element("text").value = text;
    element("text").scrollTop = at;
    number();
  }
  readPoints();
  drawViews();
  solve();
}

const snapshot = () => JSON.stringify([...files]);

function remember() {
  const now = snapshot();
  if (now === bench.kept) return;
  bench.past.push(bench.kept);
  if (bench.past.length > 300) bench.past.shift();
  bench.future = [];
  bench.kept = now;
  keep();
  setButtons();
}

function goBack(from, to) {
  if (from.length === 0) return;
  to.push(bench.kept);
  bench.kept = from.pop();
  files.clear();
  for (const [path, text] of JSON.parse(bench.kept)) files.set(path, text);
  isEdited = true;
  showFile(shown);
  keep();
  setButtons();
  renew();
}

function setButtons() {
  element("undo").disabled = bench.past.length === 0;
  element("redo").disabled = bench.future.length === 0;
  element("changes").disabled = changes() === "";
}

// The coordinates that differ from the document as opened, as settings for --set-file
function changes() {
  const lines = [];
  for (const [file, text] of bench.opened) {
    if (!/\.nml$/i.test(file)) continue;
    for (const { name, at } of pointsOf(text, groupsOf(text))) {
      const now = pointOf(name);
      ["x", "y", "z"].forEach((axis, k) => {
        if (now?.file === file && now.at[k].value !== at[k].value) lines.push(`point.${name}.${axis} = ${now.at[k].text}\n`);
      });
    }
  }
  return lines.join("");
}

// ---- controls -------------------------------------------------------------------------------------

function renew() {
  readPoints();
  drawViews();
  solve();
}

document.addEventListener("opened", ({ detail }) => {
  bench.opened = new Map(files);
  Object.assign(bench, { past: [], future: [], kept: snapshot(), chosen: "", headings: [], columns: [], view: null });
  if (detail.isNew) bench.baselines = [];
  element("test").value = tests[0];
  setButtons();
  renew();
});
let rest;
document.addEventListener("edited", () => {
  clearTimeout(rest);
  rest = setTimeout(() => {
    remember();
    renew();
  }, 400);
});
element("test").append(...tests.map((name) => new Option(name.replaceAll("_", " "), name)));
element("test").addEventListener("change", () => {
  bench.columns = [];
  solve();
});
element("quantity").addEventListener("change", ({ target }) => {
  if (!bench.shown.includes(target.value)) bench.shown.push(target.value);
  target.selectedIndex = 0;
  askFor();
  solve();
});
element("baseline").addEventListener("click", () => {
  if (!bench.curves) return;
  const number = (bench.count = (bench.count ?? 0) + 1);
  bench.baselines.push({ name: `baseline ${number}`, colour: colours[(number - 1) % colours.length], solution: bench.curves, text: bench.kept });
  drawCharts();
});
element("forget").addEventListener("click", () => {
  bench.baselines = bench.baselines.filter(({ name }) => name !== element("baselines").value);
  drawCharts();
});
element("undo").addEventListener("click", () => goBack(bench.past, bench.future));
element("redo").addEventListener("click", () => goBack(bench.future, bench.past));
element("fit").addEventListener("click", () => drawViews(true));
element("changes").addEventListener("click", () => download(`${deck.replace(/\.nml$/i, "")}_changes.set`, changes()));
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target === element("text") || element("points").hidden) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) goBack(bench.future, bench.past);
  else goBack(bench.past, bench.future);
});
document.querySelector("[data-tab=points]").addEventListener("click", renew);

// For scripts: the curves as drawn, and whether they belong to the document
globalThis.elastokin.curves = () => ({ ...bench.curves, runs: bench.runs, isCurrent: !bench.isRunning && !bench.isWaiting });
