// Figures: panels with lines, bands, bars, maps and names, drawn from the data of the page (ek_figure_data). A figure is drawn when it
// comes into view for the first time.

const stops = ["440154", "3b528b", "21918c", "5ec962", "e8d000"].map((hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16)));

// The colour of a share of a scale, from dark to light.
function shade_of(share) {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
  return `rgb(${stops[k].map((a, c) => Math.round(a + (stops[k + 1][c] - a) * (at - k))).join()})`;
}

const is_number = (value) => value !== null && value !== undefined;

// Ends of an axis and the place of a value between them, 0 to 1.
class Axis {
  constructor(own, values) {
    const some = values.filter((v) => is_number(v) && (!own.log || v > 0));
    let [low, high] = own.range || [Math.min(...some), Math.max(...some)];
    if (!Number.isFinite(low)) [low, high] = [0, 1];
    if (low === high) [low, high] = [low - Math.max(1e-6, Math.abs(low)), high + Math.max(1e-6, Math.abs(high))];
    if (!own.range && own.log) [low, high] = [10 ** Math.floor(Math.log10(low)), 10 ** Math.ceil(Math.log10(high))];
    if (!own.range && !own.log) {
      const [a, b] = ticks(low, high, 5), step = (b ?? high) - (a ?? low);
      [low, high] = [step * Math.floor(low / step + 1e-9), step * Math.ceil(high / step - 1e-9)];
    }
    Object.assign(this, { own, low, high });
  }

  share(value) {
    const { low, high, own } = this;
    return own.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  }

  ticks(count) {
    const { own } = this, [low, high] = [Math.min(this.low, this.high), Math.max(this.low, this.high)];
    if (own.bare) return [];
    if (own.names) return own.names.map((name, k) => [k + 1, name]);
    if (!own.log) return ticks(low, high, count).map((v) => [v, shown(v)]);
    const list = [], steps = high / low > 1e3 ? [1] : [1, 2, 5];
    for (let d = Math.floor(Math.log10(low)); d <= Math.ceil(Math.log10(high)); d++)
      for (const s of steps) if (s * 10 ** d >= low * 0.999 && s * 10 ** d <= high * 1.001) list.push(s * 10 ** d);
    return list.map((v) => [v, v < 1e-3 ? v.toExponential(0).replace("-", "−") : shown(v)]);
  }
}

// Columns of a series that are coordinates of an axis.
function coordinates(series, is_x) {
  const v = series.values, sum = (a, b, sign = 1) => a.map((value, k) => is_number(value) && is_number(b[k]) ? value + sign * b[k] : null);
  if (series.kind === "band") return is_x ? v[0] : [...v[1], ...v[2]];
  if (series.kind === "boxes") return is_x ? [...v[0], ...v[1]] : [...v[2], ...v[3]];
  if (series.kind === "segments") return is_x ? [...v[0], ...sum(v[0], v[2])] : [...v[1], ...sum(v[1], v[3])];
  if (series.kind === "errors") return is_x ? [...sum(v[0], v[2]), ...sum(v[0], v[2], -1)] : v[1];
  return is_x ? v[0] : v[1];
}

class Panel {
  constructor(own, figure, number) {
    const [left, right, top, bottom] = figure.margins, drawn = own.view ? own : flat(own);
    Object.assign(this, { own, figure, left, top, right: figure.width - right, bottom: figure.height - bottom });
    this.letters = figure.letters * 1.15;
    this.root = svg("svg", { viewBox: `0 0 ${figure.width} ${figure.height}`, role: "img",
      "aria-label": `${own.title || figure.title}: ${own.y.label}, over ${own.x.label}` });
    if (own.title) this.text(own.title, (this.left + this.right) / 2, this.top - 10, { class: "heading" });
    const values = drawn.series.flatMap((s) => s.values[0]);
    if (!values.some(is_number)) return void this.text(own.note || "", (this.left + this.right) / 2, (this.top + this.bottom) / 2);
    if (own.view) return void this.draw_space();
    this.x = new Axis(own.x, own.series.flatMap((s) => coordinates(s, true)));
    this.y = new Axis(own.y, own.series.flatMap((s) => coordinates(s, false)));
    this.to_x = (v) => this.left + this.x.share(v) * (this.right - this.left);
    this.to_y = (v) => this.bottom - this.y.share(v) * (this.bottom - this.top);
    this.draw_axes();
    // series end at the frame, names do not
    const clip = `clip-${figure.name}-${number}`, clipping = this.add("clipPath", { id: clip });
    clipping.append(svg("rect", { x: this.left - 3, y: this.top - 3, width: this.right - this.left + 6, height: this.bottom - this.top + 6 }));
    this.plot = this.add("g", { "clip-path": `url(#${clip})` });
    for (const series of own.series) this[series.kind](series);
  }

