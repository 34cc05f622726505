"""Nonlinear least squares by levels: the least |e₁(q)|, of all such q the least |e₂(q)|, and so on."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array
from robotics1.redundancy.coordinates_within_limits import BoundedJoints

Part = Callable[[Array], tuple[Array, Array]]  # q → e (m,) and J (m, n), with de = −J dq

RANK = 1e-7  # of the largest singular value of what is held: less is free
STATIONARY = 1e-7  # of |J| |e|: a gradient that is zero
HELD = 1e-12  # of the size of what is held: what is still on it
DIFFERENCE = 1e-5  # [rad, or reaches]
LONGEST = 0.5  # of a step [rad, or reaches]
SLOW = 0.3  # a step that leaves more of |e| is one of Gauss and Newton no longer
SMALLEST_STEP = 1e-13
LEAST_DAMPING = 1e-9  # of the largest curvature
FLAT = 1e-5  # of |J|², or of the largest curvature: one that is none, but for its differences


@dataclass(frozen=True, eq=False)
class LevelEnd:
    """Where one level ended.

    Attributes:
        q: (n,).
        realised: whether |e| ≤ tolerance.
        stationary: whether no motion that the levels before allow makes |e| smaller.
        steps: how many were taken.
        freedom: k, of how many directions the level had the choice.
    """

    q: Array
    realised: bool
    stationary: bool
    steps: int
    freedom: int


def descend_by_levels(
    parts: Sequence[Part], q: Array, joints: BoundedJoints, *, tolerance: float, most_steps: int
) -> list[LevelEnd]:
    """Return where each level ends; each starts where the one before it ended.

    Of a level that is realised e = 0 is held; of one that is not, the gradient along what the levels before it leave.
    With C the derivative of all that is held and N a basis of its null space, a step is q + N z, with z of Gauss and
    Newton on J N z = e, or of Newton where these are slow, damped as by Levenberg and Marquardt; then Newton's method
    on what is held brings q back. A step counts if |e| falls. Where the slope is zero and |e| the largest along some
    axis, the step is along it.

    Args:
        parts: of each level q → (e, J).
        q: (n,) the start.
        joints: the coordinates in which the steps are taken.
        tolerance: the |e| that is zero.
        most_steps: of each level.

    Source: Escande, Mansard, Wieber, Hierarchical quadratic programming: fast online humanoid-robot motion generation,
    Int. J. Robotics Research 33, 2014 (levels); Nocedal, Wright, Numerical Optimization, 2006, chapter 10;
    Dauphin and others, Identifying and attacking the saddle point problem, NeurIPS 2014 (|curvature|).
    """
    inside = [_within_limits(part, joints) for part in parts]
    held: list[Callable[[Array], tuple[Array, Array]]] = []
    ends: list[LevelEnd] = []
    x = joints.x(q)
    for part in inside:
        end = _descended(part, held, x, tolerance, most_steps)
        held.append(part if end.realised else _gradient_of(part, tuple(held)))
        polished = None if end.realised else _brought_back(held, end.q)
        x = end.q if polished is None else polished
        ends.append(LevelEnd(joints.q(x), end.realised, end.stationary, end.steps, end.freedom))
    return ends


def _within_limits(part: Part, joints: BoundedJoints) -> Part:
    def of(x: Array) -> tuple[Array, Array]:
        e, J = part(joints.q(x))
        return e, J * joints.slope(x)

    return of


def _gradient_of(part: Part, held: Sequence[Part]) -> Part:
    """Return the gradient g = N NᵀJᵀe along what is held as held too, with its derivative by central differences."""

    def gradient(x: Array) -> Array:
        (e, J), N = part(x), _null(held, x)
        return np.asarray(N @ (N.T @ (J.T @ e)))

    def of(x: Array) -> tuple[Array, Array]:
        N, steps = _null(held, x), DIFFERENCE * np.eye(len(x))
        slopes = np.array([gradient(x - d) - gradient(x + d) for d in steps]).reshape(steps.shape)
        H = N.T @ slopes.T / (2 * DIFFERENCE)
        along = H @ N
        values, axes = np.linalg.eigh(0.5 * (along + along.T))
        kept = np.abs(values) > FLAT * np.abs(values).max(initial=0.0)  # others are differences of rounding
        curved = axes[:, kept] * values[kept] @ axes[:, kept].T
        return gradient(x), np.asarray(N @ (curved @ N.T + H - along @ N.T))

    return of


def _descended(part: Part, held: Sequence[Part], x: Array, tolerance: float, most_steps: int) -> LevelEnd:
    damping, newton, steps, largest = 0.0, False, 0, 1e-300
    while True:
        (e, J), N = part(x), _null(held, x)
        size, g, largest = float(np.linalg.norm(e)), N.T @ (J.T @ e), max(largest, float(np.linalg.norm(J)))
        stationary = float(np.linalg.norm(g)) <= STATIONARY * largest * size
        if size <= tolerance or steps >= most_steps:
            return LevelEnd(x, size <= tolerance, size <= tolerance or stationary, steps, N.shape[1])
        B = _curvature(part, held, x, N) if newton or stationary else N.T @ J.T @ J @ N
        values, vectors = np.linalg.eigh(B)
        if stationary:
            moved = _over_the_top(part, held, x, N @ vectors[:, :1], values[:1] / largest**2)
            if moved is None:
                return LevelEnd(x, realised=False, stationary=True, steps=steps, freedom=N.shape[1])
        else:
            moved, damping = _step(part, held, x, (N @ vectors, values, vectors.T @ g), damping)
            if moved is None:
                return LevelEnd(x, realised=False, stationary=False, steps=steps, freedom=N.shape[1])
        x, steps = moved, steps + 1
        newton = float(np.linalg.norm(part(x)[0])) > SLOW * size


def _step(
    part: Part, held: Sequence[Part], x: Array, model: tuple[Array, Array, Array], damping: float
) -> tuple[Array | None, float]:
    """Return a q with a smaller |e| and the next damping; None where steps of rounding do not make it smaller.

    `model` has the axes of the curvature, its values, and the slope along them.
    """
    axes, values, slope = model
    size, top = float(np.linalg.norm(part(x)[0])), float(np.abs(values).max())
    damping = max(damping, LEAST_DAMPING * top)
    while True:
        z = slope / (np.abs(values) + damping)  # down along an axis of negative curvature too
        z *= min(1.0, LONGEST / max(float(np.linalg.norm(z)), 1e-300))
        if np.linalg.norm(z) <= SMALLEST_STEP:
            return None, damping
        moved = _brought_back(held, x + axes @ z)
        if moved is not None and np.linalg.norm(part(moved)[0]) < size:
            return moved, 0.2 * damping
        damping = max(4 * damping, 1e-3 * top)


def _over_the_top(part: Part, held: Sequence[Part], x: Array, axis: Array, curvature: Array) -> Array | None:
    """Return a q with a smaller |e| from one where it is the largest along an axis (n, 1); None if it is not."""
    if not len(curvature) or curvature[0] > -FLAT:
        return None
    size, length = float(np.linalg.norm(part(x)[0])), LONGEST
    while length > 10 * DIFFERENCE:
        for way in (length, -length):
            moved = _brought_back(held, x + way * axis[:, 0])
            if moved is not None and np.linalg.norm(part(moved)[0]) < size:
                return moved
        length *= 0.5
    return None


def _null(held: Sequence[Part], x: Array) -> Array:
    """Return a basis of the directions that keep what is held, (n, k)."""
    if not held or not len(x):
        return np.eye(len(x))
    _, sigma, Vt = np.linalg.svd(_stacked(held, x)[1])
    return np.asarray(Vt[int(np.count_nonzero(sigma > RANK * sigma[:1])) :].T)


def _stacked(held: Sequence[Part], x: Array) -> tuple[Array, Array]:
    """Return what is held and its derivative, each part in its own size."""
    values, rows = [], []
    for part in held:
        e, C = part(x)
        size = max(1e-300, float(np.linalg.norm(C)))
        values.append(e / size)
        rows.append(C / size)
    return np.concatenate(values), np.vstack(rows)


def _brought_back(held: Sequence[Part], x: Array) -> Array | None:
    """Return the q near x with what is held, by Newton's method; None where it does not get there."""
    if not held or not len(x):
        return x
    for _ in range(8):
        e, C = _stacked(held, x)
        if np.abs(e).max(initial=0.0) <= HELD:
            return x
        x = x + np.linalg.pinv(C, rcond=RANK) @ e
    e, _ = _stacked(held, x)
    return x if np.abs(e).max(initial=0.0) <= HELD else None


def _curvature(part: Part, held: Sequence[Part], x: Array, N: Array) -> Array:
    """Return the Hessian of ½|e|² on the set that is held, in N: the derivative of the projected gradient."""
    _, H = _gradient_of(part, held)(x)
    return np.asarray(N.T @ H @ N)
