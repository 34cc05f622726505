"""What bounds on the joints allow at one configuration: the polytopes of velocities and of forces."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, positive_bound, real_array
from robotics1.least_squares import RANK_TOLERANCE
from robotics1.notation import vector
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.singularities.rounding import (
    AtPrintedConfiguration,
    RoundedConfiguration,
    singularity_within_rounding,
)
from robotics1.singularities.spaces import Subspaces
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task

MOST = 12  # joints, whose 4096 corners are tried
SAME = 1e-9  # relative: vertices, and directions of columns, that are one


@dataclass(frozen=True, eq=False)
class JointBoundPolytope(AtPrintedConfiguration):
    """A polytope about the origin of the task's space, the image or the pre-image of a box of the joints.

    Attributes:
        vertices: (k, m) its corners; in a plane in order, counterclockwise.
        joints: (k, n) the joint velocities, or torques, at each corner.
        unbounded: (m, l) orthonormal directions in which it has no end: of forces, N(Jᵀ). The vertices are then those
            of its part normal to them.
        limits: (n,) the bounds of the joints.
        spaces: the subspaces of J.
        rounded: the configuration with the digits it is given by.
        at_singularity: the polytope at the singular configuration that these digits may stand for; else None.
    """

    vertices: Array
    joints: Array
    unbounded: Array
    limits: Array
    spaces: Subspaces
    rounded: RoundedConfiguration
    at_singularity: JointBoundPolytope | None = None

    @property
    def dimension(self) -> int:
        """r: 1 of a segment, 2 of a polygon, 3 of a polyhedron; without the unbounded directions."""
        return self.spaces.rank

    @property
    def largest(self) -> float:
        """The largest norm in the polytope, at one of its vertices; ∞ where it has no end."""
        return np.inf if self.unbounded.size else float(np.linalg.norm(self.vertices, axis=1).max(initial=0.0))

    @property
    def largest_at(self) -> Array:
        """(j, m) the vertices with the largest norm, in opposite pairs."""
        return self.vertices[self._longest()]

    @property
    def joints_at_largest(self) -> Array:
        """(j, n) the joint velocities or torques there."""
        return self.joints[self._longest()]

    @property
    def measure(self) -> float:
        """Length, area or volume, in the polytope's own dimension; ∞ where it has no end."""
        if self.unbounded.size:
            return np.inf
        x = self.vertices @ self.spaces.range
        if self.dimension == 0:
            return 0.0
        if self.dimension == 1:
            return float(np.ptp(x))
        from scipy.spatial import ConvexHull

        return float(ConvexHull(x / np.abs(x).max()).volume * np.abs(x).max() ** self.dimension)

    def radius(self, u: npt.ArrayLike) -> float:
        """Return the largest λ with λ u/|u| in the polytope; 0 where u leaves a flat one, ∞ where it has no end.

        Raises:
            InputError: u (m,) has no direction.
        """
        u = real_array("u", u, (len(self.spaces.J),), "one number for each row of the task")
        length = float(np.linalg.norm(u))
        if length == 0:
            raise InputError("u must have a direction; it is the zero vector")
        y, off = self.spaces.range.T @ u / length, self.spaces.left_null.T @ u / length
        if np.linalg.norm(off) > RANK_TOLERANCE and not self.unbounded.size:
            return 0.0
        if np.linalg.norm(y) <= RANK_TOLERANCE:
            return np.inf
        normals, distances = _facets(self.vertices @ self.spaces.range)
        outwards = normals @ y
        return float((distances[outwards > 0] / outwards[outwards > 0]).min())

    def explain(self) -> str:
        """Return what it is, and its largest norm, in a sentence."""
        kind = {0: "the origin", 1: "a segment", 2: "a polygon"}.get(self.dimension, "a polytope")
        parts = [f"{kind} with {len(self.vertices)} vertices, in {self.spaces.J.shape[0]} dimensions"]
        if self.unbounded.size:
            parts.append(f"without an end along {', '.join(vector(u) for u in self.unbounded.T)}")
        else:
            parts.append(f"largest norm {self.largest:.6g} at {vector(self.largest_at[0])}")
            parts.append(f"where the joints have {vector(self.joints_at_largest[0])}")
        if self.rounded.singular_q is not None:
            parts.append(f"{self.rounded.explain()}; at_singularity has the answer there")
        return "; ".join(parts)

    def _longest(self) -> npt.NDArray[np.bool_]:
        norms = np.linalg.norm(self.vertices, axis=1)
        return np.asarray(norms >= (1 - SAME) * norms.max(initial=0.0))