  add(name, attributes, content) { const node = svg(name, attributes, content); this.root.append(node); return node; }

  mark(name, attributes) { (this.plot || this.root).append(svg(name, attributes)); }

  text(content, x, y, more = {}) { return this.add("text", { x, y, "font-size": this.letters, "text-anchor": "middle", ...more }, content); }

  path(d, series, more = "") {
    const dash = series.dashed ? ";stroke-dasharray:8 6" : "";
    this.mark("path", { d, style: `fill:none;stroke:var(--${series.colour});stroke-width:${series.weight}${dash};stroke-linejoin:round;${more}` });
  }

  draw_axes() {
    const { x, y } = this.own, size = this.letters * 0.9, line = (c, d) => this.add("path", { class: c, d });
    for (const [value, label] of this.x.ticks((this.right - this.left) / 90)) {
      const at = this.to_x(value);
      if (!x.plain) line(value === 0 && x.zero ? "zero" : "grid", `M${at} ${this.bottom}V${this.top}`);
      this.text(label, at, this.bottom + size * 1.4, { "font-size": size });
    }
    for (const [value, label] of this.y.ticks((this.bottom - this.top) / 60)) {
      const at = this.to_y(value);
      if (!y.plain) line(value === 0 && y.zero ? "zero" : "grid", `M${this.left} ${at}H${this.right}`);
      this.text(label, this.left - 8, at + size / 3, { "font-size": size, "text-anchor": "end" });
    }
    if (this.own.frame & 1) line("zero", `M${this.left} ${this.bottom}H${this.right}`);
    if (this.own.frame & 2) line("zero", `M${this.left} ${this.bottom}V${this.top}`);
    if (x.label) this.text(x.label, (this.left + this.right) / 2, this.bottom + size * 3, { "font-size": size });
    if (y.label) {
      const at = [this.letters, (this.top + this.bottom) / 2];
      this.text(y.label, ...at, { "font-size": size, transform: `rotate(-90 ${at.join(" ")})` });
    }
  }

  // Runs of points without a gap.
  runs(series) {
    const [x, y, value] = series.values, list = [];
    let run = null;
    x.forEach((at, k) => {
      if (!is_number(at) || !is_number(y[k])) { run = null; return; }
      if (!run) list.push(run = { points: [], value: value && value[list.length] });
      run.points.push(`${this.to_x(at).toFixed(1)} ${this.to_y(y[k]).toFixed(1)}`);
    });
    return list;
  }

  line(series) {
    const runs = this.runs(series), d = (some) => some.map((run) => `M${run.points.join("L")}`).join("");
    if (!series.by_value) return this.path(d(runs), series);
    const scale = new Axis(this.own.value, []);
    for (const run of runs) this.path(d([run]), series, `stroke:${shade_of(scale.share(run.value))}`);
  }

  points(series) {
    const dots = this.runs(series).flatMap((run) => run.points).map((at) => `M${at}h0`).join("");
    this.path(dots, series, `stroke-linecap:round;stroke-width:${4 + 5 * series.weight}`);
  }

  both(series) {
    this.line(series);
    this.points({ ...series, weight: 0.5 });
  }

  band(series) {
    const [x, low, high] = series.values, at = (ys) => x.map((v, k) => `${this.to_x(v).toFixed(1)} ${this.to_y(ys[k]).toFixed(1)}`);
    this.mark("path", { d: `M${[...at(low), ...at(high).reverse()].join("L")}Z`, style: `fill:var(--${series.colour})` });
  }

  boxes(series) {
    const [from, to, low, high] = series.values;
    const d = from.map((v, k) => is_number(v) ? `M${this.to_x(v)} ${this.to_y(low[k])}H${this.to_x(to[k])}V${this.to_y(high[k])}H${this.to_x(v)}Z` : "");
    this.mark("path", { d: d.join(""), style: `fill:var(--${series.colour})` });
  }

  segments(series) {
    const [x, y, dx, dy] = series.values;
    this.path(x.map((v, k) => `M${this.to_x(v)} ${this.to_y(y[k])}L${this.to_x(v + dx[k])} ${this.to_y(y[k] + dy[k])}`).join(""), series);
  }

  errors(series) {
    const [x, y, half] = series.values;
    this.path(x.map((v, k) => {
      if (!is_number(v) || !is_number(half[k])) return "";
      const [from, to, at] = [this.to_x(v - half[k]), this.to_x(v + half[k]), this.to_y(y[k])];
      return `M${from} ${at}H${to}M${from} ${at - 4}v8M${to} ${at - 4}v8`;
    }).join(""), series);
  }

