// The hand at the tool: the arm follows the gizmo when it is dragged.

const NEAR = { mouse: 8, pen: 12, touch: 20 }; // pixels from a part of the gizmo that still take it

class Handle {
  constructor(app) {
    this.app = app;
    const { stage } = app;
    this.verdict = document.getElementById("verdict");
    this.build();
    stage.beforeDraw = () => this.face();
    const listen = (name, act) => stage.element.addEventListener(name, act, { capture: true });
    listen("pointerdown", event => this.start(event));
    listen("pointermove", event => this.move(event));
    listen("pointerup", event => this.stop(event));
    listen("pointercancel", event => this.stop(event));
  }

  /** Make the gizmo of the chosen robot's task. */
  build() {
    const { stage, arm, planar } = this.app;
    if (this.gizmo) stage.scene.remove(this.gizmo.group);
    this.gizmo = new Gizmo(arm, planar);
    stage.scene.add(this.gizmo.group);
    this.aimed = this.held = null;
    this.verdict.hidden = true;
  }

  /** Stand where the tool is, with the axes of the task, unless a hand holds it elsewhere. */
  show(placed) {
    const { arm, drawing } = this.app;
    const p = positionOf(this.held ? this.held.wanted : arm.frame(arm.task.frame, placed));
    const axes = this.held ? this.held.axes : this.axes(placed);
    this.gizmo.show(new THREE.Vector3(...p).add(drawing.group.position), axes);
  }

  /** Face the camera; the tools' own axes are inside the rings. While a robot plays only the ball is there. */
  face() {
    const { stage, actors, bar, abilities } = this.app;
    this.gizmo.face(stage, Boolean(bar?.playing || abilities?.moving));
    for (const { drawing } of actors) {
      drawing.sizeTool(p => 0.5 * Gizmo.size(stage, p));
    }
  }

  axes(placed) {
    const { reference } = this.app.arm.task;
    return reference ? this.app.arm.frame(reference, placed) : IDENTITY;
  }

  /** Return the part of the gizmo under the pointer, or null. */
  under(event) {
    const { stage } = this.app;
    return this.gizmo.pick(stage, stage.pixelUnder(event), NEAR[event.pointerType] ?? NEAR.mouse);
  }

  start(event) {
    const found = this.held ? null : this.under(event);
    if (!found && !this.held) return;
    event.stopImmediatePropagation(); // the camera stands still, also for a second finger
    event.preventDefault();
    if (this.held) return;
    this.app.halt();
    const placed = this.app.arm.forward(this.app.q);
    const wanted = this.app.arm.frame(this.app.arm.task.frame, placed).slice();
    this.held = { pointer: event.pointerId, wanted, axes: this.axes(placed).slice(), part: found.part };
    this.drag(this.app.stage.pixelUnder(event), event.shiftKey, found.point);
    this.gizmo.light(found.part, true);
    document.getElementById("hint").hidden = true;
    this.app.stage.element.setPointerCapture(event.pointerId);
    this.app.stage.changed();
  }

  /** Begin a drag of the part that is held, at a pixel, which is seen at the point grip of the part. */
  drag(pixel, shift, grip) {
    const { stage, planar } = this.app, { part, wanted } = this.held;
    const centre = this.gizmo.group.position.clone();
    this.held.pixel = pixel;
    this.held.rolls = part.kind === "ball" && shift;
    if (this.held.rolls) this.held.drag = new RollDrag(stage, planar, wanted, pixel);
    else if (part.kind === "arrow") {
      this.held.drag = new AxisDrag(stage, centre, this.gizmo.direction(part), wanted, pixel);
    } else if (part.kind === "ring") {
      this.held.drag = new RingDrag(stage, centre, this.gizmo.direction(part), wanted, pixel, grip);
    } else {
      const normal = planar ? new THREE.Vector3(0, 0, 1) : stage.sight(centre).negate();
      this.held.drag = new PlaneDrag(stage, centre, normal, wanted);
    }
  }

  move(event) {
    if (!this.held) {
      if (!event.buttons) this.aim(this.under(event)?.part ?? null);
      return;
    }
    event.stopImmediatePropagation();
    if (event.pointerId !== this.held.pointer) return;
    const { held } = this;
    if (held.part.kind === "ball" && event.shiftKey !== held.rolls) this.drag(held.pixel, event.shiftKey, null);
    held.pixel = this.app.stage.pixelUnder(event);
    const wanted = held.drag.to(held.pixel);
    if (!wanted) return;
    held.wanted = wanted;
    this.pull();
  }

  /** Let the part under the pointer stand out. */
  aim(part) {
    if (part === this.aimed) return;
    this.aimed = part;
    this.gizmo.light(part, false);
    this.app.stage.element.style.cursor = part ? "grab" : "";
    this.app.stage.changed();
  }

  /** Move the arm towards the wanted placement, and say what comes of it. */
  pull() {
    const { q, verdict } = follow(this.app.arm, this.app.q, this.held.wanted);
    this.app.change(q);
    const get = id => document.getElementById(id);
    if (get("panel").hidden) get("caption").append(this.verdict);
    else get("warning").after(this.verdict);
    this.verdict.hidden = false;
    this.verdict.className = verdict.kind;
    this.verdict.textContent = verdict.text;
  }

  stop(event) {
    if (!this.held || event.pointerId !== this.held.pointer) return;
    event.stopImmediatePropagation();
    this.held = this.aimed = null;
    this.gizmo.light(null, false);
    this.app.change(this.app.q);
  }
}
