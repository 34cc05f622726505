"""Every number published in the solution of 13 January 2025, held against the computed one."""

from collections.abc import Iterable

import numpy.typing as npt

from robotics1.ik import IKIteration
from robotics1.trajectories import MeetingBranch

from ..comparison import Comparison
from ..formula_table import FormulaTable
from .answers import TARGET, Exercise1, Exercise2, Exercise3

# Signs that are wrong in print: z of p at k = 0 is −2, y of p at k = 1 is negative.
ERRATA = frozenset({"table 1, k=0, p[3]", "table 1, k=1, p[2]"})

# k, q, p, |e|, det J as printed.
TABLE_1 = """
0 | -2 2.1991 1.4142  | -0.8312 1.1441 2  | 5.74027 | -1.4142
1 | 3 2.0426 -1.3968  | 0.6349 1.2441 3   | 0.43918 | 1.3968
2 | 3 2.3549 -1.3452  | 0.9500 -0.9524 3  | 0.06895 | 1.3452
3 | 3 2.3562 -1.4142  | 1.0000 -0.9999 3  | 0.00009 | 1.4142
"""
TABLE_2 = """
0 | 2 0.7854 1.4142   | 1 1 2             | 2.23607 | -1.4142
1 | 3 -0.2146 0       | 0 0 3             | 1.41421 | 0
2 | 3 -0.2146 1.1900  | 1.1627 -0.2534 3  | 0.76410 | -1.1900
3 | 3 -0.8567 1.1900  | 0.7794 -0.8993 3  | 0.24252 | -1.1900
4 | 3 -0.7720 1.4106  | 1.0107 -0.9840 3  | 0.01921 | -1.4106
5 | 3 -0.7854 1.4141  | 0.9999 -0.9999 3  | 0.00013 | -1.4141
6 | 3 -0.7854 1.4142  | 1 -1 3            | 0.00000 | -1.4142
"""

# For each arm: q and q̇, what the trajectory starts and ends with, then the coefficients of τ² τ³, t² t³ of q and of
# τ τ², t t² of q̇, joint by joint.
BRANCHES = {
    "right": {
        "q": "1.0294 1.4250",
        "q̇": "-0.7359 -0.6278",
        "q, q̇ at t = 0": "0 0 0 0",
        "q, q̇ at t = t_rv": "1.0294 1.4250 -0.7359 -0.6278",
        "q(τ)": "4.1040 5.1415 -3.0746 -3.7165",
        "q(t)": "2.1539 2.6984 -1.1690 -1.4130",
        "q̇(τ)": "5.9462 7.4495 -6.6821 -8.0773",
        "q̇(t)": "4.3077 5.3967 -3.5069 -4.2391",
    },
    "left": {
        "q": "2.1122 -1.4250",
        "q̇": "-1.1508 0.6278",
        "q, q̇ at t = 0": "0 0 0 0",
        "q, q̇ at t = t_rv": "2.1122 -1.4250 -1.1508 0.6278",
        "q(τ)": "7.9251 -5.1415 -5.8129 3.7165",
        "q(t)": "4.1593 -2.6984 -2.2101 1.4130",
        "q̇(τ)": "11.4826 -7.4495 -12.6334 8.0773",
        "q̇(t)": "8.3185 -5.3967 -6.6303 4.2391",
    },
}


def compare(one: Exercise1, two: Exercise2, three: Exercise3, tables: Iterable[FormulaTable]) -> Comparison:
    """Return the checks of all three exercises: first the formulas, then the numbers."""
    comparison = Comparison(ERRATA)
    for table in tables:
        table.check(comparison)
    check_exercise_1(comparison, one)
    check_exercise_2(comparison, two)
    check_exercise_3(comparison, three)
    return comparison


def check_exercise_1(comparison: Comparison, one: Exercise1) -> None:
    """Check the numbers of exercise 1."""
    comparison.numbers("1", "(p, φ): number of singular values of q2", "2", len(one.pose.branches))
    comparison.numbers("1", "p: number of singular (q2, q3)", "4", len(one.point.branches))
    free = [name == "q1" for name in one.pose.free_joints + one.point.free_joints]
    comparison.numbers("1", "q1 never matters (of 2 tasks)", "2", sum(free))
    comparison.numbers("1c", "rank of J_p at q_s", "1", one.spaces.rank)


