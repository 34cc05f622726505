"""Every public object, and every error, can be pickled and copied, and its copy is the same."""

import copy
import dataclasses
import importlib
import inspect
import pickle
import pkgutil
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
from arms import arm
from observation import observed
from public_names import PUBLIC
from public_objects import INSTANCES, robots

import robotics1 as r1

CLASSES = [name for name, kind in PUBLIC.items() if inspect.isclass(kind) and not issubclass(kind, Exception)]
Frozen = next(kind for kind in r1.ik.IKBatch.__mro__ if kind.__name__ == "Frozen")  # what results inherit


def pickled(x):
    return pickle.loads(pickle.dumps(x))


def test_every_public_class_has_an_instance_here():
    """A new public class must be added to the table."""
    assert sorted(INSTANCES) == sorted(CLASSES)


@pytest.mark.parametrize("name", CLASSES)
def test_a_copy_of_a_public_object_is_the_same(name):
    instances = INSTANCES[name]()
    assert instances
    for x in instances:
        fresh, _ = pickled(x), copy.deepcopy(x)
        values = observed(x)  # fills what is cached, which must not stand in the way
        replaced = [dataclasses.replace(x)] if dataclasses.is_dataclass(x) else []  # its arguments are its fields
        for other in (fresh, pickled(x), pickled(fresh), copy.deepcopy(x), copy.copy(x), *replaced):
            assert type(other) is type(x)
            assert observed(other) == values
            assert (x == other) in (True, False)
            assert (x != other) in (True, False)


def arrays_in(x):
    """Arrays that a result holds itself, in tuples, or in the results in it."""
    if isinstance(x, np.ndarray):
        yield x
    elif isinstance(x, tuple):
        for value in x:
            yield from arrays_in(value)
    elif isinstance(x, Frozen):
        yield from arrays_in(tuple(vars(x).values()))


@pytest.mark.parametrize("name", [name for name in CLASSES if issubclass(PUBLIC[name], Frozen)])
def test_nobody_can_write_into_the_arrays_of_a_result_or_of_its_copies(name):
    found = 0
    for x in INSTANCES[name]():
        for other in (x, pickled(x), copy.deepcopy(x), copy.copy(x)):
            arrays = list(arrays_in(other))
            found += len(arrays)
            assert not any(array.flags.writeable for array in arrays)
    assert found or name in (
        "ConfigurationFormulas",
        "Formulas",
        "Intersections",
        "FormulaPath",
        "IKBranch",
        "IKFormulas",
        "TrigSolutions",
        "WorkspaceFormulas",
    )  # which hold formulas alone


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))  # SymPy, for a point, has no lower one
def test_a_robot_can_be_pickled_by_every_protocol(protocol):
    for robot in robots().values():
        other = pickle.loads(pickle.dumps(robot, protocol))
        assert observed(other) == observed(robot)


def test_forward_kinematics_and_jacobian_of_a_pickled_robot_are_the_same_bits():
    for robot in robots().values():
        other, q = pickled(robot), np.full(robot.nq, 0.3)
        qdot = np.linspace(-1, 1, robot.nv)
        for frame in (other.frame_names[-1], other.frame_names[1]):
            T, S = (r1.forward_kinematics(r, q, frame=frame).homogeneous for r in (robot, other))
            assert (T == S).all()
            J, K = (r1.frame_jacobian_rate(r, q, qdot, frame=frame) for r in (robot, other))
            assert (J == K).all()


def test_a_pickled_solver_gives_the_same_answers_and_takes_its_options_with_it():
    robot = arm("six_r")
    solver = r1.IKSolver(robot, r1.PoseTask(), seed=7, tolerance=1e-9, prefer="near")
    target = r1.forward_kinematics(robot, np.linspace(0.1, 0.7, 6))
    for other in (pickled(solver), copy.deepcopy(solver)):
        assert other(target) == solver(target)
        assert other(target, np.zeros(6)) == solver(target, np.zeros(6))
        assert (other.solve_batch([target, target]).q == solver.solve_batch([target, target]).q).all()


def test_with_parameters_of_a_pickled_robot_moves_the_tool():
    """Planar arm at q = 0: the tool is at l1 + l2."""
    robot = pickled(pickled(arm("planar_2r")).with_parameters({"l1": 0.5}))
    assert dict(robot.parameters) == {"l1": 0.5, "l2": 0.8}
    longer = robot.with_parameters({"l2": 2.0})
    assert r1.forward_kinematics(longer, [0, 0]).translation == pytest.approx([2.5, 0, 0], abs=1e-12)
    assert r1.forward_kinematics(robot, [0, 0]).translation == pytest.approx([1.3, 0, 0], abs=1e-12)


