import xml.etree.ElementTree as ET

import pytest

from robotics1 import InputError, LinearMotion, cubic, load_robot, plot_joint_motion, plot_tool_path
from robotics1.viewer import plots


@pytest.fixture
def axes(monkeypatch):
    """Return the axes of the figure that was drawn last."""
    drawn = []
    write = plots._write
    monkeypatch.setattr(plots, "_write", lambda figure, path: (drawn.append(figure), write(figure, path))[1])
    return lambda: drawn[-1].axes


def test_joint_motion_draws_q_above_its_rate(tmp_path, axes):
    motion = cubic([0, 1, 2], [1, 0, -1], 2.0, 0.0, [0.5, 0, 0])
    path = plot_joint_motion(load_robot("prr"), motion, tmp_path / "motion.svg", title="A motion")
    upper, lower = axes()
    for i in range(3):
        t, q = upper.lines[i].get_data()
        assert q == pytest.approx(motion(t)[:, i])
        assert lower.lines[i].get_ydata() == pytest.approx(motion.velocity(t)[:, i])
    assert [text.get_text() for text in upper.get_legend().get_texts()] == ["q1 [m]", "q2 [rad]", "q3 [rad]"]
    assert len({line.get_linestyle() for line in upper.lines}) == 3  # to be told apart without colour
    assert ET.parse(path).getroot().tag.endswith("svg")


def test_tool_path_ends_on_the_target(tmp_path, axes):
    robot = load_robot("planar_2r")
    plot_tool_path(robot, cubic([0, 0], [0, 0], 1.0), tmp_path / "p.svg", target=LinearMotion([1, 1], [1, -1]))
    (drawing,) = axes()
    assert drawing.lines[0].get_xydata()[-1] == pytest.approx([2.0, 0.0])
    assert drawing.lines[3].get_xydata()[-1] == pytest.approx([2.0, 0.0])
    assert drawing.lines[3].get_linestyle() == ":"


def test_a_figure_is_the_same_bytes_each_time(tmp_path):
    motion = cubic([0, 0], [1, 1], 1.0)
    first = plot_joint_motion(load_robot("planar_2r"), motion, tmp_path / "a.svg").read_bytes()
    assert plot_joint_motion(load_robot("planar_2r"), motion, tmp_path / "b.svg").read_bytes() == first


def test_a_missing_folder_is_said(tmp_path):
    with pytest.raises(InputError, match="there is no folder"):
        plot_joint_motion(load_robot("planar_2r"), cubic([0, 0], [1, 1], 1.0), tmp_path / "nowhere" / "a.svg")
