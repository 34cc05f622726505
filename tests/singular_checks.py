"""Singular sets looked at from outside: their equations and bases in numbers, and a search that knows J alone."""

from functools import cache
from itertools import product

import numpy as np
import sympy
from singular_arms import CASES

from robotics1 import find_singularities

RANK = 1e-9  # σᵢ that count, beside the usual σ₁
SPECIAL = np.array([-np.pi / 2, 0.0, np.pi / 2, np.pi])


def unitless(robot, task, q):
    """J(q) with lengths in reaches."""
    rows = [1 / robot.reach if unit == "m" else 1.0 for unit in task.row_units]
    return np.array(rows)[:, None] * task.jacobian(robot, q) * units(robot)


def units(robot):
    return np.where(robot.revolute, 1.0, robot.reach)


def box_of(robot):
    """Lower and upper ends of the joints: the limits, else ±π or two reaches."""
    most = np.where(robot.revolute, np.pi, 2 * robot.reach)
    return np.maximum(robot.lower, -most), np.minimum(robot.upper, most)


def usual_sigma(robot, task):
    """The largest σ₁ at some random configurations: what singular values are small beside."""
    sample = np.random.default_rng(7).uniform(*box_of(robot), (16, robot.nq))
    return max(np.linalg.svd(unitless(robot, task, q), compute_uv=False)[0] for q in sample)


def rank(robot, task, q, usual):
    return int((np.linalg.svd(unitless(robot, task, q), compute_uv=False) > RANK * usual).sum())


def unit_columns(M):
    """M with its columns, but those that vanish, made as long as one."""
    return M / np.maximum(np.linalg.norm(M, axis=0), 1e-300)


def spans_range(basis, J, tol=1e-8):
    """Whether the columns of a basis span the range of J."""
    A, B = unit_columns(basis), J / max(1.0, np.abs(J).max())
    ranks = [np.linalg.matrix_rank(M, tol=tol) if M.size else 0 for M in (A, B, np.hstack([A, B]))]
    return ranks[0] == ranks[1] == ranks[2]


# --- formulas in numbers


def numbers(robot, expressions):
    """A matrix in q1, q2, ... and the robot's lengths as a function of q; any other symbol in it is an error.

    The lengths are the decimal fractions that they are written as: acos(−a1/(a2 − a3)) is π where a1 = a2 − a3, and not
    the 3e-8 less that rounding makes of it.
    """
    q = sympy.symbols(f"q1:{robot.nq + 1}", real=True)
    values = {sympy.Symbol(name, real=True): sympy.Rational(str(value)) for name, value in robot.parameters.items()}
    M = sympy.Matrix(expressions).xreplace(values)
    assert M.free_symbols <= set(q)
    f = sympy.lambdify(q, M, modules="numpy", cse=True)
    return lambda x: np.asarray(f(*x), dtype=float)


class Equations:
    """The conditions of a branch: sums of angles up to whole turns, f = 0 beside the usual size of f."""

    def __init__(self, robot, branch):
        assert branch.conditions
        assert all(isinstance(condition, sympy.Eq) for condition in branch.conditions)
        q = sympy.symbols(f"q1:{robot.nq + 1}", real=True)
        angles = {symbol for symbol, turns in zip(q, robot.revolute, strict=True) if turns}
        sides = [(condition.lhs, condition.rhs) for condition in branch.conditions]
        self.f = numbers(robot, [lhs - rhs for lhs, rhs in sides])
        self.turns = np.array([lhs.free_symbols <= angles and lhs.is_polynomial() for lhs, _ in sides])
        sample = np.random.default_rng(5).uniform(*box_of(robot), (20, robot.nq))
        sizes = np.max([np.abs(self.f(x)[:, 0]) for x in sample], axis=0)
        self.size = np.where([lhs.is_Symbol for lhs, _ in sides], 1.0, sizes)

    def __call__(self, x):
        """Return the largest of |lhs − rhs| at x."""
        f = self.f(x)[:, 0]
        return float(np.abs(np.where(self.turns, np.angle(np.exp(1j * f)), f / self.size)).max())


