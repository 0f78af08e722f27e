// One chart of a report: its curves as SVG, its legend, and what they are at the cursor.
// A chart belongs to a test (see page.js), which holds what its charts share: cursor, zoom, hidden curves.

const drawn_height = 236, edge = { left: 54, right: 12, top: 16, bottom: 36 };
const both = "left = right";

// An SVG element with its attributes and text.
function svg(name, attributes, text) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (text !== undefined) node.textContent = text;
  return node;
}

// A number with about five digits and a real minus.
function shown(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const size = Math.abs(value), digits = size >= 1e7 ? undefined : Math.max(0, 4 - (size >= 1 ? Math.floor(Math.log10(size)) : 0));
  const text = digits === undefined ? value.toExponential(3) : String(Number(value.toFixed(digits)));
  return text.replace("-", "−");
}

// Ticks at round numbers, about `count` of them.
function ticks(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= raw * 0.7), list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) list.push(Number((k * step).toPrecision(12)));
  return list;
}

// The state of a curve nearest to a value of the abscissa; -1 without any.
function nearest(xs, ys, x) {
  let best = -1;
  for (let k = 0; k < xs.length; k++) {
    if (xs[k] === null || ys[k] === null) continue;
    if (best < 0 || Math.abs(xs[k] - x) < Math.abs(xs[best] - x)) best = k;
  }
  return best;
}

// A curve at a value of the abscissa, linear between two states; null outside.
function value_at(xs, ys, x) {
  for (let k = 1; k < xs.length; k++) {
    const a = xs[k - 1], b = xs[k];
    if (a === null || b === null || ys[k - 1] === null || ys[k] === null || (a - x) * (b - x) > 0 || a === b) continue;
    return ys[k - 1] + (ys[k] - ys[k - 1]) * (x - a) / (b - a);
  }
  return null;
}

// A curve at a value of the abscissa: of the state there, or between two states interpolated linearly; null outside.
function reading(xs, ys, x) {
  const k = nearest(xs, ys, x), seen = xs.filter((one) => one !== null), wide = Math.max(...seen) - Math.min(...seen);
  if (k >= 0 && Math.abs(xs[k] - x) <= 1e-6 * wide) return { x: xs[k], y: ys[k], is_between: false };
  const y = value_at(xs, ys, x);
  return y === null ? null : { x, y, is_between: true };
}

class Chart {
  constructor(test, figure, description) {
    Object.assign(this, { test, figure, description, is_drawn: false, is_visible: false, curves: [] });
  }

  // Own curves, and beside each the same curve of the overlaid report.
  take_curves() {
    const { test, description } = this;
    if (test.follow) test.follow();
    const match = test.other && test.other.charts.find((c) => c.id === description.id);
    this.match = match;
    // a curve of both wheels is two curves where the other report has one for each wheel
    const own = description.curves.flatMap((c) => {
      const sides = c.name === both && match ? match.curves.filter(({ name }) => name === "left" || name === "right") : [];
      return sides.length === 2 ? sides.map(({ name, dash }) => ({ ...c, name, dash })) : [c];
    });
    this.curves = own.map((c) => {
      const curve = { name: c.name || "value", colour: c.colour, dash: c.dash, x: test.data.x[c.x], y: test.data.y[c.y],
        design: c.design ?? test.data.design, from: c.from };
      // with other rates: the curve of the deck
      if (test.deck && test.deck[c.y]) Object.assign(curve, { column: c.y, deck: { x: curve.x, y: test.deck[c.y] } });
      const same = match && (match.curves.find((t) => t.name === c.name) || match.curves.find((t) => t.name === both));
      if (same) curve.other = { x: test.other.x[same.x], y: test.other.y[same.y] };
      // a curve of both wheels is compared with what was measured at either
      const columns = c.name === both ? [c.y, c.y.replace(/^left_/, "right_")] : [c.y];
      curve.measured = (test.data.measured || []).filter(({ y }) => columns.includes(y)).map(({ at, values }) => ({ x: at, y: values }));
      return curve;
    });
  }