def check_exercise_2(comparison: Comparison, two: Exercise2) -> None:
    """Check the numbers of exercise 2."""
    _table(comparison, "2a", "table 1", TABLE_1, two.a)
    comparison.numbers("2a", "iterations to convergence", "3", two.a.iterations if two.a.converged else -1)
    comparison.numbers("2a", "q_sol,1", "3 2.3562 -1.4142", two.a.q)
    comparison.numbers("2b", "q_b[0] gives p[0]", "1 1 2", two.b.table[0].r)
    comparison.numbers("2b", "|e[0]|", "2.2361", two.b.table[0].error_norm)
    comparison.numbers("2b", "q[1]", "3 -0.2146 0", two.b.q)
    comparison.numbers("2b", "p[1]", "0 0 3", two.b.table[1].r)
    comparison.numbers("2b", "|e[1]|", "1.4142", two.b.table[1].error_norm)
    comparison.numbers("2b", "det J(q[1])", "0", two.b.table[1].det)
    stopped = two.b.iterations if two.b.status.name == "SINGULAR" else -1
    comparison.numbers("2b", "iteration at which Newton meets a singular J", "1", stopped)
    _table(comparison, "2b", "table 2", TABLE_2, two.b_pseudoinverse)
    run = two.b_pseudoinverse
    comparison.numbers("2b", "iterations with the pseudoinverse", "6", run.iterations if run.converged else -1)
    comparison.numbers("2b", "q_sol,2", "3 -0.7854 1.4142", run.q)


def _table(comparison: Comparison, exercise: str, name: str, printed: str, run: IKIteration) -> None:
    lines = [line.split("|") for line in printed.strip().splitlines()]
    comparison.numbers(exercise, f"{name}, number of rows", str(len(lines)), len(run.table))
    for (k, q, p, error, det), row in zip(lines, run.table, strict=False):
        for column, text, value in (
            ("q", q, row.q),
            ("p", p, row.r),
            ("|e|", error, row.error_norm),
            ("det J", det, row.det),
        ):
            comparison.numbers(exercise, f"{name}, k={k.strip()}, {column}", text, value)


def check_exercise_3(comparison: Comparison, three: Exercise3) -> None:
    """Check the numbers of exercise 3."""
    meeting = three.meeting
    comparison.numbers("3b", "t_rv, number", "1.380", meeting.time)
    comparison.numbers("3", "p_Ty(t_rv), number", "1.5359", meeting.position[1])
    comparison.numbers("3", "p_rv", "0 1.5359", meeting.position)
    comparison.numbers("3", "ṗ_T", "1.4489 0.3882", TARGET.velocity(meeting.time))
    comparison.numbers("3", "number of inverse kinematics solutions", "2", len(meeting.branches))
    for name, branch in (("right", three.right), ("left", three.left)):
        _branch(comparison, name, branch)


def _branch(comparison: Comparison, name: str, branch: MeetingBranch) -> None:
    trajectory = branch.trajectory
    computed: dict[str, npt.ArrayLike] = {
        "q": branch.q,
        "q̇": branch.qdot,
        "q, q̇ at t = 0": [*trajectory(0.0), *trajectory.velocity(0.0)],
        "q, q̇ at t = t_rv": [*trajectory(trajectory.duration), *trajectory.velocity(trajectory.duration)],
        "q(τ)": trajectory.coefficients[2:].ravel(),
        "q(t)": trajectory.coefficients_t[2:].ravel(),
        "q̇(τ)": trajectory.rate.coefficients[1:].ravel(),
        "q̇(t)": trajectory.rate.coefficients_t[1:].ravel(),
    }
    for quantity, printed in BRANCHES[name].items():
        comparison.numbers("3b", f"{name} arm, {quantity}", printed, computed[quantity])