def written(conditions):
    """Equations as a set of expressions that vanish, without common number and sign, to be compared."""
    parts = [sympy.expand(condition.lhs - condition.rhs).primitive()[1] for condition in conditions]
    return frozenset(-x if x.could_extract_minus_sign() else x for x in parts)


def read(text, robot):
    """The sets of equations that "q2 = 0 | pi; q3 = 0" stands for, written as above: a choice of values, and more."""
    names = [f"q{i}" for i in range(1, robot.nq + 1)] + list(robot.parameters)
    known = {name: sympy.Symbol(name, real=True) for name in names}
    choices = []
    for equation in text.split(";"):
        left, right = equation.split("=")
        choices.append(
            [sympy.Eq(*(sympy.sympify(x, known) for x in (left, value)), evaluate=False) for value in right.split("|")]
        )
    return [written(choice) for choice in product(*choices)]


@cache
def case(name):
    """robot, task, ρ, the set, the usual σ₁, the equations of each branch."""
    make, task, generic, _ = CASES[name]
    robot = make()
    found = find_singularities(robot, task, method="symbolic", time_limit=600)
    return robot, task, generic, found, usual_sigma(robot, task), [Equations(robot, b) for b in found.branches]


# --- the search


def singular_near(robot, task, q, order, usual, steps=60):
    """Return a configuration inside the joints' limits at which the rank is below `order`, or None.

    There J has k = m − order + 1 left null vectors, Jᵀ U = 0 with Uᵀ U = 1: solved for (q, U) by Gauss-Newton steps.
    """
    U = np.linalg.svd(unitless(robot, task, q))[0][:, order - 1 :]
    m, k = U.shape
    unit = units(robot)
    directions = np.eye(m * k).reshape(-1, m, k)
    for _ in range(steps):
        J = unitless(robot, task, q)
        F = np.concatenate([(J.T @ U).ravel(), (U.T @ U - np.eye(k)).ravel()])
        if np.abs(F).max() < 1e-14 * usual:
            break
        moved = [(unitless(robot, task, q + e) - unitless(robot, task, q - e)) / 2e-6 for e in 1e-6 * np.diag(unit)]
        by_q = [np.concatenate([(dJ.T @ U).ravel(), np.zeros(k * k)]) for dJ in moved]
        by_U = [np.concatenate([(J.T @ D).ravel(), (D.T @ U + U.T @ D).ravel()]) for D in directions]
        step = np.linalg.lstsq(np.array([*by_q, *by_U]).T, -F, rcond=1e-8)[0]
        move, turn = step[: len(q)], step[len(q) :].reshape(m, k)
        q = q + unit * move * min(1.0, 0.5 / max(np.abs(move).max(), 1e-300))
        U = np.linalg.qr(U + turn)[0]
    lower, upper = box_of(robot)
    whole = robot.revolute & (upper - lower > 2 * np.pi - 1e-6)
    q = np.where(whole, np.angle(np.exp(1j * q)), q)
    gap = np.linalg.svd(unitless(robot, task, q), compute_uv=False)[order - 1]
    return q if gap <= 1e-13 * usual and ((q >= lower - 1e-9) & (q <= upper + 1e-9)).all() else None


def starts(robot, count, rng):
    """Yield random configurations, in every other one some joints near multiples of π/2, and slides near zero."""
    lower, upper = box_of(robot)
    for i in range(count):
        q = rng.uniform(lower, upper)
        if i % 2:
            special = np.where(robot.revolute, rng.choice(SPECIAL, len(q)), 0.0)
            q = np.where(rng.random(len(q)) < 0.6, special + 0.01 * rng.standard_normal(len(q)), q)
        yield np.clip(q, lower, upper)


def corners(robot, count, rng):
    """Yield configurations inside the limits, most of whose joints are at multiples of π/2 and slides at zero."""
    lower, upper = box_of(robot)
    for _ in range(count):
        special = np.where(robot.revolute, rng.choice(SPECIAL, robot.nq), 0.0)
        q = np.where(rng.random(robot.nq) < 0.75, special, rng.uniform(lower, upper))
        if ((q >= lower) & (q <= upper)).all():
            yield q