  // Ends of the axes: of the zoomed range, or of the whole test; both reports if one is overlaid.
  axes() {
    const all = this.curves.flatMap((c) => [c, c.other, ...c.measured]).filter(Boolean), { match, description } = this;
    const xs = all.flatMap((c) => c.x.filter((x) => x !== null));
    let [x0, x1] = this.test.zoom || [Math.min(...xs), Math.max(...xs)];
    if (x0 === x1) [x0, x1] = [x0 - 1, x1 + 1];
    let low = Math.min(description.low, match ? match.low : Infinity), high = Math.max(description.high, match ? match.high : -Infinity);
    for (const { y } of this.curves.filter((c) => c.deck)) {
      const some = y.filter((v) => v !== null), step = (description.high - description.low) / 10;
      low = Math.min(low, description.low + step * Math.floor((Math.min(...some) - description.low) / step));
      high = Math.max(high, description.low + step * Math.ceil((Math.max(...some) - description.low) / step));
    }
    for (const v of this.curves.flatMap((c) => c.measured.flatMap((m) => m.y))) {
      if (v === null) continue;
      [low, high] = [Math.min(low, v), Math.max(high, v)];
    }
    if (this.test.zoom) {
      const ys = all.flatMap((c) => c.y.filter((y, k) => y !== null && c.x[k] >= x0 && c.x[k] <= x1 && y >= low && y <= high));
      if (ys.length) [low, high] = [Math.min(...ys), Math.max(...ys)];
      const span = description.span || 1e-6;
      if (high - low < span) [low, high] = [(low + high - 2 * span) / 2, (low + high + 2 * span) / 2];
    }
    const room = 0.05 * (high - low);
    return [x0, x1, low - room, high + room];
  }

  // `width`: that of the last time saves the browser a layout
  draw(width = Math.max(260, this.figure.clientWidth - 12)) {
    this.take_curves();
    this.width = width;
    const [x0, x1, y0, y1] = this.ends = this.axes();
    const right = width - edge.right, bottom = drawn_height - edge.bottom;
    this.to_x = (x) => edge.left + (x - x0) / (x1 - x0) * (right - edge.left);
    this.to_y = (y) => bottom - (y - y0) / (y1 - y0) * (bottom - edge.top);
    this.from_x = (p) => x0 + (p - edge.left) / (right - edge.left) * (x1 - x0);
    const root = svg("svg", { viewBox: `0 0 ${width} ${drawn_height}`, class: "chart", tabindex: 0, role: "img",
      "aria-label": `${this.description.title}, ${this.description.label}, over ${this.test.data.label}` });
    for (const y of ticks(y0, y1, 4)) {
      root.append(svg("line", { class: y === 0 ? "zero" : "grid", x1: edge.left, x2: right, y1: this.to_y(y), y2: this.to_y(y) }),
        svg("text", { x: edge.left - 6, y: this.to_y(y) + 4, "text-anchor": "end" }, shown(y)));
    }
    for (const x of ticks(x0, x1, width / 80)) {
      const at = this.to_x(x), label = shown(x), is_last = at + 3.2 * label.length > width;      // its label would be cut at the edge
      root.append(svg("line", { class: x === 0 ? "zero" : "grid", y1: edge.top, y2: bottom, x1: at, x2: at }),
        svg("text", { x: is_last ? width - 1 : at, y: bottom + 15, "text-anchor": is_last ? "end" : "middle" }, label));
    }
    this.x_label = svg("text", { x: (edge.left + right) / 2, y: drawn_height - 4, "text-anchor": "middle" }, this.test.data.label);
    const clip = `clip-${this.figure.id}`, clipping = svg("clipPath", { id: clip }), plot = svg("g", { "clip-path": `url(#${clip})` });
    clipping.append(svg("rect", { x: edge.left, y: edge.top, width: right - edge.left, height: bottom - edge.top }));
    this.shade(plot, root, x0, x1, bottom);
    for (const curve of this.curves) {
      const seen = !this.test.hidden.has(curve.name), colour = `--colour:var(--c${(curve.colour - 1) % 8 + 1})`;
      if (curve.other && seen) plot.append(this.line(curve.other, "curve other", colour));
      if (curve.deck && seen) plot.append(this.line(curve.deck, "curve deck", ""));
      for (const measured of seen ? curve.measured : [])
        plot.append(svg("path", { class: "measured loop", d: this.path_of(measured), style: colour }),
          svg("path", { class: "measured", d: this.path_of(measured, true), style: colour }));
      if (seen) plot.append(curve.path = this.line(curve, `curve dash${curve.dash}`, colour));
      const k = curve.design;
      if (seen && k >= 0 && curve.y[k] !== null)
        plot.append(curve.ring = svg("circle", { class: "design", cx: this.to_x(curve.x[k]), cy: this.to_y(curve.y[k]), r: 3.5 }));
      curve.dot = svg("circle", { class: "dot", r: 4, style: colour, visibility: "hidden" });
    }
    this.hair = svg("line", { class: "hair", y1: edge.top, y2: bottom, visibility: "hidden" });
    this.mark = svg("line", { class: "hair reference", y1: edge.top, y2: bottom, visibility: "hidden" });
    this.box = svg("rect", { class: "box", y: edge.top, height: bottom - edge.top, width: 0 });
    plot.append(this.box, this.mark, this.hair, ...this.curves.map((c) => c.dot));
    root.append(clipping, plot, this.x_label);
    this.figure.querySelector("svg, .keys") && this.figure.querySelectorAll("svg, .keys").forEach((n) => n.remove());
    this.figure.append(this.legend(), root);
    this.root = root;
    this.is_drawn = true;
    this.listen(width);
    this.show_cursor();
  }

