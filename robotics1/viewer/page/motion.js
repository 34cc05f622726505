// Motions of the joints and of a target, and the bar that plays them.

/** Return the doubles of a base64 text. */
function doubles(text) {
  return new Float64Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
}

/** A curve through samples: cubic Hermite where the velocities are known, straight lines between recorded values. */
class Samples {
  constructor({ width, times, values, velocities }) {
    this.width = width;
    this.times = doubles(times);
    this.values = doubles(values);
    this.velocities = velocities ? doubles(velocities) : null;
    this.duration = this.times[this.times.length - 1];
  }

  get count() {
    return this.times.length;
  }

  /** Return the k-th sample. */
  sample(k) {
    return Array.from(this.values.subarray(k * this.width, (k + 1) * this.width));
  }

  /** Return the number of the last sample at or before t. */
  before(t) {
    let low = 0, high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  at(t) {
    const k = Math.min(this.before(t), this.count - 2), h = this.times[k + 1] - this.times[k];
    const a = this.sample(k), b = this.sample(k + 1);
    const s = h > 0 ? Math.min(1, Math.max(0, (t - this.times[k]) / h)) : 0;
    if (!this.velocities) return a.map((x, i) => x + s * (b[i] - x));
    const u = this.velocity(k), v = this.velocity(k + 1), r = 1 - s;
    return a.map(
      (x, i) => r * r * (1 + 2 * s) * x + s * s * (3 - 2 * s) * b[i] + h * s * r * (r * u[i] - s * v[i]),
    );
  }

  /** Return the velocity at the k-th sample; of recorded values the slope to the next one. */
  velocity(k) {
    if (this.velocities) return Array.from(this.velocities.subarray(k * this.width, (k + 1) * this.width));
    const i = Math.min(k, this.count - 2), h = this.times[i + 1] - this.times[i];
    return minus(this.sample(i + 1), this.sample(i)).map(d => (h > 0 ? d / h : 0));
  }
}

/** A line that grows with the time: thin rods between points; so many of them are shown. */
class Trail {
  constructor(instants, points, radius, color) {
    this.ends = [];
    const steps = [];
    for (let k = 1; k < points.length; k++) {
      if (norm(minus(points[k], points[k - 1])) > 1e-9) {
        steps.push([points[k - 1], points[k]]);
        this.ends.push(instants[k]);
      }
    }
    const thin = new THREE.CylinderGeometry(radius, radius, 1, 8);
    this.mesh = new THREE.InstancedMesh(thin, paint(color), Math.max(1, steps.length));
    this.mesh.frustumCulled = false;
    const up = new THREE.Vector3(0, 1, 0), one = new THREE.Matrix4();
    steps.forEach(([a, b], k) => {
      const along = new THREE.Vector3(...minus(b, a)), length = along.length();
      const turned = new THREE.Quaternion().setFromUnitVectors(up, along.divideScalar(length));
      const middle = new THREE.Vector3(...times(0.5, plus(a, b)));
      this.mesh.setMatrixAt(k, one.compose(middle, turned, new THREE.Vector3(1, length, 1)));
    });
    this.mesh.name = "trail";
  }

  show(t) {
    this.mesh.count = this.ends.filter(end => end <= t + 1e-12).length;
  }
}

/** A moving point: a ball on a dotted path. */
class Target {
  constructor(samples, radius) {
    this.samples = samples;
    this.group = new THREE.Group();
    this.ball = new THREE.Mesh(new THREE.SphereGeometry(5 * radius, 24, 16), paint(0x2a8f3c));
    this.ball.name = "moving target";
    const count = Math.min(300, samples.count);
    const dots = new THREE.InstancedMesh(new THREE.SphereGeometry(radius, 8, 6), paint(0x2a8f3c), count);
    this.points = Array.from({ length: count }, (_, k) => samples.at((samples.duration * k) / Math.max(1, count - 1)));
    this.points.forEach((p, k) => dots.setMatrixAt(k, new THREE.Matrix4().makeTranslation(...p)));
    dots.frustumCulled = false;
    this.group.add(this.ball, dots);
  }

  show(t) {
    this.ball.position.set(...this.samples.at(t));
  }
}

/** The bar: play, pause, step, scrub, speed, loop, clock, and the keys. */
class Bar {
  /** onTime is called with each new time, turned when the play begins or ends. */
  constructor(duration, onTime, turned) {
    this.duration = duration;
    Object.assign(this, { onTime, turned });
    this.time = 0;
    this.playing = false;
    this.held = 0; // seconds at the end of a loop
    const get = id => document.getElementById(id);
    [this.button, this.slider, this.clock, this.speed, this.loop] = ["play", "time", "clock", "speed", "loop"].map(get);
    this.slider.max = duration;
    this.button.onclick = () => this.play(!this.playing);
    this.slider.oninput = () => this.scrub(Number(this.slider.value));
    get("back").onclick = () => this.scrub(this.time - this.stride);
    get("forth").onclick = () => this.scrub(this.time + this.stride);
    this.loop.onclick = () => this.loop.setAttribute("aria-pressed", this.looping ? "false" : "true");
    window.addEventListener("keydown", event => this.key(event));
    get("bar").hidden = false;
    this.seek(0);
  }

  get looping() {
    return this.loop.getAttribute("aria-pressed") === "true";
  }

  get stride() {
    return this.duration / 100;
  }

  seek(time) {
    this.time = Math.min(this.duration, Math.max(0, time));
    this.slider.value = this.time;
    this.clock.textContent = `${this.time.toFixed(2)} / ${this.duration.toFixed(2)} s`;
    this.onTime(this.time);
  }

  scrub(time) {
    this.play(false);
    this.seek(time);
  }

  play(yes) {
    if (yes && this.time >= this.duration) this.seek(0);
    this.playing = yes;
    this.turned(); // on or off
    this.button.textContent = yes ? "❚❚" : "▶";
    this.button.setAttribute("aria-label", yes ? "Pause" : "Play");
    this.last = null;
    if (yes) requestAnimationFrame(now => this.tick(now));
  }

  tick(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    const time = this.time + passed * Number(this.speed.value);
    if (time < this.duration) this.seek(time);
    else if (!this.looping) return this.scrub(this.duration);
    else {
      this.seek(this.duration);
      this.held += passed; // the end is held before the motion starts again
      if (this.held > 0.7) this.seek(0);
    }
    if (time < this.duration) this.held = 0;
    requestAnimationFrame(next => this.tick(next));
  }

  key(event) {
    const own = event.key === " " ? "input:not(#time), select, button" : "input:not(#time), select"; // their own keys
    const typing = event.target instanceof HTMLElement && event.target.matches(own);
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = {
      " ": () => this.play(!this.playing),
      ArrowLeft: () => this.scrub(this.time - this.stride),
      ArrowRight: () => this.scrub(this.time + this.stride),
      Home: () => this.scrub(0),
      End: () => this.scrub(this.duration),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
