// What the arm can do at a configuration: ellipsoids of velocity and force, and the motion that the task does not see.

class Abilities {
  constructor(app) {
    this.app = app;
    this.shapes = { velocity: this.ellipsoid(0x2b62d1), force: this.ellipsoid(0xb7791f) };
    for (const name of Object.keys(this.shapes)) {
      const button = document.getElementById(name);
      button.onclick = () => {
        button.setAttribute("aria-pressed", String(!this.on(name)));
        this.app.change(this.app.q);
      };
    }
    this.button = document.getElementById("selfmotion");
    this.button.onclick = () => this.play(!this.moving);
  }

  on(name) {
    return document.getElementById(name).getAttribute("aria-pressed") === "true";
  }

  ellipsoid(color) {
    const shape = new THREE.Mesh(
      new THREE.SphereGeometry(1, 40, 24),
      paint(color, { opacity: 0.3, transparent: true, depthWrite: false }),
    );
    shape.visible = false;
    this.app.stage.scene.add(shape);
    return shape;
  }

  /** The semi-axes of {J q̇ : |q̇| ≤ 1} are the singular values, those of {f : |Jᵀ f| ≤ 1} their inverses. */
  show(placed) {
    const { arm, drawing } = this.app;
    const J = arm.jacobian(arm.task.frame, placed).slice(0, 3).map(row => row.map((v, j) => v * arm.scale[j]));
    const { values, U } = singularValues(J, arm.size);
    const axes = completed([U[0] ?? null, U[1] ?? null, U[2] ?? null], 3);
    const sizes = axes.map((_, k) => values[k] ?? 0), most = Math.max(...sizes) || 1;
    const thin = 0.004 * arm.length, longest = 0.13 * arm.length;
    const inverse = sizes.map(s => (s > 1e-9 * most ? most / s : this.app.planar && s === 0 ? 0 : 1e9));
    const flat = this.app.planar ? sizes.map(s => s <= 1e-9 * most) : [false, false, false];
    const least = Math.min(...inverse.filter((_, k) => !flat[k]));
    const lengths = {
      velocity: sizes.map(s => Math.max(thin, (longest * s) / most)),
      force: inverse.map((s, k) => (flat[k] ? thin : Math.min(4 * longest, (0.5 * longest * s) / least))),
    };
    for (const [name, shape] of Object.entries(this.shapes)) {
      shape.visible = this.on(name);
      if (!shape.visible) continue;
      const third = cross(axes[0], axes[1]); // a right-handed basis
      const basis = [axes[0], axes[1], third].map(v => new THREE.Vector3(...v));
      shape.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(...basis));
      shape.scale.set(...lengths[name]);
      shape.position.set(...positionOf(arm.frame(arm.task.frame, placed))).add(drawing.group.position);
    }
    const dimension = this.freedom(this.app.q).length;
    this.button.disabled = dimension === 0;
    this.button.title = dimension ? `${dimension} directions of q̇ do not move the task` : "every q̇ moves the task";
  }

  /** Return an orthonormal basis of the null space of J, without units. */
  freedom(q) {
    const { rank, V } = this.app.arm.measure(q);
    return V.slice(rank);
  }

  play(yes) {
    this.moving = yes;
    this.button.setAttribute("aria-pressed", String(yes));
    this.app.stage.changed();
    if (!yes) return;
    this.app.halt(this);
    const { arm } = this.app;
    this.wanted = arm.frame(arm.task.frame, arm.forward(this.app.q)).slice();
    this.along = this.freedom(this.app.q)[0];
    const tick = () => {
      if (!this.moving) return;
      this.step(0.01);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  /** Go so far along the null space, in the direction so far; turn round at a limit. */
  step(length) {
    const { arm } = this.app;
    const basis = this.freedom(this.app.q);
    if (!basis.length) return this.play(false);
    let v = basis.reduce((sum, b) => plus(sum, times(dot(b, this.along), b)), new Array(arm.size).fill(0));
    v = norm(v) > 1e-6 ? times(1 / norm(v), v) : basis[0];
    const wish = this.app.q.map((value, j) => value + length * v[j] * arm.scale[j]);
    const next = arm.clamped(wish);
    const turned = next.some((value, j) => Math.abs(value - wish[j]) > 1e-12);
    this.along = turned ? times(-1, v) : v;
    this.app.change(turned ? this.app.q : descend(arm, next, this.wanted, 5).q);
  }
}
