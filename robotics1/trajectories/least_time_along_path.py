"""The fastest motion along a path under bounds on the joints, by toppra."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.curves.composition import PathTrajectory, stretched
from robotics1.curves.curve import Curve
from robotics1.curves.given import as_path
from robotics1.errors import InputError, MissingExtraError, NotConverged
from robotics1.inputs import Array, counting_number
from robotics1.results import Frozen
from robotics1.trajectories.limits import LimitUse, MotionLimits
from robotics1.trajectories.profiles import law_of_phases
from robotics1.trajectories.ramps import Phase

SAMPLES = 64  # in each phase, its ends included
CORNER = 1e-9  # of |p'|: a smaller jump of the tangent is rounding
BEFORE = 1e-6  # of the end: so far before a break p'' is still the one before it
UNITS = (1.0, 0.1, 0.01)  # of the expected duration: the units of time in which toppra is asked, one after the other
NEAR = 1e-9  # of the end: a point of the grid so near to a break is the break


@dataclass(frozen=True, eq=False)
class PathTiming(Frozen):
    """The fastest motion along a path, at rest at both ends.

    Attributes:
        trajectory: q(s(t)); s̈ is constant between the points of the grid.
        active: the bounds that it touches, of each joint and quantity one, where it is most used.
        correction: k, by which the grid's answer was stretched so that the bounds hold between its points too; 1 for
            an endless grid.
    """

    trajectory: PathTrajectory
    active: tuple[LimitUse, ...]
    correction: float

    @property
    def duration(self) -> float:
        """T [s]."""
        return self.trajectory.duration


def time_optimal(path: Curve, limits: MotionLimits, *, grid: int = 200) -> PathTiming:
    """Return the law s(t) of least duration for which |q̇| = |p' ṡ| ≤ V and |q̈| = |p'' ṡ² + p' s̈| ≤ A along the path.

    On a grid of s the bounds are linear in ṡ² and s̈, and the greatest ṡ² is found point by point, backwards and
    forwards (time-optimal path parameterisation by reachability). Between its points the bounds are passed a little,
    the less, the finer the grid; the law is stretched uniformly until they hold at 64 instants of each phase, which
    leaves an excess below 1e-4 between those.

    Args:
        path: in joint space, q(s) = p(s), with a continuous tangent.
        limits: the velocity and acceleration of the joints, both.
        grid: the number of phases of s(t), and two more at each break.

    Raises:
        MissingExtraError: toppra is not installed.
        InputError: a bound lacks, one is on the jerk or the deceleration, the path has a corner, or p' vanishes.
        NotConverged: toppra finds no law.

    Source: Pham, Pham, A New Approach to Time-Optimal Path Parameterization Based on Reachability Analysis, IEEE
    Trans. Robotics 34, 2018.
    """
    path = as_path("path", path)
    bounds = _bounds(path, limits)
    count = counting_number("grid", grid, least=10)
    s: Array = np.linspace(0.0, path.end, count + 1)
    _refuse_corners(path, s)
    s = _with_breaks(s, path)
    speed = _speeds(path, bounds, s)
    # between two points of the grid s̈ is constant: ṡ₁² − ṡ₀² = 2 s̈ (s₁ − s₀)
    mean = (speed[1:] + speed[:-1]) / 2
    dt = np.diff(s) / mean
    phases = tuple(Phase(*row) for row in zip(dt.tolist(), (np.diff(speed) / dt).tolist(), strict=True))
    law = law_of_phases(0.0, 0.0, phases)
    k = max(use.stretch for use in _uses(PathTrajectory(path, law), bounds))
    trajectory = PathTrajectory(path, stretched(law, k))
    active = tuple(use for use in _uses(trajectory, bounds) if use.active)
    return PathTiming(trajectory, active, k)


def _bounds(path: Curve, limits: Any) -> dict[str, Array]:
    """Return V and A of the joints."""
    if not isinstance(limits, MotionLimits):
        raise InputError(f"limits must be MotionLimits(velocity=..., acceleration=...); it is {limits!r}")
    if limits.jerk is not None or limits.deceleration is not None:
        raise InputError("along a path the velocity and the acceleration are bounded; leave out the other bounds")
    bounds = limits.of_joints(path.dimension)
    for name in ("velocity", "acceleration"):
        if not np.isfinite(getattr(bounds, name)).all():
            raise InputError(f"each joint needs a bound on the {name}")
    return {"velocity": bounds.velocity, "acceleration": bounds.acceleration}


def _refuse_corners(path: Curve, s: Array) -> None:
    path.refuse_standstill(s, path.speed(s))
    if len(path.breakpoints):
        after, before = path.derivative(path.breakpoints, 1), path.derivative(path.breakpoints, 1, side="left")
        corner = np.linalg.norm(after - before, axis=1) > CORNER * np.linalg.norm(after, axis=1)
        if corner.any():
            raise InputError(
                f"the tangent jumps at s = {path.breakpoints[corner][0]:.6g}, where the motion would have to stop: "
                "blend the corner, as polyline_path(points, blend=...) does, or time the parts one by one"
            )


def _with_breaks(s: Array, path: Curve) -> Array:
    """Return the points of the grid with the breaks of the path, and a point just before each of them."""
    breaks = path.breakpoints
    apart = np.abs(s[:, None] - breaks).min(axis=1, initial=np.inf) > NEAR * path.end
    return np.unique(np.concatenate([s[apart], breaks, breaks - BEFORE * path.end]))


def _time_scale(rates: Array, bends: Array, bounds: dict[str, Array]) -> float:
    """Return a time [s] of the order of the least duration, from p' (k, n) and p'' (k, n) with respect to s/end.

    Of each joint it is the way over V, the time from rest to rest over that way under A, and the mean of √(|p''|/A),
    which is 1/ṡ where the path bends most sharply for A.
    """
    way = np.abs(rates).mean(axis=0)
    V, A = bounds["velocity"], bounds["acceleration"]
    return float(np.max([way / V, 2 * np.sqrt(way / A), np.sqrt(np.abs(bends) / A).mean(axis=0)]))


def _speeds(path: Curve, bounds: dict[str, Array], s: Array) -> Array:
    """Return the greatest ṡ at the points of the grid, from rest to rest.

    The tolerances of toppra's solver are absolute. So it is given a problem in units of its own: s in [0, 1], a time
    in which the motion takes about 1, and each joint in the unit in which its bound A is 1. Where bounds differ by
    orders of magnitude it may find nothing; in a smaller unit of time it does, with a little less precision.
    """
    try:
        import toppra
        from toppra.algorithm import TOPPRA
        from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint
    except ImportError as error:
        raise MissingExtraError("toppra", "toppra") from error

    n, end = path.dimension, path.end
    V, A = bounds["velocity"], bounds["acceleration"]
    scale = _time_scale(end * path.derivative(s, 1), end**2 * path.derivative(s, 2), bounds)

    class Geometry(toppra.interpolator.AbstractGeometricPath):  # type: ignore[misc]
        """The path in toppra's words, and in those units."""

        path_interval = np.array([0.0, 1.0])
        dof = n

        def __init__(self, unit: float):
            self.unit = unit

        def __call__(self, places: Any, order: int = 0) -> Array:
            values = path.derivative(np.minimum(end * np.asarray(places), end), order)
            return np.asarray(values * end**order / (A * self.unit**2))

    for unit in scale * np.array(UNITS):
        constraints = [
            JointVelocityConstraint(np.outer(V / (A * unit), [-1, 1])),
            JointAccelerationConstraint(np.outer(np.ones(n), [-1, 1])),
        ]
        _, speed, _ = TOPPRA(constraints, Geometry(unit), gridpoints=s / end).compute_parameterization(0.0, 0.0)
        if speed is not None and np.isfinite(speed).all() and ((speed[1:] + speed[:-1]) > 0).all():
            return np.asarray(np.asarray(speed) * end / unit)
    raise NotConverged("toppra finds no law along this path; try a finer grid", speed)


def _uses(trajectory: PathTrajectory, bounds: dict[str, Array]) -> list[LimitUse]:
    """Return what the motion asks of each bound, at instants of each phase, from inside it at its ends."""
    law: Any = trajectory.law
    starts = np.cumsum([0.0, *(phase.duration for phase in law.phases)])
    shares = np.linspace(0.0, 1.0, SAMPLES)
    t = np.unique((starts[:-1, None] + np.diff(starts)[:, None] * shares).clip(0.0, trajectory.duration))
    found = []
    for quantity, bound in bounds.items():
        rate = getattr(trajectory, quantity)
        values = np.concatenate([rate(t), rate(t, side="left")])
        for j, i in enumerate(np.abs(values).argmax(axis=0)):
            found.append(LimitUse(j, quantity, float(values[i, j]), float(bound[j]), float(t[i % len(t)])))
    return found
