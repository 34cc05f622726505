"""What is drawn: values, units, sides of jumps, bounds; and that lines differ without colour."""

import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q
from test_paths_in_time import law_to, trapezoid

import robotics1 as r1
from robotics1 import InputError, MotionLimits

CORNER = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=0.2)
SPACE = r1.curves.polyline_path([[0, 0, 0], [1, 0, 0], [1, 1, 1]], blend=0.2)


def is_svg(path):
    return ET.parse(path).getroot().tag.endswith("svg")


def pose_motion():
    T1 = pin.SE3(pin.exp3(np.array([0, 0, 1.2])), np.array([1, 2, 2.0]))
    path = r1.curves.pose_line(np.eye(4), T1)
    return r1.curves.PathTrajectory(path, law_to(path.end))


def test_trajectory_is_drawn_with_its_derivatives_and_units(tmp_path):
    motion = r1.curves.PathTrajectory(CORNER, law_to(CORNER.end))
    panels = r1.plot_trajectory(motion, file=tmp_path / "a.svg", names=["x", "y"], units="m", title="over a corner")
    assert is_svg(tmp_path / "a.svg")
    assert [panel.get_ylabel() for panel in panels] == ["position [m]", "velocity [m/s]", "acceleration [m/s²]"]
    assert panels[-1].get_xlabel() == "t [s]"
    assert panels[0].get_title() == "over a corner"
    for panel, values in zip(panels, (motion, motion.velocity), strict=False):
        for i in range(2):
            t, drawn = panel.lines[i].get_data()
            assert drawn == pytest.approx(values(t)[:, i], abs=1e-12)
    assert [text.get_text() for text in panels[1].get_legend().get_texts()] == ["x", "y"]


def test_a_jump_is_drawn_upright_from_both_sides(tmp_path):
    motion = r1.curves.PathTrajectory(CORNER, law_to(CORNER.end))
    drawn = r1.plot_trajectory(motion)
    switch = motion.breakpoints[0]
    t, a = drawn[2].lines[1].get_data()
    at = a[np.isclose(t, switch, atol=1e-12)]
    assert at == pytest.approx([motion.acceleration(switch, side="left")[1], motion.acceleration(switch)[1]])
    assert abs(at[1] - at[0]) > 1


def test_joints_have_the_robots_names_and_units_of_each_kind(tmp_path):
    robot = arm("prr")
    motion = r1.cubic([0, 0, 0], [1, 2, 3], 1.0)
    panels = r1.plot_trajectory(motion, robot=robot, limits=MotionLimits(velocity=[1.0, 2.0, 3.0]))
    legends = [[text.get_text() for text in panel.get_legend().get_texts()] for panel in panels]
    assert legends[0] == ["q1 [m]", "q2 [rad]", "q3 [rad]"]
    assert legends[2] == ["q1 [m/s²]", "q2 [rad/s²]", "q3 [rad/s²]"]
    assert panels[0].get_ylabel() == "position"
    levels = sorted(line.get_ydata()[0] for line in panels[1].lines[3:])
    assert levels == [-3, -2, -1, 1, 2, 3]
    assert len(panels[2].lines) == 3
    drawn = r1.plot_trajectory(motion, robot=robot, limits=MotionLimits(acceleration=4.0))
    assert sorted(line.get_ydata()[0] for line in drawn[2].lines[3:]) == [-4, 4]


def test_twenty_lines_differ_without_colour(tmp_path):
    for robot in (r1.robot_from_dh([("R", 1, 0, 0, 0)] * 20), arm("redundant")):
        drawn = r1.plot_trajectory(r1.cubic(random_q(robot, 1), random_q(robot, 2), 1.0), robot=robot)
        lines = drawn[0].lines
        assert len({(line.get_linestyle(), line.get_marker()) for line in lines}) == robot.nq


def test_poses_are_drawn_as_a_position_and_a_rotation_vector(tmp_path):
    motion = pose_motion()
    units = ["m"] * 3 + ["rad"] * 3
    drawn = r1.plot_trajectory(motion, names=["x", "y", "z", "a", "b", "c"], units=units)
    lines = drawn[0].lines
    assert lines[5].get_ydata()[-1] == pytest.approx(1.2)
    assert lines[1].get_ydata()[-1] == pytest.approx(2)
    turning = r1.curves.PathTrajectory(motion.path.orientation, law_to(1.2))
    drawn = r1.plot_trajectory(turning)
    assert drawn[0].lines[2].get_ydata()[-1] == pytest.approx(1.2)


