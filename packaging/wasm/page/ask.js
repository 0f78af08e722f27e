// Questions about a number of elastokin.html, behind curves.js: what moves it most (derivatives, drawn as arrows at the points), what
// it consists of (explain), and which parameters of the deck give it another value (solve). The command line answers, with the document.
const question = { conditions: [], unknowns: new Map(), arrows: [], found: [] };      // unknowns: path -> [low, high]

// The number pointed at: a column of the test at the state of the slider, as `solve` names it
const askedNumber = () => `${bench.curves.test}:${element("asked").value}@${bench.curves.columns.factor[bench.row]}`;

function fillAsked() {
  const names = Object.keys(bench.curves.columns).filter((name) => bench.shown.includes(name.replace(/^(left|right)_/, "")));
  const chosen = element("asked").value, list = element("asked");
  if ([...list.options].map(({ value }) => value).join() !== names.join()) fill(list, names, names.includes(chosen) ? chosen : names[0]);
}

// The answer belongs to a former document
function outdate() {
  question.arrows = [];
  question.found = [];
  element("accept").disabled = true;
  element("answer").classList.toggle("stale", element("answer").textContent !== "");
}

// Runs a command with the document; its files as text, or null with a message in the page
async function consult(words) {
  const before = snapshot();
  outdate();
  element("answer").classList.remove("stale");
  element("answer").textContent = `${words[0]} …`;
  const result = await program.run([words[0], deck, ...words.slice(1), "--quiet", "--out", "answer"], [...files]);
  if (result === null) {
    element("answer").textContent = "Stopped.";
    return null;
  }
  const written = result.written.map(([path, content]) => [relative(path), textOf(content)]);
  if (result.trap || written.length === 0 || before !== snapshot()) {
    element("answer").textContent = before === snapshot() ? firstLine(result) : "The document has changed meanwhile: ask again.";
    return null;
  }
  return { ...result, written };
}

const ofTest = () => ["--case", bench.curves.test, "--of", element("asked").value, "--at", String(bench.curves.columns.factor[bench.row])];

// Shows tables, or other parts of an answer, after the reason why it is not whole
function answerWith({ status, messages }, ...parts) {
  element("answer").replaceChildren(...status === 0 ? [] : [firstLine({ messages })], ...parts);
}

// The rows of a file that a command wrote, as objects by heading
function rowsOf({ written }, ending) {
  const [heads, ...rows] = tableOf(written.find(([path]) => path.endsWith(ending))[1]);
  return rows.map((row) => Object.fromEntries(heads.map((head, k) => [head, row[k]])));
}

// A small change of a number other than a coordinate, with its words, as `derivatives` sorts by
const smallChange = ({ unit, at }) => ({ mm: [1, "1 mm"], deg: [0.06, "0.06 deg"] })[unit] ?? [Math.abs(Number(at)) / 100, "1 %"];

// The numbers that the command prints: the ten with the largest effects, and none whose derivative is rounding noise
const listedNumbers = ({ output }) => new Set([...output.matchAll(/^  (\S+) +\S+(?: per .*)?$/gm)].map(([, path]) => path));

async function showMovers() {
  const column = element("asked").value, head = `Change of ${column} ${stateText()}`;
  const result = await consult(["derivatives", ...ofTest()]);
  if (!result) return;
  const points = new Map(), others = [], listed = listedNumbers(result);
  for (const row of rowsOf(result, "_derivatives.csv").filter(({ number }) => listed.has(number))) {
    const slope = Number(row.derivative), [size, words] = smallChange(row);
    const [, name, axis] = /^point\.(.+)\.([xyz])$/.exec(row.number) ?? [];
    if (!name && !/^case\./.test(row.number)) others.push([row.number, words, slope * size]);
    if (!name) continue;
    if (!points.has(name)) points.set(name, { name, unit: row.unit, slopes: [NaN, NaN, NaN] });
    points.get(name).slopes["xyz".indexOf(axis)] = slope;
  }
  const known = (slopes) => slopes.map((slope) => slope || 0);
  const sorted = [...points.values()].map((one) => ({ ...one, size: Math.hypot(...known(one.slopes)) }))
    .sort((a, b) => b.size - a.size);
  question.arrows = sorted.map(({ name, slopes }) => ({ name, vector: known(slopes).map((slope) => slope / sorted[0].size) }));
  drawViews();
  answerWith(result,
    sorted.length === 0 ? `No point moves ${column} ${stateText()}.` :
      tableWith(`${head}, by 1 ${sorted[0].unit} of a point, of the ten largest; the arrows point to where it grows`,
        ["Point", "at most", "x", "y", "z"],
        sorted.map(({ name, slopes, size }) => [name, size, ...slopes.map((slope) => Number.isNaN(slope) ? "" : slope)])),
    others.length === 0 ? "" : tableWith(`${head}, by another number`, ["Number", "by", "change"],
      others.sort((a, b) => Math.abs(b[2]) - Math.abs(a[2]))));
}

