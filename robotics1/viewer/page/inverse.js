// Inverse kinematics of the page: damped least squares inside the limits, from where the arm is.

const REACHED = 1e-5; // of the error, without units
const STILL = 1e-9; // a step that moves no more

/** Return the task's error, without units, between a wanted placement and that of the task's frame. */
function taskError(arm, placed, wanted) {
  const T = arm.frame(arm.task.frame, placed);
  const V = [...minus(positionOf(wanted), positionOf(T)), ...rotationBetween(wanted, T)];
  return arm.taskRows(V, placed).map((e, i) => e * arm.task.scale[i]);
}

/** Return { q, error, held }: where the descent ends, and the joints that stand at a limit and would go beyond. */
function descend(arm, start, wanted, steps) {
  let q = arm.clamped(start), held = new Set(), damping = 0.02;
  let placed = arm.forward(q), error = taskError(arm, placed, wanted);
  for (let step = 0; step < steps && norm(error) > 1e-10; step++) {
    const J = arm.unitless(arm.taskJacobian(placed)).map(row => row.map((v, j) => (held.has(j) ? 0 : v)));
    const move = dampedStep(J, arm.size, error, damping);
    const longest = Math.max(...move.map(Math.abs), 1e-300);
    const wish = q.map((v, j) => v + Math.min(1, 0.3 / longest) * move[j] * arm.scale[j]);
    const next = arm.clamped(wish);
    const beyond = wish.map((v, j) => (v !== next[j] ? j : -1)).filter(j => j >= 0 && !held.has(j));
    if (beyond.length && beyond.every(j => next[j] === q[j])) {
      beyond.forEach(j => held.add(j));
      continue;
    }
    const there = arm.forward(next), left = taskError(arm, there, wanted);
    if (norm(left) < norm(error)) {
      if (norm(minus(next, q)) < STILL) break;
      [q, placed, error] = [next, there, left];
      damping = Math.max(1e-4, damping / 3);
      held = new Set();
    } else {
      damping *= 4;
      if (damping > 1e3) break;
    }
  }
  return { q, error, held };
}

/**
 * Move the arm towards a wanted placement. Return { q, verdict }: the verdict is a sentence.
 *
 * Where the descent stands still before the target, it tries again from a little aside: a singular arm cannot leave
 * in the lost direction by itself.
 */
function follow(arm, start, wanted) {
  let best = descend(arm, start, wanted, 40);
  for (let attempt = 1; attempt <= 2 && norm(best.error) > REACHED; attempt++) {
    const aside = start.map((v, j) => v + 0.05 * attempt * (j % 2 ? -1 : 1) * arm.scale[j]);
    const other = descend(arm, aside, wanted, 60);
    if (norm(other.error) < 0.9 * norm(best.error)) best = other;
  }
  return { q: best.q, verdict: verdict(arm, best, wanted) };
}

function verdict(arm, { q, error, held }, wanted) {
  if (norm(error) <= REACHED) return { kind: "reached", text: "reached" };
  const placed = arm.forward(q);
  const left = norm(minus(positionOf(wanted), positionOf(arm.frame(arm.task.frame, placed))));
  const away = left > 1e-4 * arm.reach;
  if (held.size) {
    const names = [...held].map(j => arm.coordinates[j].name).join(", ");
    return { kind: "limit", text: `at a limit of ${names}${away ? `, ${short(left)} m away` : ""}` };
  }
  const { start, length } = arm.chain;
  if (length !== null && norm(minus(positionOf(wanted), start)) > length) {
    return { kind: "far", text: `out of reach by ${short(left)} m` };
  }
  if (!away) return { kind: "singular", text: "this orientation cannot be realised here" };
  const { least } = arm.measure(q);
  if (least > 0.02 * arm.task.usual) return { kind: "moving", text: `on the way, ${short(left)} m to go` };
  return { kind: "singular", text: `singular: this direction cannot be realised, ${short(left)} m away` };
}

/** Return a number with three digits that matter. */
function short(value) {
  const size = Math.abs(value);
  if (size < 5e-13) return "0";
  return size < 1e-3 || size >= 1e5 ? value.toExponential(2) : String(Number(value.toPrecision(3)));
}
