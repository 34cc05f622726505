// A robot in the scene: its shapes move with its joints.

/** Return the bytes of a base64 text that were compressed with deflate. */
async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/**
 * Return the geometry of a mesh: 16-bit corners between min and max, then the corners of each triangle.
 *
 * Each corner of a triangle has the mean normal of the triangles that meet there at less than 40°: edges stay sharp.
 */
async function meshGeometry({ corners: count, triangles, min, max, data }) {
  const bytes = await inflated(data);
  const packed = new Uint16Array(bytes, 0, 3 * count);
  const wide = count > 65535;
  const start = wide ? Math.ceil((6 * count) / 4) * 4 : 6 * count;
  const faces = wide ? new Uint32Array(bytes, start, 3 * triangles) : new Uint16Array(bytes, start, 3 * triangles);
  const at = new Float32Array(3 * count);
  for (let i = 0; i < 3 * count; i++) at[i] = min[i % 3] + (packed[i] / 65535) * (max[i % 3] - min[i % 3]);
  const geometry = new THREE.BufferGeometry();
  const position = new Float32Array(9 * triangles);
  for (let k = 0; k < 3 * triangles; k++) {
    for (let c = 0; c < 3; c++) position[3 * k + c] = at[3 * faces[k] + c];
  }
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(creasedNormals(position, faces, count), 3));
  return geometry;
}

function creasedNormals(position, faces, count) {
  const triangles = faces.length / 3, area = new Float32Array(faces.length), unit = new Float32Array(faces.length);
  for (let f = 0; f < triangles; f++) {
    const p = position.subarray(9 * f, 9 * f + 9);
    const a = [p[3] - p[0], p[4] - p[1], p[5] - p[2]], b = [p[6] - p[0], p[7] - p[1], p[8] - p[2]];
    const n = cross(a, b), size = norm(n) || 1;
    for (let c = 0; c < 3; c++) {
      area[3 * f + c] = n[c];
      unit[3 * f + c] = n[c] / size;
    }
  }
  const first = new Uint32Array(count + 1), around = new Uint32Array(faces.length);
  for (const v of faces) first[v + 1]++;
  for (let v = 0; v < count; v++) first[v + 1] += first[v];
  const next = first.slice(0, count);
  faces.forEach((v, k) => (around[next[v]++] = Math.floor(k / 3)));
  const normal = new Float32Array(3 * faces.length), crease = Math.cos((40 * Math.PI) / 180);
  for (let k = 0; k < faces.length; k++) {
    const f = Math.floor(k / 3);
    let x = 0, y = 0, z = 0;
    for (let i = first[faces[k]]; i < first[faces[k] + 1]; i++) {
      const g = 3 * around[i];
      if (unit[3 * f] * unit[g] + unit[3 * f + 1] * unit[g + 1] + unit[3 * f + 2] * unit[g + 2] < crease) continue;
      x += area[g];
      y += area[g + 1];
      z += area[g + 2];
    }
    const size = Math.hypot(x, y, z) || 1;
    normal.set([x / size, y / size, z / size], 3 * k);
  }
  return normal;
}

/** Return the geometry of a plain shape in the axes of URDF: cylinders and capsules along z. */
function plainGeometry({ kind, size }) {
  if (kind === "box") return new THREE.BoxGeometry(...size);
  if (kind === "sphere") return new THREE.SphereGeometry(size[0], 32, 20);
  if (kind === "capsule") return capsule(...size);
  return new THREE.CylinderGeometry(size[0], size[0], size[1], 32).rotateX(Math.PI / 2);
}

function capsule(radius, length) {
  const profile = [];
  for (let k = 0; k <= 32; k++) {
    const angle = -Math.PI / 2 + (k * Math.PI) / 32;
    const middle = k <= 16 ? -length / 2 : length / 2;
    profile.push(new THREE.Vector2(radius * Math.cos(angle), middle + radius * Math.sin(angle)));
  }
  return new THREE.LatheGeometry(profile, 32).rotateX(Math.PI / 2);
}

class Drawing {
  /** meshes: promises of the geometries; ghost: drawn pale, as another solution or an earlier posture. */
  constructor(arm, meshes, { ghost = 0, offset = [0, 0, 0], tint = null } = {}) {
    this.arm = arm;
    this.group = new THREE.Group();
    this.group.position.set(...offset);
    this.group.name = arm.name;
    this.links = arm.joints.map(joint => this.linkGroup(joint.name));
    this.base = this.linkGroup("base");
    this.complete = Promise.all(arm.shapes.map(shape => this.addShape(shape, meshes, ghost, tint)));
    this.tool = arm.tool && !ghost ? new THREE.Group() : null;
    if (this.tool) {
      this.tool.name = "tool frame";
      this.tool.add(triad(1, "", 1.6));
      this.sizeTool(() => 0.12 * arm.length);
      this.group.add(this.tool);
    }
    this.lost = arrow(0.2 * arm.length, 0.005 * arm.length, COLORS.warning);
    this.lost.visible = false;
    this.group.add(this.lost);
  }

  linkGroup(name) {
    const group = new THREE.Group();
    group.name = name;
    group.matrixAutoUpdate = false;
    this.group.add(group);
    return group;
  }

  async addShape(shape, meshes, ghost, tint) {
    const geometry = shape.kind === "mesh" ? await meshes[shape.mesh] : plainGeometry(shape);
    const [red, green, blue, alpha] = shape.color;
    const opacity = ghost ? ghost * alpha : alpha;
    const material = paint(new THREE.Color(...(tint ?? [red, green, blue])), {
      opacity, transparent: opacity < 1, depthWrite: opacity >= 1,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(asMatrix(shape.placement)).scale(new THREE.Vector3(...(shape.scale ?? [1, 1, 1])));
    mesh.name = shape.link;
    mesh.userData = { joint: shape.joint, drawn: shape };
    (shape.joint < 0 ? this.base : this.links[shape.joint]).add(mesh);
  }

  show(q) {
    this.q = q;
    const placed = this.arm.forward(q);
    this.links.forEach((group, i) => {
      group.matrix.copy(asMatrix(placed[i]));
      group.matrixWorldNeedsUpdate = true;
    });
    if (this.tool) place(this.tool, this.arm.frame(this.arm.tool, placed));
    return placed;
  }

  /** Let the axes of the tool be as long as a function says of where they are. */
  sizeTool(size) {
    this.tool?.children[0].scale.setScalar(size(new THREE.Vector3().setFromMatrixPosition(this.tool.matrixWorld)));
  }

  /** Show, at the tool, the direction in which it cannot move, or nothing. */
  showLost(direction) {
    this.lost.visible = direction !== null;
    if (direction === null) return;
    this.lost.position.set(...positionOf(this.arm.frame(this.arm.task.frame, this.arm.forward(this.q))));
    this.lost.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), new THREE.Vector3(...direction));
  }

  /** Return the box round all shapes where they are now. */
  box() {
    this.group.updateMatrixWorld(true);
    const box = new THREE.Box3();
    for (const group of [this.base, ...this.links]) box.expandByObject(group);
    if (this.arm.tool) {
      const p = positionOf(this.arm.frame(this.arm.tool, this.arm.forward(this.q)));
      const ball = new THREE.Sphere(new THREE.Vector3(...p).add(this.group.position), 0.16 * this.arm.length);
      const round = ball.getBoundingBox(new THREE.Box3());
      box.union(round); // the gizmo
    }
    return box;
  }
}
