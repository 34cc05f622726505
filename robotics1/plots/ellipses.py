"""Plots of the velocity and the force ellipses of a robot's tool, at a configuration or along a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from robotics1.curves.given import joint_motion
from robotics1.errors import TaskError
from robotics1.inputs import Array, counting_number, one_of
from robotics1.kinematics import forward_kinematics
from robotics1.least_squares import RANK_TOLERANCE, numeric_rank
from robotics1.plots.figures import MOST_DRAWN, PLANES, drawn, new_axes, new_projections
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.singularities.ellipsoids import Ellipsoid, force_ellipsoid, velocity_ellipsoid
from robotics1.singularities.spaces import subspaces
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import constant_rows
from robotics1.tasks.task import Task

Kind = Literal["velocity", "force"]
KINDS: dict[Kind, Any] = {
    "velocity": (velocity_ellipsoid, "m/s", {"linestyle": "-", "color": "C0"}),
    "force": (force_ellipsoid, "N", {"linestyle": "--", "color": "C3"}),
}
SIZE = 0.16  # of the reach: the longest drawn semi-axis of velocity, and a usual one of force
FINE = (
    121  # instants of a motion at which the path of the tool is drawn, and points of an ellipse; the first is its last
)
SHOWN = 2.5  # sizes: a force ellipse that is longer is cut by the edge of the plot


@dataclass(frozen=True, eq=False)
class Shadow(Frozen):
    """The orthogonal projection of an ellipsoid about the origin into a plane.

    Attributes:
        boundary: (k, 2) the ellipse; empty where the shadow is not bounded.
        edges: (2, 2) two points, one on each of the two parallel lines between which an unbounded shadow lies; empty
            where it is bounded, or where it is the whole plane.
        along: (2,) the direction of those lines; empty where there are none.
    """

    boundary: Array
    edges: Array
    along: Array

    @property
    def bounded(self) -> bool:
        """Whether it is an ellipse, which may be flat."""
        return len(self.boundary) > 0


NOTHING = np.zeros((0, 2))


def plot_ellipses(
    robot: RobotLike,
    task: TaskLike,
    at: Any,
    ax: Any = None,
    *,
    kinds: Kind | Sequence[Kind] = ("velocity", "force"),
    count: int = 6,
    file: str | Path | None = None,
    title: str = "",
) -> Any:
    """Draw velocity and force ellipses at the tool, and return the axes.

    The velocity ellipsoid is {J q̇ : |q̇| ≤ 1}, with the singular values of J as semi-axes; the force ellipsoid is
    {f : |Jᵀ f| ≤ 1}, with their inverses, in the same directions. J are the rows of the position; with prismatic
    joints, whose rates and forces have other units, 1 is a rate of the reach per second, and a torque divided by the
    reach. A plane task is drawn in its plane; a position in space as the shadows of the ellipsoids in the planes xy, xz
    and yz. In a singular configuration the velocity ellipse is flat and the force ellipse is not bounded: two parallel
    lines. The arm is drawn as thin lines from joint to joint.

    Args:
        robot: the robot.
        task: two or three coordinates of the position of a frame, in world axes, such as `PositionTask("xy")`; a
            `PlanarPoseTask` or `PoseTask` counts with its position.
        at: (n,) a configuration, or a motion of the joints.
        ax: the Matplotlib axes to draw in, three for a position in space; by default those of a new figure.
        kinds: "velocity", "force", or both.
        count: at how many instants of a motion, evenly spaced.
        file: where to write the figure, as .svg, .pdf or .png.
        title: above the plot.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        TaskError: the task holds no two or three such coordinates, or no joint moves its frame.
        InputError: a configuration of the wrong shape, a motion of other joints, or a file that has another suffix or
            cannot be written there.

    Source: Yoshikawa, Manipulability of robotic mechanisms, Int. J. Robotics Research 4, 1985.
    """
    robot, task = robot_and_task(robot, task)
    task.check(robot)
    rows, letters = _position_rows(task)
    listed = [kinds] if isinstance(kinds, str) or not np.iterable(kinds) else kinds
    chosen = [one_of("one of kinds", kind, tuple(KINDS)) for kind in listed]
    postures = _postures(robot, at, count)
    jacobians = [task.jacobian(robot, q)[rows] * robot.units for q in postures]
    if max(float(np.abs(J).max(initial=0)) for J in jacobians) == 0:
        raise TaskError("no joint moves the position of this task here, so there is no ellipse")
    flat = len(rows) == 2
    panels = [new_axes(ax, 2)] if flat else list(new_projections(ax))
    arms = [_arm(robot, task, q) for q in postures]
    course = np.array([_arm(robot, task, q)[-1] for q in _postures(robot, at, FINE)])
    per_metre = {kind: _rounded(_usual_length(kind, jacobians) / (SIZE * robot.reach)) for kind in chosen}
    for panel, plane in zip(panels, [(0, 1)] if flat else PLANES, strict=True):
        columns = [letters[k] for k in plane]
        for arm in arms:
            panel.plot(*arm[:, columns].T, "-o", color="0.6", linewidth=1, markersize=3)
        tools = [arm[-1, columns] for arm in arms]
        panel.plot(*course[:, columns].T, "-", color="black", linewidth=0.8)
        panel.plot(*np.array(tools).T, ".", color="black")
        for kind in chosen:
            _draw(
                panel,
                kind,
                [_shadow(KINDS[kind][0](subspaces(J)), plane) for J in jacobians],
                tools,
                per_metre[kind],
                robot.reach,
            )
        x, y = ("xyz"[k] for k in columns)
        panel.set_aspect("equal", adjustable="datalim")
        panel.set(xlabel=f"{x} [m]", ylabel=f"{y} [m]")
        panel.grid(visible=True, alpha=0.4)
    panels[0].set(title=title)
    panels[len(panels) // 2].legend(loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4, ncols=len(KINDS))
    return drawn(panels[0] if flat else np.array(panels), file)


def _position_rows(task: Task) -> tuple[list[int], list[int]]:
    """Return which rows of the task are coordinates of the position, and of which axes."""
    form, S = task.frame_map(), constant_rows(task)
    known = np.zeros((0, 6)) if form is None or S is None or form.reference != "world" else S
    units = [(i, k) for i, row in enumerate(known) for k in range(3) if np.array_equal(row, np.eye(6)[k])]
    if len(units) not in (2, 3):
        raise TaskError(
            "ellipses are drawn of two or three coordinates of a position in world axes, such as PositionTask('xy')"
        )
    return [i for i, _ in units], [k for _, k in units]


def _postures(robot: Robot, at: Any, count: int) -> list[Array]:
    """Return the configuration that is given, or so many along a motion."""
    if isinstance(at, Sequence | np.ndarray):
        return [robot.configuration(at, "at")]
    motion = joint_motion("at, if it is no configuration,", at, robot.nv)
    count = counting_number("count", count, least=1, most=MOST_DRAWN)
    return [robot.configuration(motion(float(t)), "a value of the motion") for t in np.linspace(0, motion.end, count)]


def _arm(robot: Robot, task: Task, q: Array) -> Array:
    """Return the positions of the joints on the way to the frame of a task, and of the frame, (k, 3)."""
    form = task.frame_map()
    frame = None if form is None else form.frame
    way = robot.joints_to(frame)
    links = [way[0].parent, *(joint.child for joint in way)]
    return np.array([forward_kinematics(robot, q, frame=link).translation for link in [*links, frame]])


def _draw(
    panel: Any, kind: Kind, shadows: Sequence[Shadow], tools: Sequence[Array], per_metre: float, reach: float
) -> None:
    """Draw the shadows of one kind at the tools; the legend says how much a drawn metre is."""
    _, unit, style = KINDS[kind]
    label = f"{kind}: 1 m is {per_metre:g} {unit}"
    for shadow, tool in zip(shadows, tools, strict=True):
        for edge in shadow.edges:
            at = tool + edge / per_metre
            panel.axline(at, at + reach * shadow.along, label=label, **style)
            label = ""
        if shadow.bounded:
            points = tool + shadow.boundary / per_metre
            panel.plot(*points.T, label=label, scalex=False, scaley=False, **style)
            label = ""
            _let_be_seen(panel, points, tool, reach)
    if label:  # every shadow is the whole plane
        panel.plot([], [], label=f"{kind}: not bounded", **style)


def _let_be_seen(panel: Any, points: Array, tool: Array, reach: float) -> None:
    """Let the limits of the plot hold a boundary, but for what is so far away that the edge shall cut it."""
    panel.update_datalim(points[np.abs(points - tool).max(axis=1) <= SHOWN * SIZE * reach])
    panel.autoscale_view()


def _usual_length(kind: str, jacobians: Sequence[Array]) -> float:
    """Return the longest semi-axis of velocity, or the median of those of force, which near a singularity are long."""
    sigmas = [np.linalg.svd(J, compute_uv=False) for J in jacobians]
    if kind == "velocity":
        return float(max(sigma[0] for sigma in sigmas))
    return float(np.median(np.concatenate([1 / sigma[: numeric_rank(sigma)] for sigma in sigmas])))


def _rounded(value: float) -> float:
    """Return the round number (1, 2 or 5 times a power of ten) at or above a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * next(k for k in (1, 2, 5, 10) if k * power >= value * (1 - 1e-9)))


