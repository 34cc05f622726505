"""Exercise 1: the singularities of the PRR robot, and its statics in one of them."""

from collections.abc import Callable
from math import pi

import numpy as np
import numpy.typing as npt

from robotics1.analysis.spaces import subspaces
from robotics1.analysis.statics import balancing_torque
from robotics1.exams.comparison import Comparison
from robotics1.exams.exam_2025_01_13 import FORCE, POINT, POSE, Exercise1
from robotics1.inputs import Array
from robotics1.robot.loading import load_robot
from robotics1.robot.model import Robot


def check_exercise_1(comparison: Comparison, one: Exercise1) -> None:
    """Check exercise 1."""
    _pose_formulas(comparison)
    _point_formulas(comparison)
    _static_formulas(comparison)
    values = sorted(branch.values["q2"] for branch in one.pose.branches)
    comparison.numbers("1", "(p, φ): number of singular values of q2", "2", len(values))
    comparison.formula("1", "(p, φ): singular q2", "q2 = ±π/2", lambda _: np.array(values) - [-pi / 2, pi / 2])
    pairs = sorted((branch.values["q2"], branch.values["q3"]) for branch in one.point.branches)
    printed = [(-pi / 2, 0), (-pi / 2, pi), (pi / 2, 0), (pi / 2, pi)]
    comparison.numbers("1", "p: number of singular (q2, q3)", "4", len(pairs))
    comparison.formula(
        "1", "p: singular (q2, q3)", "(π/2, 0), (π/2, π), (−π/2, 0), (−π/2, π)", lambda _: np.subtract(pairs, printed)
    )
    free = [name == "q1" for name in one.pose.free_joints + one.point.free_joints]
    comparison.numbers("1", "q1 never matters (of 2 tasks)", "2", sum(free))
    comparison.numbers("1c", "rank of J_p at q_s", "1", one.spaces.rank)


def _pose_formulas(comparison: Comparison) -> None:
    """The task (p, φ) of the PRR robot."""
    _add(comparison, "1", "r(q)", "(q1 + l2 c2 + l3 c23, l2 s2 + l3 s23, q2 + q3)", _pose_value)
    _add(
        comparison,
        "1",
        "J_r(q)",
        "[1, −l2 s2 − l3 s23, −l3 s23; 0, l2 c2 + l3 c23, l3 c23; 0, 1, 1]",
        lambda robot, q, l2, l3: POSE.jacobian(robot, q) - _J_r(q, l2, l3),
    )
    _add(
        comparison,
        "1",
        "det J_r",
        "l2 cos q2",
        lambda robot, q, l2, l3: np.linalg.det(POSE.jacobian(robot, q)) - l2 * np.cos(q[1]),
    )
    for sign, name in ((1, "π/2"), (-1, "−π/2")):
        _pose_at(comparison, sign, name)
    _add(comparison, "1b", "velocities that cannot be realised", "ṙ3 l3 sin q3 + ṙ2 ≠ 0", _unrealisable)


def _pose_at(comparison: Comparison, sign: int, name: str) -> None:
    """The two singular configurations, q2 = ±π/2."""

    def at(robot: Robot, q: Array) -> Array:
        return POSE.jacobian(robot, np.array([q[0], sign * pi / 2, q[2]]))

    _add(
        comparison,
        "1",
        f"J_r at q2 = {name}",
        "[1, −l2 − l3 c3, −l3 c3; 0, −l3 s3, −l3 s3; 0, 1, 1]"
        if sign > 0
        else "[1, l2 + l3 c3, l3 c3; 0, l3 s3, l3 s3; 0, 1, 1]",
        lambda robot, q, l2, l3: (
            at(robot, q)
            - [
                [1, -sign * (l2 + l3 * np.cos(q[2])), -sign * l3 * np.cos(q[2])],
                [0, -sign * l3 * np.sin(q[2]), -sign * l3 * np.sin(q[2])],
                [0, 1, 1],
            ]
        ),
    )
    _add(
        comparison,
        "1a",
        f"null space at q2 = {name}",
        "ν (l2, 1, −1)" if sign > 0 else "ν (l2, −1, 1)",
        lambda robot, q, l2, l3: _outside(subspaces(at(robot, q)).null, np.array([l2, sign, -sign])),
    )
    _add(
        comparison,
        "1b",
        f"null space of the transpose at q2 = {name}",
        "μ (0, 1, l3 s3)" if sign > 0 else "μ (0, −1, l3 s3)",
        lambda robot, q, l2, l3: _outside(subspaces(at(robot, q)).left_null, np.array([0, sign, l3 * np.sin(q[2])])),
    )


