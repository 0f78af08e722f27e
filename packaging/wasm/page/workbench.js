// Points and curves of elastokin.html: the hardpoints of the document as three views and a table, and the curves of a test that follow
// every change. A change is a change of the text, so that text, views, table and curves are one document. The numbers are those of
// `elastokin run DECK --case TEST --increments 20`, solved anew after each change.
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

// The groups of a deck: { name, text, start, keys: key -> { start, end } }, positions in the text. In `masked`, strings are ×, comments blank.
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

const stringsOf = (text, key) => key ? [...text.slice(key.start, key.end).matchAll(/'((?:[^']|'')*)'|"([^"]*)"/g)].map((m) => m[1] ?? m[2]) : [];

// The points of a deck with three numbers: { name, at: [{ start, text, value }, …] }, each number with its position in the text.
function pointsOf(text, groups) {
  const points = [];
  for (const { name, keys } of groups) {
    if (name !== "point" || !keys.name || !keys.at) continue;
    const numbers = [...text.slice(keys.at.start, keys.at.end).matchAll(/[-+]?(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?/gi)];
    if (numbers.length !== 3) continue;
    points.push({ name: stringsOf(text, keys.name)[0],
      at: numbers.map((m) => ({ start: keys.at.start + m.index, text: m[0], value: Number(m[0].replace(/d/i, "e")) })) });
  }
  return points;
}

// Reads the points of all files, and the lines between the points of each body.
function readPoints() {
  bench.points = [];
  const of = new Map(), pairs = [];
  const add = (body, point) => {
    if (!body || body === "chassis" || !point) return;
    if (!of.has(body)) of.set(body, new Set());
    of.get(body).add(point);
  };
  for (const [file, text] of files) {
    if (!/\.nml$/i.test(file)) continue;
    const groups = groupsOf(text);
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
        if (now && now.at[k].value !== at[k].value) lines.push(`point.${name}.${axis} = ${now.at[k].text}\n`);
      });
    }
  }
  return lines.join("");
}

// ---- views ----------------------------------------------------------------------------------------

// Horizontal and vertical axis of each view with their sign on the screen; front to the left, right side to the right from behind
function viewsOf() {
  const forward = bench.axes === "x-rear" ? 1 : -1;
  return [["Side", 0, forward, 2, 1], ["From behind", 1, forward, 2, 1], ["Top", 0, forward, 1, forward]];
}

function make(name, attributes, parent, text) {
  const node = document.createElementNS(drawing, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  parent?.append(node);
  return node;
}

const width = 300, height = 210, edge = 26;

function drawViews(isNew = false) {
  const box = element("views");
  if (bench.points.length === 0) {
    box.replaceChildren("This deck has no points with three numbers.");
    return fillPoints();
  }
  if (isNew || !bench.view) {     // a view keeps its scale while points are moved
    const span = [0, 1, 2].map((k) => bench.points.map(({ at }) => at[k].value)).map((v) => [Math.min(...v), Math.max(...v)]);
    bench.view = { middle: span.map(([a, b]) => (a + b) / 2), size: Math.max(1e-9, ...span.map(([a, b]) => b - a)) };
  }
  const { middle, size } = bench.view, scale = (height - 2 * edge) / size * 1.25, known = new Map(bench.points.map((p) => [p.name, p]));
  const drawn = viewsOf().map(([title, h, hs, v, vs]) => {
    const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `${title} view` });
    make("text", { x: 8, y: 16, class: "title" }, svg, title);
    const place = ({ at }) => [width / 2 + hs * (at[h].value - middle[h]) * scale, height / 2 - vs * (at[v].value - middle[v]) * scale];
    for (const [a, b, kind] of bench.links) {
      const [x1, y1] = place(known.get(a)), [x2, y2] = place(known.get(b));
      make("line", { x1, y1, x2, y2, class: /spring|damper|stop/.test(kind) ? "spring" : kind === "body" ? "body" : "link" }, svg);
    }
    for (const point of bench.points) {
      const [cx, cy] = place(point);
      const dot = make("circle", { cx, cy, r: 5, tabindex: 0, role: "button", "data-point": point.name, "aria-label": `${point.name}, ${title} view` }, svg);
      if (point.name === bench.chosen) dot.setAttribute("class", "chosen");
      make("title", {}, dot, `${point.name}: ${point.at.map((one) => one.text).join(", ")}`);
      dot.addEventListener("pointerdown", (event) => drag(event, point.name, { h, hs, v, vs, scale }));
      dot.addEventListener("focus", () => choose(point.name));
      dot.addEventListener("keydown", (event) => nudge(event, point.name, { h, hs, v, vs, title }));
    }
    if (known.has(bench.chosen)) {
      const [x, y] = place(known.get(bench.chosen));
      make("text", { x: Math.min(x + 8, width - 90), y: Math.max(24, y - 8), class: "name" }, svg, bench.chosen);
    }
    return svg;
  });
  const active = document.activeElement?.dataset?.point, label = document.activeElement?.getAttribute?.("aria-label");
  bench.isDrawing = true;
  box.replaceChildren(...drawn);
  if (active) [...box.querySelectorAll("circle")].find((dot) => dot.getAttribute("aria-label") === label)?.focus({ preventScroll: true });
  bench.isDrawing = false;
  fillPoints();
}