  // Where a stop is in contact along the first curve: shaded, with the name of the stop above the curves.
  shade(plot, root, x0, x1, bottom) {
    const { contacts = [] } = this.test.data, x = this.curves[0] && this.curves[0].x;
    if (!x || this.description.points) return;
    const names = [[], []];         // of the stops at the left and at the right
    contacts.forEach((contact) => {
      const ends = [x[contact.first], x[contact.last]];
      if (ends.includes(null) || ends.includes(undefined)) return;
      const [from, to] = [Math.max(x0, Math.min(...ends)), Math.min(x1, Math.max(...ends))].map(this.to_x);
      if (to <= from) return;
      const is_right = from + to > this.width;
      plot.append(svg("rect", { class: "contact", x: from, y: edge.top, width: Math.max(1, to - from), height: bottom - edge.top }));
      names[Number(is_right)].push(contact.stop);
    });
    // names that would meet in the middle are in the tip of their number
    const fits = 6 * names.flat().join(", ").length < this.width - edge.left - edge.right;
    names.forEach((list, k) => {
      const text = svg("text", { x: k ? this.width - edge.right : edge.left, y: edge.top - 3, "text-anchor": k ? "end" : "start" },
        fits || list.length < 2 ? list.join(", ") : `${list.length} stops`);
      text.append(svg("title", {}, list.join(", ")));
      root.append(text);
    });
  }

  // The path of a curve with gaps where it has no value, or its states as points.
  line(curve, look, style) {
    return svg("path", { class: this.description.points ? `${look} points` : look, d: this.path_of(curve), style });
  }

  path_of(curve, has_points = this.description.points) {
    let path = "", pen = "M";
    for (let k = 0; k < curve.x.length; k++) {
      if (curve.x[k] === null || curve.y[k] === null) { pen = "M"; continue; }
      const at = `${this.to_x(curve.x[k]).toFixed(1)} ${this.to_y(curve.y[k]).toFixed(1)}`;
      path += has_points ? `M${at}h0` : pen + at;
      pen = "L";
    }
    return path;
  }

  // One button per curve: its name and its value at the cursor; pressed, it hides the curve in all charts of the test.
  legend() {
    const keys = document.createElement("div");
    keys.className = "keys";
    for (const curve of this.curves) {
      const button = document.createElement("button"), mark = document.createElement("i"), value = document.createElement("output");
      mark.className = `dash${curve.dash}`;
      mark.style.setProperty("--colour", `var(--c${(curve.colour - 1) % 8 + 1})`);
      button.type = "button";
      button.title = "hide or show";
      button.setAttribute("aria-pressed", String(!this.test.hidden.has(curve.name)));
      button.append(mark, curve.name, value);
      button.addEventListener("click", () => this.test.toggle(curve.name));
      curve.button = button;
      curve.value = value;
      keys.append(button);
    }
    if (this.curves.some((c) => c.measured.length)) {
      const note = document.createElement("small");
      note.textContent = "points: measured";
      keys.append(note);
    }
    return keys;
  }

