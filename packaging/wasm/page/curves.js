// The curves of elastokin.html, behind workbench.js: a test of the document solved in the worker, and its charts.
// Numbers that the worker sets, as [path, value], and the document without them: another frame is another model.
function settable() {
  const numbers = numbersOf(bench), rest = new Map(files);
  for (const file of new Set(numbers.map((one) => one.file))) {
    rest.set(file, replaceNumbers(rest.get(file), numbers.filter((one) => one.file === file).map((one) => [one, "#"])));
  }
  return { numbers: numbers.map(({ path, value }) => [path, value]), frame: JSON.stringify([...rest]) };
}

// Solves the chosen test; while one solution runs, only the last change waits.
async function solve() {
  if (element("points").hidden || !deck || !program) return;
  if (bench.isRunning) {
    bench.isWaiting = true;
    return;
  }
  bench.isRunning = true;
  do {
    bench.isWaiting = false;
    const test = element("test").value, head = `${test}, 20 increments`;
    const isWhole = bench.headings.length === 0 || bench.columns.length === 0, wanted = isWhole ? [] : bench.columns;
    const result = await program.solve({ ...settable(), files: [...files], deck, test, increments: 20, columns: wanted });
    if (result === null) continue;
    bench.runs++;
    if (result.units) {
      bench.units = new Map(result.units);
      fillRates();
      fill(element("key-number"), ["K&C metric …", ...result.keyNumbers], "K&C metric …");
    }
    const { columns } = result;
    if (!columns) {
      if (!isWhole) {      // another deck has other columns
        bench.columns = [];
        bench.isWaiting = true;
        continue;
      }
      tell(`${head}: no curve. ${firstLine(result)} The curves below are those of the last document that could be solved.`, true);
      element("charts").classList.add("stale");
      continue;
    }
    if (isWhole) setColumns(Object.keys(columns));
    const { duration, bytes, openings, poses, bodies } = result;
    bench.curves = { test, columns, x: abscissaOf(test, columns), duration, bytes, openings, poses, bodies };
    element("charts").classList.remove("stale");
    drawCharts();
    if (bench.at !== null) drawViews();
    const bad = columns.converged?.filter((one) => one === 0).length ?? 0;
    tell(`${head}: solved in ${result.duration.toFixed(1)} ms${result.status === 0 ? "" : `; ${firstLine(result)}`}` +
      `${bad > 0 ? ` ${bad} states have no solution.` : ""}`, result.status !== 0);
  } while (bench.isWaiting);
  bench.isRunning = false;
  document.dispatchEvent(new Event("solved"));
}

const firstLine = ({ messages, trap }) => trap ? `The program was stopped by an error in it: ${trap}` :
  messages.split("\n").find((line) => line.trim() !== "" && !/^(note|remark|balance)/.test(line)) ?? "";

function tell(text, isBad) {
  element("said").textContent = text;
  element("said").className = isBad ? "bad" : "";
}

// Swept values other than the travel of the wheels, with the units of the table
const swept = { roll: ["axle roll", "deg"], steering: ["steering driver", ""], lateral_force: ["lateral force", "N"], braking: ["braking force", "N"],
  traction: ["driving force", "N"], aligning_torque: ["aligning torque", "N m"] };
const abscissaOf = (test, columns) => test in swept ? "factor" :
  ["wheel_travel_mm", "left_wheel_travel_mm"].find((name) => name in columns && spread(columns[name]) > 1e-6) ?? "factor";
const finite = (values) => values.filter(Number.isFinite);
const spread = (values) => {
  const known = finite(values);
  return known.length > 0 ? Math.max(...known) - Math.min(...known) : 0;
};

// The columns of the deck, without side; those that charts show, with both sides, are asked for in further runs.
function setColumns(headings) {
  const plain = [...new Set(headings.map((name) => name.replace(/^(left|right)_/, "")))]
    .filter((name) => !["state", "factor", "converged", "stable", "near_singular", "iterations", "constraint_error"].includes(name));
  if (plain.join() !== bench.headings.join()) {
    bench.headings = plain;
    fill(element("quantity"), ["another chart …", ...plain], "another chart …");
  }
  bench.all = headings;
  bench.shown = (bench.shown ?? wanted).filter((name) => plain.includes(name));
  if (bench.shown.length === 0) bench.shown = wanted.filter((name) => plain.includes(name));
  askFor();
}