  labels(series) {
    const [x, y] = series.values, [dx, dy] = series.offset || [0, 0], size = this.letters * (series.small ? 0.85 : 1);
    series.labels.forEach((label, k) => this.text(label, this.to_x(x[k]) + dx * size * 0.6, this.to_y(y[k]) - dy * size + size / 3,
      { "font-size": size, "text-anchor": ["middle", "start", "end"][series.align || 0], style: `fill:var(--${series.colour})` }));
  }

  // Colours between the points of a grid, lines of equal value, and the scale of the colours at the right.
  heat(series) {
    const [x, y, z] = series.values, scale = new Axis(this.own.value, []), fine = 4, shades = 48;
    const levels = (list) => [...new Set(list.filter(is_number))].sort((a, b) => a - b), xs = levels(x), ys = levels(y);
    const table = new Map(z.map((value, k) => [`${x[k]} ${y[k]}`, value])), at = (i, j) => table.get(`${xs[i]} ${ys[j]}`);
    const [px, py] = [xs.map(this.to_x), ys.map(this.to_y)], fills = Array.from({ length: shades + 1 }, () => ""), mix = (a, b, t) => a + (b - a) * t;
    let lines = "";
    const borders = ticks(Math.min(...z.filter(is_number)), Math.max(...z.filter(is_number)), 8);
    for (let i = 0; i + 1 < xs.length; i++) for (let j = 0; j + 1 < ys.length; j++) {
      const corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      if (!corners.every(is_number)) continue;
      const [a, b, c, d] = corners, inside = (s, t) => mix(mix(a, b, s), mix(d, c, s), t);
      for (let s = 0; s < fine; s++) for (let t = 0; t < fine; t++) {
        const shade = Math.round(shades * scale.share(inside((s + 0.5) / fine, (t + 0.5) / fine)));
        const [x0, x1, y0, y1] = [mix(px[i], px[i + 1], s / fine), mix(px[i], px[i + 1], (s + 1) / fine), mix(py[j], py[j + 1], t / fine),
          mix(py[j], py[j + 1], (t + 1) / fine)].map((v) => v.toFixed(1));
        fills[Math.min(Math.max(shade, 0), shades)] += `M${x0} ${y0}H${x1}V${y1}H${x0}Z`;
      }
      const places = [[px[i], py[j]], [px[i + 1], py[j]], [px[i + 1], py[j + 1]], [px[i], py[j + 1]]];
      for (const level of borders) {
        const ends = [0, 1, 2, 3].filter((k) => (corners[k] > level) !== (corners[(k + 1) % 4] > level)).map((k) => {
          const n = (k + 1) % 4, t = (level - corners[k]) / (corners[n] - corners[k]);
          return `${mix(places[k][0], places[n][0], t).toFixed(1)} ${mix(places[k][1], places[n][1], t).toFixed(1)}`;
        });
        for (let k = 0; k + 1 < ends.length; k += 2) lines += `M${ends[k]}L${ends[k + 1]}`;
      }
    }
    fills.forEach((d, k) => d && this.mark("path", { d, style: `fill:${shade_of(k / shades)};stroke:${shade_of(k / shades)};stroke-width:.6` }));
    this.path(lines, { weight: 1.2 }, "stroke:#fff");
    const right = this.right + 14, step = (this.bottom - this.top) / 40;
    for (let k = 0; k < 40; k++) this.add("rect", { x: right, y: this.bottom - (k + 1) * step, width: 14, height: step + 0.5, fill: shade_of((k + 0.5) / 40) });
    for (const [value, label] of scale.ticks(5))
      this.text(label, right + 20, this.bottom - scale.share(value) * (this.bottom - this.top) + this.letters / 3, { "text-anchor": "start", "font-size": this.letters * 0.85 });
  }

