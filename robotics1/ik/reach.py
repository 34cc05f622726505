"""How far a chain reaches at most: what proves a target out of reach."""

from dataclasses import dataclass
from math import hypot

import numpy as np

from robotics1.ik.pose_problem import PoseProblem
from robotics1.inputs import Array

SWEEPS, SMOOTHING = 400, 50  # over the axes, until the shortest way over them is found


@dataclass(frozen=True, eq=False)
class ReachBound:
    """No configuration takes the frame's origin farther from a point o on the first joint axis than `length`.

    A path from o over one point on each joint axis to the frame turns or stretches as the joints move, but its pieces
    keep their lengths: |p − o| ≤ Σ |pieces| + Σ travel. Any points on the axes of turning joints will do; those that
    make the sum least bound best.

    Attributes:
        o: (3,) the point on the first axis [m], in the task's axes.
        length: Σ |pieces| + Σ max |travel| [m]; ∞ if a prismatic joint has no limits.
        hand: (3,) where the last of the points on axes is in the task's frame [m], if that joint turns: a target pose
            tells where it must be.
        length_to_hand: the sum without the last piece [m].
        least: no configuration takes the origin nearer to o: the longest piece without all the others [m].
        arms: (k,) the sums of what follows each joint: how far its axis is from the frame's origin at most [m].
    """

    o: Array
    length: float
    hand: Array | None
    length_to_hand: float
    least: float
    arms: Array

    def excess(self, goal: Array, counted: Array) -> float:
        """Return by how much a goal, (4, 4) [m], is farther or nearer than the chain reaches; negative proves nothing.

        Of coordinates that do not count nothing is known, so just the others, counted (6,), enter |p_d − o|.
        """
        with np.errstate(over="ignore"):  # ∞ is far too
            return self._excess(goal, counted)

    def _excess(self, goal: Array, counted: Array) -> float:
        away = np.linalg.norm((goal[:3, 3] - self.o) * counted[:3])
        far = [away - self.length, self.least - away if counted[:3].all() else -np.inf]
        if self.hand is not None and counted.all():
            far.append(np.linalg.norm(goal[:3, :3] @ self.hand + goal[:3, 3] - self.o) - self.length_to_hand)
        return float(max(far))


def reach_bound(problem: PoseProblem) -> ReachBound:
    """Return the bound of a chain, with the points on the axes that make it least."""
    chain, coordinates = problem.chain, problem.coordinates[problem.active[problem.chain.coordinate]]
    P, turning = chain.placements, chain.prismatic == 0
    travel = chain.ratio * np.abs(coordinates[:, :2]).max(axis=1) / coordinates[:, 3]

    def pieces(shifts: Array) -> Array:
        """From the point shifted along each axis z to the next one, (k, 3); the last one leads to the frame."""
        shifts = np.append(shifts * turning, 0.0)
        return np.asarray(P[1:, :, 3] + shifts[1:, None] * P[1:, :, 2] - shifts[:-1, None] * np.array([0.0, 0.0, 1.0]))

    shifts = _shortest(P, turning)
    lengths = np.linalg.norm(pieces(shifts), axis=1)
    arms = np.cumsum((lengths + np.append(np.where(turning, 0.0, travel)[1:], 0.0))[::-1])[::-1]
    R, p = P[-1, :, :3], P[-1, :, 3]
    length = float(lengths.sum() + travel[~turning].sum())
    return ReachBound(
        o=problem.unit * (P[0, :, 3] + shifts[0] * P[0, :, 2]),
        length=problem.unit * length,
        hand=problem.unit * (R.T @ (np.array([0.0, 0.0, shifts[-1]]) - p)) if turning[-1] else None,
        length_to_hand=problem.unit * float(length - lengths[-1]),
        least=problem.unit * float(2 * lengths.max() - length),
        arms=problem.unit * arms,
    )


def _shortest(P: Array, turning: Array) -> Array:
    """Return the shifts along the axes, (k,), that make Σ |pieces| least, one after the other, again and again.

    The point on an axis from which the way to a and to b is shortest divides their feet a_z and b_z as their distances
    d_a and d_b from the axis. These are rounded up at first, so that no point sticks to another.
    """
    R, p = P[:, :, :3].tolist(), P[:, :, 3].tolist()
    shifts = [0.0] * len(turning)
    for sweep in range(SWEEPS):
        smooth, change = 0.5**sweep, 0.0
        for i in np.flatnonzero(turning).tolist():
            ahead = shifts[i + 1] if i + 1 < len(shifts) else 0.0
            b = [p[i + 1][row] + ahead * R[i + 1][row][2] for row in range(3)]
            foot, d_b = b[2], hypot(b[0], b[1], smooth)
            if i > 0:
                back = [-p[i][row] + (shifts[i - 1] if row == 2 else 0.0) for row in range(3)]
                a = [sum(R[i][row][column] * back[row] for row in range(3)) for column in range(3)]
                d_a = hypot(a[0], a[1], smooth)
                foot = (a[2] * d_b + b[2] * d_a) / (d_a + d_b) if d_a + d_b > 0 else 0.5 * (a[2] + b[2])
            change, shifts[i] = max(change, abs(foot - shifts[i])), foot
        if sweep > SMOOTHING and change < 1e-12:
            break
    return np.array(shifts)
