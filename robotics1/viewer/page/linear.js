// Small matrices as arrays of rows, and placements as twelve numbers: the rows of (R | p).

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Return the placement A·B. */
function compose(A, B) {
  const C = new Array(12);
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 4; j++) {
      C[4 * i + j] =
        A[4 * i] * B[j] + A[4 * i + 1] * B[4 + j] + A[4 * i + 2] * B[8 + j] + (j === 3 ? A[4 * i + 3] : 0);
    }
  }
  return C;
}

/** Return the rotation matrix by an angle about a unit axis, as a placement (Rodrigues). */
function turn(axis, angle) {
  const [x, y, z] = axis, s = Math.sin(angle), c = Math.cos(angle), v = 1 - c;
  return [
    c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0,
    y * x * v + z * s, c + y * y * v, y * z * v - x * s, 0,
    z * x * v - y * s, z * y * v + x * s, c + z * z * v, 0,
  ];
}

/** Return the shift along a unit axis, as a placement. */
function shift(axis, length) {
  return [1, 0, 0, axis[0] * length, 0, 1, 0, axis[1] * length, 0, 0, 1, axis[2] * length];
}

const positionOf = T => [T[3], T[7], T[11]];
const rotate = (T, v) => [0, 1, 2].map(i => T[4 * i] * v[0] + T[4 * i + 1] * v[1] + T[4 * i + 2] * v[2]);
const rotateBack = (T, v) => [0, 1, 2].map(i => T[i] * v[0] + T[4 + i] * v[1] + T[8 + i] * v[2]);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const plus = (a, b) => a.map((x, i) => x + b[i]);
const times = (k, a) => a.map(x => k * x);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const norm = a => Math.hypot(...a);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const transposed = A => (A.length ? A[0].map((_, j) => A.map(row => row[j])) : []);
const applied = (A, x) => A.map(row => dot(row, x));

/** Return the rotation vector of A·Bᵀ: the turn, in world axes, that takes the orientation of B to that of A. */
function rotationBetween(A, B) {
  const R = [0, 1, 2].map(i => [0, 1, 2].map(j => dot(A.slice(4 * i, 4 * i + 3), B.slice(4 * j, 4 * j + 3))));
  const twice = [R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]];
  const sine = norm(twice) / 2, cosine = (R[0][0] + R[1][1] + R[2][2] - 1) / 2, angle = Math.atan2(sine, cosine);
  if (sine > 1e-9) return times(angle / (2 * sine), twice);
  if (cosine > 0) return times(0.5, twice);
  const k = [0, 1, 2].reduce((best, i) => (R[i][i] > R[best][best] ? i : best), 0); // half a turn
  const axis = [0, 1, 2].map(i => (R[i][k] + R[k][i]) / 2 + (i === k ? 1 : 0));
  return times(Math.PI / norm(axis), axis);
}

/**
 * Return the singular values of A (m × n), largest first, with U (columns, each m long) and V (columns, each n long):
 * one-sided Jacobi rotations, which find also small singular values exactly (Hestenes, 1958).
 *
 * There are min(m, n) values. V has n columns; those beyond them span the null space.
 */
function singularValues(A, n) {
  const m = A.length;
  const W = Array.from({ length: n }, (_, j) => A.map(row => row[j])); // columns of A·V
  const V = Array.from({ length: n }, (_, j) => Array.from({ length: n }, (__, i) => (i === j ? 1 : 0)));
  for (let sweep = 0; sweep < 60; sweep++) {
    let rotated = false;
    for (let p = 0; p < n - 1; p++) {
      for (let q = p + 1; q < n; q++) {
        const a = dot(W[p], W[p]), b = dot(W[q], W[q]), c = dot(W[p], W[q]);
        if (Math.abs(c) <= 1e-15 * Math.sqrt(a * b) || c === 0) continue;
        rotated = true;
        const zeta = (b - a) / (2 * c);
        const t = (zeta >= 0 ? 1 : -1) / (Math.abs(zeta) + Math.sqrt(1 + zeta * zeta));
        const cosine = 1 / Math.sqrt(1 + t * t), sine = cosine * t;
        for (const M of [W, V]) {
          const [x, y] = [M[p], M[q]];
          M[p] = x.map((v, i) => cosine * v - sine * y[i]);
          M[q] = x.map((v, i) => sine * v + cosine * y[i]);
        }
      }
    }
    if (!rotated) break;
  }
  const order = W.map((_, j) => j).sort((i, j) => norm(W[j]) - norm(W[i]));
  const count = Math.min(m, n);
  const values = order.slice(0, count).map(j => norm(W[j]));
  const U = values.map((s, k) => (s > 1e-14 * (values[0] || 1) ? times(1 / s, W[order[k]]) : null));
  return { values, U: completed(U, m), V: order.map(j => V[j]) };
}

/** Replace the missing directions (null) by unit vectors orthogonal to the others: Gram and Schmidt. */
function completed(directions, m) {
  const found = directions.slice();
  for (let k = 0; k < found.length; k++) {
    if (found[k]) continue;
    let best = null;
    for (let i = 0; i < m; i++) {
      let e = Array.from({ length: m }, (_, j) => (i === j ? 1 : 0));
      for (let round = 0; round < 2; round++) {
        for (const u of found) if (u) e = minus(e, times(dot(u, e), u));
      }
      if (!best || norm(e) > norm(best)) best = e;
    }
    found[k] = times(1 / norm(best), best);
  }
  return found;
}

/** Return the determinant of a square matrix: elimination with pivots. */
function determinant(A) {
  const M = A.map(row => row.slice());
  let value = 1;
  for (let k = 0; k < M.length; k++) {
    const pivot = M.reduce((best, row, i) => (i >= k && Math.abs(row[k]) > Math.abs(M[best][k]) ? i : best), k);
    if (M[pivot][k] === 0) return 0;
    if (pivot !== k) {
      [M[pivot], M[k]] = [M[k], M[pivot]];
      value = -value;
    }
    value *= M[k][k];
    for (let i = k + 1; i < M.length; i++) M[i] = minus(M[i], times(M[i][k] / M[k][k], M[k]));
  }
  return value;
}

/** Return x that solves (A Aᵀ + λ²·1) y = b, x = Aᵀ y: damped least squares (Nakamura and Hanafusa, 1986). */
function dampedStep(A, n, b, damping) {
  const { values, U, V } = singularValues(A, n);
  let x = new Array(n).fill(0);
  values.forEach((s, k) => {
    const factor = s / (s * s + damping * damping);
    if (s > 0) x = plus(x, times(factor * dot(U[k], b), V[k]));
  });
  return x;
}