  // In space: the box of the axes with equal scales, then lines and strokes, seen from a fixed direction.
  draw_space() {
    const { own } = this, [turn, tilt] = own.view.map((angle) => angle * Math.PI / 180), axes = [own.x, own.y, own.z];
    const middle = axes.map((axis) => (axis.range[0] + axis.range[1]) / 2), edge = own.x.range[1] - own.x.range[0];
    const scale = 0.56 * Math.min(this.right - this.left, this.bottom - this.top) / edge;
    const place = (...at) => {
      const [x, y, z] = at.map((v, k) => v - middle[k]), [c, s] = [Math.cos(turn), Math.sin(turn)];
      return [(this.left + this.right) / 2 + scale * (c * x + s * y),
        (this.top + this.bottom) / 2 - scale * ((c * y - s * x) * Math.cos(tilt) + z * Math.sin(tilt))];
    };
    const point = (at) => place(...at).map((v) => v.toFixed(1)).join(" "), [xr, yr, zr] = axes.map((axis) => axis.range);
    let box = "";
    for (const a of [0, 1]) for (const b of [0, 1]) box += `M${point([xr[0], yr[a], zr[b]])}L${point([xr[1], yr[a], zr[b]])}` +
      `M${point([xr[a], yr[0], zr[b]])}L${point([xr[a], yr[1], zr[b]])}M${point([xr[a], yr[b], zr[0]])}L${point([xr[a], yr[b], zr[1]])}`;
    this.add("path", { class: "grid", d: box, fill: "none" });
    // tics at the edges nearest to the reader, below, and at the left
    const corners = [0, 1].flatMap((a) => [0, 1].map((b) => [xr[a], yr[b]])), low = (at) => place(...at, zr[0]);
    const near = corners.reduce((a, b) => low(a)[1] > low(b)[1] ? a : b), left = corners.reduce((a, b) => low(a)[0] < low(b)[0] ? a : b);
    const tics = (axis, at) => ticks(...axis.range, 3).forEach((v) => {
      const [x, y] = at(v), side = x < low(near)[0] ? "end" : "start";
      this.text(shown(v), x + (side === "end" ? -8 : 8), y + this.letters, { "text-anchor": side });
    });
    tics(own.x, (v) => place(v, near[1], zr[0]));
    tics(own.y, (v) => place(near[0], v, zr[0]));
    tics(own.z, (v) => { const [x, y] = place(...left, v); return [x, y - this.letters * 0.6]; });
    const label = (axis, at) => { const [x, y] = at; this.text(axis.label, x + (x < low(near)[0] ? -50 : 50), y + this.letters * 3); };
    label(own.x, place(middle[0], near[1], zr[0]));
    label(own.y, place(near[0], middle[1], zr[0]));
    for (const series of own.series) {
      const [x, y, z, ...more] = series.values;
      let d = "", pen = "M";
      x.forEach((v, k) => {
        if (!is_number(v) || !is_number(z[k])) { pen = "M"; return; }
        d += pen + point([v, y[k], z[k]]);
        if (more.length) d += `L${point([v + more[0][k], y[k] + more[1][k], z[k] + more[2][k]])}`;
        else pen = "L";
      });
      this.path(d, series);
    }
  }
}

// A panel with the series that a plane figure draws.
function flat(panel) { return { series: panel.series.filter((s) => s.values.length > 1) }; }

function draw_figure(place, own) {
  const head = document.createElement("figcaption"), title = document.createElement("b"), grid = document.createElement("div");
  title.textContent = own.title;
  head.append(title, own.subtitle);
  grid.className = "panels";
  grid.style.setProperty("--columns", own.columns);
  const first = own.panels[0];
  if (own.scale) {
    const scale = new Axis(first.value, []), root = svg("svg", { viewBox: "0 0 300 44", class: "scale", role: "img", "aria-label": `Colours: ${own.scale}` });
    for (let k = 0; k < 60; k++) root.append(svg("rect", { x: 20 + k * 4, y: 16, width: 4.5, height: 10, fill: shade_of((k + 0.5) / 60) }));
    root.append(svg("text", { x: 20, y: 11, "font-size": 12 }, own.scale));
    for (const [value, label] of scale.ticks(4)) root.append(svg("text", { x: 20 + scale.share(value) * 240, y: 40, "font-size": 11, "text-anchor": "middle" }, label));
    head.append(root);
  }
  const named = first.series.filter((s) => s.title);
  if (named.length) {
    const legend = document.createElement("p");
    legend.className = "legend";
    for (const { title: name, colour } of named) {
      const entry = document.createElement("span"), mark = document.createElement("i");
      mark.style.borderTop = `3px solid var(--${colour})`;
      entry.append(mark, name);
      legend.append(entry);
    }
    head.append(legend);
  }
  // abscissae that all lines of a series share are listed once
  for (const { values } of own.panels.flatMap((p) => p.series)) {
    const [x, y = x] = values;
    if (x.length < y.length) values[0] = y.map((_, k) => x[k % x.length]);
  }
  own.panels.forEach((panel, k) => grid.append(new Panel(panel, own, k).root));
  place.prepend(head, grid);
}

const undrawn = new Map((data.figures || []).map((own) => [document.getElementById(`figure-${own.name}`), own]).filter(([place]) => place));
const draw_now = (place) => { if (undrawn.has(place)) { draw_figure(place, undrawn.get(place)); undrawn.delete(place); } };
const figure_watcher = new IntersectionObserver((entries) => entries.forEach((entry) => entry.isIntersecting && draw_now(entry.target)), { rootMargin: "300px" });
for (const place of undrawn.keys()) figure_watcher.observe(place);
addEventListener("beforeprint", () => [...undrawn.keys()].filter((place) => !place.closest("details:not([open])")).forEach(draw_now));