function choose(name) {
  if (bench.isDrawing || bench.chosen === name) return;
  bench.chosen = name;
  drawViews();
}

const stepOf = () => Number(element("step").value);
const snap = (value, step) => Math.round(value / step) * step;

function drag(event, name, { h, hs, v, vs, scale }) {
  event.preventDefault();
  bench.chosen = name;
  const from = pointOf(name).at.map(({ value }) => value), box = event.target.ownerSVGElement.getBoundingClientRect();
  const unit = width / box.width, start = [event.clientX, event.clientY], step = stepOf();
  const move = ({ clientX, clientY }) => {
    const values = [...from];
    values[h] = from[h] + snap(hs * (clientX - start[0]) * unit / scale, step);
    values[v] = from[v] - snap(vs * (clientY - start[1]) * unit / scale, step);
    movePoint(name, values);
  };
  const end = () => {
    removeEventListener("pointermove", move);
    removeEventListener("pointerup", end);
    removeEventListener("pointercancel", end);
    remember();
  };
  addEventListener("pointermove", move);
  addEventListener("pointerup", end);
  addEventListener("pointercancel", end);
  drawViews();
}

function nudge(event, name, { h, hs, v, vs }) {
  const way = { ArrowLeft: [h, -hs], ArrowRight: [h, hs], ArrowUp: [v, vs], ArrowDown: [v, -vs] }[event.key];
  if (!way) return;
  event.preventDefault();
  const values = pointOf(name).at.map(({ value }) => value);
  values[way[0]] += way[1] * stepOf();
  movePoint(name, values);
  remember();
}

// The table of points. Cells that exist are only given their values, so that typing is not interrupted.
function fillPoints() {
  const table = element("coordinates"), names = bench.points.map(({ name }) => name).join("\n");
  if (table.dataset.names !== names) {
    table.dataset.names = names;
    const head = document.createElement("tr");
    for (const word of ["Point", "x", "y", "z"]) {
      const cell = document.createElement("th");
      cell.textContent = word;
      head.append(cell);
    }
    table.replaceChildren(head, ...bench.points.map(({ name }) => {
      const row = document.createElement("tr"), first = document.createElement("th");
      first.textContent = name;
      row.append(first);
      ["x", "y", "z"].forEach((axis, k) => {
        const cell = row.insertCell(), input = document.createElement("input");
        input.setAttribute("aria-label", `${name} ${axis}`);
        input.addEventListener("focus", () => choose(name));
        input.addEventListener("change", () => {
          const value = Number(input.value.replace(",", ".").replace("−", "-"));
          if (input.value.trim() === "" || !Number.isFinite(value)) return fillPoints();
          const values = [];
          values[k] = value;
          movePoint(name, values);
          return remember();
        });
        input.addEventListener("keydown", (event) => {
          if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
          event.preventDefault();
          const values = [];
          values[k] = pointOf(name).at[k].value + (event.key === "ArrowUp" ? 1 : -1) * stepOf();
          movePoint(name, values);
          input.value = pointOf(name).at[k].text;
          remember();
        });
        cell.append(input);
      });
      return row;
    }));
  }
  bench.points.forEach(({ name, at }, k) => {
    const row = table.rows[k + 1];
    row.className = name === bench.chosen ? "chosen" : "";
    at.forEach(({ text }, m) => {
      const input = row.cells[m + 1].firstChild;
      if (input !== document.activeElement || !input.matches(":focus") || bench.isReset) input.value = text;
    });
  });
}

