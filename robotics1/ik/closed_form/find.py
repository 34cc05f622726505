"""From a robot and a task to the formulas of all solutions."""

from __future__ import annotations

import numpy as np
import sympy

from robotics1.errors import FormulaError, Robotics1Error, TaskError
from robotics1.ik.added_joints import way_to_all_solutions
from robotics1.ik.closed_form.comparison import verify
from robotics1.ik.closed_form.equations import PartOfChain
from robotics1.ik.closed_form.family import IKFormulas
from robotics1.ik.closed_form.links import Links, links_of, with_the_frame_as_a_link
from robotics1.ik.closed_form.one_polynomial import NoEquation
from robotics1.ik.closed_form.peeling import Peeling
from robotics1.ik.closed_form.target import Target, TargetChain, is_given, number_given, symbolic_target
from robotics1.ik.closed_form.trial_point import trial_point
from robotics1.ik.scaled_task import scaled_task
from robotics1.inputs import positive_number
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.chain import chain_to
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.polynomials.trig_polynomial import Matrix
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import FrameMap, Task

PLACES = 3  # random q at which the rank of J is taken
VANISHES = 1e-9  # a singular value of J [m or 1]
LITTLE = 5.0  # s: for the arms of six joints that probably have no formulas
OPEN = 1.0  # m: the range of a slide without limits, which makes no difference to the method
POLYNOMIAL = (
    "its solutions are the real roots of a polynomial of degree 16 at most (Raghavan and Roth, 1993), "
    "all of which ik_solutions finds by {method}"
)


def ik_formulas(robot: RobotLike, task: TaskLike, *, time_limit: float = 30.0) -> IKFormulas:
    """Return the formulas of every solution of f(q) = r_d, in the target's symbols and the robot's named lengths.

    Joint after joint is found from equations with one unknown: a sin θ + b cos θ = c, sin θ and cos θ together, or a
    polynomial in a prismatic joint of degree one or two. They come from the pose between two links with known joints
    on the side of the target, and from distances that other joints do not change. The formulas are compared with
    Pinocchio at random q and lengths before they are returned.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q): coordinates of a frame, polar ones too, its rotation, its pose, its angle in a plane, the
            direction of its x, y or z axis, or several of these.
        time_limit: of the search for formulas [s]; of an arm of six joints none of which are special, for whose
            solutions there is a polynomial of degree 16 but no formula, at most 5.

    Raises:
        TaskError: the task does not fit the robot, no joint moves it, or more joints do than it has rows.
        InputError: the time limit is no positive number.
        FormulaError: no closed formula is found in the time, or it does not agree with Pinocchio; the message says
            what finds the solutions.

    Source: Paul, Robot Manipulators, 1981, chapter 3; Craig, Introduction to Robotics, 2005, chapter 4.
    """
    robot, task = robot_and_task(robot, task)
    task.check_integrable(robot)
    form = task.frame_map()
    if form is None:
        raise FormulaError(f"inverse formulas are written for tasks on a frame, not for {task!r}")
    limit = positive_number("time_limit", time_limit)
    if _is_general(_method_of(robot, task)):
        limit = min(limit, LITTLE)
    try:
        with TimeLimit(limit).kept():
            try:
                return _found(robot, task, form, thorough=False)
            except (FormulaError, NoEquation):
                return _found(robot, task, form, thorough=True)
    except NoEquation as left:
        error = FormulaError(f"{left}; {_other_way(robot, task)}{left.remains}")
        error.polynomial, error.joint = left.polynomial, left.joint
        raise error from None
    except OutOfTime:
        raise FormulaError(f"no closed formula is found in {limit:g} s; {_other_way(robot, task)}") from None


def _found(robot: Robot, task: Task, form: FrameMap, *, thorough: bool) -> IKFormulas:
    """Return the formulas; `thorough` tries longer equations where shorter ones leave a choice."""
    found = chain_to(robot, robot.link_of(form.frame))
    chain = TargetChain(found.robot, found.frame, found.joints, found.turns)
    links = links_of(chain, _axes(robot, chain, form))
    target = symbolic_target(chain, task, form, links.pose)
    moving = _moving(chain, links, target)
    _check_number(robot, task, [n for n, q in enumerate(chain.q) if q in moving])
    peeling = _peeling(chain, links, target, moving, thorough=thorough)
    constraints = peeling.constraints() if len(moving) < task.rows else ()
    joints = peeling.solve()
    names = dict(zip(chain.q, robot.joint_names, strict=True))
    formulas = IKFormulas(
        robot=robot,
        task=task,
        target=target.symbols,
        places=target.places,
        names=tuple(names[joint.q] for joint in joints),
        joints=joints,
        constraints=constraints,
        free_joints=tuple(names[q] for q in chain.q if q not in moving),
    )
    verify(formulas)
    return formulas