def test_with_parameters_keeps_the_limits_of_a_table():
    rows = [("P", 0, 0, "d", 0), ("R", "a", 0, 0, 0)]
    robot = r1.robot_from_dh(rows, parameters={"a": 1, "d": 2}, lower=[None, -1], upper=[3, None])
    other = robot.with_parameters({"a": 4})
    assert dict(other.parameters) == {"d": 2, "a": 4}
    assert other.lower.tolist() == [-np.inf, -1]
    assert other.upper.tolist() == [3, np.inf]
    assert other.warnings == ()


def test_with_parameters_of_a_robot_with_a_point_moves_the_point():
    robot = pickled(r1.formulas(arm("planar_2r"), r1.PositionTask("xy"), point=["d", 0, 0]).robot)
    moved = robot.with_parameters({"d": 3.0}).with_parameters({"l1": 1.0})
    assert r1.forward_kinematics(moved, [0, 0], frame="point").translation[0] == pytest.approx(1.0 + 0.8 + 3.0)


def test_with_parameters_says_what_is_wrong():
    with pytest.raises(r1.InputError, match="'six_r' has no named parameters"):
        arm("six_r").with_parameters({"l1": 1})
    with pytest.raises(r1.UnknownNameError, match=r"'l3'.*there is "):
        arm("planar_2r").with_parameters({"l3": 1})
    for wrong in ({"l1": np.nan}, {"l1": "long"}, [("l1", 1)], {1: 1}):
        with pytest.raises(r1.InputError):
            arm("planar_2r").with_parameters(wrong)


def test_parameters_cannot_be_written():
    with pytest.raises(TypeError):
        pickled(arm("planar_2r")).parameters["l1"] = 2.0


def test_a_lambda_in_a_task_is_refused_by_pickle_itself():
    with pytest.raises((pickle.PicklingError, AttributeError), match="lambda"):
        pickle.dumps(r1.FunctionTask(lambda p, R, q: p, 3))


# --- errors


class MineError(r1.UnknownNameError):
    """An error of a user's own, with other arguments."""

    def __init__(self, *, number):
        super().__init__("robot named", "ur6", ["ur5"], " in my list")
        self.number = number


ERRORS = {
    "FormulaError": lambda: r1.FormulaError("no formula"),
    "InputError": lambda: r1.InputError("q is wrong"),
    "MineError": lambda: MineError(number=3),
    "MissingExtraError": lambda: r1.MissingExtraError("meshcat", "viewer"),
    "NotConverged": lambda: r1.NotConverged("no", r1.solve_ik(arm("planar_2r"), r1.PositionTask("xy"), [9, 9])),
    "RobotFileError": lambda: r1.RobotFileError("no robot", path=Path("arm.urdf"), line=3, element="j1"),
    "Robotics1Error": lambda: r1.Robotics1Error("anything", 2),
    "TaskError": lambda: r1.TaskError("no task"),
    "UnknownNameError": lambda: r1.UnknownNameError("frame named", "tol", ["tool", "base"]),
}


def every_error(kind=r1.Robotics1Error):
    return {kind}.union(*map(every_error, kind.__subclasses__()))


def raise_it(name):
    raise ERRORS[name]()


def assert_same_error(found, wanted):
    assert type(found) is type(wanted)
    assert str(found) == str(wanted)
    assert found.args == wanted.args
    assert vars(found) == vars(wanted)
    assert getattr(found, "msg", None) == getattr(wanted, "msg", None)


def test_every_error_has_an_instance_here():
    for module in pkgutil.walk_packages(r1.__path__, "robotics1."):
        importlib.import_module(module.name)
    assert sorted(ERRORS) == sorted(kind.__name__ for kind in every_error())


@pytest.mark.parametrize("name", ERRORS)
def test_a_copy_of_an_error_has_its_message_and_its_data(name):
    error = ERRORS[name]()
    error.add_note("while the arm was being read")
    copies = [pickle.loads(pickle.dumps(error, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    for found in (*copies, copy.copy(error), copy.deepcopy(error), pickled(copies[0])):
        assert_same_error(found, error)


def test_an_error_comes_back_from_a_worker_with_its_data():
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        futures = {name: pool.submit(raise_it, name) for name in ERRORS}
        for name, future in futures.items():
            assert_same_error(future.exception(timeout=120), ERRORS[name]())


def test_a_warning_can_be_pickled():
    assert str(pickled(r1.RobotWarning("odd"))) == "odd"


@pytest.mark.parametrize("name", [name for name in CLASSES if issubclass(PUBLIC[name], Frozen)])
def test_the_repr_of_a_result_is_one_line(name):
    for x in INSTANCES[name]():
        text = repr(x)
        assert text.startswith(f"{type(x).__name__}(")
        assert text.endswith(")")
        assert "\n" not in text
        assert len(text) < 700
