"""Exercise 1: the singularities of the PRR robot, and its statics in one of them."""

from robotics1.exams.comparison import Comparison
from robotics1.exams.exam_2025_01_13 import Exercise1


def check_exercise_1(comparison: Comparison, one: Exercise1) -> None:
    """Check the numbers of exercise 1."""
    comparison.numbers("1", "(p, φ): number of singular values of q2", "2", len(one.pose.branches))
    comparison.numbers("1", "p: number of singular (q2, q3)", "4", len(one.point.branches))
    free = [name == "q1" for name in one.pose.free_joints + one.point.free_joints]
    comparison.numbers("1", "q1 never matters (of 2 tasks)", "2", sum(free))
    comparison.numbers("1c", "rank of J_p at q_s", "1", one.spaces.rank)
