"""Ellipses of velocity and force: their axes, their shadows in three planes, and where they are not bounded."""

import numpy as np
import pytest
from arms import arm, random_q

import robotics1 as r1
from robotics1 import plots

PLANE = r1.PositionTask("xy")
PLANES = [(0, 1), (0, 2), (1, 2)]
DIRECTIONS = np.array([[np.cos(a), np.sin(a)] for a in np.linspace(0, np.pi, 7)])


def per_metre(label):
    """The number of "velocity: 1 m is 5 m/s"."""
    return float(label.split(" is ")[1].split()[0])


def ellipse(panel, kind, at):
    """What is drawn of a kind round a point, in m/s or N."""
    line = next(line for line in panel.lines if line.get_label().startswith(kind))
    return (line.get_xydata() - at) * per_metre(line.get_label())


def test_semi_axes_of_a_drawn_velocity_ellipse_are_the_singular_values_and_of_force_their_inverses():
    robot, q = arm("planar_2r"), [0.3, 1.1]
    panel = plots.plot_ellipses(robot, PLANE, q)
    tool = r1.forward_kinematics(robot, q).translation[:2]
    l1, l2 = robot.parameters["l1"], robot.parameters["l2"]
    s1, c1, s12, c12 = np.sin(0.3), np.cos(0.3), np.sin(1.4), np.cos(1.4)
    J = np.array([[-l1 * s1 - l2 * s12, -l2 * s12], [l1 * c1 + l2 * c12, l2 * c12]])
    sigma = np.sqrt(np.linalg.eigvalsh(J @ J.T))
    for kind, axes in (("velocity", sigma), ("force", 1 / sigma)):
        lengths = np.linalg.norm(ellipse(panel, kind, tool), axis=1)
        assert [lengths.min(), lengths.max()] == pytest.approx(sorted(axes), rel=1e-12)
    for f in ellipse(panel, "force", tool):
        assert np.linalg.norm(J.T @ f) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("name", ["six_r", "spatial", "redundant"])
@pytest.mark.parametrize("plane", PLANES)
def test_a_shadow_has_the_support_of_its_ellipsoid(name, plane):
    """The largest nᵀ J q̇ with |q̇| = 1 is |Jᵀ n|, the largest nᵀ f with |Jᵀ f| = 1 is √(nᵀ (J Jᵀ)⁻¹ n).

    The rate 1 of a slide is the reach per second.
    """
    robot = arm(name)
    q = random_q(robot, np.random.default_rng(3))
    J = r1.PositionTask().jacobian(robot, q) * np.where(robot.revolute, 1, robot.reach)
    tool = r1.forward_kinematics(robot, q).translation[list(plane)]
    panel = plots.plot_ellipses(robot, r1.PositionTask(), q)[PLANES.index(plane)]
    for n in DIRECTIONS:
        normal = np.zeros(3)
        normal[list(plane)] = n
        for kind, support in (
            ("velocity", np.linalg.norm(J.T @ normal)),
            ("force", np.sqrt(normal @ np.linalg.solve(J @ J.T, normal))),
        ):
            boundary = ellipse(panel, kind, tool)
            assert (boundary @ n).max() == pytest.approx(support, rel=1e-3)  # of 121 points
            assert (boundary @ n).max() <= support * (1 + 1e-9)


def test_where_the_arm_is_stretched_velocity_is_a_segment_and_force_is_between_two_lines():
    robot = arm("planar_2r")
    l1, l2 = robot.parameters["l1"], robot.parameters["l2"]
    sigma = np.hypot(l1 + l2, l2)  # of J = [0 0; l1 + l2, l2]
    panel = plots.plot_ellipses(robot, PLANE, [0.0, 0.0])
    velocity = ellipse(panel, "velocity", [l1 + l2, 0])
    assert velocity[:, 0] == pytest.approx(np.zeros(len(velocity)), abs=1e-9)
    assert velocity[:, 1].max() == pytest.approx(sigma)
    first, second = (line for line in panel.lines if type(line).__name__ == "AxLine")
    heights = [line.get_xy1()[1] * per_metre(first.get_label()) for line in (first, second)]
    assert sorted(heights) == pytest.approx([-1 / sigma, 1 / sigma])
    assert all(line.get_xy2()[1] == pytest.approx(line.get_xy1()[1]) for line in (first, second))  # along x


def test_forces_across_a_slide_are_not_bounded():
    """J = (1, 0, 0)ᵀ: |Jᵀ f| ≤ 1 bounds f_x alone, by 1; in the plane yz nothing is drawn."""
    robot = r1.planar_arm("P", lengths=[])
    xy, xz, yz = plots.plot_ellipses(robot, r1.PositionTask(), [0.4])
    for panel in (xy, xz):
        lines = [line for line in panel.lines if type(line).__name__ == "AxLine"]
        at = sorted((line.get_xy1()[0] - 0.4) * per_metre(lines[0].get_label()) for line in lines)
        assert at == pytest.approx([-1 / robot.reach, 1 / robot.reach])  # a torque divided by the reach
        assert all(line.get_xy2()[0] == pytest.approx(line.get_xy1()[0]) for line in lines)
    assert not [line for line in yz.lines if type(line).__name__ == "AxLine"]


