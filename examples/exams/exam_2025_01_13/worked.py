"""The worked answers of the exam of 13 January 2025, as a person reads them, with figures and pages."""

from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path
from typing import Any

from rich.console import Console

from robotics1 import PositionTask, animate
from robotics1.files import make_folder
from robotics1.notation import count, vector
from robotics1.plots import plot_path, plot_trajectory
from robotics1.singularities.explain import directions
from robotics1.terminal_tables import iteration_table, table
from robotics1.trajectories import TaskTrajectory

from ..comparison import Comparison
from ..formula_page import write_formula_page
from ..formula_table import FormulaTable
from ..overview import write_overview
from ..polynomials import polynomial_table
from .answers import (
    TARGET,
    Exercise1,
    Exercise2,
    Exercise3,
    exercise_1,
    exercise_2,
    exercise_3,
)
from .formulas import formula_tables
from .published import compare

TITLE = "Robotics 1, 13 January 2025"


@dataclass(frozen=True, eq=False)
class WorkedExam:
    """The answers, the checks and the files.

    Attributes:
        one, two, three: the answers.
        tables: the formulas of each exercise.
        comparison: the published values beside the computed ones.
        files: the figures and pages that were written.
    """

    one: Exercise1
    two: Exercise2
    three: Exercise3
    tables: tuple[FormulaTable, FormulaTable, FormulaTable]
    comparison: Comparison
    files: tuple[Path, ...]

    @property
    def all_hold(self) -> bool:
        """Whether every published value is reproduced."""
        return not self.comparison.failures()

    def as_json(self) -> dict[str, Any]:
        """Return the checks and the files."""
        checks = [
            {name: getattr(check, name) for name in ("exercise", "name", "printed", "computed", "agreement")}
            for check in self.comparison.checks
        ]
        return {"checks": checks, "files": [str(path) for path in self.files]}

    def print(self, console: Console) -> None:
        """Print the worked answers, then the verdict on the published values."""
        one, two, three = self.tables
        _print_formulas(console, one)
        _print_exercise_1(console, self.one)
        _print_formulas(console, two)
        _print_exercise_2(console, self.two)
        _print_formulas(console, three)
        _print_exercise_3(console, self.three)
        _print_checks(console, self.comparison)
        for path in self.files:
            console.print(f"wrote {path}", highlight=False, soft_wrap=True)


def work_exam(folder: Path) -> WorkedExam:
    """Solve the exam, check it, and write its formulas, figures 2 to 5, an animated page and an overview of all."""
    make_folder(folder)  # first, for the exercises take seconds
    one, two, three = exercise_1(), exercise_2(), exercise_3()
    tables = formula_tables(one, two, three)
    sections = [table.section() for table in tables]
    formulas = write_formula_page(folder / "formulas.html", sections, title=f"{TITLE}: formulas")
    figures: list[Path] = []
    for first, name, branch in ((2, "right", three.right), (4, "left", three.left)):
        title = f"2R robot, {name} arm at the rendez-vous"
        joints = folder / f"figure-{first}-{name}-arm-joints.svg"
        path = folder / f"figure-{first + 1}-{name}-arm-path.svg"
        motion, robot = branch.trajectory, three.robot
        plot_trajectory(motion, file=joints, robot=robot, derivatives=1, title=title)
        tool = TaskTrajectory(robot, PositionTask("xy"), motion)
        plot_path(tool, file=path, target=TARGET, title=title)
        figures += [joints, path]
    page = folder / "rendezvous.html"
    animate(
        three.robot,
        [three.right.trajectory, three.left.trajectory],
        page,
        names=["right arm", "left arm"],
        target=TARGET,
        title="Rendez-vous of a 2R robot",
        caption=f"Each tool (red) meets the target (green) at t = {three.meeting.time:.3f} s, at its velocity.",
    )
    worked = WorkedExam(one, two, three, tables, compare(one, two, three, tables), (formulas, *figures, page))
    index = write_overview(
        folder / "index.html",
        title=TITLE,
        comparison=worked.comparison,
        answers=_as_text(worked),
        pages={"The formulas": formulas, "The two arms at the rendez-vous, to play with": page},
        figures=figures,
    )
    return replace(worked, files=(index, *worked.files))


