// The views of elastokin.html, behind workbench.js: the points from three sides, which are dragged.
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
    box.replaceChildren(deck ? "This deck has no points with three numbers." : "Open a deck of the library, or drop one here.");
    return fillTables();
  }
  if (isNew || !bench.view) {     // a view keeps its scale while points are moved
    const span = [0, 1, 2].map((k) => bench.points.map(({ at }) => at[k].value)).map((v) => [Math.min(...v), Math.max(...v)]);
    bench.view = { middle: span.map(([a, b]) => (a + b) / 2), size: Math.max(1e-9, ...span.map(([a, b]) => b - a)) };
  }
  const { middle, size } = bench.view, scale = (height - 2 * edge) / size * 1.25, known = new Map(bench.points.map((p) => [p.name, p]));
  const drawn = viewsOf().map(([title, h, hs, v, vs]) => {
    const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `${title} view` });
    make("text", { x: 8, y: 16, class: "title" }, svg, title);
    const place = (point, body = point.body) => {
      const at = positionOf(point, body);
      return [width / 2 + hs * (at[h] - middle[h]) * scale, height / 2 - vs * (at[v] - middle[v]) * scale];
    };
    for (const { ends, kind, bodies } of bench.links) {
      const [[x1, y1], [x2, y2]] = ends.map((end, k) => place(known.get(end), bodies[k]));
      make("line", { x1, y1, x2, y2, class: /spring|damper|stop/.test(kind) ? "spring" : kind === "body" ? "body" : "link" }, svg);
    }
    for (const { name, vector } of question.arrows.filter((one) => known.has(one.name))) {
      drawArrow(svg, place(known.get(name)), [44 * hs * vector[h], -44 * vs * vector[v]], name);
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
  fillTables();
}

// A point of a body in the state of the slider, in the unit of the deck; at design, and where no pose is known, as in the deck. A body of
// the half deck of an axle is the left one.
function positionOf({ at }, body) {
  const p = at.map(({ value }) => value), { poses, bodies } = bench.curves ?? {};
  const k = poses && bench.at !== null ? Math.max(bodies.indexOf(body), bodies.indexOf(`left_${body}`)) : -1;
  if (k < 0 || !(bench.row < poses.length) || !Number.isFinite(poses[bench.row][12 * k])) return p;
  const m = poses[bench.row].subarray(12 * k, 12 * k + 12);
  return [0, 1, 2].map((i) => m[3 * i] * p[0] + m[3 * i + 1] * p[1] + m[3 * i + 2] * p[2] + m[9 + i] / bench.length);
}

// An arrow of some length, from a place; one that is too short to be seen, or along the view, is left out
function drawArrow(svg, [x, y], [dx, dy], name) {
  const length = Math.hypot(dx, dy), [ux, uy] = [dx / length, dy / length], [tx, ty] = [x + dx, y + dy];
  if (!(length > 7)) return;
  const head = [[-6, 3], [-6, -3]].map(([along, across]) => `L${tx + along * ux - across * uy} ${ty + along * uy + across * ux}`).join("");
  make("path", { d: `M${x} ${y}L${tx} ${ty}M${tx} ${ty}${head}Z`, class: "arrow", "data-arrow": name }, svg);
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
