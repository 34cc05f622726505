// The page: what is in its data is drawn, and what a hand does is answered.

/** One robot that can be played with, and the others beside it. */
class App {
  constructor(data) {
    this.data = data;
    this.planar = data.planar;
    this.stage = new Stage(document.getElementById("scene"), data.planar);
    this.meshes = data.meshes.map(meshGeometry);
    this.arms = data.arms.map(arm => new Arm(arm));
    this.actors = data.actors.map(actor => this.actor(actor));
    this.others = [];
    this.chosen = 0;
  }

  get arm() {
    return this.actors[this.chosen].arm;
  }

  get drawing() {
    return this.actors[this.chosen].drawing;
  }

  get q() {
    return this.actors[this.chosen].q;
  }

  actor({ arm, q, motion, target, offset, tint }) {
    const one = { arm: this.arms[arm], q };
    one.drawing = new Drawing(one.arm, this.meshes, { offset, tint });
    this.stage.scene.add(one.drawing.group);
    one.motion = motion === null ? null : new Samples(motion);
    if (target !== null) {
      one.target = new Target(new Samples(target), 0.006 * one.arm.length);
      one.drawing.group.add(one.target.group);
    }
    if (one.motion && one.arm.tool) {
      const points = Array.from({ length: one.motion.count }, (_, k) =>
        positionOf(one.arm.frame(one.arm.tool, one.arm.forward(one.motion.sample(k)))),
      );
      one.trail = new Trail(one.motion.times, points, 0.004 * one.arm.length, 0xc92a2a);
      one.drawing.group.add(one.trail.mesh);
    }
    one.drawing.show(q);
    return one;
  }

  async start() {
    await Promise.all(this.actors.map(actor => actor.drawing.complete));
    this.frame();
    const world = triad(0.15 * this.arm.length, "₀");
    world.name = "world frame";
    this.stage.scene.add(world);
    this.panel = new Panel(this);
    this.handle = this.arm.task ? new Handle(this) : null;
    this.abilities = this.arm.task ? new Abilities(this) : null;
    this.tools();
    const { solutions, voxels } = this.data;
    if (voxels) this.voxels = new Voxels(this, voxels);
    if (solutions.length) this.solutions = new Solutions(this, solutions, ghost => this.ghost(ghost));
    const duration = Math.max(0, ...this.actors.map(actor => actor.motion?.duration ?? 0));
    if (duration > 0) {
      this.plots = this.motionPlots();
      this.bar = new Bar(duration, t => this.seek(t), () => this.stage.changed());
      this.showPlots(false);
    }
    this.change(this.q);
    if (this.voxels) this.frame();
    this.stage.fit();
    if (duration > 0) this.bar.play(true);
  }

  ghost(opacity) {
    const drawing = new Drawing(this.arm, this.meshes, { ghost: opacity });
    this.stage.scene.add(drawing.group);
    return drawing;
  }

  motionPlots() {
    const { arm, motion, target } = this.actors[this.chosen];
    if (!motion) return [];
    const plots = plotsOf(arm, motion, target?.samples, t => this.bar.scrub(t));
    document.getElementById("plots").replaceChildren(...plots.map(plot => plot.node));
    return plots;
  }

  showPlots(yes) {
    document.getElementById("plots").hidden = !yes;
    document.getElementById("plotting").setAttribute("aria-pressed", String(yes));
    this.stage.fit();
  }

  /** Let the camera and the floor see where the robots are, and the whole motion. */
  frame() {
    const box = this.stage.box.makeEmpty();
    for (const actor of this.actors) {
      const steps = actor.motion ? Math.min(60, actor.motion.count) : 1;
      for (let k = 0; k < steps; k++) {
        if (actor.motion) actor.drawing.show(actor.motion.at((actor.motion.duration * k) / Math.max(1, steps - 1)));
        box.union(actor.drawing.box());
      }
      actor.drawing.show(actor.q);
      if (actor.motion) box.union(actor.drawing.box());
      const offset = actor.drawing.group.position;
      actor.target?.points.forEach(p => box.expandByPoint(new THREE.Vector3(...p).add(offset)));
    }
    for (const { q } of this.data.solutions) {
      this.drawing.show(q);
      box.union(this.drawing.box());
    }
    this.drawing.show(this.q);
    if (this.voxels) box.union(this.voxels.box);
    this.stage.floor(Math.min(0, box.min.z) - 1e-3 * this.arm.length);
  }

