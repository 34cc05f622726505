"""Sections with pictures: workspace, ellipsoids at the posture, scan of σ_min."""

import numpy as np

from robotics1.data_sheet.asked import UNLIMITED, Answer, Asked
from robotics1.data_sheet.inverse import open_slides
from robotics1.data_sheet.markup import figure, note, paragraphs, sentences, table
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.notation import count, number, vector
from robotics1.plots.ellipses import plot_ellipses
from robotics1.plots.figures import new_axes
from robotics1.plots.reach import plot_workspace
from robotics1.robot.box import joint_box
from robotics1.singularities.scan import scan_singularities
from robotics1.singularities.scan_result import SingularityScan
from robotics1.tasks.position import PositionTask
from robotics1.tasks.task import unitless_jacobian
from robotics1.viewer.arm_data import is_planar
from robotics1.workspaces.find import workspace as exact_workspace

SAMPLES = 20_000  # points of a workspace that is not known exactly
CELLS = 60  # of its picture, across
SCANNED = 100_000
PER_OCTAVE = 2  # bars of the histogram


def workspace(asked: Asked) -> Answer:
    """Return the workspace: exactly where the package knows it, else by samples."""
    planar = is_planar(asked.robot)
    task, box = PositionTask("xy" if planar else "xyz", frame=asked.frame), open_slides(asked)
    try:
        found = exact_workspace(asked.robot, task, box=box)
    except TaskError:
        return _sampled(asked)
    size = f"area {found.area:.4g} m²" if found.volume is None else f"volume {found.volume:.4g} m³"
    title = "The reached points" + ("" if planar else f" in the section ({', '.join(found.coordinates)})")
    text = figure(
        lambda: plot_workspace(found), f"{title}, with the number of inverse kinematics solutions in each region"
    )
    text += sentences(found.explain().split("\nThe boundary")[0]) + _open_note(box)
    text += note("Proven: the boundary is made of arcs and segments, and these are computed exactly.")
    return Answer(text, f"{size}; reach {found.r_min:.4g} to {found.r_max:.4g} m from the first joint's axis")


def _open_note(box: dict[str, tuple[float, float]] | None) -> str:
    if not box:
        return ""
    return note(f"{', '.join(box)}: a slide without limits, taken from −{UNLIMITED:g} to {UNLIMITED:g} m here.")


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
    return Answer(text + _open_note(open_slides(asked)), f"reaches at least {far:.4g} m from the first joint (samples)")


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


def ellipsoids(asked: Asked) -> Answer:
    """Return the velocity and force ellipsoids of the tool's point at the posture."""
    robot, task = asked.robot, asked.require_task()
    point = PositionTask("xy" if is_planar(robot) else "xyz", frame=asked.frame)
    caption = f"The arm at q = {vector(asked.q)}, with the ellipsoids of its tool's velocity and force"
    text = figure(lambda: plot_ellipses(robot, point, asked.q), caption)
    sigma = np.linalg.svd(unitless_jacobian(robot, task, asked.q), compute_uv=False)
    rows = [(f"σ{i}", number(value)) for i, value in enumerate(sigma, 1)]
    rows += [("σ_max/σ_min", number(sigma[0] / sigma[-1])), ("manipulability, the product", f"{np.prod(sigma):.4g}")]
    text += paragraphs(
        "Where the ellipse of velocity is long, the tool is fast and its force small; the other way round for force.",
        f"Singular values of J at this posture, lengths in units of the reach ({robot.reach:.4g} m):",
    )
    return Answer(text + table(("", "value"), rows), f"σ_max/σ_min = {sigma[0] / sigma[-1]:.4g} at the posture")


def scan(asked: Asked) -> Answer:
    """Return how often the arm is how near to singular."""
    robot, task = asked.robot, asked.require_task()
    found = scan_singularities(robot, task, samples=SCANNED, length=robot.reach, box=open_slides(asked))
    half = found.quantile(0.5)
    text = figure(
        lambda: _histogram(found), f"σ_min of J at {found.count} random configurations, lengths in units of the reach"
    )
    text += sentences(found.explain()) + _open_note(open_slides(asked))
    return Answer(text, f"σ_min is {half:.3g} at half of {count(found.count, 'configuration')}, J without units")


def _histogram(found: SingularityScan) -> object:
    edges, counts = found.histogram(per_octave=PER_OCTAVE)
    shown = counts > 0
    panel = new_axes(None, 2)
    panel.bar(
        edges[:-1][shown], 100 * counts[shown] / found.count, np.diff(edges)[shown], align="edge", color="#7fb3c8"
    )
    for p, style in ((0.01, "--"), (0.5, "-")):
        panel.axvline(found.quantile(p), linestyle=style, color="0.2", label=f"{100 * p:g} % are below")
    panel.set(xscale="log", xlabel="σ_min", ylabel="configurations [%]")
    panel.legend()
    return panel