// ---- curves ---------------------------------------------------------------------------------------

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
    const start = performance.now(), test = element("test").value, at = deck, asked = bench.headings.length > 0 && bench.columns?.length > 0
      ? ["--columns", bench.columns.join(",")] : [];
    const result = await program.run(["run", at, "--case", test, "--increments", "20", ...asked, "--quiet", "--out", "/curves"], [...files]);
    if (result === null) continue;
    bench.runs++;
    const written = result.written.find(([path]) => /\.csv$/.test(path)), head = `${test}, 20 increments`;
    if (result.trap || !written) {
      if (asked.length > 0) {      // another deck has other columns
        bench.columns = [];
        bench.isWaiting = true;
        continue;
      }
      tell(`${head}: no curve. ${firstLine(result)} The curves below are those of the last document that could be solved.`, true);
      element("charts").classList.add("stale");
      continue;
    }
    const rows = textOf(written[1]).split("\n").filter((row) => row !== "" && !row.startsWith("#")).map(cellsOf), columns = {};
    rows[0].forEach((name, k) => { columns[name] = rows.slice(1).map((row) => row[k] === "" ? NaN : Number(row[k])); });
    if (asked.length === 0) setColumns(rows[0]);
    bench.curves = { test, columns, x: abscissaOf(columns) };
    element("charts").classList.remove("stale");
    drawCharts();
    const bad = columns.converged?.filter((one) => one === 0).length ?? 0;
    tell(`${head}: solved in ${Math.round(performance.now() - start)} ms${result.status === 0 ? "" : `; ${firstLine(result)}`}` +
      `${bad > 0 ? ` ${bad} states have no solution.` : ""}`, result.status !== 0);
  } while (bench.isWaiting);
  bench.isRunning = false;
}

const firstLine = ({ messages, trap }) => trap ? `The program was stopped by an error in it: ${trap}` :
  messages.split("\n").find((line) => line.trim() !== "" && !/^(note|remark|balance)/.test(line)) ?? "";

function tell(text, isBad) {
  element("said").textContent = text;
  element("said").className = isBad ? "bad" : "";
}

const abscissaOf = (columns) => ["wheel_travel_mm", "left_wheel_travel_mm"].find((name) => name in columns && spread(columns[name]) > 1e-6) ?? "factor";
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

function valueAtDesign(solution, values) {
  const xs = solution.columns[solution.x];
  let best = 0;
  xs.forEach((x, k) => { if (Math.abs(x) < Math.abs(xs[best])) best = k; });
  return values[best];
}

function drawCharts() {
  const now = bench.curves, boxes = bench.shown.map((quantity) => {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const before = bench.baselines.filter(({ solution }) => solution.test === now.test);
    const lines = [...before.flatMap(({ solution, colour, name }) => curvesOf(solution, quantity).map(([side, values]) =>
      ({ xs: solution.columns[solution.x], values, colour, side, name }))),
      ...curvesOf(now, quantity).map(([side, values], k) => ({ xs: now.columns[now.x], values, colour: k ? "#c2185b" : "var(--link)", side, name: "" }))];
    const current = lines.filter(({ name }) => name === ""), last = lines.filter(({ name }) => name !== "" && name === before.at(-1)?.name);
    const value = current.map((line) => valueAtDesign(now, line.values)), old = last.map((line) => valueAtDesign(before.at(-1).solution, line.values));
    caption.textContent = `${quantity}: ${value.map(shortly).join(", ")} at design`;
    if (old.length === value.length && old.length > 0) {
      caption.textContent += `, Δ ${value.map((one, k) => shortly(one - old[k])).join(", ")}; Δ at most ${shortly(largestChange(current, last))}`;
    }
    const remove = document.createElement("button");
    remove.type = "button";
    remove.textContent = "×";
    remove.setAttribute("aria-label", `Remove the chart of ${quantity}`);
    remove.addEventListener("click", () => {
      bench.shown = bench.shown.filter((name) => name !== quantity);
      askFor();
      drawCharts();
    });
    caption.append(remove);
    figure.append(caption, chartOf(lines, now.x));
    return figure;
  });
  element("charts").replaceChildren(...boxes);
  fill(element("baselines"), bench.baselines.map(({ name }) => name), bench.baselines.at(-1)?.name);
  element("forget").disabled = bench.baselines.length === 0;
}

// Largest difference of two sets of curves at the same abscissas
function largestChange(current, last) {
  let most = NaN;
  current.forEach(({ xs, values }, k) => values.forEach((value, m) => {
    if (xs[m] === last[k].xs[m] && Number.isFinite(value - last[k].values[m])) most = Math.max(Math.abs(value - last[k].values[m]), most || 0);
  }));
  return most;
}

function chartOf(lines, x) {
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