def _point_formulas(comparison: Comparison) -> None:
    """The task p of the PRR robot."""
    _add(
        comparison,
        "1",
        "J_p(q)",
        "the first two rows of J_r",
        lambda robot, q, l2, l3: POINT.jacobian(robot, q) - _J_r(q, l2, l3)[:2],
    )
    _add(
        comparison,
        "1",
        "det J_−1",
        "l2 l3 s3",
        lambda robot, q, l2, l3: np.array(_minor(robot, q, 0) - l2 * l3 * np.sin(q[2])),
    )
    _add(
        comparison,
        "1",
        "det J_−2",
        "l3 c23",
        lambda robot, q, l2, l3: np.array(_minor(robot, q, 1) - l3 * np.cos(q[1] + q[2])),
    )
    _add(
        comparison,
        "1",
        "det J_−3",
        "l2 c2 + l3 c23",
        lambda robot, q, l2, l3: np.array(_minor(robot, q, 2) - l2 * np.cos(q[1]) - l3 * np.cos(q[1] + q[2])),
    )


def _static_formulas(comparison: Comparison) -> None:
    """The statics of the task p at q_s = (q1, π/2, π)."""
    _add(
        comparison,
        "1c",
        "J_pᵀ at q_s",
        "[1, 0; l3 − l2, 0; l3, 0]",
        lambda robot, q, l2, l3: _J_s(robot, q).T - [[1, 0], [l3 - l2, 0], [l3, 0]],
    )
    _add(
        comparison,
        "1c",
        "forces without torque at q_s",
        "ϕ (0, 1)",
        lambda robot, q, l2, l3: _outside(subspaces(_J_s(robot, q)).left_null, np.array([0.0, 1.0])),
    )
    _add(
        comparison,
        "1d",
        "τ that balances (3, 1)",
        "(−3, 3 (l2 − l3), −3 l3)",
        lambda robot, q, l2, l3: balancing_torque(_J_s(robot, q), FORCE) - [-3, 3 * (l2 - l3), -3 * l3],
    )
    _add(
        comparison,
        "1d",
        "τ is the same for every (3, ϕ)",
        "(−3, 3 (l2 − l3), −3 l3)",
        lambda robot, q, l2, l3: balancing_torque(_J_s(robot, q), [3, q[2]]) - [-3, 3 * (l2 - l3), -3 * l3],
    )


def _add(
    comparison: Comparison,
    exercise: str,
    name: str,
    printed: str,
    difference: Callable[[Robot, Array, float, float], npt.ArrayLike],
) -> None:
    """Try a formula of the PRR robot at random lengths and q."""
    comparison.formula(exercise, name, printed, lambda seed: difference(*_prr(seed)))


def _minor(robot: Robot, q: Array, column: int) -> float:
    return float(np.linalg.det(np.delete(POINT.jacobian(robot, q), column, axis=1)))


def _J_s(robot: Robot, q: Array) -> Array:
    return POINT.jacobian(robot, np.array([q[0], pi / 2, pi]))


def _prr(seed: int) -> tuple[Robot, Array, float, float]:
    """Return the PRR robot with random lengths, a random q, and the lengths."""
    rng = np.random.default_rng(seed)
    l2, l3 = (float(length) for length in rng.uniform(0.2, 1.5, 2))
    return load_robot("prr", parameters={"l2": l2, "l3": l3}), rng.uniform([-2, -pi, -pi], [2, pi, pi]), l2, l3


def _pose_value(robot: Robot, q: Array, l2: float, l3: float) -> Array:
    a, b = q[1], q[1] + q[2]
    printed = np.array([q[0] + l2 * np.cos(a) + l3 * np.cos(b), l2 * np.sin(a) + l3 * np.sin(b), b])
    return POSE.error(robot, q, printed)  # the angle modulo 2π


def _J_r(q: Array, l2: float, l3: float) -> Array:
    c2, s2, c23, s23 = np.cos(q[1]), np.sin(q[1]), np.cos(q[1] + q[2]), np.sin(q[1] + q[2])
    return np.array([[1, -l2 * s2 - l3 * s23, -l3 * s23], [0, l2 * c2 + l3 * c23, l3 * c23], [0, 1, 1]])


def _outside(basis: Array, v: Array) -> Array:
    """Return the part of v outside a one-dimensional span; 1 where the span has another dimension."""
    return v - basis @ (basis.T @ v) if basis.shape[1] == 1 else np.ones(1)


def _unrealisable(robot: Robot, q: Array, l2: float, l3: float) -> Array:
    """The printed condition is, up to its sign, the part of ṙ along (0, 1, l3 s3), and vanishes in the range."""
    s3 = np.sin(q[2])
    spaces = subspaces(POSE.jacobian(robot, np.array([q[0], pi / 2, q[2]])))
    rate = np.array([0.3, -0.7, 0.4])
    part = np.linalg.norm(spaces.unrealisable(rate)) * np.hypot(1, l3 * s3)
    within = spaces.range @ np.array([0.8, -0.6])
    return np.array([abs(rate[2] * l3 * s3 + rate[1]) - part, within[2] * l3 * s3 + within[1]])
