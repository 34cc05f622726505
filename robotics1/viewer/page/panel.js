// The panel: a slider for each joint, and what the tool and the Jacobian say there.

const DEGREE = Math.PI / 180;
const NAMED = 0.05; // a part of a direction that is smaller is not named

/** Return a unit vector as text, such as "y" or "0.60 x − 0.80 y". */
function directionText(rows, u) {
  const parts = rows.map((name, i) => [name, u[i]]).filter(([, v]) => Math.abs(v) > NAMED);
  if (parts.length === 1) return parts[0][0];
  const terms = parts.map(([name, v]) => `${v < 0 ? "−" : "+"}\u00a0${Math.abs(v).toFixed(2)}\u00a0${name}`);
  return terms.join(" ").replace(/^\+\u00a0/, "");
}

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

class Panel {
  /** app has arm, q and change(q): the panel shows the first and calls the last. */
  constructor(app) {
    this.app = app;
    this.degrees = true;
    this.rows = [];
    this.build();
  }

  build() {
    const { arm } = this.app;
    this.rows = arm.coordinates.map((_, i) => this.row(i));
    document.getElementById("joints").replaceChildren(...this.rows.map(row => row.node));
    const unit = document.getElementById("unit");
    unit.onclick = () => {
      this.degrees = !this.degrees;
      unit.textContent = this.degrees ? "degrees" : "radians";
      this.rows.forEach(row => row.rescale());
      this.show();
    };
    const postures = {
      zero: () => 0,
      middle: i => this.range(i).reduce((a, b) => (a + b) / 2),
      random: i => this.range(i)[0] + Math.random() * (this.range(i)[1] - this.range(i)[0]),
    };
    for (const [id, posture] of Object.entries(postures)) {
      const q = () => arm.clamped(arm.coordinates.map((_, i) => posture(i)));
      document.getElementById(id).onclick = () => this.app.change(q());
    }
    document.getElementById("copy").onclick = () => this.copy();
  }

  /** Return the limits of a joint, or a range to play in. */
  range(i) {
    const { lower, upper, unit } = this.app.arm.coordinates[i];
    const far = unit === "rad" ? Math.PI : this.app.arm.reach;
    return [lower ?? (upper === null ? -far : upper - 2 * far), upper ?? (lower === null ? far : lower + 2 * far)];
  }

  row(i) {
    const { name, unit } = this.app.arm.coordinates[i];
    const factor = () => (unit === "rad" && this.degrees ? DEGREE : 1);
    const slider = element("input", { type: "range", step: "any", "aria-label": name });
    const box = element("input", { type: "number", step: "any", "aria-label": `${name}, value` });
    const word = element("span", { class: "unit" });
    const set = value => {
      if (!Number.isFinite(value)) return;
      const q = this.app.q.slice();
      q[i] = value;
      this.app.change(this.app.arm.clamped(q));
    };
    slider.oninput = () => set(Number(slider.value));
    box.onchange = () => {
      set(box.value === "" ? NaN : Number(box.value) * factor());
      this.show();
    };
    const rescale = () => {
      [slider.min, slider.max] = this.range(i);
      word.textContent = unit === "m" ? "m" : this.degrees ? "°" : "rad";
    };
    rescale();
    const limited = this.app.arm.coordinates[i];
    const show = value => {
      slider.value = value;
      if (document.activeElement !== box) box.value = Number((value / factor()).toFixed(factor() === 1 ? 4 : 2));
      const atLimit = [limited.lower, limited.upper].some(l => l !== null && Math.abs(value - l) < 1e-9);
      node.classList.toggle("limit", atLimit);
    };
    const kind = name.length > 8 ? "joint long" : "joint";
    const node = element("div", { class: kind }, element("label", { title: name }, name), slider, box, word);
    return { node, show, rescale };
  }

  show() {
    const { arm, q } = this.app;
    this.rows.forEach((row, i) => row.show(q[i]));
    this.showTool(arm.forward(q));
    if (arm.task) this.showJacobian(arm.measure(q));
  }

  showTool(placed) {
    const { arm } = this.app, box = document.getElementById("tool");
    if (!arm.tool) {
      box.textContent = "no tool is named";
      return;
    }
    const T = arm.frame(arm.tool, placed);
    const [x, y, z] = positionOf(T).map(v => (Math.abs(v) < 5e-5 ? 0 : v).toFixed(4));
    const yaw = Math.atan2(T[4], T[0]), roll = Math.atan2(T[9], T[10]);
    const pitch = Math.atan2(-T[8], Math.hypot(T[0], T[4]));
    const angle = v => (this.degrees ? `${(v / DEGREE).toFixed(1)}°` : v.toFixed(3));
    const turns = `roll ${angle(roll)}  pitch ${angle(pitch)}  yaw ${angle(yaw)}`;
    const turned = this.app.planar ? `φ = ${angle(yaw)}` : turns;
    box.textContent = `${arm.tool.name}: (${x}, ${y}${this.app.planar ? "" : `, ${z}`}) m\n${turned}`;
  }

  showJacobian({ values, rank, least, determinant: det, U }) {
    const { arm } = this.app, box = document.getElementById("jacobian"), warning = document.getElementById("warning");
    const lines = [`${arm.task.name}: rank ${rank} of ${Math.min(arm.task.S.length, arm.size)}`];
    lines.push(`σ_min = ${short(least)}${det === null ? "" : `   det J = ${short(det)}`}`);
    box.textContent = lines.join("\n");
    const near = arm.task.generic > 0 && values[arm.task.generic - 1] < 0.03 * arm.task.usual;
    warning.hidden = !near;
    const found = U[arm.task.generic - 1] ?? [];
    const u = times(Math.sign(found.find(v => Math.abs(v) > NAMED) ?? 1), found); // its sign means nothing
    if (near) {
      const [word, verb] = rank < arm.task.generic ? ["Singular", "cannot be"] : ["Near a singularity", "is hardly"];
      warning.textContent = `${word}: a task velocity along ${directionText(arm.task.rows, u)} ${verb} realised.`;
    }
    this.app.drawing.showLost(near ? this.lostDirection(u) : null);
  }

  /** Return the lost direction of the tool as a unit vector in world axes, or null when only a turn is lost. */
  lostDirection(u) {
    const { arm, q } = this.app, { S, scale, reference } = arm.task;
    const rows = u.map((v, i) => v * scale[i]);
    const local = [0, 1, 2].map(k => S.reduce((sum, row, i) => sum + row[k] * rows[i], 0));
    const v = reference ? rotate(arm.frame(reference, arm.forward(q)), local) : local;
    return norm(v) > 1e-6 ? times(1 / norm(v), v) : null;
  }

  copy() {
    const text = `[${this.app.q.map(v => Number(v.toPrecision(12))).join(", ")}]`;
    const field = element("textarea", {});
    field.value = text; // a file page has no clipboard of its own
    document.body.append(field);
    field.select();
    document.execCommand("copy");
    field.remove();
    document.getElementById("copy").textContent = "copied";
    setTimeout(() => (document.getElementById("copy").textContent = "copy q"), 1200);
  }
}
