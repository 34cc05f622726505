"""A robot's file is read once: no question that is asked of a loaded robot parses XML, and nothing changes it."""

import copy
import pickle
import xml.etree.ElementTree as ET
from xml.parsers import expat

import numpy as np
import pinocchio as pin
import pytest
from arms import one_joint_file

import robotics1 as r1


@pytest.fixture
def parses(monkeypatch):
    """The list of parsers of XML that are made while a test runs."""
    made = []

    def counted(make):
        def counting(*arguments, **named):
            made.append(make)
            return make(*arguments, **named)

        return counting

    monkeypatch.setattr(expat, "ParserCreate", counted(expat.ParserCreate))
    monkeypatch.setattr(ET, "XMLParser", counted(ET.XMLParser))
    return made


def test_loading_a_file_is_seen_to_parse_it(parses):
    r1.load_robot("cylindrical")
    assert len(parses) == 1
    r1.load_robot("prr")
    assert len(parses) > 1


QUESTIONS = {
    "singularities": lambda robot: r1.find_singularities(robot, r1.PositionTask("xy")).branches,
    "formulas": lambda robot: r1.formulas(robot, r1.PositionTask("xy")).jacobian,
    "a point": lambda robot: r1.formulas(robot, r1.PositionTask("xy"), point=("d", 0, 0.1)).value,
    "a joint's frame": lambda robot: r1.formulas(robot, r1.PositionTask("xy", frame=robot.joint_names[-1])).value,
    "a DH table": r1.dh.urdf_to_dh,
    "inverse kinematics": lambda robot: r1.solve_ik(robot, r1.PositionTask("x"), [0.3], time_limit=0.1),
}


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("name", ["prr", "cylindrical", "planar_2r"])
def test_a_question_asked_of_a_loaded_robot_parses_no_xml(name, question, parses):
    robot = r1.load_robot(name)
    parses.clear()
    QUESTIONS[question](robot)
    QUESTIONS[question](pickle.loads(pickle.dumps(robot)))
    assert parses == []


def test_a_robot_of_a_table_is_made_without_xml(parses):
    robot = r1.robot_from_dh([("R", "a", 0, "d", 0.3), ("P", 0, "-b", 0, 0)], parameters={"a": 1, "b": 0.2, "d": -1})
    r1.formulas(robot.with_parameters({"a": 2.0}), r1.PositionTask()).jacobian  # noqa: B018
    assert parses == []


def test_polynomials_are_found_of_a_small_file_at_once_and_go_with_the_parameters(parses):
    """prr: link 3 is l2 from link 2, and the tool l3 from link 3."""
    robot = r1.load_robot("prr")
    placements = robot.placements
    assert placements["q3"].xyz == ({("l2",): 1.0}, {}, {})
    assert placements["tip"].xyz == ({("l3",): 1.0}, {}, {})
    longer = robot.with_parameters({"l2": 2.0})
    assert longer.joints[2].xyz == (2.0, 0.0, 0.0)
    parses.clear()
    assert longer.placements == placements
    assert parses == []


@pytest.mark.parametrize("text", ["1 if l &lt; 2 else l", "max(l, 0.5)"])
def test_a_length_that_is_a_polynomial_on_one_side_only_is_refused_where_both_are_near(tmp_path, text):
    robot = r1.load_robot(one_joint_file(tmp_path, "l", text), parameters={"l": 2.0 if "if" in text else 0.5})
    with pytest.raises(r1.FormulaError, match="xyz of joint 'tip' is no polynomial of degree 2 in the parameters"):
        r1.formulas(robot, r1.PositionTask("xy"))


def test_polynomials_of_other_lengths_are_found_again_where_the_file_has_others(tmp_path):
    """The tip is at l up to l = 2, and at l² from there."""
    robot = r1.load_robot(one_joint_file(tmp_path, "l", "l if l &lt; 2 else l*l"), parameters={"l": 1.0})
    assert robot.placements["tip"].xyz[0] == {("l",): 1.0}
    assert robot.with_parameters({"l": 4.0}).placements["tip"].xyz[0] == {("l", "l"): 1.0}