def velocity_polytope(
    robot: Robot, task: Task, q: npt.ArrayLike, *, velocity: npt.ArrayLike | None = None
) -> JointBoundPolytope:
    """Return the task velocities that joints within their bounds produce: {J q̇ : |q̇ᵢ| ≤ Vᵢ}, with its vertices.

    Each vertex is the image of a corner of the box, so that the largest speed is at one. Where J is singular, the
    polytope is flat: a segment of a planar arm. At digits that round a singular q, `at_singularity` is the one there.

    Args:
        robot: of at most 12 joints.
        task: m rows; the norm has a meaning if they have one unit.
        q: (nq,) configuration [rad or m].
        velocity: V > 0 [rad/s or m/s], (n,) or one number for all; by default the robot's limits.

    Raises:
        InputError: a joint has no bound, or there are more than 12.
        TaskError: the task does not fit the robot.

    Source: Lee, A study on the manipulability measures for robot manipulators, IROS, 1997; McMullen, On zonotopes,
    Trans. Amer. Math. Soc. 159, 1971.
    """

    def polytope(spaces: Subspaces, there: JointBoundPolytope | None = None) -> JointBoundPolytope:
        vertices, rates = _images_of_corners(spaces, V)
        return JointBoundPolytope(vertices, rates, np.zeros((len(spaces.J), 0)), V, spaces, rounded, there)

    rounded, V = _situation(robot, task, q, "velocity", velocity)
    there = rounded.at_singularity
    return polytope(rounded.spaces, None if there is None else polytope(there))


def force_polytope(
    robot: Robot, task: Task, q: npt.ArrayLike, *, torque: npt.ArrayLike | None = None
) -> JointBoundPolytope:
    """Return the forces that motors within their bounds exert or hold: {f : |(Jᵀ f)ᵢ| ≤ Tᵢ}, with its vertices.

    Where J loses rank, forces of N(Jᵀ) need no torque: they are `unbounded`, and the vertices are those of the part
    normal to them.

    Args:
        robot: of at most 12 joints.
        task: m rows; the norm has a meaning if they have one unit.
        q: (nq,) configuration [rad or m].
        torque: T > 0 [N m or N], (n,) or one number for all; by default the robot's effort limits.

    Raises:
        InputError: a joint has no bound, or there are more than 12.
        TaskError: the task does not fit the robot.

    Source: Chiacchio, Bouffard-Vercelli, Pierrot, Force polytope and force ellipsoid for redundant manipulators,
    J. Robotic Systems 14, 1997.
    """

    def polytope(spaces: Subspaces, there: JointBoundPolytope | None = None) -> JointBoundPolytope:
        vertices = _of_half_spaces(spaces, limits)
        return JointBoundPolytope(vertices, vertices @ spaces.J, spaces.left_null, limits, spaces, rounded, there)

    rounded, limits = _situation(robot, task, q, "torque", torque)
    there = rounded.at_singularity
    return polytope(rounded.spaces, None if there is None else polytope(there))