function askFor() {
  const names = ["wheel_travel_mm", ...bench.shown];
  bench.columns = bench.all.filter((name) => names.includes(name.replace(/^(left|right)_/, "")));
}

// [label, values] of a quantity in a solution: one curve where both sides are equal but for rounding
function curvesOf({ columns }, quantity) {
  const sides = [["", quantity], ["left", `left_${quantity}`], ["right", `right_${quantity}`]].filter(([, name]) => name in columns);
  if (sides.length < 2) return sides.map(([side, name]) => [side, columns[name]]);
  const [left, right] = sides.map(([, name]) => columns[name]), most = Math.max(...finite([...left, ...right]).map(Math.abs), 0);
  if (left.every((value, k) => Math.abs(value - right[k]) <= 1e-7 * Math.max(1, most) || Number.isNaN(value + right[k]))) return [["left = right", left]];
  return sides.map(([side, name]) => [side, columns[name]]);
}

const shortly = (value) => Number.isFinite(value) ? String(Number(value.toPrecision(4))).replace("-", "−") : "–";

// The difference of two values; 0 if it is rounding
const difference = (a, b) => Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(b)) ? 0 : a - b;

// The row of the design, where the abscissa is least
function rowOfDesign({ columns, x }) {
  const xs = columns[x].map(Math.abs);
  return xs.reduce((best, value, k) => value < xs[best] ? k : best, 0);
}

// The row of a solution with the swept value of the slider; without one, that of the design
function rowOf(solution) {
  const row = bench.at === null ? -1 : solution.columns.factor.findIndex((value) => Math.abs(value - bench.at) <= 1e-9 * Math.max(1, Math.abs(value)));
  return row < 0 ? rowOfDesign(solution) : row;
}

function stateText() {
  const { test, x, columns } = bench.curves, [words, unit] = x === "factor" && swept[test] || [x.replace(/^left_/, ""), ""];
  return bench.row === rowOfDesign(bench.curves) ? "at design" : `at ${words} ${shortly(columns[x][bench.row])} ${unit}`.trim();
}

// Moves to a state of the test: row `row` of the solution
function setState(row) {
  if (!bench.curves) return;
  bench.at = row === rowOfDesign(bench.curves) ? null : bench.curves.columns.factor[row];
  drawCharts();
  drawViews();
}

// The list of baselines; a new one is chosen
function listBaselines() {
  const list = element("baselines"), names = bench.baselines.map(({ name }) => name);
  if ([...list.options].map(({ value }) => value).join("\n") !== names.join("\n")) fill(list, names, names.at(-1));
  element("forget").disabled = element("compare").disabled = names.length === 0;
}

function drawCharts() {
  const now = bench.curves, slider = element("state");
  listBaselines();
  bench.row = rowOf(now);
  slider.max = now.columns.factor.length - 1;
  slider.value = bench.row;
  element("state-text").textContent = stateText();
  slider.setAttribute("aria-valuetext", stateText());
  fillAsked();
  const boxes = bench.shown.map((quantity) => {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const before = bench.baselines.filter(({ solution }) => solution.test === now.test);
    const lines = [...before.flatMap(({ solution, colour, name }) => curvesOf(solution, quantity).map(([side, values]) =>
      ({ xs: solution.columns[solution.x], at: solution.columns.factor, values, colour, side, name }))),
      ...curvesOf(now, quantity).map(([side, values], k) => ({ xs: now.columns[now.x], at: now.columns.factor, values, colour: k ? "#c2185b" : "var(--link)", side, name: "" }))];
    const base = before.find(({ name }) => name === element("baselines").value) ?? before.at(-1);
    const current = lines.filter(({ name }) => name === ""), last = lines.filter(({ name }) => name !== "" && name === base?.name);
    const value = current.map((line) => line.values[bench.row]), old = last.map((line) => line.values[rowOf(base.solution)]);
    caption.textContent = `${quantity}: ${value.map(shortly).join(", ")} ${stateText()}`;
    if (old.length === value.length && old.length > 0) {
      caption.textContent += `, Δ ${value.map((one, k) => shortly(difference(one, old[k]))).join(", ")}; Δ at most ${shortly(largestChange(current, last))}`;
    }
    caption.append(buttonOf("×", `Remove the chart of ${quantity}`, () => {
      bench.shown = bench.shown.filter((name) => name !== quantity);
      askFor();
      drawCharts();
    }));
    figure.append(caption, chartOf(lines, now.x === "factor" && swept[now.test] ? swept[now.test].filter((word) => word !== "").join(", ") : now.x, (x) => pointAt(quantity, x), now.columns[now.x][bench.row]));
    return figure;
  });
  element("charts").replaceChildren(...boxes);
}