  // A curve at the cursor, which is its nearest state, or without a cursor at the value of the field of the test; null without both.
  read(curve) {
    const { cursor, at } = this.test, k = cursor === null ? -1 : nearest(curve.x, curve.y, cursor);
    if (cursor !== null) return k < 0 ? null : { x: curve.x[k], y: curve.y[k], is_between: false };
    return at === null ? null : reading(curve.x, curve.y, at);
  }

  // The cursor of the test: a line, and a dot and a value per curve, with the differences to the reference state, to the deck and to
  // the overlaid report.
  show_cursor() {
    const { data, cursor, snapped, at, reference } = this.test, x = cursor === null ? at : snapped;
    this.mark.setAttribute("visibility", reference === null ? "hidden" : "visible");
    if (reference !== null) for (const end of ["x1", "x2"]) this.mark.setAttribute(end, this.to_x(reference));
    this.x_label.textContent = (reference === null ? "" : `reference ${shown(reference)}, `) + data.label + (x === null ? "" : `: ${shown(x)}`);
    let is_seen = false;
    for (const curve of this.curves) {
      const read = this.test.hidden.has(curve.name) ? null : this.read(curve);
      curve.dot.setAttribute("visibility", read ? "visible" : "hidden");
      curve.value.textContent = "";
      if (!read) continue;
      is_seen = true;
      const place = this.to_x(read.x);
      curve.dot.setAttribute("cx", place);
      curve.dot.setAttribute("cy", this.to_y(read.y));
      for (const end of ["x1", "x2"]) this.hair.setAttribute(end, place);
      const b = curve.other && value_at(curve.other.x, curve.other.y, read.x);
      const from = this.curves[curve.from], a = from && value_at(from.x, from.y, read.x);
      const base = reference === null ? -1 : nearest(curve.x, curve.y, reference), deck = curve.deck && reading(curve.deck.x, curve.deck.y, read.x);
      curve.value.textContent = (read.is_between ? "≈ " : "") + shown(read.y) + (from ? ` Δ ${shown(a === null ? null : read.y - a)}` : "") +
        (base >= 0 ? `, Δref ${shown(read.y - curve.y[base])}` : "") + (deck ? `, deck ${shown(deck.y)}` : "") +
        (curve.other ? ` | ${shown(b)} Δ ${shown(b === null ? null : b - read.y)}` : "");
    }
    this.hair.setAttribute("visibility", is_seen ? "visible" : "hidden");
  }

  // The state nearest to a value of the abscissa becomes the reference of the test.
  refer(x) {
    const { x: xs, y: ys } = this.curves[0], k = nearest(xs, ys, x);
    if (k >= 0) this.test.refer(xs[k]);
  }

  // Pointer and keys: the cursor follows, a click or Enter sets the reference, a drag zooms, a double click or Escape shows everything.
  listen(width) {
    const place = (event) => {
      const box = this.root.getBoundingClientRect();
      return Math.min(width - edge.right, Math.max(edge.left, (event.clientX - box.left) / box.width * width));
    };
    let from = null;
    this.root.addEventListener("pointermove", (event) => {
      const p = place(event);
      this.test.move(this.from_x(p), this);
      if (from === null) return;
      this.box.setAttribute("x", Math.min(from, p));
      this.box.setAttribute("width", Math.abs(from - p));
    });
    this.root.addEventListener("pointerdown", (event) => { from = place(event); });
    this.root.addEventListener("pointerup", (event) => {
      const p = place(event), ends = [this.from_x(Math.min(from, p)), this.from_x(Math.max(from, p))];
      if (from !== null && Math.abs(from - p) > 8) this.test.zoom_to(ends);
      else if (from !== null) this.refer(ends[0]);
      from = null;
      this.box.setAttribute("width", 0);
    });
    this.root.addEventListener("pointerleave", () => { from = null; this.box.setAttribute("width", 0); this.test.move(null, this); });
    this.root.addEventListener("dblclick", () => this.test.zoom_to(null));
    this.root.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (step) this.test.step(step, this);
      else if (event.key === "+") this.test.zoom_in();
      else if (event.key === "Enter" && this.test.cursor !== null) this.refer(this.test.cursor);
      else if (event.key === "Escape" || event.key === "0") this.test.clear();
      else return;
      event.preventDefault();
    });
  }
}
