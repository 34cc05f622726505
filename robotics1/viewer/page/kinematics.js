// Forward kinematics and Jacobians of an arm, in double precision.

class Arm {
  /**
   * data.joints: in an order in which parents come first; each has parent (number, or −1), placement, kind, axis,
   * and moves by multiplier · q[coordinate] + offset. data.coordinates: name, unit, lower, upper of each entry of q.
   * data.tool, data.task.frame: a joint's number and a placement in it. data.chain: the frame of the task, or the tool,
   * is never farther than length from the point start; length is null where a joint slides without a limit.
   */
  constructor(data) {
    Object.assign(this, data);
    this.size = data.coordinates.length;
    this.length = Math.min(data.reach, Math.max(data.chain.length ?? data.reach, 0.4 * data.reach)); // of what is drawn
    this.scale = data.coordinates.map(c => (c.unit === "rad" ? 1 : data.reach)); // what counts as one
  }

  /** Return the placement of each joint's frame in the world. */
  forward(q) {
    const placed = [];
    for (const joint of this.joints) {
      const above = joint.parent < 0 ? joint.placement : compose(placed[joint.parent], joint.placement);
      const value = joint.coordinate < 0 ? 0 : joint.multiplier * q[joint.coordinate] + joint.offset;
      const motion = { revolute: turn, prismatic: shift }[joint.kind];
      placed.push(motion ? compose(above, motion(joint.axis, value)) : above);
    }
    return placed;
  }

  /** Return the placement of a frame (joint, placement), given those of the joints. */
  frame(frame, placed) {
    return frame.joint < 0 ? frame.placement : compose(placed[frame.joint], frame.placement);
  }

  /** Return J (6 × n) of a frame: its velocity (v, ω) in world axes for each unit of q̇. */
  jacobian(frame, placed) {
    const point = positionOf(this.frame(frame, placed));
    const J = Array.from({ length: 6 }, () => new Array(this.size).fill(0));
    for (let i = frame.joint; i >= 0; i = this.joints[i].parent) {
      const joint = this.joints[i];
      if (joint.coordinate < 0) continue;
      const axis = times(joint.multiplier, rotate(placed[i], joint.axis));
      const turns = joint.kind === "revolute";
      const v = turns ? cross(axis, minus(point, positionOf(placed[i]))) : axis;
      for (let k = 0; k < 3; k++) {
        J[k][joint.coordinate] += v[k];
        if (turns) J[3 + k][joint.coordinate] += axis[k];
      }
    }
    return J;
  }

  /** Return the rows S·V of the task for a velocity V = (v, ω) in world axes. */
  taskRows(V, placed) {
    const { S, reference } = this.task;
    const R = reference ? this.frame(reference, placed) : IDENTITY;
    return applied(S, [...rotateBack(R, V.slice(0, 3)), ...rotateBack(R, V.slice(3))]);
  }

  /** Return the task's Jacobian (m × n). */
  taskJacobian(placed) {
    const columns = transposed(this.jacobian(this.task.frame, placed)).map(V => this.taskRows(V, placed));
    return this.task.S.map((_, i) => columns.map(c => c[i]));
  }

  /** Return a matrix without units: rows in metres, and joints in metres, are divided by the reach. */
  unitless(J) {
    return J.map((row, i) => row.map((v, j) => v * this.task.scale[i] * this.scale[j]));
  }

  /** Return what the task's Jacobian says at q: its singular values without units, the rank, and the determinant. */
  measure(q) {
    const placed = this.forward(q);
    const J = this.taskJacobian(placed);
    const { values, U, V } = singularValues(this.unitless(J), this.size);
    const rank = values.filter(s => s > 1e-9 * this.task.usual).length;
    const least = values.length ? values[values.length - 1] : 0;
    return { placed, J, values, U, V, rank, least, determinant: J.length === this.size ? determinant(J) : null };
  }

  /** Return q inside the limits. */
  clamped(q) {
    return q.map((value, i) => {
      const { lower, upper } = this.coordinates[i];
      return Math.min(upper ?? Infinity, Math.max(lower ?? -Infinity, value));
    });
  }
}
