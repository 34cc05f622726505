// What a pointer that holds a part of the gizmo wants: a placement for each pixel where it goes.

/** The target follows the pointer in a plane. */
class PlaneDrag {
  constructor(stage, centre, normal, wanted) {
    Object.assign(this, { stage, centre, wanted });
    this.plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, centre);
  }

  to(pixel) {
    const point = this.stage.rayAt(pixel).intersectPlane(this.plane, new THREE.Vector3());
    return point && shifted(this.wanted, point.sub(this.centre));
  }
}

/** The target follows along an axis: it is where the axis is nearest to the pointer's line of sight. */
class AxisDrag {
  constructor(stage, centre, axis, wanted, pixel) {
    Object.assign(this, { stage, centre, axis, wanted });
    this.start = this.along(pixel) ?? 0;
  }

  /** Return the coordinate on the axis that is nearest to the line of sight, or null where both are parallel. */
  along(pixel) {
    const { origin, direction } = this.stage.rayAt(pixel);
    const cosine = this.axis.dot(direction), between = origin.clone().sub(this.centre);
    const sine = 1 - cosine ** 2;
    return sine < 1e-6 ? null : (this.axis.dot(between) - cosine * direction.dot(between)) / sine;
  }

  to(pixel) {
    const at = this.along(pixel);
    return at === null ? null : shifted(this.wanted, this.axis.clone().multiplyScalar(at - this.start));
  }
}

/** The target turns about an axis through its point, as far as the pointer goes round. */
class RingDrag {
  constructor(stage, centre, axis, wanted, pixel, grip) {
    Object.assign(this, { stage, centre, axis, wanted, angle: 0, last: pixel });
    this.plane = new THREE.Plane().setFromNormalAndCoplanarPoint(axis, centre);
    this.open = Math.abs(axis.dot(stage.sight(centre))) > 0.3;
    const reach = grip.clone().sub(centre), step = axis.clone().cross(reach).multiplyScalar(0.01);
    const [a, b] = [grip, grip.clone().add(step)].map(p => stage.pixelOf(p));
    this.radian = [(b[0] - a[0]) / 0.01, (b[1] - a[1]) / 0.01]; // pixels, along the ring where it is held
  }

  /** Return the angle between two pixels: round the centre, or, where the ring is seen flat, along its tangent. */
  between(from, to) {
    if (!this.open) {
      const [x, y] = this.radian;
      return ((to[0] - from[0]) * x + (to[1] - from[1]) * y) / Math.max(x * x + y * y, 1e-9);
    }
    const [a, b] = [from, to].map(p => this.stage.rayAt(p).intersectPlane(this.plane, new THREE.Vector3()));
    if (!a || !b) return 0;
    a.sub(this.centre);
    b.sub(this.centre);
    return Math.atan2(this.axis.dot(a.clone().cross(b)), a.dot(b));
  }

  to(pixel) {
    this.angle += this.between(this.last, pixel);
    this.last = pixel;
    return turned(this.wanted, this.axis.toArray(), this.angle);
  }
}

/** The target rolls as a ball under the pointer; in the plane it turns about the normal. A pixel is half a degree. */
class RollDrag {
  constructor(stage, planar, wanted, pixel) {
    Object.assign(this, { stage, planar, wanted, last: pixel });
  }

  to(pixel) {
    const half = Math.PI / 360, right = (pixel[0] - this.last[0]) * half, down = (pixel[1] - this.last[1]) * half;
    this.last = pixel;
    const { quaternion } = this.stage.viewer.camera;
    const seen = (...axis) => new THREE.Vector3(...axis).applyQuaternion(quaternion).toArray();
    this.wanted = this.planar
      ? turned(this.wanted, [0, 0, 1], -right)
      : turned(turned(this.wanted, seen(0, 1, 0), right), seen(1, 0, 0), down);
    return this.wanted;
  }
}

/** Return a placement that is moved by a vector. */
function shifted(T, by) {
  const there = T.slice();
  [there[3], there[7], there[11]] = [T[3] + by.x, T[7] + by.y, T[11] + by.z];
  return there;
}

/** Return a placement that is turned where it is, about an axis of the world. */
function turned(T, axis, angle) {
  const there = compose(turn(axis, angle), T);
  [there[3], there[7], there[11]] = positionOf(T);
  return there;
}