// How far the number varies if every coordinate of the points does, by their derivatives: all coordinates are independent, with the given
// standard deviation. On a mirrored axle, a coordinate varies on both sides alike.
async function showTolerance() {
  const column = element("asked").value, deviation = Number(element("deviation").value.replace(",", "."));
  if (!(deviation > 0)) {
    element("answer").textContent = "Enter a standard deviation of the coordinates above 0.";
    return;
  }
  const result = await consult(["derivatives", ...ofTest()]);
  if (!result) return;
  const rows = rowsOf(result, "_derivatives.csv").map((row) => ({ ...row, effect: Number(row.derivative) * deviation }))
    .filter(({ number, derivative, error }) => /^point\./.test(number) && Math.abs(derivative) > 10 * Math.abs(error));
  const square = rows.reduce((sum, { effect }) => sum + effect ** 2, 0), most = rows.reduce((sum, { effect }) => sum + Math.abs(effect), 0);
  if (rows.length === 0) return answerWith(result, `No coordinate of a point changes ${column} ${stateText()}.`);
  const head = `${column} ${stateText()} = ${shortly(Number(rows[0].value))} has the standard deviation ${shortly(Math.sqrt(square))} if every coordinate ` +
    `has ${shortly(deviation)} ${rows[0].unit}; if every coordinate differs by ${shortly(deviation)} ${rows[0].unit} in the worst direction, it changes by ${shortly(most)}`;
  return answerWith(result, tableWith(head, ["Coordinate", "effect", "share of the variance, %"],
    rows.sort((a, b) => Math.abs(b.effect) - Math.abs(a.effect)).slice(0, 10).map(({ number, effect }) => [number, effect, 100 * effect ** 2 / square])));
}

async function showParts() {
  const column = element("asked").value, result = await consult(["explain", ...ofTest()]);
  if (!result) {
    if (/is not a compliance column/.test(element("answer").textContent)) {
      element("answer").append(" Such columns are responses to loads, for example lateral_in_load_held_steer_deg_per_kn: add its chart.");
    }
    return;
  }
  const rows = rowsOf(result, "_contributions.csv");
  const head = `${column} ${stateText()} = ${shortly(Number(rows[0].column_value))} consists of`;
  answerWith(result, tableWith(head, ["Part", "value", "share, %"],
    rows.map(({ row, part, value, share }) => [`${row}.${part}`, Number(value), 100 * Number(share)])
      .sort((a, b) => Math.abs(b[1]) - Math.abs(a[1])).slice(0, 15)));
}

