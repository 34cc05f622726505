"""Whatever makes a robot reads limits in the same way: None is no limit, and what is none is refused."""

import numpy as np
import pytest

import robotics1 as r1

TURN = [[0, 0, 1], [0, 0, 0]]
MAKERS = {
    "a DH table": lambda **limits: r1.robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)], **limits),
    "a planar arm": lambda **limits: r1.textbook_robots.planar_arm("RR", [1, 1], **limits),
    "transforms": lambda **limits: r1.textbook_robots.robot_from_transforms(
        ["Rz(q1)", "Tx(1)", "Rz(q2)", "Tx(1)"], **limits
    ),
    "a formula": lambda **limits: r1.textbook_robots.robot_from_formula(["cos(q1)", "sin(q2)"], joints="RR", **limits),
    "screws": lambda **limits: r1.rigid_motions.robot_from_screws(
        np.eye(4), space=[TURN, [[0, 0, 1], [0, -1, 0]]], **limits
    ),
}
WRONG = {
    "the wrong way round": ({"lower": [0, 1], "upper": [1, 0.5]}, "limits of q2 must have lower ≤ upper"),
    "an infinite lower limit": ({"lower": [np.inf, 0]}, "limits of q1 must have lower ≤ upper"),
    "an infinite upper limit below": ({"upper": [1, -np.inf]}, "limits of q2 must have lower ≤ upper"),
    "no number": ({"lower": [0, np.nan]}, "lower must have one number or None for each of 2 joints"),
    "one too few": ({"upper": [1]}, "upper must have one number or None for each of 2 joints"),
    "a text": ({"upper": ["1", "a"]}, "upper must have one number or None for each of 2 joints"),
    "one number": ({"upper": 1.0}, "upper must have one number or None for each of 2 joints"),
    "beyond all size": ({"upper": [1e300, None]}, r"at most 1e\+18 can be computed with"),
}


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_limits_are_those_that_are_given_and_none_is_no_limit(make):
    robot = make(lower=[None, -0.5], upper=[2, None])
    assert robot.lower.tolist() == [-np.inf, -0.5]
    assert robot.upper.tolist() == [2, np.inf]
    assert np.isinf([*make().lower, *make().upper]).all()


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
@pytest.mark.parametrize(("limits", "sentence"), WRONG.values(), ids=WRONG)
def test_limits_that_are_none_are_refused(make, limits, sentence):
    with pytest.raises(r1.InputError, match=sentence):
        make(**limits)


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_limits_in_degrees_are_asked_about(make):
    with pytest.warns(r1.RobotWarning, match=r"a limit has the angle -170, .* write radians\(-170\)"):
        make(lower=[-170, None], upper=[170, None])


def test_a_limit_of_45_may_be_in_degrees_and_one_of_30_is_some_turns(recwarn):
    rows = [("R", 1, 0, 0, 0)]
    r1.robot_from_dh(rows, lower=[-30], upper=[30])
    assert not recwarn
    with pytest.warns(r1.RobotWarning, match=r"write radians\(45\)"):
        r1.robot_from_dh(rows, lower=[-1], upper=[45])
