"""The formulas of the solution of 13 January 2025, computed, each beside the published one."""

from robotics1.exams.exam_2025_01_13 import Exercise1, Exercise2, Exercise3
from robotics1.exams.formula_table import FormulaTable
from robotics1.exams.formulas_2025_01_13.exercise_1 import formulas_1
from robotics1.exams.formulas_2025_01_13.exercise_2 import formulas_2
from robotics1.exams.formulas_2025_01_13.exercise_3 import formulas_3


def formula_tables(one: Exercise1, two: Exercise2, three: Exercise3) -> tuple[FormulaTable, FormulaTable, FormulaTable]:
    """Return the formulas of all three exercises."""
    return formulas_1(one), formulas_2(two), formulas_3(three)
