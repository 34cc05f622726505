"""What is drawn of a simulated law and of tasks by priority."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import robotics1 as r1
from robotics1 import control, redundancy

ARM = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
XY, Q = r1.PositionTask("xy"), np.array([0.4, 0.7, -0.9])
START = XY.value(ARM, Q)
LINE = r1.line_path(START, START + np.array([-0.2, 0.1]))
MOTION = r1.curves.PathTrajectory(LINE, r1.cubic(0, LINE.end, 1.0))


def test_a_simulated_law_is_drawn_with_its_error(tmp_path):
    run = control.simulate_law(control.joint_law(ARM, [0.0, 0.0, 0.0], 4.0), Q, duration=1.0, samples=11)
    panels = r1.plots.plot_run(run, robot=ARM, file=tmp_path / "run.svg", title="a joint law")
    assert [panel.get_ylabel() for panel in panels] == ["position", "velocity", "error"]
    for panel, values in zip(panels, (run.q, run.qdot, run.error), strict=True):
        assert np.array([line.get_ydata() for line in panel.lines]).T == pytest.approx(values)
        assert panel.lines[0].get_xdata() == pytest.approx(run.t)
    assert [text.get_text() for text in panels[0].get_legend().texts] == list(ARM.joint_names)
    assert len({line.get_linestyle() for line in panels[0].lines}) == 3
    assert ET.parse(tmp_path / "run.svg").getroot().tag.endswith("svg")


def test_every_level_of_a_priority_has_its_own_error():
    levels = [(XY, MOTION, 5), (r1.PositionTask("y", frame="link2"), [0.5], 1)]
    run = redundancy.follow_by_priority(ARM, levels, Q, samples=11, damping=0.1)
    panels = r1.plots.plot_run(run)
    assert [panel.get_ylabel() for panel in panels[2:]] == ["error of level 1", "error of level 2"]
    assert panels[3].lines[0].get_ydata() == pytest.approx(run.errors[1][:, 0])
    assert [text.get_text() for text in panels[1].get_legend().texts] == ["q1", "q2", "q3"]


@pytest.mark.parametrize("junk", [None, 3, "run", [1, 2], MOTION, control.ControlRun, object()])
def test_what_is_no_run_is_refused(junk):
    with pytest.raises(r1.InputError, match="run must be what simulate_law or follow_by_priority returns"):
        r1.plots.plot_run(junk)


def test_a_run_of_another_robot_and_wrong_axes_are_refused(tmp_path):
    run = control.simulate_law(control.joint_law(ARM, [0.0, 0.0, 0.0], 4.0), Q, duration=0.1, samples=3)
    with pytest.raises(r1.InputError, match="the run has 3 joints, and the robot 2"):
        r1.plots.plot_run(run, robot="planar_2r")
    with pytest.raises(r1.InputError, match="ax must be 3 Matplotlib axes"):
        r1.plots.plot_run(run, [1, 2])
    with pytest.raises(r1.InputError, match="a figure is written as"):
        r1.plots.plot_run(run, file=tmp_path / "a.jpg")