def test_a_robot_that_is_given_by_its_name_or_by_its_path_is_loaded_once(tmp_path, parses):
    path = tmp_path / "arm.urdf"
    path.write_text(r1.load_robot("planar_2r").urdf)
    for given in ("planar_2r", path):
        r1.forward_kinematics(given, [0, 0])
        parses.clear()
        r1.forward_kinematics(given, [0, 0.1])
        assert not parses


# --- nobody changes a robot


def test_limits_cannot_be_written_and_do_not_follow_the_model():
    robot = r1.load_robot("prr")
    lower = robot.lower.tolist()
    for copied in (robot, copy.deepcopy(robot), pickle.loads(pickle.dumps(robot))):
        for limits in (copied.lower, copied.upper, copied.max_velocity, copied.max_effort, copied.revolute):
            with pytest.raises(ValueError, match="read-only"):
                limits[:] = 0
    robot.model.lowerPositionLimit = np.full(3, -99.0)
    assert robot.lower.tolist() == lower


def test_no_solver_reports_success_outside_the_limits_after_the_model_has_changed():
    """planar_2r with q2 in [0.5, 1]: a target at the reach needs q2 = 0."""
    rows = [("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)]
    robot = r1.robot_from_dh(rows, lower=[None, 0.5], upper=[None, 1.0])
    task, inside, outside = r1.PositionTask("xy"), [1 + np.cos(0.7), np.sin(0.7)], [2.0, 0.0]
    ready = r1.IKSolver(robot, task)
    robot.model.lowerPositionLimit, robot.model.upperPositionLimit = np.full(2, -3.0), np.full(2, 3.0)
    for solver in (ready, r1.IKSolver(robot, task)):
        assert solver(inside).converged
        assert not solver(outside).converged
        assert not solver.solve_batch([outside]).converged.any()


def test_what_is_written_to_the_model_changes_no_answer_and_a_changed_model_is_a_robot_of_its_own():
    """planar_2r: the tip is at l1 + l2 = 2; joint 2 moved to 9 m makes 10 of it, of the other robot only."""
    robot = r1.robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)])
    for copied in (robot, copy.deepcopy(robot), pickle.loads(pickle.dumps(robot))):
        copied.model.jointPlacements[2].translation = np.array([9.0, 0, 0])
        assert r1.forward_kinematics(copied, [0, 0]).translation == pytest.approx([2, 0, 0])
        assert r1.ik_solutions(copied, r1.PositionTask("xy"), [0, 1.5]).complete
        other = r1.load_robot(copied.model, tool=robot.tool)
        assert r1.forward_kinematics(other, [0, 0]).translation == pytest.approx([10, 0, 0])


def test_the_model_and_the_data_of_a_robot_fit_each_other():
    panda = r1.load_robot("panda")
    q = panda.configuration("zero")
    pin.framesForwardKinematics(panda.model, panda.data, q)
    number = panda.model.getFrameId("panda_hand")
    assert panda.data.oMf[number].homogeneous == pytest.approx(
        r1.forward_kinematics(panda, q, frame="panda_hand").homogeneous, abs=1e-15
    )


def test_what_a_robot_was_loaded_with_is_copied(tmp_path):
    values, locked = {"l2": 0.5}, {"q1": 0.0}
    robot = r1.load_robot("prr", parameters=values, locked=locked)
    values["l2"], locked["q1"] = 9.0, 9.0
    assert r1.forward_kinematics(robot.with_parameters({"l3": 0.4}), [0, 0]).translation == pytest.approx([0.9, 0, 0])


def test_a_table_is_copied_and_cannot_be_written():
    lower, T = np.array([-1.0]), np.eye(4)
    table = r1.dh.DHTable([["R", 1, 0, 0, 0]], lower=lower, base_placement=T)
    lower[0], T[0, 3] = 5.0, 5.0
    assert (table.lower.tolist(), table.base_placement.translation.tolist()) == ([-1], [0, 0, 0])
    for copied in (table, copy.deepcopy(table), pickle.loads(pickle.dumps(table))):
        with pytest.raises(ValueError, match="read-only"):
            copied.lower[0] = 5.0