def _axes(robot: Robot, chain: TargetChain, form: FrameMap) -> Matrix | None:
    """Return the constant rotation to the axes that the task is written in; None for the world's."""
    if form.reference == "world":
        return None
    joints = robot.joints_to(robot.link_of(None if form.reference == "tool" else form.reference))
    return chain.turn(joints).T


def _moving(chain: TargetChain, links: Links, target: Target) -> set[sympy.Symbol]:
    """Return the joints that move what the target gives."""
    (R, p), (R_d, p_d) = links.pose, target.pose
    entries = zip([*R.flat, *p], [*R_d.flat, *p_d], strict=True)
    given = [f for f, entry in entries if is_given(entry, target.definitions)]
    return {symbol for f in given for symbol in f.symbols} & set(chain.q)


def _check_number(robot: Robot, task: Task, moving: list[int]) -> None:
    """Refuse an arm whose targets have infinitely many solutions, or none but by chance."""
    if not moving:
        raise TaskError(f"no joint of robot {robot.name!r} moves the task, so that there is nothing to solve for")
    if len(moving) > task.rows:
        raise TaskError(
            f"{len(moving)} joints of robot {robot.name!r} move a task of {task.rows} rows, so that a target has "
            f"infinitely many solutions; load the robot with some joints locked, or add rows to the task"
        )
    rng = np.random.default_rng(0)
    trials = [rng.uniform(-1, 1, robot.nq) * np.where(robot.revolute, np.pi, robot.reach) for _ in range(PLACES)]
    rank = max(np.linalg.matrix_rank(task.jacobian(robot, q)[:, moving], tol=VANISHES) for q in trials)
    if rank < len(moving):
        raise TaskError(
            f"{len(moving)} joints of robot {robot.name!r} move the task, but the rank of its Jacobian is {rank} at "
            f"most, so that a target has infinitely many solutions or none; load the robot with some joints locked"
        )


def _peeling(chain: TargetChain, links: Links, target: Target, moving: set[sympy.Symbol], *, thorough: bool) -> Peeling:
    """Return the beginning: all joints between the world and the last link, whose pose the target gives."""
    trial = trial_point({*chain.q, *chain.angles}, dict(chain.robot.parameters))
    R, in_the_last_link = target.pose[0], target.pose[0] @ links.tool[0].T
    if number_given(in_the_last_link, target.definitions) < number_given(R, target.definitions):
        links = with_the_frame_as_a_link(chain, links)
    part = PartOfChain(chain, links, 0, len(links.steps), target.pose[0], target.pose[1], links.tool[1])
    peeling = Peeling(chain, target, part, target.definitions, set(moving), trial, thorough)
    peeling.begin(target.pose[0] @ links.tool[0].T)
    return peeling


def _other_way(robot: Robot, task: Task) -> str:
    """Return the method by which `ik_solutions` finds the numbers, in half a sentence."""
    method = _method_of(robot, task)
    if method is None:
        return "ik_solutions finds the numbers, by a search"
    if _is_general(method):
        return POLYNOMIAL.format(method=method)
    return f"ik_solutions finds the numbers, by {method}"


def _method_of(robot: Robot, task: Task) -> str | None:
    """Return the name of the method of `ik_solutions` that finds all solutions; None where it searches."""
    slides = ~robot.revolute & ~(np.isfinite(robot.lower) & np.isfinite(robot.upper))
    box = {name: (-OPEN, OPEN) for name, is_open in zip(robot.joint_names, slides, strict=True) if is_open}
    try:
        problem = scaled_task(robot, task, box or None)
    except Robotics1Error:
        return None
    form = way_to_all_solutions(problem)
    return None if form is None else form.method


def _is_general(method: str | None) -> bool:
    """Whether no three joints of six are special, so that formulas joint after joint are not to be expected."""
    return method == "elimination to an eigenvalue problem"
