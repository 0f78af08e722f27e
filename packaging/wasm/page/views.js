// The views of elastokin.html, behind workbench.js: the points from three sides and obliquely, which are dragged.
// Right and upward direction of each view on the screen, in the frame of the deck; front to the left, right side to the right from behind.
// The oblique view is from above, and turns: `bench.turn` is its angle from the view from behind.
function viewsOf() {
  const forward = bench.axes === "x-rear" ? 1 : -1, up = [0, 0, 1], [c, s] = [Math.cos(bench.turn), Math.sin(bench.turn)], tilt = 0.42;
  return [["Side", [forward, 0, 0], up], ["From behind", [0, forward, 0], up], ["Top", [forward, 0, 0], [0, forward, 0]],
    ["Oblique", [-s * forward, c * forward, 0], [-Math.sin(tilt) * c * forward, -Math.sin(tilt) * s * forward, Math.cos(tilt)]]];
}

const along = (p, direction) => p[0] * direction[0] + p[1] * direction[1] + p[2] * direction[2];

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
  const drawn = viewsOf().map(([title, right, up]) => {
    const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `${title} view` });
    make("text", { x: 8, y: 16, class: "title" }, svg, title);
    const place = (point, body = point.body) => {
      const at = positionOf(point, body).map((one, k) => one - middle[k]);
      return [width / 2 + along(at, right) * scale, height / 2 - along(at, up) * scale];
    };
    for (const { ends, kind, bodies } of bench.links) {
      const [[x1, y1], [x2, y2]] = ends.map((end, k) => place(known.get(end), bodies[k]));
      make("line", { x1, y1, x2, y2, class: /spring|damper|stop/.test(kind) ? "spring" : kind === "body" ? "body" : "link" }, svg);
    }
    for (const { name, vector } of question.arrows.filter((one) => known.has(one.name))) {
      drawArrow(svg, place(known.get(name)), [44 * along(vector, right), -44 * along(vector, up)], name);
    }
    const places = bench.points.map((point) => [point, ...place(point)]);
    places.sort(([a], [b]) => (a.name === bench.chosen) - (b.name === bench.chosen));      // the chosen point above the others
    for (const [point, cx, cy] of places) {
      const dot = make("circle", { cx, cy, r: 5, tabindex: 0, role: "button", "data-point": point.name, "aria-label": `${point.name}, ${title} view` }, svg);
      if (point.name === bench.chosen) dot.setAttribute("class", "chosen");
      make("title", {}, dot, `${point.name}: ${point.at.map((one) => one.text).join(", ")}`);
      dot.addEventListener("pointerdown", (event) => drag(event, nearest(event, svg, places), { title, right, up, scale }));
      dot.addEventListener("focus", () => choose(point.name));
      dot.addEventListener("keydown", (event) => nudge(event, point.name, { right, up }));
    }
    if (known.has(bench.chosen)) {
      const [x, y] = place(known.get(bench.chosen));
      make("text", { x: Math.min(x + 8, width - 90), y: Math.max(24, y - 8), class: "name" }, svg, bench.chosen);
    }
    if (title === "Oblique") turnable(svg);
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

// Follows the pointer from an event until it is released: `move` receives the way on the screen
function follow(event, move, end) {
  event.preventDefault();
  const start = [event.clientX, event.clientY], moved = ({ clientX, clientY }) => move(clientX - start[0], clientY - start[1]);
  const ended = () => {
    removeEventListener("pointermove", moved);
    removeEventListener("pointerup", ended);
    removeEventListener("pointercancel", ended);
    end();
  };
  addEventListener("pointermove", moved);
  addEventListener("pointerup", ended);
  addEventListener("pointercancel", ended);
}

// The point that is nearest to the pointer, of those that cover each other
function nearest({ clientX, clientY }, svg, places) {
  const box = svg.getBoundingClientRect(), unit = width / box.width, [x, y] = [(clientX - box.x) * unit, (clientY - box.y) * unit];
  const gap = ([, px, py]) => Math.hypot(px - x, py - y);
  return places.reduce((best, one) => gap(one) <= gap(best) ? one : best)[0].name;
}

// A point follows the pointer in the plane of the view; each coordinate moves by whole steps
function drag(event, name, { title, right, up, scale }) {
  const from = pointOf(name).at.map(({ value }) => value), box = event.target.ownerSVGElement.getBoundingClientRect();
  const unit = width / box.width / scale, step = stepOf();
  bench.chosen = name;
  follow(event, (x, y) => movePoint(name, from.map((one, k) => one + snap((right[k] * x - up[k] * y) * unit, step))), remember);
  drawViews();
  document.querySelector(`#views circle[aria-label="${name}, ${title} view"]`).focus({ preventScroll: true });      // for the arrow keys
}

// The arrow keys move a point by one step, along the axis that is nearest to the direction on the screen
function nudge(event, name, { right, up }) {
  const [way, sign] = { ArrowLeft: [right, -1], ArrowRight: [right, 1], ArrowUp: [up, 1], ArrowDown: [up, -1] }[event.key] ?? [];
  if (!way) return;
  event.preventDefault();
  const values = pointOf(name).at.map(({ value }) => value), k = [0, 1, 2].reduce((best, m) => Math.abs(way[m]) > Math.abs(way[best]) ? m : best, 0);
  values[k] += sign * Math.sign(way[k]) * stepOf();
  movePoint(name, values);
  remember();
}

// The oblique view is turned by a drag of its ground, or by the arrow keys
function turnable(svg) {
  const turn = (angle) => {
    bench.turn = angle;
    drawViews();
  };
  svg.setAttribute("tabindex", 0);
  svg.setAttribute("aria-label", "Oblique view, turned by the left and right arrow keys");
  svg.addEventListener("pointerdown", (event) => {
    const from = bench.turn;
    if (!event.target.dataset.point) follow(event, (x) => turn(from + 0.01 * x), () => {});
  });
  svg.addEventListener("keydown", (event) => {
    if (event.target !== svg || event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    turn(bench.turn + (event.key === "ArrowLeft" ? -0.1 : 0.1));
    [...document.querySelectorAll("#views svg")].at(-1).focus({ preventScroll: true });
  });
}
