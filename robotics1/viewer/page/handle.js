// The handle at the tool: the arm follows it when it is dragged.

class Handle {
  constructor(app) {
    this.app = app;
    const { stage, arm } = app;
    this.group = new THREE.Group();
    this.group.name = "handle";
    this.ball = new THREE.Mesh(
      new THREE.SphereGeometry(0.02 * arm.length, 24, 16),
      paint(COLORS.accent, { opacity: 0.55, transparent: true, depthTest: false }),
    );
    this.ball.renderOrder = 5;
    this.group.add(this.ball);
    stage.scene.add(this.group);
    this.ray = new THREE.Raycaster();
    this.verdict = document.getElementById("verdict");
    const listen = (name, act) => stage.element.addEventListener(name, act, { capture: true });
    listen("pointerdown", event => this.start(event));
    listen("pointermove", event => this.move(event));
    listen("pointerup", event => this.stop(event));
    listen("pointercancel", event => this.stop(event));
  }

  /** Stand where the tool is, unless a hand holds it elsewhere. */
  show(placed) {
    const { arm, drawing } = this.app;
    const p = this.held ? positionOf(this.held.wanted) : positionOf(arm.frame(arm.task.frame, placed));
    this.group.position.set(...p).add(drawing.group.position);
  }

  aim(event) {
    const { stage } = this.app, box = stage.element.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * 2 - 1, y = 1 - ((event.clientY - box.top) / box.height) * 2;
    this.ray.setFromCamera(new THREE.Vector2(x, y), stage.viewer.camera);
  }

  start(event) {
    this.aim(event);
    if (!this.ray.intersectObject(this.ball).length) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    const { arm, q, stage } = this.app;
    this.app.halt();
    const normal = this.app.planar
      ? new THREE.Vector3(0, 0, 1)
      : stage.viewer.camera.getWorldDirection(new THREE.Vector3()).negate();
    this.held = {
      pointer: event.pointerId,
      at: [event.clientX, event.clientY],
      plane: new THREE.Plane().setFromNormalAndCoplanarPoint(normal, this.group.position),
      wanted: arm.frame(arm.task.frame, arm.forward(q)).slice(),
    };
    stage.element.setPointerCapture(event.pointerId);
  }

  move(event) {
    if (!this.held || event.pointerId !== this.held.pointer) {
      this.aim(event);
      this.app.stage.element.style.cursor = this.ray.intersectObject(this.ball).length ? "grab" : "";
      return;
    }
    event.stopImmediatePropagation();
    const [x, y] = this.held.at;
    this.held.at = [event.clientX, event.clientY];
    if (event.shiftKey) {
      this.turn(event.clientX - x, event.clientY - y);
      return;
    }
    this.aim(event);
    const point = this.ray.ray.intersectPlane(this.held.plane, new THREE.Vector3());
    if (!point) return;
    point.sub(this.app.drawing.group.position);
    [this.held.wanted[3], this.held.wanted[7], this.held.wanted[11]] = point.toArray();
    this.pull();
  }

  /** Turn the wanted orientation: a pixel is half a degree, about z in the plane, in space as a ball rolls. */
  turn(right, down) {
    const { camera } = this.app.stage.viewer, half = Math.PI / 360;
    const turns = this.app.planar
      ? [[[0, 0, 1], -right * half]]
      : [[[0, 1, 0], right * half], [[1, 0, 0], down * half]].map(([axis, angle]) => [
          new THREE.Vector3(...axis).applyQuaternion(camera.quaternion).toArray(), angle,
        ]);
    const p = positionOf(this.held.wanted);
    for (const [axis, angle] of turns) this.held.wanted = compose(turn(axis, angle), this.held.wanted);
    [this.held.wanted[3], this.held.wanted[7], this.held.wanted[11]] = p;
    this.pull();
  }

  /** Move the arm towards the wanted placement, and say what comes of it. */
  pull() {
    const { q, verdict } = follow(this.app.arm, this.app.q, this.held.wanted);
    this.app.change(q);
    this.verdict.hidden = false;
    this.verdict.className = verdict.kind;
    this.verdict.textContent = verdict.text;
  }

  stop(event) {
    if (!this.held || event.pointerId !== this.held.pointer) return;
    event.stopImmediatePropagation();
    this.held = null;
    this.app.change(this.app.q);
  }
}