def test_timing_law_is_drawn_with_bounds_peaks_and_switching_times(tmp_path):
    law = trapezoid(2.0, 0.5, 1.0)
    limits = MotionLimits(velocity=1.5, acceleration=4.0)
    panels = r1.plot_timing_law(law, file=tmp_path / "a.svg", limits=limits, unit="rad", title="trapezoid")
    assert is_svg(tmp_path / "a.svg")
    labels = [panel.get_ylabel() for panel in panels]
    assert labels == ["s [rad]", "ds/dt [rad/s]", "d²s/dt² [rad/s²]", "d³s/dt³ [rad/s³]"]
    t, v = panels[1].lines[0].get_data()
    assert v == pytest.approx(law.velocity(t))
    texts = [text.get_text() for text in panels[1].get_legend().get_texts()]
    assert texts == ["bound 1.5", "peak 1.333 at t = 0.5 s"]
    dashed = [line.get_ydata()[0] for line in panels[2].lines if line.get_linestyle() == "--"]
    assert sorted(dashed) == [-4, 4]
    dotted = [line.get_xdata()[0] for line in panels[0].lines if line.get_linestyle() == ":"]
    assert dotted == pytest.approx([0.5, 1.5])
    t, a = panels[2].lines[0].get_data()
    assert a[np.isclose(t, 0.5)] == pytest.approx([8 / 3, 0])


def test_a_path_is_drawn_with_start_end_and_breaks(tmp_path):
    panel = r1.plot_path(CORNER, file=tmp_path / "a.svg", frames=4)
    assert is_svg(tmp_path / "a.svg")
    line, start, end, breaks, *frames = panel.lines
    assert line.get_xydata()[0] == pytest.approx([0, 0])
    assert line.get_xydata()[-1] == pytest.approx([1, 1])
    assert start.get_xydata() == pytest.approx(np.array([[0, 0]]))
    assert end.get_xydata() == pytest.approx(np.array([[1, 1]]))
    assert breaks.get_xydata() == pytest.approx(CORNER(CORNER.breakpoints))
    assert len({mark.get_marker() for mark in (line, start, end, breaks)}) == 4
    assert len(frames) == 4  # the four tangents: on the lines there is no normal
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("x [m]", "y [m]")


def test_frames_along_an_arc_are_its_tangents_and_normals(tmp_path):
    drawn = r1.plot_path(r1.curves.arc_path([0, 0], [1, 0], 1.0), frames=1)
    tangent, normal = drawn.lines[3:]
    directions = [np.diff(line.get_xydata(), axis=0)[0] for line in (tangent, normal)]
    assert directions[0] / np.linalg.norm(directions[0]) == pytest.approx([0, 1])
    assert directions[1] / np.linalg.norm(directions[1]) == pytest.approx([-1, 0])
    assert (tangent.get_linestyle(), normal.get_linestyle()) == ("-", "--")


def test_paths_in_space_poses_and_trajectories_are_drawn(tmp_path):
    panel = r1.plot_path(SPACE, file=tmp_path / "a.svg", frames=3, unit="mm")
    assert is_svg(tmp_path / "a.svg")
    assert panel.get_zlabel() == "z [mm]"
    assert np.array(panel.lines[0].get_data_3d())[:, -1] == pytest.approx([1, 1, 1])
    drawn = r1.plot_path(pose_motion().path, frames=3)
    assert len(drawn.lines) == 3 + 9
    r1.plot_path(pose_motion(), frames=2)
    motion = r1.curves.PathTrajectory(SPACE, law_to(SPACE.end))
    drawn = r1.plot_path(motion, frames=2)
    assert np.array(drawn.lines[0].get_data_3d())[:, -1] == pytest.approx([1, 1, 1])


@pytest.mark.parametrize(
    ("suffix", "start"), [(".svg", b"<?xml"), (".pdf", b"%PDF"), (".PNG", b"\x89PNG"), ("", b"<?xml")]
)
def test_the_same_figure_is_the_same_bytes_in_the_format_of_its_suffix(tmp_path, suffix, start):
    files = [tmp_path / f"a{suffix}", tmp_path / f"b{suffix}"]
    for file in files:
        r1.plot_path(SPACE, file=file, frames=2)
    assert files[0].read_bytes() == files[1].read_bytes()
    assert files[0].read_bytes().startswith(start)


def test_a_figure_of_another_format_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"a figure is written as .svg, .pdf, .png; the file is '.*a.jpg'"):
        r1.plot_path(SPACE, file=tmp_path / "a.jpg")


def test_a_tool_path_ends_on_the_target_which_is_dotted(planar_2r):
    tool = r1.trajectories.TaskTrajectory(planar_2r, r1.PositionTask("xy"), r1.cubic([0, 0], [0, 0], 1.0))
    drawing = r1.plot_path(tool, target=r1.LinearMotion([1, 1], [1, -1]))
    assert drawing.lines[0].get_xydata()[-1] == pytest.approx([2.0, 0.0])
    assert drawing.lines[3].get_xydata()[-1] == pytest.approx([2.0, 0.0])
    assert drawing.lines[3].get_linestyle() == ":"