def _situation(
    robot: RobotLike, task: TaskLike, q: ConfigurationLike, name: str, given: npt.ArrayLike | None
) -> tuple[RoundedConfiguration, Array]:
    robot, task = robot_and_task(robot, task)
    n = robot.nv
    if n > MOST:
        raise InputError(f"the corners of {n} joints' bounds are too many; polytopes are for at most {MOST} joints")
    own = robot.max_velocity if name == "velocity" else robot.max_effort
    bounds = np.array(own) if given is None else positive_bound(name, given, n)
    for joint, bound in zip(robot.joint_names, bounds, strict=True):
        if not np.isfinite(bound) or bound <= 0:
            raise InputError(f"{joint} has no bound on its {name}: give {name}=..., one number for all or one a joint")
    return singularity_within_rounding(robot, task, q), bounds


def _images_of_corners(spaces: Subspaces, V: Array) -> tuple[Array, Array]:
    """Return the vertices of the zonotope Σ [−1, 1] Vᵢ Jᵢ, (k, m), and the corners of the box, (k, n)."""
    U, n = spaces.range, len(V)
    columns = (U.T @ spaces.J) * V  # (r, n), what moves nothing is zero
    groups = _parallel(columns)
    if not groups:
        return np.zeros((1, len(U))), np.zeros((1, n))
    signs = np.zeros((len(groups), n))
    for row, group in enumerate(groups):
        for i in group:
            signs[row, i] = 1.0 if columns[:, i] @ columns[:, group[0]] > 0 else -1.0
    corners = np.array(list(product((-1.0, 1.0), repeat=len(groups)))) @ signs
    points = corners @ columns.T
    chosen = _hull(points, U)
    return points[chosen] @ U.T, corners[chosen] * V + 0.0


def _parallel(columns: Array) -> list[list[int]]:
    """Return the numbers of columns in groups of one direction, without those that are zero."""
    norms = np.linalg.norm(columns, axis=0)
    groups: list[list[int]] = []
    for i in np.flatnonzero(norms > RANK_TOLERANCE * norms.max(initial=0.0)):
        for group in groups:
            j = group[0]
            if abs(abs(columns[:, i] @ columns[:, j]) - norms[i] * norms[j]) <= SAME**1.5 * norms[i] * norms[j]:
                group.append(int(i))
                break
        else:
            groups.append([int(i)])
    return groups


def _of_half_spaces(spaces: Subspaces, limits: Array) -> Array:
    """Return the vertices (k, m) of {f ∈ R(J) : |Jᵀ f| ≤ T}."""
    U, r = spaces.range, spaces.rank
    if r == 0:
        return np.zeros((1, len(U)))
    A = (spaces.J.T @ U) / limits[:, None]  # (n, r): |A y| ≤ 1
    normals, distances = _facets(np.vstack([A, -A]))  # of the polar set; each is a vertex here
    points = normals / distances[:, None]
    size = np.abs(points).max()
    distinct = points[np.unique(np.round(points / size / SAME / 10), axis=0, return_index=True)[1]]
    return np.asarray(distinct[_hull(distinct, U)] @ U.T)


def _facets(points: Array) -> tuple[Array, Array]:
    """Return the half-spaces N x ≤ d, (l, r) and (l,), whose intersection is the convex hull of points (k, r)."""
    if points.shape[1] == 1:
        return np.array([[1.0], [-1.0]]), np.array([points.max(), -points.min()])
    from scipy.spatial import ConvexHull

    size = float(np.abs(points).max())
    equations = ConvexHull(points / size).equations
    return np.asarray(equations[:, :-1]), np.asarray(-equations[:, -1] * size)


def _hull(points: Array, U: Array) -> npt.NDArray[np.intp]:
    """Return the numbers of the corners of the convex hull of points U x, x (k, r); in a plane counterclockwise."""
    if points.shape[1] == 1:
        return np.array([int(points.argmin()), int(points.argmax())])
    from scipy.spatial import ConvexHull

    corners = np.asarray(ConvexHull(points / np.abs(points).max()).vertices)
    return corners[::-1] if U.shape == (2, 2) and np.linalg.det(U) < 0 else corners
