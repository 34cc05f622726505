"""Exercise 2: Newton's iterations for the cylindrical robot, with both tables."""

from robotics1.exams.comparison import Comparison
from robotics1.exams.exam_2025_01_13 import Exercise2
from robotics1.ik.iterate import IKIteration

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
