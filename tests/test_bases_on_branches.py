"""Bases in symbols of the branches of the singular set keep their rank at special configurations too.

At multiples of π/2, at zero slides, and where the basis's own minors vanish, each has as many independent columns as
numbers have there, and spans the same; or `except_where` names the place.
"""

import numpy as np
import pytest
import sympy
from dh_arms import R, dh
from singular_arms import CASES, PLANE, POLAR, XYZ
from singular_checks import box_of, case, numbers, rank
from sweeps import some_of

from robotics1 import find_singularities

LONG = {"Puma 560", "UR5", "7R twist", "7R limited", "6R xyz", "Stanford", "5R twist", "gantry and wrist"}
QUICK = (
    "2R xy",
    "2R x",
    "3R pose",
    "PRR pose",
    "RPR pose",
    "RRP xyz",
    "RRP pointing",
    "3R arm of numbers xyz",
    "ZYZ wrist",
)
INDEPENDENT = 1e-6

pytestmark = pytest.mark.filterwarnings(
    "ignore:q has the angle:robotics1.RobotWarning"
)  # some turns away, by equations


def placed(branch, q, equation):
    """q with the joints moved on the branch, by Gauss-Newton steps on its equations; None if they do not lead there."""
    for _ in range(40):
        f = equation.f(q)[:, 0]
        f = np.where(equation.turns, np.angle(np.exp(1j * f)), f / equation.size)
        if np.abs(f).max() < 1e-15:
            break
        moved = [(equation.f(q + e) - equation.f(q - e))[:, 0] / (2e-6 * equation.size) for e in 1e-6 * np.eye(len(q))]
        q = q - np.linalg.lstsq(np.array(moved).T, f, rcond=1e-8)[0]
    return q if branch.contains(q) else None


def special(robot, branch, equation, rng, count):
    """Configurations on the branch near which most joints are at multiples of π/2 or zero, and random ones."""
    lower, upper = box_of(robot)
    for _ in range(count):
        at = np.where(robot.revolute, rng.choice([-np.pi / 2, 0, np.pi / 2, np.pi], robot.nq), 0.0)
        q = np.where(rng.random(robot.nq) < 0.8, at, rng.uniform(lower, upper))
        q = placed(branch, q, equation)
        if q is not None:
            yield q


class Basis:
    """A basis in symbols of a branch, in numbers."""

    def __init__(self, branch, robot, name):
        self.name, self.formulas, self.robot = name, branch.formulas, robot
        self.shape = getattr(branch.formulas, name).shape
        self.f = numbers(robot, getattr(branch.formulas, name)) if self.shape[1] else None

    def __call__(self, q):
        return np.zeros(self.shape) if self.f is None else self.f(q).reshape(self.shape)

    def is_independent(self, q):
        """Whether its unit columns are; not if one of them vanishes."""
        lengths = np.linalg.norm(self(q), axis=0)
        if lengths.min(initial=1.0) < 1e-9:
            return False
        return np.linalg.svd(self(q) / lengths, compute_uv=False).min(initial=1.0) > INDEPENDENT

    def is_excepted(self, q):
        """Whether q satisfies all equations of a place where the basis loses its rank."""
        for piece in self.formulas.except_where(self.name):
            f = numbers(self.robot, [condition.lhs - condition.rhs for condition in piece])(q)[:, 0]
            if np.abs(np.sin(f / 2)).max() < 1e-6:
                return True
        return False


def check(basis, J, orthogonal, q):
    """The basis at q has independent columns, or q is an exception; and is orthogonal to what it must be."""
    assert basis.is_independent(q) or basis.is_excepted(q), (basis.name, q)
    B = basis(q)
    assert np.abs(orthogonal.T @ B).max(initial=0) <= 1e-8 * max(1.0, np.abs(J).max()) * max(
        1.0, np.abs(B).max(initial=0)
    )


def check_all(name, count):
    robot, task, _, found, usual, equations = case(name)
    rng = np.random.default_rng(11)
    for branch, equation in list(zip(found.branches, equations, strict=True))[:4]:
        names = ("null",) if task is POLAR else ("null", "range", "left_null")
        bases = [Basis(branch, robot, basis) for basis in names]
        for q in special(robot, branch, equation, rng, count):
            J = task.jacobian(robot, q)
            if rank(robot, task, q, usual) != branch.rank or np.abs(J).max(initial=0) > 1e3:
                continue  # deeper in the singular set, or beside the pole of polar coordinates
            U = np.linalg.svd(J)[0]
            for basis, orthogonal in zip(bases, (J.T, U[:, branch.rank :], J), strict=False):
                check(basis, J, orthogonal, q)


@pytest.mark.filterwarnings(
    "ignore:q has the angle:robotics1.RobotWarning"
)  # values that solve equations, some turns away
@pytest.mark.parametrize("name", QUICK)
def test_bases_keep_their_rank_at_special_configurations_of_the_branch(name):
    check_all(name, 10)


@pytest.mark.parametrize("name", some_of((name for name in CASES if name not in LONG), 12))
def test_bases_keep_their_rank_at_special_configurations_of_the_branches_of_every_arm(name):
    check_all(name, 30)


def test_the_range_of_a_planar_3r_with_q2_0_has_rank_2_at_q3_0_too():
    robot = dh(R(1, 0, 0), R(1, 0, 0), R(1, 0, 0))
    found = find_singularities(robot, PLANE)
    assert len(found.branches) == 2
    for branch in found.branches:
        for q3 in (0.0, np.pi, 0.3, np.pi / 2):
            q = np.array([0.4, branch.values["q2"], q3])
            B = numbers(robot, branch.formulas.range)(q)
            assert np.linalg.matrix_rank(B, tol=1e-9) == 2
            assert np.linalg.matrix_rank(np.hstack([B, PLANE.jacobian(robot, q)]), tol=1e-9) == 2
        assert branch.formulas.except_where("range") == ()


def test_where_no_basis_was_found_that_holds_everywhere_the_exceptions_are_equations_of_joints():
    for name in ("3R arm xyz", "RRP xyz"):
        robot, _, _, found, *_ = case(name)
        symbols = set(sympy.symbols(f"q1:{robot.nq + 1}", real=True))
        for branch in found.branches:
            for basis in ("null", "range", "left_null"):
                for piece in branch.formulas.except_where(basis):
                    assert piece
                    assert all(equation.free_symbols & symbols for equation in piece)


def test_a_basis_without_columns_has_no_exceptions():
    found = case("3R arm xyz")[3]
    assert found.task is XYZ
    assert found.generic_bases.null.shape == (3, 0)
    assert found.generic_bases.except_where("null") == ()
