"""How far a chain reaches at most: what proves a target out of reach."""

from dataclasses import dataclass

import numpy as np

from robotics1.ik.pose_problem import PoseProblem
from robotics1.inputs import Array


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
        arms: (k,) the sums of what follows each joint: how far its axis is from the frame's origin at most [m].
    """

    o: Array
    length: float
    hand: Array | None
    length_to_hand: float
    arms: Array

    def excess(self, goal: Array, counted: Array) -> float:
        """Return by how much a goal, (4, 4) [m], is farther than the chain reaches [m]; negative proves nothing.

        Of coordinates that do not count nothing is known, so just the others, counted (6,), enter |p_d − o|.
        """
        with np.errstate(over="ignore"):  # ∞ is far too
            return self._excess(goal, counted)

    def _excess(self, goal: Array, counted: Array) -> float:
        far = [np.linalg.norm((goal[:3, 3] - self.o) * counted[:3]) - self.length]
        if self.hand is not None and counted.all():
            far.append(np.linalg.norm(goal[:3, :3] @ self.hand + goal[:3, 3] - self.o) - self.length_to_hand)
        return float(max(far))


def reach_bound(problem: PoseProblem) -> ReachBound:
    """Return the bound of a chain, with the points on the axes that make it least."""
    from scipy.optimize import minimize

    chain, coordinates = problem.chain, problem.coordinates[problem.active[problem.chain.coordinate]]
    P, turning = chain.placements, chain.prismatic == 0
    travel = chain.ratio * np.abs(coordinates[:, :2]).max(axis=1) / coordinates[:, 3]

    def pieces(shifts: Array) -> Array:
        """From the point shifted along each axis z to the next one, (k, 3); the last one leads to the frame."""
        shifts = np.append(shifts * turning, 0.0)
        return np.asarray(P[1:, :, 3] + shifts[1:, None] * P[1:, :, 2] - shifts[:-1, None] * np.array([0.0, 0.0, 1.0]))

    shifts = minimize(lambda t: np.linalg.norm(pieces(t), axis=1).sum(), np.zeros(len(turning))).x * turning
    lengths = np.linalg.norm(pieces(shifts), axis=1)
    arms = np.cumsum((lengths + np.append(np.where(turning, 0.0, travel)[1:], 0.0))[::-1])[::-1]
    R, p = P[-1, :, :3], P[-1, :, 3]
    length = float(lengths.sum() + travel[~turning].sum())
    return ReachBound(
        o=problem.unit * (P[0, :, 3] + shifts[0] * P[0, :, 2]),
        length=problem.unit * length,
        hand=problem.unit * (R.T @ (np.array([0.0, 0.0, shifts[-1]]) - p)) if turning[-1] else None,
        length_to_hand=problem.unit * float(length - lengths[-1]),
        arms=problem.unit * arms,
    )
