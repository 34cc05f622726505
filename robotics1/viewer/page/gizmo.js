// The gizmo at the target: a ball to take it anywhere, rings about its axes, and outside them arrows along the axes.

const AXES = ["x", "y", "z"];
const RING = 0.68; // radius; the tip of an arrow is at 1
const TOWARDS = 0.95; // cosine to the line of sight: an arrow that comes nearer to it cannot be drawn along it
const EDGE = 0.12; // cosine to the line of sight: a ring of less is seen from its edge

function flat(color) {
  return new THREE.MeshBasicMaterial({ color, transparent: true, depthTest: false, depthWrite: false });
}

/** Return the axes, 0 to 2, along which a task moves its target (or about which it turns it). */
function axesOf({ S }, planar, turning) {
  const free = planar ? (turning ? [2] : [0, 1]) : [0, 1, 2];
  return free.filter(k => S.some(row => Math.abs(row[k + (turning ? 3 : 0)]) > 1e-12));
}

class Gizmo {
  /** The parts are those of the arm's task: arrows where it has a position, rings where it has an orientation. */
  constructor(arm, planar) {
    this.group = new THREE.Group();
    this.group.name = "handle";
    const along = axesOf(arm.task, planar, false), about = axesOf(arm.task, planar, true);
    const start = about.length ? RING : 0.2;
    this.parts = [this.ball(), ...along.map(k => this.arrow(k, start)), ...about.map(k => this.ring(k))];
    for (const { node } of this.parts) {
      node.traverse(one => (one.renderOrder = 11));
      this.group.add(node);
    }
    this.light(null, false);
  }

  ball() {
    const node = new THREE.Group();
    node.add(new THREE.Mesh(new THREE.SphereGeometry(0.13, 24, 16), flat(COLORS.accent)));
    return { kind: "ball", words: "drag the target", node, points: [[0, 0, 0]], axis: null };
  }

  /** Return an arrow from so far outside the middle. */
  arrow(k, start) {
    const node = new THREE.Group(), material = flat(COLORS[AXES[k]]);
    const head = new THREE.Mesh(new THREE.ConeGeometry(0.075, 0.22, 24), material);
    head.position.set(0.89, 0, 0);
    head.rotation.z = -Math.PI / 2;
    node.add(rod([start, 0, 0], [0.8, 0, 0], 0.022, material), head);
    const axis = unit(k);
    node.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), axis);
    const points = [start, 1].map(at => times(at, axis.toArray()));
    return { kind: "arrow", words: `drag along ${AXES[k]}`, node, points, axis };
  }

  /** Return a ring: pale as a whole, and its front half strong. */
  ring(k) {
    const node = new THREE.Group(), material = flat(COLORS[AXES[k]]), pale = flat(COLORS[AXES[k]]);
    const front = new THREE.Mesh(new THREE.TorusGeometry(RING, 0.018, 8, 48, Math.PI), material);
    node.add(new THREE.Mesh(new THREE.TorusGeometry(RING, 0.018, 8, 96), pale), front);
    const axis = unit(k), points = [];
    node.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), axis);
    for (let i = 0; i <= 48; i++) {
      const angle = (i * Math.PI) / 24, p = new THREE.Vector3(RING * Math.cos(angle), RING * Math.sin(angle), 0);
      points.push(p.applyQuaternion(node.quaternion).toArray());
    }
    return { kind: "ring", words: `turn about ${AXES[k]}`, node, front, pale, points, axis };
  }

  /** Stand at a point, with the axes of a placement. */
  show(point, T) {
    this.group.position.copy(point);
    this.group.quaternion.setFromRotationMatrix(asMatrix(T));
  }

  /** Return a part's axis in the world. */
  direction(part) {
    return part.axis.clone().applyQuaternion(this.group.quaternion);
  }

  /** Return how long an arrow is from the middle at a point [m]: as many pixels, whatever the camera. */
  static size(stage, point) {
    const { clientWidth, clientHeight } = stage.element;
    return stage.pixelAt(point) * Math.min(92, Math.max(64, 0.13 * Math.min(clientWidth, clientHeight)));
  }

  /** Face the camera: keep the size in the window, and hide what is seen from its end or its edge. */
  face(stage, bare) {
    const { position } = this.group;
    this.group.scale.setScalar(Gizmo.size(stage, position));
    const sight = stage.sight(position).negate();
    for (const part of this.parts) {
      const cosine = part.axis ? Math.abs(this.direction(part).dot(sight)) : 0;
      part.node.visible = !part.axis || (!bare && (part.kind === "arrow" ? cosine < TOWARDS : cosine > EDGE));
      const strength = part === this.chosen ? 1 : this.held ? 0.2 : 0.8;
      part.node.traverse(({ material }) => material && (material.opacity = strength));
      if (part.kind === "ring") this.turnFront(part, sight, cosine, strength);
    }
    this.group.updateMatrixWorld(true);
  }

  /** Turn the strong half of a ring towards the eye; seen along its axis, all of it is in front. */
  turnFront(part, sight, cosine, strength) {
    const inRing = part.node.quaternion.clone().premultiply(this.group.quaternion).invert();
    const seen = sight.clone().applyQuaternion(inRing);
    part.front.rotation.z = Math.atan2(seen.y, seen.x) - Math.PI / 2;
    part.pale.opacity = (cosine < 0.98 ? 0.35 : 1) * strength;
  }

  /** Return { part, point } nearest to a pixel, not farther than so many pixels, or null; the ball comes first. */
  pick(stage, pixel, tolerance) {
    let best = null;
    for (const part of this.parts.filter(one => one.node.visible)) {
      const points = part.points.map(p => new THREE.Vector3(...p).applyMatrix4(this.group.matrixWorld));
      const { distance, point } = nearest(points, points.map(p => stage.pixelOf(p)), pixel);
      const off = part.kind === "ball" ? Math.max(0, distance - 12) : distance;
      if (off <= tolerance && (!best || off < best.off)) best = { part, point, off };
    }
    return best;
  }

  /** Show which part is under the pointer; while it is held, the others are pale. */
  light(chosen, held) {
    this.chosen = chosen;
    this.held = held;
  }
}

function unit(k) {
  return new THREE.Vector3().setComponent(k, 1);
}

/** Return how far a pixel is from a line through pixels, and the point of the world that is there. */
function nearest(points, pixels, [x, y]) {
  let best = { distance: Math.hypot(pixels[0][0] - x, pixels[0][1] - y), point: points[0] };
  for (let i = 1; i < points.length; i++) {
    const [a, b] = [pixels[i - 1], pixels[i]], along = [b[0] - a[0], b[1] - a[1]];
    const part = ((x - a[0]) * along[0] + (y - a[1]) * along[1]) / Math.max(along[0] ** 2 + along[1] ** 2, 1e-12);
    const share = Math.min(1, Math.max(0, part));
    const distance = Math.hypot(a[0] + share * along[0] - x, a[1] + share * along[1] - y);
    if (distance < best.distance) best = { distance, point: points[i - 1].clone().lerp(points[i], share) };
  }
  return best;
}