// Largest difference of two sets of curves at the same swept values
function largestChange(current, last) {
  let most = NaN;
  current.forEach(({ at, values }, k) => values.forEach((value, m) => {
    const change = Math.abs(at[m] - last[k].at[m]) <= 1e-9 * Math.max(1, Math.abs(at[m])) ? Math.abs(difference(value, last[k].values[m])) : NaN;
    if (Number.isFinite(change)) most = Math.max(change, most || 0);
  }));
  return most;
}

// A click on a chart points at its quantity, in the state whose abscissa is nearest
function pointAt(quantity, x) {
  const { columns, x: name } = bench.curves, gaps = columns[name].map((value) => Number.isFinite(value) ? Math.abs(value - x) : Infinity);
  const side = [quantity, `left_${quantity}`, `right_${quantity}`].find((one) => one in columns);
  setState(gaps.indexOf(Math.min(...gaps)));
  if (side) element("asked").value = side;
}

// A chart; `take` receives the abscissa of a click, `marked` is the abscissa of the state
function chartOf(lines, x, take, marked) {
  const svg = make("svg", { viewBox: "0 0 300 170", role: "img" }), left = 46, right = 292, top = 8, bottom = 144;
  const xs = finite(lines.flatMap((line) => line.xs)), ys = finite(lines.flatMap((line) => line.values));
  if (ys.length === 0) {
    make("text", { x: 60, y: 80 }, svg, "no value");
    return svg;
  }
  const [x0, x1] = rangeOf(xs), [y0, y1] = rangeOf(ys);
  const px = (value) => left + (right - left) * (value - x0) / (x1 - x0), py = (value) => bottom - (bottom - top) * (value - y0) / (y1 - y0);
  for (const tick of ticksOf(x0, x1)) {
    make("line", { x1: px(tick), x2: px(tick), y1: top, y2: bottom, class: "grid" }, svg);
    make("text", { x: px(tick), y: bottom + 13, "text-anchor": "middle" }, svg, shortly(tick));
  }
  for (const tick of ticksOf(y0, y1)) {
    make("line", { x1: left, x2: right, y1: py(tick), y2: py(tick), class: "grid" }, svg);
    make("text", { x: left - 4, y: py(tick) + 4, "text-anchor": "end" }, svg, shortly(tick));
  }
  make("text", { x: (left + right) / 2, y: 168, "text-anchor": "middle" }, svg, x);
  if (Number.isFinite(marked)) make("line", { x1: px(marked), x2: px(marked), y1: top, y2: bottom, class: "state" }, svg);
  svg.addEventListener("click", (event) => {
    const box = svg.getBoundingClientRect();
    take(x0 + (x1 - x0) * ((event.clientX - box.x) * 300 / box.width - left) / (right - left));
  });
  for (const { xs: across, values, colour, side, name } of lines) {
    let path = "", isOpen = false;
    values.forEach((value, k) => {
      if (!Number.isFinite(value)) isOpen = false;
      else {
        path += `${isOpen ? "L" : "M"}${px(across[k]).toFixed(2)} ${py(value).toFixed(2)}`;
        isOpen = true;
      }
    });
    const curve = make("path", { d: path, class: name === "" ? "curve" : "curve baseline", stroke: colour }, svg);
    make("title", {}, curve, [name || "now", side].filter((word) => word !== "").join(", "));
  }
  return svg;
}

function rangeOf(values) {
  const low = Math.min(...values), high = Math.max(...values), room = high - low > 1e-9 * Math.max(1, Math.abs(high)) ? 0.04 * (high - low) : Math.max(1e-3, 0.01 * Math.abs(high));
  return [low - room, high + room];
}

function ticksOf(low, high) {
  const rough = (high - low) / 4, power = 10 ** Math.floor(Math.log10(rough)), step = power * [1, 2, 5, 10].find((k) => k * power >= rough);
  const first = Math.ceil(low / step), ticks = [];
  for (let k = first; k * step <= high; k++) ticks.push(k * step);
  return ticks;
}
