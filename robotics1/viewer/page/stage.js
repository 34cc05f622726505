// The stage: Meshcat's scene without its own panel, lights, floor with ticks, and a camera whose z is up.

const THREE = MeshCat.THREE;
const COLORS = { x: 0xd1352b, y: 0x2a8f3c, z: 0x2b62d1, ink: 0x26323f, warning: 0xd9480f, accent: 0x0b7285 };

function asMatrix(T) {
  return new THREE.Matrix4().set(...T, 0, 0, 0, 1);
}

/** Give an object a placement for good: Three's own position and rotation are not used. */
function place(object, T) {
  object.matrixAutoUpdate = false;
  object.matrix.copy(asMatrix(T));
  object.matrixWorldNeedsUpdate = true;
}

function paint(color, options = {}) {
  return new THREE.MeshPhongMaterial({ color, shininess: 25, specular: 0x222222, side: THREE.DoubleSide, ...options });
}

/** Return a word that always faces the camera, so high [m]. */
function label(text, height, color = "#26323f") {
  const canvas = document.createElement("canvas");
  const font = "600 48px system-ui, sans-serif";
  let context = canvas.getContext("2d");
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 16;
  canvas.height = 64;
  context = canvas.getContext("2d");
  context.font = font;
  context.textBaseline = "middle";
  context.lineWidth = 8;
  context.lineJoin = "round";
  context.strokeStyle = "rgba(255, 255, 255, 0.85)";
  context.strokeText(text, 8, 34);
  context.fillStyle = color;
  context.fillText(text, 8, 34);
  const map = new THREE.CanvasTexture(canvas);
  map.minFilter = THREE.LinearFilter;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false, transparent: true }));
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  sprite.renderOrder = 10;
  return sprite;
}

/** Return a cylinder between two points. */
function rod(start, end, radius, material) {
  const a = new THREE.Vector3(...start), b = new THREE.Vector3(...end);
  const mesh = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, a.distanceTo(b) || 1e-9, 16), material);
  mesh.position.copy(a).add(b).multiplyScalar(0.5);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), b.clone().sub(a).normalize());
  return mesh;
}

/** Return an arrow from the origin along x, so long. */
function arrow(length, radius, color) {
  const group = new THREE.Group(), material = paint(color);
  const head = new THREE.Mesh(new THREE.ConeGeometry(2.6 * radius, 7 * radius, 20), material);
  head.position.set(length - 3.5 * radius, 0, 0);
  head.rotation.z = -Math.PI / 2;
  group.add(rod([0, 0, 0], [length - 6 * radius, 0, 0], radius, material), head);
  return group;
}

/** Return three axes with letters: the world's, or the tool's, which is small and so bolder. */
function triad(size, name, bold = 1) {
  const group = new THREE.Group();
  for (const [letter, axis] of [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]]) {
    const one = arrow(size, 0.022 * bold * size, COLORS[letter]);
    one.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), new THREE.Vector3(...axis));
    const text = label(letter + name, 0.28 * bold * size, "#" + COLORS[letter].toString(16).padStart(6, "0"));
    text.position.set(...times(1.18 * size, axis));
    group.add(one, text);
  }
  return group;
}

class Stage {
  /** planar: everything happens in the plane z = 0, which is seen from the top without perspective. */
  constructor(element, planar) {
    this.element = element;
    this.viewer = new MeshCat.Viewer(element, false);
    this.viewer.gui.domElement.remove();
    for (const name of ["Grid", "Axes"]) this.viewer.set_property([name], "visible", false);
    this.viewer.set_property(["Background"], "top_color", [0.98, 0.985, 0.99]);
    this.viewer.set_property(["Background"], "bottom_color", [0.86, 0.89, 0.92]);
    this.scene = this.viewer.scene;
    this.scene.rotation.set(0, 0, 0); // Meshcat turns its y up; here z is up
    this.box = new THREE.Box3();
    this.viewer.set_property(["Lights"], "visible", false);
    this.beforeDraw = () => {};
    this.light();
    this.look(planar ? "top" : "iso", planar);
    window.addEventListener("resize", () => this.fit());
    const draw = () => {
      requestAnimationFrame(draw);
      if (!this.viewer.needs_render) return;
      this.beforeDraw();
      this.viewer.render();
    };
    draw();
  }