def test_a_position_in_space_is_drawn_in_three_planes_of_one_scale(tmp_path):
    robot, q = arm("six_r"), [0.3, -0.8, 0.9, 0.2, 0.5, 0.1]
    panels = plots.plot_ellipses(robot, r1.PoseTask(), q, file=tmp_path / "a.pdf", title="an arm")
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
    names = [(panel.get_xlabel(), panel.get_ylabel()) for panel in panels]
    assert names == [("x [m]", "y [m]"), ("x [m]", "z [m]"), ("y [m]", "z [m]")]
    tool = r1.forward_kinematics(robot, q).translation
    J = r1.frame_jacobian(robot, q)[:3]
    for panel, plane in zip(panels, PLANES, strict=True):
        largest = np.linalg.norm(ellipse(panel, "velocity", tool[list(plane)]), axis=1).max()
        assert largest == pytest.approx(np.linalg.norm(J[list(plane)], 2), rel=1e-3)
        label = {line.get_label() for line in panel.lines if line.get_label().startswith("velocity")}
        assert label == {line.get_label() for line in panels[0].lines if line.get_label().startswith("velocity")}


def test_ellipses_along_a_motion_stand_on_the_path_of_the_tool():
    from matplotlib.figure import Figure

    robot, motion = arm("planar_2r"), r1.cubic([0.2, 0.5], [1.0, 1.5], 2.0)
    given = Figure().subplots()
    panel = plots.plot_ellipses(robot, PLANE, motion, given, kinds="velocity", count=5)
    assert panel is given
    ellipses = [line for line in panel.lines if line.get_linestyle() == "-" and line.get_color() == "C0"]
    centres = [(line.get_xydata()[:-1]).mean(axis=0) for line in ellipses]
    tools = [PLANE.value(robot, motion(t)) for t in np.linspace(0, 2, 5)]
    assert np.array(centres) == pytest.approx(np.array(tools), abs=1e-12)


def test_rates_of_prismatic_joints_count_in_reaches():
    robot, q = arm("prr"), [0.2, 0.5, 1.0]
    panel = plots.plot_ellipses(robot, r1.PlanarPoseTask(), q)
    J = PLANE.jacobian(robot, q) * [robot.reach, 1, 1]
    tool = PLANE.value(robot, q)
    assert np.linalg.norm(ellipse(panel, "velocity", tool), axis=1).max() == pytest.approx(np.linalg.norm(J, 2))


def test_the_two_kinds_differ_without_colour():
    panel = plots.plot_ellipses(arm("planar_2r"), PLANE, [0.3, 1.1])
    styles = {line.get_label()[:5]: line.get_linestyle() for line in panel.lines}
    assert (styles["veloc"], styles["force"]) == ("-", "--")


MISUSE = [
    (lambda: plots.plot_ellipses(arm("six_r"), r1.OrientationTask(), np.zeros(6)), r1.TaskError, "two or three"),
    (lambda: plots.plot_ellipses(arm("six_r"), r1.PositionTask("z"), np.zeros(6)), r1.TaskError, "two or three"),
    (
        lambda: plots.plot_ellipses(arm("six_r"), r1.PositionTask("xy", reference="tool"), np.zeros(6)),
        r1.TaskError,
        "world axes",
    ),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, [0.0]), r1.InputError, r"at must have shape \(2,\)"),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, [0.0, np.nan]), r1.InputError, "finite"),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, 3), r1.InputError, "at, if it is no configuration"),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, r1.cubic([0], [1], 1)), r1.InputError, "joints"),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, [0, 1], kinds="power"), r1.InputError, "one of kinds"),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, [0, 1], kinds=3), r1.InputError, "kinds"),
    (lambda: plots.plot_ellipses(arm("planar_2r"), PLANE, [0, 1], file="a.jpg"), r1.InputError, "a figure is written"),
    (lambda: plots.plot_ellipses(arm("six_r"), r1.PositionTask(), [0] * 6, 3), r1.InputError, "ax must be 3"),
]


@pytest.mark.parametrize(("call", "error", "message"), MISUSE, ids=range(len(MISUSE)))
def test_misuse_of_ellipses_is_a_typed_error(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_the_tool_of_a_spatial_arm_moves_in_space_or_in_three_projections(tmp_path):
    robot, motion = arm("six_r"), r1.cubic(np.zeros(6), [0.5, -0.4, 0.6, 0.1, 0.8, 0.2], 2.0)
    end = r1.forward_kinematics(robot, motion(2.0)).translation
    space = r1.plot_path(motion, robot=robot, frames=2)
    assert np.array(space.lines[0].get_data_3d())[:, -1] == pytest.approx(end)
    panels = plots.plot_path(motion, robot=robot, projection="projections", file=tmp_path / "a.png")
    for panel, plane in zip(panels, PLANES, strict=True):
        assert panel.lines[0].get_xydata()[-1] == pytest.approx(end[list(plane)])
        assert [panel.get_xlabel(), panel.get_ylabel()] == [f"{'xyz'[k]} [m]" for k in plane]
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_the_tool_of_a_planar_arm_moves_in_the_plane():
    robot, motion = arm("planar_2r"), r1.cubic([0, 0], [1, 1], 2.0)
    panel = r1.plot_path(motion, robot=robot)
    assert panel.lines[0].get_xydata()[-1] == pytest.approx(PLANE.value(robot, [1, 1]))


@pytest.mark.parametrize(
    ("options", "message"),
    [({"projection": "isometric"}, "projection must be one of '3d', 'projections'"), ({"robot": 3}, "robot")],
)
def test_misuse_of_a_tool_path_is_an_input_error(options, message):
    with pytest.raises(r1.InputError, match=message):
        r1.plot_path(r1.cubic([0, 0], [1, 1], 1.0), **options)