  tools() {
    const get = id => document.getElementById(id);
    for (const view of ["iso", "top", "front"]) {
      get(view).onclick = () => {
        this.frame();
        this.stage.look(view);
      };
    }
    get("fit").onclick = () => {
      this.frame();
      this.stage.fit();
    };
    get("png").onclick = () => this.picture();
    get("plotting").onclick = () => this.showPlots(get("plots").hidden);
    get("fold").onclick = () => {
      get("panel").hidden = !get("panel").hidden;
      this.stage.fit();
    };
    get("panel").hidden = window.innerWidth < 700;
    const choice = get("choice");
    choice.hidden = this.actors.length < 2;
    choice.replaceChildren(...this.actors.map((actor, i) => element("option", { value: i }, actor.arm.label)));
    choice.onchange = () => this.choose(Number(choice.value));
    this.hover();
  }

  /** Save what is seen as a PNG file, without the gizmo. */
  picture() {
    if (this.handle) this.handle.gizmo.group.visible = false;
    this.stage.picture(this.arm.name);
    if (this.handle) this.handle.gizmo.group.visible = true;
    this.stage.changed();
  }

  /** Let panel and handle be those of another robot. */
  choose(number) {
    this.drawing.showLost(null);
    this.chosen = number;
    this.panel.build();
    this.handle?.build();
    if (this.bar) this.plots = this.motionPlots();
    this.change(this.q);
  }

  /** Name the link and the joint under the pointer, and draw the joint's axis. */
  hover() {
    const hint = document.getElementById("hint"), ray = new THREE.Raycaster();
    const axis = rod([0, 0, -1], [0, 0, 1], 0.004, paint(COLORS.accent));
    axis.visible = false;
    this.stage.scene.add(axis);
    this.stage.element.addEventListener("pointermove", event => {
      const box = this.stage.element.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * 2 - 1, y = 1 - ((event.clientY - box.top) / box.height) * 2;
      ray.setFromCamera(new THREE.Vector2(x, y), this.stage.viewer.camera);
      const part = this.handle?.aimed;
      const hit = event.buttons || part ? null : ray.intersectObjects(this.actors.map(a => a.drawing.group), true)
        .find(found => found.object.userData.drawn);
      hint.hidden = !hit && !part;
      axis.visible = Boolean(hit) && hit.object.userData.joint >= 0;
      hint.textContent = part ? part.words : "";
      hint.style.left = `${Math.min(event.clientX + 14, window.innerWidth - 240)}px`;
      hint.style.top = `${event.clientY + 14}px`;
      if (hit) this.tell(hit.object, hint, axis);
      this.stage.changed();
    });
  }

  tell(object, hint, axis) {
    const { arm, drawing, q } = this.actors.find(a => a.drawing.group === object.parent.parent);
    const joint = arm.joints[object.userData.joint];
    hint.textContent = joint ? `${object.name}  moved by ${joint.name} (${joint.kind})` : `${object.name}  fixed`;
    if (!joint) return;
    const T = arm.forward(q)[object.userData.joint], along = new THREE.Vector3(...rotate(T, joint.axis));
    axis.position.set(...positionOf(T)).add(drawing.group.position);
    axis.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along);
    axis.scale.set(arm.length, 0.35 * arm.length, arm.length);
  }

  /** Stop what moves by itself, but for one. */
  halt(except = null) {
    if (this.bar && this.bar !== except) this.bar.play(false);
    if (this.abilities?.moving && this.abilities !== except) this.abilities.play(false);
  }

  /** Put the chosen robot at q. */
  change(q) {
    if (!q.every(Number.isFinite)) return;
    if (this.bar?.playing) this.bar.play(false);
    this.pose(this.actors[this.chosen], q);
    this.answer();
  }

  pose(actor, q) {
    actor.q = q;
    actor.placed = actor.drawing.show(q);
  }

  answer() {
    const { placed } = this.actors[this.chosen];
    this.panel.show();
    this.handle?.show(placed);
    this.abilities?.show(placed);
    this.stage.changed();
  }

  /** Put every robot, trail and target where it is at time t. */
  seek(t) {
    for (const actor of this.actors) {
      if (actor.motion) this.pose(actor, actor.motion.at(t));
      actor.trail?.show(t);
      actor.target?.show(t);
    }
    this.plots.forEach(plot => plot.show(t));
    if (this.actors[this.chosen].placed) this.answer();
  }
}

/** Show a sentence where there is no picture. */
function tellWhyNot(error) {
  const box = document.getElementById("loading");
  box.hidden = false;
  box.textContent = /WebGL/i.test(String(error))
    ? "This browser shows no 3D graphics: WebGL is switched off or missing."
    : `The page cannot be shown: ${error}`;
}

async function show(text) {
  try {
    const app = new App(JSON.parse(text));
    window.robotics1 = { app, ready: false };
    await app.start();
    document.getElementById("loading").hidden = true;
    window.robotics1.ready = true;
  } catch (error) {
    tellWhyNot(error);
    throw error;
  }
}

show(document.getElementById("data").textContent);
