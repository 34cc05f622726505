"""The section of the workspace: exact, traced or sampled, as its kind is known; and it says which."""

import numpy as np

from robotics1.data_sheet.asked import UNLIMITED, Answer, Asked, open_note, open_slides
from robotics1.data_sheet.markup import figure, note, paragraphs, sentences
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.plots.figures import new_axes
from robotics1.plots.reach import plot_workspace
from robotics1.robot.box import joint_box
from robotics1.tasks.position import PositionTask
from robotics1.viewer.arm_data import is_planar
from robotics1.workspaces.find import workspace as find_workspace
from robotics1.workspaces.result import Workspace

SAMPLES = 20_000  # points of a workspace that is a surface or a curve
CELLS = 60  # of its picture, across


def workspace(asked: Asked) -> Answer:
    """Return the workspace: exactly where the package knows it, else by cells, or by points of a surface."""
    planar = is_planar(asked.robot)
    task = PositionTask("xy" if planar else "xyz", frame=asked.frame)
    try:
        found = find_workspace(asked.robot, task, box=open_slides(asked))
    except TaskError:
        return _sampled(asked)
    text = figure(lambda: plot_workspace(found), _caption(found, planar=planar))
    text += sentences(found.explain().split("\nThe boundary")[0])
    return Answer(text + open_note(asked) + note(_surety(found)), _fact(asked, found))


def _caption(found: Workspace, *, planar: bool) -> str:
    title = "The reached points" + ("" if planar else f" in the section ({', '.join(found.coordinates)})")
    if found.redundant or found.resolution:
        return title
    return f"{title}, with the number of inverse kinematics solutions in each region"


def _surety(found: Workspace) -> str:
    if found.resolution:
        return (
            f"Searched: the section is sampled in cells of {found.resolution:.3g} m. A reached cell is proven by a "
            "configuration; that the others are not reached is not proven."
        )
    if any(curve.kind == "curve" for curve in found.boundary):
        return "Computed: the boundary is where the joints are singular or at limits, traced along these curves."
    return "Proven: the boundary is made of arcs and segments, and these are computed exactly."


def _fact(asked: Asked, found: Workspace) -> str:
    size = f"area {found.area:.4g} m²" if found.volume is None else f"volume {found.volume:.4g} m³"
    first = next(joint for joint in asked.robot.joints_to(asked.frame) if joint.kind != "fixed")
    origin = "first joint's axis" if first.kind == "revolute" else "world's origin"
    how = ", by samples" if found.resolution else ""
    return f"{size}; {found.r_min:.4g} to {found.r_max:.4g} m from the {origin}{how}"


def _sampled(asked: Asked) -> Answer:
    """Return the reached points around the first joint's axis, of random configurations."""
    robot = asked.robot
    drawn = joint_box(robot, unlimited=UNLIMITED).random(np.random.default_rng(0), SAMPLES)
    points = np.array([forward_kinematics(robot, q, frame=asked.frame).translation for q in drawn])
    origin, axis = _first_axis(asked)
    along = (points - origin) @ axis
    across = np.linalg.norm(points - origin - along[:, None] * axis, axis=1)
    far = float(np.linalg.norm(points - origin, axis=1).max())
    text = figure(
        lambda: _cloud(across, along),
        f"Where the tool was at {SAMPLES} random configurations: the darker, the more often",
    )
    text += paragraphs(
        f"The farthest of these points is {far:.4g} m from the first joint, the highest {along.max():.4g} m up."
    )
    text += note("Searched: these are samples; the boundary lies at or beyond the outermost of them.")
    return Answer(text + open_note(asked), f"reaches at least {far:.4g} m from the first joint (samples)")


def _cloud(across: Array, along: Array) -> object:
    """Draw how often a cell of the section was reached."""
    counts, rho, height = np.histogram2d(across, along, bins=CELLS)
    panel = new_axes(None, 2)
    reached = np.ma.masked_equal(counts.T, 0)
    panel.pcolormesh(rho, height, np.log(reached), cmap="GnBu", vmin=-2, rasterized=True)
    panel.set(xlabel="distance from the first joint's axis [m]", ylabel="height along it [m]", aspect="equal")
    panel.grid(visible=True, alpha=0.4)
    return panel


def _first_axis(asked: Asked) -> tuple[Array, Array]:
    """Return a point of the axis of the first joint on the way to the tool, and its direction; z if it slides."""
    import pinocchio as pin

    robot = asked.robot
    joint = next(j for j in robot.joints_to(asked.frame) if j.kind != "fixed")
    pin.forwardKinematics(robot.own_model, robot.data, pin.neutral(robot.own_model))
    placement = robot.data.oMi[robot.own_model.getJointId(joint.name)]
    axis = placement.rotation @ np.array(joint.axis) if joint.kind == "revolute" else np.array([0.0, 0.0, 1.0])
    return placement.translation.copy(), axis