  /** Light from the sky, from the right in front, and a little from behind: a white robot keeps its shades. */
  light() {
    const sky = new THREE.HemisphereLight(0xffffff, 0x9aa3ad, 0.55);
    sky.position.set(0, 0, 1);
    this.scene.add(sky);
    for (const [strength, ...from] of [[0.42, 3, -4, 6], [0.16, -5, 3, 2]]) {
      const lamp = new THREE.DirectionalLight(0xffffff, strength);
      lamp.position.set(...from);
      this.scene.add(lamp);
    }
  }

  changed() {
    this.viewer.set_dirty();
  }

  /** Return where the pointer of an event is [pixels from the left and the top of the scene]. */
  pixelUnder(event) {
    const box = this.element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** Return the ray from the eye through a pixel. */
  rayAt([x, y]) {
    const { clientWidth, clientHeight } = this.element;
    const caster = new THREE.Raycaster();
    caster.setFromCamera(
      new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.viewer.camera,
    );
    return caster.ray;
  }

  /** Return the pixel where a point is seen. */
  pixelOf(point) {
    const { x, y } = point.clone().project(this.viewer.camera);
    return [((x + 1) / 2) * this.element.clientWidth, ((1 - y) / 2) * this.element.clientHeight];
  }

  /** Return the direction in which the eye sees a point. */
  sight(point) {
    const { camera } = this.viewer;
    return camera.isOrthographicCamera
      ? camera.getWorldDirection(new THREE.Vector3())
      : point.clone().sub(camera.position).normalize();
  }

  /** Return how large a pixel is at a point [m]. */
  pixelAt(point) {
    const { camera } = this.viewer, { clientHeight } = this.element;
    if (camera.isOrthographicCamera) return (camera.top - camera.bottom) / camera.zoom / clientHeight;
    const depth = point.clone().sub(camera.position).dot(camera.getWorldDirection(new THREE.Vector3()));
    return (2 * depth * Math.tan((camera.fov * Math.PI) / 360)) / clientHeight;
  }

  /** Look from the side of a name, without perspective if asked, and fit the scene into the window. */
  look(from, flat = from !== "iso") {
    const [direction, up] = {
      iso: [[0.72, -1, 0.55], [0, 0, 1]],
      top: [[0, 0, 1], [0, 1, 0]],
      front: [[0, -1, 0], [0, 0, 1]],
    }[from];
    const camera = flat
      ? new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000)
      : new THREE.PerspectiveCamera(40, 1, 0.01, 1000);
    camera.up.set(...up);
    camera.position.set(...direction);
    this.viewer.controls.dispose();
    this.viewer.camera.parent.remove(this.viewer.camera);
    this.scene.add(camera);
    this.viewer.set_camera(camera);
    this.fit();
  }

