// Points and curves of elastokin.html: the hardpoints of the document as three views and a table (views.js), and the curves of a test
// that follow every change (curves.js). A change is a change of the text, so that text, views, tables and curves are one document. The
// numbers are those of `elastokin run DECK --case TEST --increments 20`, solved anew after each change: in a model that the worker
// keeps open, because only parameters of the deck change while a point is dragged.
const tests = ["parallel_travel", "opposite_travel", "roll", "steering", "lateral_force", "braking", "traction", "aligning_torque"];
const wanted = ["toe_deg", "camber_deg", "caster_deg", "track_change_mm", "wheel_rate_n_per_mm", "roll_centre_height_mm"];
const colours = ["#b5651d", "#7a4fa3", "#1d8a6b", "#a8201a"];
const drawing = "http://www.w3.org/2000/svg";
const bench = {
  points: [], rows: [], links: [], isMirrored: false, axes: "x-rear", units: new Map(),    // readDocument; units of the paths that the program lists
  chosen: "", view: null, turn: 0.6,                                              // what is drawn
  opened: new Map(), past: [], future: [], kept: new Map(),             // the document as opened, its changes, and as last remembered
  curves: null, baselines: [], shown: null, headings: [],               // { columns: name -> numbers, x: name }
  at: null, row: 0,                                                     // the state: its swept value, null at design; its row
  isRunning: false, isWaiting: false, runs: 0,
};

// ---- the document ---------------------------------------------------------------------------------

const readPoints = () => Object.assign(bench, readDocument(files));
const pointOf = (name) => bench.points.find((point) => point.name === name);

// Writes numbers, [number, value] of one file, into its text; undo takes the text before `remember`.
function setNumbers(list) {
  const changed = list.filter(([{ value }, now]) => now !== value);
  if (changed.length === 0) return;
  const { file } = changed[0][0], text = replaceNumbers(files.get(file), changed.map(([number, now]) => [number, textOfNumber(now)]));
  files.set(file, text);
  isEdited = true;
  if (file === shown) replaceText(text);
  outdate();
  readPoints();
  drawViews();
  solve();
}

function textOfNumber(value) {
  const text = String(Number(value.toPrecision(12)));
  return /\.|e/i.test(text) ? text : `${text}.0`;
}

// Moves a point. A point on the mirror plane stays there: parts of both sides share it
function movePoint(name, values) {
  const { at } = pointOf(name);
  setNumbers(at.map((one, k) => [one, k === 1 && bench.isMirrored && one.value === 0 ? 0 : values[k]]));
}

const snapshot = () => JSON.stringify([...files]);

// Ends a step of the history: what has changed since the last one is undone together
function remember() {
  clearTimeout(rest);
  bench.since = 0;
  const changed = changesOf(bench.kept, files);
  if (changed.length === 0) return;
  bench.past.push(changed);
  if (bench.past.length > 300) bench.past.shift();
  bench.future = [];
  bench.kept = new Map(files);
  keep();
  setButtons();
}

// Undoes the last step (`past`), or does one again (`future`)
function goBack(from) {
  remember();
  const isUndo = from === "past", step = bench[from].pop();
  if (!step) return;
  bench[isUndo ? "future" : "past"].push(step);
  for (const change of step) files.set(change[0], (isUndo ? withoutChange : withChange)(files.get(change[0]), change));
  bench.kept = new Map(files);
  isEdited = true;
  if (step.some(([path]) => path === shown)) replaceText(files.get(shown), true);
  else showFile(step[0][0]);
  keep();
  setButtons();
  command(["check", deck]);
  bench.isReset = true;      // also the field that has the focus
  renew();
  bench.isReset = false;
}

function setButtons() {
  element("undo").disabled = bench.past.length === 0;
  element("redo").disabled = bench.future.length === 0;
  element("changes").disabled = changes() === "";
}

// The coordinates, rates and lengths that differ from the document as opened, as settings for --set-file
function changes() {
  const now = new Map(numbersOf(bench).map((one) => [`${one.file} ${one.path}`, one]));
  return numbersOf(readDocument(bench.opened)).map(({ file, path, value }) => {
    const found = now.get(`${file} ${path}`);
    return found && found.value !== value && (/^point\./.test(path) || bench.units.has(path)) ? `${path} = ${found.text}\n` : "";
  }).join("");
}

// ---- controls -------------------------------------------------------------------------------------

function renew() {
  outdate();
  readPoints();
  drawViews();
  solve();
}

document.addEventListener("opened", ({ detail }) => {
  bench.opened = new Map(files);
  Object.assign(bench, { past: [], future: [], kept: new Map(files), chosen: "", headings: [], columns: [], view: null, at: null });
  if (detail.isNew) bench.baselines = [];
  element("test").value = tests[0];
  setButtons();
  renew();
});
let rest;
document.addEventListener("edited", () => {
  clearTimeout(rest);
  const now = performance.now();
  bench.since ||= now;
  if (now - bench.since > 3000) remember();      // who types without a pause undoes in steps, too
  rest = setTimeout(() => {
    remember();
    renew();
  }, 400);
});
element("test").append(...tests.map((name) => new Option(name.replaceAll("_", " "), name)));
element("test").addEventListener("change", () => {
  bench.columns = [];
  bench.at = null;
  solve();
});
element("state").addEventListener("input", ({ target }) => setState(Number(target.value)));
element("quantity").addEventListener("change", ({ target }) => {
  if (!bench.shown.includes(target.value)) bench.shown.push(target.value);
  target.selectedIndex = 0;
  askFor();
  solve();
});
element("baseline").addEventListener("click", () => {
  if (!bench.curves) return;
  remember();      // what was typed a moment ago
  const number = (bench.count = (bench.count ?? 0) + 1), name = element("baseline-name").value.trim() || `baseline ${number}`;
  bench.baselines = bench.baselines.filter((one) => one.name !== name);
  bench.baselines.push({ name, colour: colours[(number - 1) % colours.length], solution: bench.curves, text: bench.kept });
  element("baseline-name").value = "";
  element("baseline-name").placeholder = `baseline ${number + 1}`;
  drawCharts();
});
element("baselines").addEventListener("change", drawCharts);
element("forget").addEventListener("click", () => {
  bench.baselines = bench.baselines.filter(({ name }) => name !== element("baselines").value);
  drawCharts();
});
element("undo").addEventListener("click", () => goBack("past"));
element("redo").addEventListener("click", () => goBack("future"));
element("fit").addEventListener("click", () => drawViews(true));
element("changes").addEventListener("click", () => download(`${deck.replace(/\.nml$/i, "")}_changes.set`, changes()));
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || editor.dom.contains(event.target) || element("points").hidden) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) goBack("future");
  else goBack("past");
});
document.querySelector("[data-tab=points]").addEventListener("click", renew);

// For scripts: the curves as drawn, and whether they belong to the document
globalThis.elastokin.curves = () => ({ ...bench.curves, runs: bench.runs, isCurrent: !bench.isRunning && !bench.isWaiting });