def _as_text(worked: WorkedExam) -> str:
    """Return what is printed, but for the names of the files."""
    text = StringIO()
    replace(worked, files=()).print(Console(file=text, width=110))
    return text.getvalue()


def _print_formulas(console: Console, table: FormulaTable) -> None:
    section = table.section()
    console.rule(section.title)
    console.print(section.given, highlight=False)
    for formula in section.formulas:
        console.print(formula.text(), highlight=False, markup=False, soft_wrap=True)


def _print_exercise_1(console: Console, one: Exercise1) -> None:
    console.print("\nTask r = (p, φ)", style="bold")
    console.print(one.pose.explain(), highlight=False)
    console.print("\nTask r = p", style="bold")
    console.print(one.point.explain(), highlight=False)
    console.print(f"\nAt q_s = {vector(one.q_s)}, all joint values positive:", style="bold", highlight=False)
    console.print(f"rank J_p = {one.spaces.rank}", highlight=False)
    console.print(f"c) forces along {directions(one.spaces.left_null)} need no joint force or torque", highlight=False)
    console.print(f"d) τ = −J_sᵀ (3, 1) = {vector(one.torque)} [N, N m, N m]", highlight=False)


def _print_exercise_2(console: Console, two: Exercise2) -> None:
    console.print()
    titles = ("a) Newton, Table 1", "b) Newton", "b) with the pseudoinverse, Table 2")
    for title, run in zip(titles, (two.a, two.b, two.b_pseudoinverse), strict=True):
        console.print(iteration_table(run, title))
        steps = count(run.iterations, "iteration")
        console.print(f"{run.status.name} after {steps}: {run.status.value}\n", highlight=False)


def _print_exercise_3(console: Console, three: Exercise3) -> None:
    meeting = three.meeting
    console.print(
        f"\nt_rv = {meeting.time:.4f} s, p_rv = {vector(meeting.position)} m, ṗ_T = {vector(meeting.velocity)} m/s; "
        f"{meeting.status.value}.",
        highlight=False,
    )
    for name, branch in (("right", three.right), ("left", three.left)):
        console.print(f"\n{name} arm: q = {vector(branch.q)} rad, q̇ = {vector(branch.qdot)} rad/s", highlight=False)
        console.print(polynomial_table(three.robot, branch.trajectory))
        for violation in branch.violations:
            console.print(str(violation), style="yellow")
    console.print("\nFrom a perturbed start, with q̇ = q̇_d + K (q_d − q) and the robot's velocity limits:")
    for choice in (three.feedback, three.too_far):
        start = choice.run.q[0]
        console.print(
            f"q(0) = {vector(start)}: K = {choice.gain[0]:.3f} · 1 [1/s] is the smallest for a final error of 1e-3; "
            f"with it |q_d − q| = {choice.run.final_error:.2e} at t_rv: {choice.status.value}.",
            highlight=False,
        )


def _print_checks(console: Console, comparison: Comparison) -> None:
    console.rule("Published values")
    kinds = [check.agreement for check in comparison.checks]
    rows = []
    for exercise in sorted({check.exercise[0] for check in comparison.checks}):
        mine = [check.agreement for check in comparison.checks if check.exercise[0] == exercise]
        counts = [mine.count(kind) for kind in ("formula", "rounded", "truncated", "erratum", None)]
        rows.append((exercise, *map(str, counts)))
    headings = ("exercise", "formulas", "rounded", "truncated", "print errors", "not reproduced")
    console.print(table(headings, rows))
    for check in comparison.checks:
        if check.agreement == "erratum":
            console.print(f"print error: {check.name} is printed {check.printed}, and is {check.computed:.4f}")
    for check in comparison.failures():
        missed = f"not reproduced: {check.name}, printed {check.printed}, computed {check.computed}"
        console.print(missed, style="red")
    held = len(kinds) - kinds.count(None)
    console.print(f"{held} of {len(kinds)} published values and formulas are reproduced.", style="bold")
