"""Every number and formula published in the solution of 13 January 2025, held against the computed ones."""

from collections.abc import Iterable

from robotics1.exams.checks_2025_01_13.exercise_1 import check_exercise_1
from robotics1.exams.checks_2025_01_13.exercise_2 import ERRATA, check_exercise_2
from robotics1.exams.checks_2025_01_13.exercise_3 import check_exercise_3
from robotics1.exams.comparison import Comparison
from robotics1.exams.exam_2025_01_13 import Exercise1, Exercise2, Exercise3
from robotics1.exams.formula_table import FormulaTable


def compare(one: Exercise1, two: Exercise2, three: Exercise3, tables: Iterable[FormulaTable]) -> Comparison:
    """Return the checks of all three exercises: first the formulas, then the numbers."""
    comparison = Comparison(ERRATA)
    for table in tables:
        table.check(comparison)
    check_exercise_1(comparison, one)
    check_exercise_2(comparison, two)
    check_exercise_3(comparison, three)
    return comparison
