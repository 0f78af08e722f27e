// The suspension in space: a drag, an arrow key or a slider turns it, other sliders choose a state of its travel, roll or steering, and
// a button shows the states one after the other.

class Turntable {
  constructor(place, own) {
    const numbers = (text) => new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
    Object.assign(this, { own, turn: own.turn, tilt: 20, motion: 0, state: own.motions[0].design, frame: 0 });
    this.lines = own.lines.map(({ kind, label, at }) => ({ kind, label, at: numbers(at) }));
    this.poses = own.motions.map((motion) => numbers(motion.poses));
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "Suspension in space; the sliders turn and move it");
    place.append(this.canvas);
    this.sliders = document.createElement("div");
    this.sliders.className = "sliders";
    this.turner = this.slider("turn, °", -180, 180, 1, this.turn, (value) => { this.turn = value; });
    this.tilter = this.slider("tilt, °", -90, 90, 1, this.tilt, (value) => { this.tilt = value; });
    this.movers = own.motions.map((motion, m) => this.slider(motion.label, 0, motion.values.length - 1, 1, motion.design, (value) => {
      // a state is that of one test: the other one is back at design
      this.play(false);
      this.take(m, value);
    }, (value) => shown(motion.values[value])));
    this.add_controls();
    place.append(this.sliders);
    this.find_size();
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.from = [event.clientX, event.clientY, this.turn, this.tilt];
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!this.from) return;
      const [x, y, turn, tilt] = this.from;
      this.turner.set(Math.round(((turn - (event.clientX - x) / 3 + 180) % 360 + 360) % 360 - 180));
      this.tilter.set(Math.round(Math.max(-90, Math.min(90, tilt + (event.clientY - y) / 3))));
      [this.turn, this.tilt] = [this.turner.value(), this.tilter.value()];
      this.draw_soon();
    });
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => { this.from = null; });
    addEventListener("resize", () => this.draw_soon());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw_soon());
    this.draw();
  }

  // A state of a motion; the sliders of the other motions are back at design.
  take(motion, state) {
    [this.motion, this.state] = [motion, state];
    this.movers.forEach((mover, k) => mover.set(k === motion ? state : this.own.motions[k].design));
  }

  add_controls() {
    const button = document.createElement("button"), label = document.createElement("label"), box = document.createElement("input");
    Object.assign(button, { type: "button", textContent: "Play" });
    button.addEventListener("click", () => this.play(!this.timer));
    Object.assign(box, { type: "checkbox", checked: innerWidth > 700 });
    box.addEventListener("change", () => { this.has_names = box.checked; this.draw_soon(); });
    label.append(box, "names");
    this.has_names = box.checked;
    this.player = button;
    this.sliders.append(button, label);
  }

  // Plays from design to the last state, to the first one and back to design, of one motion after the other.
  play(is_on) {
    clearInterval(this.timer);
    this.timer = 0;
    this.player.textContent = is_on ? "Stop" : "Play";
    if (!is_on) return;
    const way = this.own.motions.flatMap(({ values, design }, m) => {
      const up = (from, to) => Array.from({ length: Math.abs(to - from) }, (_, k) => [m, from + (k + 1) * Math.sign(to - from)]);
      return [...up(design, values.length - 1), ...up(values.length - 1, 0), ...up(0, design)];
    });
    let k = 0;
    this.timer = setInterval(() => { this.take(...way[k++ % way.length]); this.draw_soon(); }, 70);
  }

  // A named slider; its number is shown by `words_of`.
  slider(name, low, high, step, at, take, words_of = String) {
    const label = document.createElement("label"), input = document.createElement("input"), output = document.createElement("output");
    Object.assign(input, { type: "range", min: low, max: high, step, value: at });
    const show = () => { output.textContent = words_of(Number(input.value)); input.setAttribute("aria-valuetext", output.textContent); };
    input.addEventListener("input", () => { show(); take(Number(input.value)); this.draw_soon(); });
    label.append(`${name} `, input, output);
    this.sliders.append(label);
    show();
    return { set: (value) => { input.value = value; show(); }, value: () => Number(input.value) };
  }

  // A point of a body in the present state, axes of the deck [mm]: r + A(q) arm.
  place_of(body, x, y, z) {
    if (body === 0) return [x, y, z];
    const p = this.poses[this.motion], k = 6 * (this.own.bodies * this.state + body - 1), [a, b, c] = [p[k + 3], p[k + 4], p[k + 5]];
    const w = Math.sqrt(Math.max(0, 1 - a * a - b * b - c * c)), t = [2 * (b * z - c * y), 2 * (c * x - a * z), 2 * (a * y - b * x)];
    return [p[k] + x + w * t[0] + b * t[2] - c * t[1], p[k + 1] + y + w * t[1] + c * t[0] - a * t[2], p[k + 2] + z + w * t[2] + a * t[1] - b * t[0]];
  }

  points_of(line) {
    const list = [];
    for (let k = 0; k < line.at.length; k += 4) list.push(this.place_of(line.at[k], line.at[k + 1], line.at[k + 2], line.at[k + 3]));
    return list;
  }

  // Middle of everything at design, and how far it reaches from there across and upward: a turn must not change the scale.
  find_size() {
    const all = this.lines.flatMap((line) => this.points_of(line)), ends = [0, 1, 2].map((k) => [Math.min(...all.map((p) => p[k])), Math.max(...all.map((p) => p[k]))]);
    this.middle = ends.map(([a, b]) => (a + b) / 2);
    this.across = Math.max(...all.map((p) => Math.hypot(p[0] - this.middle[0], p[1] - this.middle[1])));
    this.upward = ends[2][1] - this.middle[2];
  }

  draw_soon() { this.frame ||= requestAnimationFrame(() => { this.frame = 0; this.draw(); }); }

  draw() {
    const { canvas } = this, wide = canvas.clientWidth || 600, high = Math.round(Math.min(560, 0.62 * wide)), sharp = devicePixelRatio || 1;
    canvas.width = wide * sharp;
    canvas.height = high * sharp;
    canvas.style.height = `${high}px`;
    const pen = canvas.getContext("2d"), look = getComputedStyle(page);
    const [turn, tilt] = [this.turn * Math.PI / 180, this.tilt * Math.PI / 180];
    const [ct, st, ce, se] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    const scale = 0.47 * Math.min(wide / this.across, high / (this.upward * ce + this.across * Math.abs(se)));
    pen.scale(sharp, sharp);
    const seen = (p) => {
      const [x, y, z] = p.map((v, k) => v - this.middle[k]), near = ct * x + st * y;
      return [wide / 2 + scale * (ct * y - st * x), high / 2 - scale * (ce * z - se * near), ce * near + se * z];
    };
    const front = seen([this.middle[0] + this.own.front * this.across * 0.7, this.middle[1], this.middle[2] - this.upward]);
    pen.fillStyle = look.getPropertyValue("--soft");
    pen.font = "13px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.fillText("front", front[0], front[1]);
    const pieces = [];
    for (const line of this.lines) {
      const points = this.points_of(line).map(seen);
      for (let k = 1; k < points.length; k++) pieces.push([line.kind, points[k - 1], points[k]]);
    }
    pieces.sort((a, b) => a[1][2] + a[2][2] - b[1][2] - b[2][2]);
    pen.lineCap = "round";
    for (const [kind, a, b] of pieces) {
      pen.strokeStyle = look.getPropertyValue({ arm: "--c1", carrier: "--soft", rod: "--c3", damper: "--zero", spring: "--c2", wheel: "--ink" }[kind]);
      pen.lineWidth = { arm: 5, carrier: 6, rod: 4, damper: 6, spring: 2, wheel: 1.5 }[kind];
      pen.beginPath();
      pen.moveTo(a[0], a[1]);
      if (kind === "spring") {
        const [dx, dy] = [b[0] - a[0], b[1] - a[1]], long = Math.hypot(dx, dy) || 1, turns = 12;
        for (let k = 1; k < turns; k++) {
          const aside = k % 2 ? 7 : -7;
          pen.lineTo(a[0] + dx * k / turns - dy / long * aside, a[1] + dy * k / turns + dx / long * aside);
        }
      }
      pen.lineTo(b[0], b[1]);
      pen.stroke();
    }
    if (!this.has_names) return;
    pen.font = "12px system-ui, sans-serif";
    pen.strokeStyle = look.getPropertyValue("--paper");
    pen.fillStyle = look.getPropertyValue("--ink");
    pen.lineWidth = 3;
    const placed = [];
    for (const { label, ...line } of this.lines) {
      if (!label) continue;
      const [a, b] = this.points_of(line).map(seen), x = (a[0] + b[0]) / 2, half = pen.measureText(label).width / 2;
      let y = (a[1] + b[1]) / 2 - 6;
      while (placed.some((one) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y - y) < 13)) y += 13;     // below other labels
      placed.push({ x, y, half });
      pen.strokeText(label, x, y);
      pen.fillText(label, x, y);
    }
  }
}

const turntable_place = document.getElementById("turntable");
if (data.turntable && turntable_place) turntable_place.table = new Turntable(turntable_place, data.turntable);
