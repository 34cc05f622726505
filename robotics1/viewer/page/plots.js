// Plots under the scene that share one time axis: a click seeks.

const LINES = ["#1864ab", "#c92a2a", "#2b8a3e", "#e67700", "#6741d9", "#0b7285", "#862e9c", "#495057"];
const [WIDTH, LEFT, RIGHT] = [420, 42, 412]; // of a plot, in units of its picture
const DASHES = ["", "7 3", "2 3", "9 3 2 3"];

function svg(tag, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** Return some round numbers in [low, high], four at most. */
function ticks(low, high) {
  const power = 10 ** Math.floor(Math.log10((high - low) / 3 || 1));
  const step = power * [1, 2, 5, 10].find(k => (high - low) / (k * power) <= 4.5);
  const found = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) found.push(v);
  return found;
}

class Plot {
  /** lines: { name, points: [[t, y], ...], bounds: [y, ...] } */
  constructor(title, lines, duration, onTime) {
    Object.assign(this, { title, lines, duration, onTime });
    this.node = element("figure", { class: "plot" });
    const values = lines.flatMap(line => line.points.map(p => p[1])).filter(Number.isFinite);
    let low = Math.min(...extreme(values, Math.min), 0), high = Math.max(...extreme(values, Math.max), 0);
    if (high - low < 1e-12) [low, high] = [low - 1, high + 1];
    const near = bound => bound > 2 * low - high && bound < 2 * high - low;
    const bounds = lines.flatMap(line => line.bounds ?? []).filter(near);
    [low, high] = [Math.min(low, ...bounds), Math.max(high, ...bounds)];
    const margin = 0.06 * (high - low);
    [this.low, this.high] = [low - margin, high + margin];
    this.draw();
  }

  x(t) {
    return LEFT + (t / this.duration) * (RIGHT - LEFT);
  }

  y(v) {
    return 112 - ((v - this.low) / (this.high - this.low)) * 90;
  }

  draw() {
    const picture = svg("svg", { viewBox: `0 0 ${WIDTH} 132`, role: "img", "aria-label": this.title });
    picture.append(svg("text", { x: LEFT, y: 14, class: "title" }, this.title));
    for (const v of ticks(this.low, this.high)) {
      picture.append(svg("line", { x1: LEFT, x2: RIGHT, y1: this.y(v), y2: this.y(v), class: "grid" }));
      picture.append(svg("text", { x: LEFT - 4, y: this.y(v) + 4, class: "tick", "text-anchor": "end" }, short(v)));
    }
    for (const t of ticks(0, this.duration)) {
      picture.append(svg("text", { x: this.x(t), y: 127, class: "tick", "text-anchor": "middle" }, `${short(t)} s`));
    }
    this.lines.forEach((line, i) => {
      const style = { stroke: LINES[i % LINES.length], "stroke-dasharray": DASHES[i % 4] };
      for (const bound of line.bounds ?? []) {
        const y = this.y(bound);
        const limit = svg("line", { x1: LEFT, x2: RIGHT, y1: y, y2: y, class: "bound", ...style });
        if (y > 20 && y < 114) picture.append(limit);
      }
      const points = line.points.map(([t, v]) => `${this.x(t).toFixed(1)},${this.y(v).toFixed(1)}`).join(" ");
      picture.append(svg("polyline", { points, ...style }));
    });
    if (this.lines.length > 1) this.nameLines(picture);
    this.cursor = svg("line", { y1: 20, y2: 114, class: "cursor" });
    picture.append(this.cursor);
    const seek = event => {
      const box = picture.getBoundingClientRect();
      const t = (((event.clientX - box.left) / box.width) * WIDTH - LEFT) / (RIGHT - LEFT);
      this.onTime(Math.min(1, Math.max(0, t)) * this.duration);
    };
    picture.addEventListener("pointerdown", event => {
      picture.setPointerCapture(event.pointerId);
      seek(event);
    });
    picture.addEventListener("pointermove", event => event.buttons && seek(event));
    this.node.replaceChildren(picture);
  }

  /** Write the names of the lines beside the title, as many as have room; under the pointer all are shown. */
  nameLines(picture) {
    const names = shortened(this.lines.map(line => line.name));
    let at = RIGHT;
    for (let i = names.length - 1; i >= 0; i--) {
      const width = 6.6 * names[i].length + 8, fits = at - width >= (i > 0 ? 123 : 108);
      const style = { y: 14, class: "name", fill: fits ? LINES[i % LINES.length] : "#5c6773" };
      at -= fits ? width : 18;
      picture.append(svg("text", { x: at + 5, ...style }, fits ? names[i] : "…"));
      if (!fits) break;
    }
    picture.append(svg("title", {}, this.lines.map(line => line.name).join(", ")));
  }

  show(t) {
    this.cursor.setAttribute("x1", this.x(t));
    this.cursor.setAttribute("x2", this.x(t));
  }
}

/** Return names without the words, up to "_", that all begin or end with, and of 14 letters at most. */
function shortened(names) {
  let words = names.map(name => name.split("_"));
  const same = k => words.every(parts => parts.length > 1 && parts.at(k) === words[0].at(k));
  while (same(0)) words = words.map(parts => parts.slice(1));
  while (same(-1)) words = words.map(parts => parts.slice(0, -1));
  return words.map(parts => parts.join("_").slice(0, 14));
}

function extreme(values, which) {
  return [values.reduce((a, b) => which(a, b), values[0] ?? 0)];
}

/** Return the plots of a motion: q, q̇ with its limits, σ_min, and the distance to the target. */
function plotsOf(arm, samples, target, onTime) {
  const every = Math.max(1, Math.floor(samples.count / 400));
  const all = Array.from({ length: samples.count }, (_, k) => k);
  const chosen = all.filter(k => k % every === 0 || k === samples.count - 1);
  const instants = chosen.map(k => samples.times[k]);
  const postures = chosen.map(k => samples.sample(k));
  const line = (name, values, bounds) => ({ name, points: instants.map((t, k) => [t, values[k]]), bounds });
  const finite = values => values.filter(v => v !== null);
  const plots = [];
  for (const [unit, word] of [["rad", "q [rad]"], ["m", "q [m]"]]) {
    const joints = arm.coordinates.map((c, i) => ({ ...c, i })).filter(c => c.unit === unit);
    if (!joints.length) continue;
    plots.push([word, joints.map(c => line(c.name, postures.map(q => q[c.i]), finite([c.lower, c.upper])))]);
    const rates = joints.map(c =>
      line(c.name, chosen.map(k => samples.velocity(k)[c.i]), c.velocity === null ? [] : [c.velocity, -c.velocity]),
    );
    plots.push([word.replace("q", "q̇").replace("]", "/s]"), rates]);
  }
  if (arm.task) plots.push(["σ_min", [line("", postures.map(q => arm.measure(q).least))]]);
  if (target && arm.tool) {
    const tool = q => positionOf(arm.frame(arm.tool, arm.forward(q)));
    const distances = postures.map((q, k) => norm(minus(tool(q), target.at(instants[k]))));
    plots.push(["distance to the target [m]", [line("", distances)]]);
  }
  return plots.map(([title, lines]) => new Plot(title, lines, samples.duration, onTime));
}