  /** Move the camera, along its line of sight, so that the box of all that is drawn fills the free part. */
  fit() {
    const { camera, controls } = this.viewer;
    const width = this.element.clientWidth, height = this.element.clientHeight;
    this.viewer.renderer.setSize(width, height);
    const bottom = document.getElementById("bottom").offsetHeight; // the panel ends above it
    document.documentElement.style.setProperty("--bottom", `${bottom}px`);
    const unit = new THREE.Box3(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
    const box = this.box.isEmpty() ? unit : this.box;
    const centre = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length() || 1;
    const away = camera.position.clone().sub(controls.target).normalize();
    controls.target.copy(centre);
    camera.position.copy(centre).addScaledVector(away, size);
    camera.lookAt(centre);
    camera.updateMatrixWorld();
    const seen = corners(box).map(p => p.applyMatrix4(camera.matrixWorldInverse.copy(camera.matrixWorld).invert()));
    const aspect = width / Math.max(height, 1), room = this.room(width, height);
    if (camera.isOrthographicCamera) {
      const across = Math.max(...seen.map(p => Math.abs(p.x))) / room.x;
      const up = Math.max(...seen.map(p => Math.abs(p.y))) / room.y;
      const half = Math.max(up, across / aspect) * 1.06 || 1;
      Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, zoom: 1 });
      Object.assign(camera, { near: -20 * size, far: 20 * size });
    } else {
      const tangent = Math.tan((camera.fov * Math.PI) / 360);
      const distance = Math.max(
        ...seen.map(
          p => p.z + size + Math.max(Math.abs(p.y) / room.y, Math.abs(p.x) / (room.x * aspect)) / tangent,
        ),
      );
      camera.position.copy(centre).addScaledVector(away, 1.06 * distance);
      Object.assign(camera, { aspect, near: 0.01 * size, far: 60 * size });
    }
    camera.setViewOffset(width, height, room.shift.x, room.shift.y, width, height);
    camera.updateProjectionMatrix();
    controls.update();
    this.changed();
  }

  /** Return which part of the window is free: panel and bar stand over the scene, in a narrow window both below. */
  room(width, height) {
    const panel = document.getElementById("panel"), bar = document.getElementById("bottom");
    const narrow = width <= 700;
    const right = !panel.hidden && !narrow ? panel.offsetWidth + 12 : 0;
    const foot = !panel.hidden && narrow ? height - panel.offsetTop : 0;
    const low = Math.max(foot, bar.offsetHeight ? bar.offsetHeight + 12 : 0);
    const top = document.getElementById("caption").offsetHeight;
    return {
      x: Math.max(0.3, 1 - right / width),
      y: Math.max(0.2, 1 - (low + top) / height),
      shift: { x: right / 2, y: (low - top) / 2 },
    };
  }

  /** Draw a floor under the box: a grid in round steps of metres, its ticks with numbers. */
  floor(height) {
    const { box } = this;
    const size = box.getSize(new THREE.Vector3());
    const extent = Math.max(size.x, size.y, 0.7 * size.z, 1e-6);
    const power = 10 ** Math.floor(Math.log10(extent / 4));
    const step = power * [1, 2, 5, 10].find(k => extent / (k * power) <= 8);
    const range = axis => [Math.floor(box.min[axis] / step) - 1, Math.ceil(box.max[axis] / step) + 1];
    const [x0, x1] = range("x"), [y0, y1] = range("y");
    const points = [];
    for (let i = x0; i <= x1; i++) points.push([i * step, y0 * step], [i * step, y1 * step]);
    for (let j = y0; j <= y1; j++) points.push([x0 * step, j * step], [x1 * step, j * step]);
    const geometry = new THREE.BufferGeometry().setFromPoints(points.map(p => new THREE.Vector3(...p, height)));
    const floor = new THREE.Group();
    floor.name = "floor";
    floor.add(new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0xb4bec8 })));
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const tick = (words, x, y) => {
      const text = label(words, 0.032 * extent, "#66727e");
      text.position.set(x, y, height);
      text.material.depthTest = true;
      floor.add(text);
    };
    const left = box.min.x - 0.07 * extent, front = box.min.y - 0.05 * extent;
    const ticks = axis => {
      const first = Math.ceil(box.min[axis] / step - 0.3); // none in the corner
      const last = Math.max(first, Math.floor(box.max[axis] / step + 0.3));
      return Array.from({ length: last - first + 1 }, (_, i) => first + i);
    };
    const along = ticks("x");
    for (const i of along) tick(`${(i * step).toFixed(digits)}${i === along.at(-1) ? " m" : ""}`, i * step, front);
    for (const j of ticks("y")) tick((j * step).toFixed(digits), left, j * step);
    if (this.ground) this.scene.remove(this.ground);
    this.ground = floor;
    this.scene.add(floor);
    box.expandByPoint(new THREE.Vector3(left - 0.05 * extent, front - 0.03 * extent, height));
  }

  /** Save what is seen as a PNG file. */
  picture(name) {
    const link = document.createElement("a");
    link.href = this.viewer.capture_image();
    link.download = `${name}.png`;
    link.click();
  }
}

function corners({ min, max }) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    k => new THREE.Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z),
  );
}
