"""Curves of solutions, followed step by step: along the tangent, then back to the solutions by Newton's method.

Source: Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, section 6; Burdick, On the inverse
kinematics of redundant manipulators: characterization of the self-motion manifolds, ICRA 1989.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.ik.descent import REACHED
from robotics1.ik.scaled_task import ScaledTask
from robotics1.inputs import Array

STEP = 0.08  # along a curve, in units
SMALLEST = 1e-4  # step at which a curve ends for another reason than a limit
MOST_STEPS = 4000
TURNED = 0.9  # cosine between the tangents before and after a step
CORRECTIONS = 8
EXACT = 1e-12  # |e| without units, at which the corrections end
RANK = 1e-9


@dataclass(frozen=True, eq=False)
class TracedCurve:
    """Configurations along a curve, in order.

    Attributes:
        q: (k, nq) [rad or m]; joints that make whole turns run on without a jump.
        closed: whether the last is followed by the first.
        ends: why it ends at its first and at its last configuration: the joint that is at a limit, or "a singularity".
    """

    q: Array
    closed: bool
    ends: tuple[str, str]


@dataclass(frozen=True, eq=False)
class CurveTracer:
    """Follows the solutions of f(q) = target where one joint more moves the task than it has rows."""

    problem: ScaledTask
    target: Any

    def corrected(self, q: Array, across: Array | None = None) -> Array | None:
        """Return the solution next to q (nq,), in the plane across a direction if one is given; None if none."""
        moving, unit = self.problem.moving, self.problem.box.unit
        for _ in range(CORRECTIONS):
            e = self.problem.error(q, self.target)
            if np.abs(e).max(initial=0.0) < EXACT:
                break
            J = self.problem.jacobian(q)[:, moving]
            if across is not None:
                J, e = np.vstack([J, across[moving]]), np.append(e, 0.0)
            step = np.linalg.lstsq(J, e, rcond=RANK)[0]
            if np.abs(step).max() > 0.5:
                return None
            q = q.copy()
            q[moving] += unit[moving] * step
        return q if self.is_solution(q) else None

    def is_solution(self, q: Array) -> bool:
        """Whether f(q) is the target."""
        return self.problem.relative_error(q, self.target) <= REACHED

    def tangent(self, q: Array) -> Array:
        """Return the direction (nq,) in which the task stands still, of length 1 in units."""
        direction = np.zeros(len(q))
        direction[self.problem.moving] = np.linalg.svd(self.problem.jacobian(q)[:, self.problem.moving])[2][-1]
        return direction

    def curve(self, q: Array) -> TracedCurve:
        """Return the whole curve through a solution q (nq,)."""
        tangent = self.tangent(q)
        ahead, closed, end = self._followed(q, tangent)
        if closed:
            return TracedCurve(np.array(ahead), True, ("", ""))
        back, _, start = self._followed(q, -tangent)
        return TracedCurve(np.array([*reversed(back[1:]), *ahead]), False, (start, end))

    def _followed(self, q: Array, tangent: Array) -> tuple[list[Array], bool, str]:
        """Return the solutions from q to one side, whether they come back to it, and why they end."""
        unit = self.problem.box.unit
        found, first, h = [q], tangent, STEP
        while len(found) < MOST_STEPS:
            p = self.corrected(found[-1] + h * unit * tangent, across=tangent)
            after = None if p is None else self.tangent(p)
            if after is not None and after @ tangent < 0:
                after = -after
            far = p is not None and np.linalg.norm((p - found[-1]) / unit) > 1.5 * h
            if p is None or after is None or after @ tangent < TURNED or far:
                h *= 0.5
                if h < SMALLEST:
                    return found, False, "a singularity"
                continue
            j = self._first_limit(found[-1], p)
            if j is not None:
                at = self._at_limit(found[-1], p, j)
                return [*found, at] if at is not None else found, False, self.problem.robot.joint_names[j]
            if len(found) > 2 and self._passes(found[-1], p, q, first, after):
                return found, True, ""
            found.append(p)
            tangent, h = after, min(STEP, 1.5 * h)
        return found, False, "the most steps"

    def _passes(self, a: Array, b: Array, q: Array, tangent: Array, after: Array) -> bool:
        """Whether the step from a to b passes q in the direction in which the curve began there."""
        box = self.problem.box
        from_a, from_b = box.difference(a, q), box.difference(b, q)
        near = min(np.linalg.norm(from_a), np.linalg.norm(from_b)) < 1.5 * STEP
        return bool(near and from_a @ tangent <= 0 <= from_b @ tangent and after @ tangent > 0)

    def _first_limit(self, a: Array, b: Array) -> int | None:
        """Return the joint that leaves its limits first on the step from a to b; None if none does."""
        box = self.problem.box
        outside = ~box.circular & ((b > box.upper + 1e-12) | (b < box.lower - 1e-12))
        if not outside.any():
            return None
        limit = np.where(b > box.upper, box.upper, box.lower)
        share = np.where(outside, (limit - a) / np.where(b == a, 1.0, b - a), np.inf)
        return int(np.argmin(share))

    def _at_limit(self, a: Array, b: Array, j: int) -> Array | None:
        """Return the solution between a and b with joint j at its limit."""
        box = self.problem.box
        limit = box.upper[j] if b[j] > box.upper[j] else box.lower[j]
        q = a + np.clip((limit - a[j]) / (b[j] - a[j]), 0.0, 1.0) * (b - a)
        q[j] = limit
        at = self.corrected(q, across=np.eye(len(q))[j])
        if at is None:
            return None
        at[j] = limit
        return at if box.contains(at) else None
