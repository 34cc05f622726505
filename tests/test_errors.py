import pytest

import robotics1 as r1

TREE = {
    "RobotFileError": ValueError,
    "UnknownNameError": LookupError,
    "InputError": ValueError,
    "TaskError": ValueError,
    "FormulaError": RuntimeError,
    "NotConverged": RuntimeError,
    "MissingExtraError": ImportError,
}


@pytest.mark.parametrize(("name", "builtin"), TREE.items())
def test_each_error_is_a_robotics1_error_and_the_builtin_it_means(name, builtin):
    error = getattr(r1, name)
    assert issubclass(error, r1.Robotics1Error)
    assert issubclass(error, builtin)


def test_the_tree_has_no_other_errors():
    assert {error.__name__ for error in r1.Robotics1Error.__subclasses__()} == set(TREE)


def test_robot_warning_is_a_user_warning_and_no_error():
    assert issubclass(r1.RobotWarning, UserWarning)
    assert not issubclass(r1.RobotWarning, r1.Robotics1Error)


def test_robot_file_error_says_path_and_line_before_the_message():
    error = r1.RobotFileError("the axis is zero", path="arm.urdf", line=7, element="q1")
    assert str(error) == "arm.urdf:7: the axis is zero"
    assert (error.path, error.line, error.element) == ("arm.urdf", 7, "q1")
    assert str(r1.RobotFileError("the axis is zero")) == "the axis is zero"


@pytest.mark.parametrize(
    ("name", "candidates", "message"),
    [
        ("tol", ["tool", "base"], "no frame 'tol'; did you mean 'tool'?"),
        ("xyz", ["tool", "base"], "no frame 'xyz'; there is 'tool', 'base'"),
        ("xyz", [], "no frame 'xyz'; there is none"),
    ],
)
def test_unknown_name_error_names_the_nearest_or_all(name, candidates, message):
    error = r1.UnknownNameError("frame", name, candidates)
    assert str(error) == message
    assert error.candidates == tuple(candidates)


def test_not_converged_carries_the_result():
    result = object()
    assert r1.NotConverged("no", result).result is result


def test_missing_extra_error_says_how_to_install_it():
    assert "pip install 'robotics1[viewer]'" in str(r1.MissingExtraError("meshcat", "viewer"))