async function solveConditions() {
  const conditions = question.conditions.flatMap(({ name, wanted }) => ["--for", `${name}=${wanted.trim() || "keep"}`]);
  const unknowns = [...question.unknowns].flatMap(([path, [low, high]]) => ["--vary", `${path}=${low}:${high}`]);
  const result = await consult(["solve", ...unknowns, ...conditions]);
  if (!result) return;
  const settings = result.written.find(([path]) => path.endsWith(".set"))?.[1] ?? "", report = document.createElement("pre");
  report.textContent = result.output.split("\n").filter((line) => !/\.(set|csv)$/.test(line)).join("\n");
  answerWith(result, report);
  question.found = settings.split("\n").filter((line) => /^[^#]*=/.test(line)).map((line) => line.split("=").map((word) => word.trim()));
  element("accept").disabled = question.found.length === 0;
}

// The numbers that `solve` found, in the text of the document
function accept() {
  const found = new Map(question.found), missing = question.found.filter(([path]) => !numbersOf(bench).some((one) => one.path === path));
  for (const file of filesOfDeck(files)) {
    const list = numbersOf(bench).filter((one) => one.file === file && found.has(one.path));
    setNumbers(list.map((one) => [one, Number(found.get(one.path))]));
  }
  remember();
  if (missing.length > 0) element("answer").append(`Not in the text of the deck: ${missing.map(([path]) => path).join(", ")}`);
}

// ---- tables ---------------------------------------------------------------------------------------

const tableOf = (text) => text.split("\n").filter((row) => row !== "" && !row.startsWith("#")).map(cellsOf);

function tableWith(title, heads, rows) {
  const table = document.createElement("table");
  table.createCaption().textContent = title;
  table.append(headOf(heads), ...rows.map(([first, ...rest]) => {
    const row = document.createElement("tr");
    row.append(cellOf(first));
    for (const value of rest) row.insertCell().append(typeof value === "number" ? shortly(value) : value);
    return row;
  }));
  return table;
}

function plainField(label, value, take, hint = "") {
  const input = document.createElement("input");
  input.placeholder = hint;
  input.value = value;
  input.setAttribute("aria-label", label);
  input.addEventListener("change", () => take(input.value.replace(",", ".").replace("−", "-")));
  return input;
}

function buttonOf(text, label, act) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  button.setAttribute("aria-label", label);
  button.addEventListener("click", act);
  return button;
}

function fillQuestion() {
  const { conditions, unknowns } = question;
  element("conditions").replaceChildren(tableWith("Conditions", ["Number", "wanted", ""], conditions.map((one) => [one.name,
    plainField(`wanted value of ${one.name}`, one.wanted, (value) => { one.wanted = value; }, "keep"),
    buttonOf("×", `Remove the condition of ${one.name}`, () => {
      question.conditions = conditions.filter((other) => other !== one);
      fillQuestion();
    })])));
  const rows = [...unknowns].map(([path, bounds]) => [path,
    ...[0, 1].map((k) => plainField(`${path} ${["from", "to"][k]}`, bounds[k], (value) => { bounds[k] = value; })),
    buttonOf("×", `Keep ${path}`, () => setFree(path, false))]);
  element("unknowns").replaceChildren(tableWith("Numbers that may change", ["Number", "from", "to", ""], rows));
  for (const button of document.querySelectorAll("[data-free]")) {
    button.setAttribute("aria-pressed", String(unknowns.has(button.dataset.free)));
  }
  element("solve").disabled = conditions.length === 0 || unknowns.size === 0;
}

// Whether `solve` may change a number; the first bounds are 20 mm on both sides of a coordinate, and half and double of another number
function setFree(path, isFree) {
  const value = numbersOf(bench).find((one) => one.path === path)?.value ?? 0, digits = (bound) => String(Number(bound.toPrecision(6)));
  const bounds = /^point\./.test(path) ? [value - 20, value + 20] : value === 0 ? [-1, 1] : [value / 2, value * 2].sort((a, b) => a - b);
  if (isFree) question.unknowns.set(path, bounds.map(digits));
  else question.unknowns.delete(path);
  fillQuestion();
}

function addCondition(name, wanted) {
  if (!question.conditions.some((one) => one.name === name)) question.conditions.push({ name, wanted });
  fillQuestion();
}

const onceSolved = (act) => () => element("asked").value === "" ? undefined : act();
element("movers").addEventListener("click", onceSolved(showMovers));
element("tolerance").addEventListener("click", onceSolved(showTolerance));
element("parts").addEventListener("click", onceSolved(showParts));
element("condition").addEventListener("click", onceSolved(() => {
  addCondition(askedNumber(), String(Number(bench.curves.columns[element("asked").value][bench.row].toPrecision(6))));
}));
element("key-number").addEventListener("change", ({ target }) => {
  addCondition(target.value, "");
  target.selectedIndex = 0;
});
element("solve").addEventListener("click", solveConditions);
element("accept").addEventListener("click", accept);
document.addEventListener("opened", () => {
  Object.assign(question, { conditions: [], unknowns: new Map(), arrows: [], found: [] });
  element("answer").replaceChildren();
  outdate();
  fillQuestion();
});
fillQuestion();
