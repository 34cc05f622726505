// The cells that an arm reaches: coloured by a value, and cut open by a slider.

const RAMP = [
  [0.267, 0.005, 0.329], [0.283, 0.141, 0.458], [0.254, 0.265, 0.53], [0.207, 0.372, 0.553], [0.164, 0.471, 0.558],
  [0.128, 0.567, 0.551], [0.135, 0.659, 0.518], [0.267, 0.749, 0.441], [0.478, 0.821, 0.318], [0.741, 0.873, 0.15],
  [0.993, 0.906, 0.144],
]; // Matplotlib's viridis, at equal steps

/** Return red, green and blue at a share of the way along the ramp. */
function rampColor(share) {
  const along = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1), k = Math.min(Math.floor(along), RAMP.length - 2);
  return RAMP[k].map((value, i) => value + (along - k) * (RAMP[k + 1][i] - value));
}

class Voxels {
  constructor(app, { cut, size, points, measures }) {
    this.app = app;
    this.points = points;
    this.axis = cut;
    this.measures = measures;
    this.count = points.length / 3;
    const shape = new THREE.BoxGeometry(...size.map(width => 0.8 * width));
    const look = new THREE.MeshLambertMaterial({ color: 0xffffff, transparent: true, opacity: 0.8 });
    this.mesh = new THREE.InstancedMesh(shape, look, this.count);
    this.mesh.name = "reached cells";
    const at = new THREE.Matrix4();
    this.box = new THREE.Box3();
    for (let i = 0; i < this.count; i++) {
      const p = new THREE.Vector3(...points.slice(3 * i, 3 * i + 3));
      this.mesh.setMatrixAt(i, at.setPosition(p));
      this.box.expandByPoint(p);
    }
    this.mesh.frustumCulled = false; // which would ask for the sphere around one cell
    app.stage.scene.add(this.mesh);
    this.controls();
  }

  controls() {
    const get = id => document.getElementById(id), measure = get("measure"), slider = get("cut");
    get("reach").hidden = false;
    measure.replaceChildren(...this.measures.map(([name], i) => element("option", { value: i }, name)));
    measure.onchange = () => this.color(Number(measure.value));
    const colors = RAMP.map(color => `rgb(${color.map(value => Math.round(255 * value)).join(",")})`);
    get("ramp").style.background = `linear-gradient(to right, ${colors.join(",")})`;
    slider.min = this.coordinate(this.count - 1);
    slider.max = this.coordinate(0);
    slider.value = slider.min;
    slider.oninput = () => this.cut(Number(slider.value));
    this.color(0);
    this.cut(Number(slider.value));
  }

  coordinate(i) {
    return this.points[3 * i + this.axis];
  }

  /** Colour the cells by one of the measures, from zero to its largest value. */
  color(number) {
    const [, values] = this.measures[number], most = values.reduce((a, b) => Math.max(a, b), 0) || 1;
    values.forEach((value, i) => this.mesh.setColorAt(i, new THREE.Color(...rampColor(value / most))));
    this.mesh.instanceColor.needsUpdate = true;
    document.getElementById("most").textContent = String(most);
    this.app.stage.changed();
  }

  /** Draw the cells from a coordinate on: they are in descending order. */
  cut(from) {
    let count = 0;
    while (count < this.count && this.coordinate(count) >= from - 1e-9) count++;
    this.mesh.count = count;
    document.getElementById("from").textContent = `${"xyz"[this.axis]} ≥ ${from.toFixed(2)} m`;
    this.app.stage.changed();
  }
}