def test_joints_are_drawn_above_their_rates_into_axes_that_are_given():
    from matplotlib.figure import Figure

    robot, motion = arm("prr"), r1.cubic([0, 1, 2], [1, 0, -1], 2.0, 0.0, [0.5, 0, 0])
    given = Figure().subplots(2)
    upper, lower = r1.plot_trajectory(motion, given, robot=robot, derivatives=1, title="A motion")
    assert (upper, lower) == tuple(given)
    for i in range(3):
        t, q = upper.lines[i].get_data()
        assert q == pytest.approx(motion(t)[:, i])
        assert lower.lines[i].get_ydata() == pytest.approx(motion.velocity(t)[:, i])
    assert [text.get_text() for text in upper.get_legend().get_texts()] == ["q1 [m]", "q2 [rad]", "q3 [rad]"]
    assert len({line.get_linestyle() for line in upper.lines}) == 3  # to be told apart without colour


MOTION = r1.cubic([0, 0], [1, 1], 1.0)
CALLS = [
    (lambda d: r1.plot_trajectory(MOTION, file=d / "no" / "a.svg"), "there is no folder"),
    (lambda d: r1.plot_trajectory(MOTION, file=d / "a.svg", names=["x"]), "names must be 2 texts"),
    (lambda d: r1.plot_trajectory(MOTION, file=d / "a.svg", names=[1, 2]), "one of names must be a text"),
    (lambda d: r1.plot_trajectory(MOTION, file=d / "a.svg", units=["m"]), "units must be 2 texts"),
    (lambda d: r1.plot_trajectory(MOTION, file=d / "a.svg", robot=arm("prr")), "has 3 joints; the trajectory moves 2"),
    (lambda d: r1.plot_timing_law(MOTION.joint(0), file=d / "a.svg", unit=3), "unit must be a text"),
    (lambda d: r1.plot_timing_law(MOTION.joint(0), file=d / "a.svg", limits=MotionLimits(velocity=[1, 2])), "velocity"),
    (lambda d: r1.plot_path(r1.line_path([0], [1]), file=d / "a.svg"), "two or three coordinates can"),
    (lambda d: r1.plot_path(pose_motion().path.orientation, file=d / "a.svg"), "a path of points or of poses"),
    (lambda d: r1.plot_path(CORNER, d / "a.svg"), "ax must be Matplotlib axes of 2 dimensions"),
    (lambda d: r1.plot_trajectory(MOTION, d / "a.svg"), "ax must be 3 Matplotlib axes"),
    (lambda d: r1.plot_path(CORNER, file=d / "a.svg", frames=-1), "frames must be an integer"),
]  # fmt: skip


@pytest.mark.parametrize(("call", "message"), CALLS, ids=range(len(CALLS)))
def test_misuse_of_plots_is_an_input_error(tmp_path, call, message):
    with pytest.raises(InputError, match=message):
        call(tmp_path)


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        (3, "must be a motion"),
        (r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0), "joints"),
        (r1.cubic([0], [1], 1), "joints"),
    ],
)
def test_what_is_no_motion_of_the_robots_joints_is_an_input_error(motion, message, planar_2r, tmp_path):
    for draw in (
        lambda: r1.animate(planar_2r, motion, tmp_path / "motion.out"),
        lambda: r1.plot_trajectory(motion, robot=planar_2r),
        lambda: r1.trajectories.TaskTrajectory(planar_2r, r1.PositionTask("xy"), motion),
    ):
        with pytest.raises(r1.InputError, match=message):
            draw()


def test_a_profile_is_animated(planar_2r, tmp_path):
    motion = r1.minimum_time([0, 0], [1, -1], r1.MotionLimits(1, 2)).trajectory
    assert r1.animate(planar_2r, motion, tmp_path / "profile.html").file.stat().st_size > 100_000


def test_poses_are_drawn_in_metres_and_radians(tmp_path):
    drawn = r1.plot_trajectory(pose_motion())
    texts = [text.get_text() for text in drawn[1].get_legend().get_texts()]
    assert texts == ["x [m/s]", "y [m/s]", "z [m/s]", "θx [rad/s]", "θy [rad/s]", "θz [rad/s]"]


@pytest.mark.parametrize("path", [r1.curves.helix_path([0, 0, 0], [0.5, 0, 0], 0.2, 2), SPACE])
def test_the_labels_of_three_axes_are_inside_the_figure(tmp_path, path):
    space = r1.plot_path(path, file=tmp_path / "a.svg")
    space.figure.canvas.draw()
    for axis, name in ((space.xaxis, "x [m]"), (space.yaxis, "y [m]"), (space.zaxis, "z [m]")):
        assert axis.label.get_text() == name
        low, high = axis.label.get_window_extent().get_points()
        assert (low >= 0).all()
        assert (high <= space.figure.bbox.size).all()