# --- shadows


def _shadow(ellipsoid: Ellipsoid, plane: tuple[int, int]) -> Shadow:
    """Return the shadow of an ellipsoid in the plane of two coordinates; along an axis without bound it has none."""
    finite, free = ellipsoid.bounded_part[list(plane)], ellipsoid.unbounded_axes[list(plane)]
    directions, sizes, _ = np.linalg.svd(free)
    unbounded = int(np.count_nonzero(sizes > RANK_TOLERANCE))
    if unbounded == 0:
        return Shadow(_ellipse(finite), NOTHING, np.zeros(0))
    if unbounded == 1:
        across = directions[:, 1]
        edge = np.linalg.norm(across @ finite) * across
        return Shadow(NOTHING, np.array([edge, -edge]), directions[:, 0])
    return Shadow(NOTHING, NOTHING, np.zeros(0))


def _ellipse(A: Array) -> Array:
    """Return the boundary of {A x : |x| ≤ 1}, (k, 2), for a matrix of two rows."""
    U, sigma, _ = np.linalg.svd(A, full_matrices=True)
    axes = U * np.pad(sigma, (0, 2 - len(sigma)))
    angles = np.linspace(0.0, 2 * np.pi, FINE)
    return np.asarray(np.column_stack([np.cos(angles), np.sin(angles)]) @ axes.T)
