"""Sections in formulas: direct kinematics, Jacobian, determinant, singular set."""

from robotics1.data_sheet.asked import Answer, Asked
from robotics1.data_sheet.markup import equation, folded, note, paragraphs, sentences, table
from robotics1.kinematics import forward_kinematics
from robotics1.notation import enumeration, number, vector
from robotics1.singularities.explain import place
from robotics1.singularities.find import find_singularities
from robotics1.singularities.result import SingularSet
from robotics1.symbolic.tasks.formula import formulas
from robotics1.symbolic.tasks.task_formulas import Formulas
from robotics1.symbolic.writing.decimals import lengths_in
from robotics1.symbolic.writing.printing import line_text
from robotics1.symbolic.writing.readable import readable
from robotics1.tasks.pose import PoseTask

EXACT_ANGLE = 1e-9  # rad: a smaller correction is not worth a sentence
SINGULAR_SET_TIME = 12.0  # s
SHOWN_PLACES = 6
LONGEST_FACT = 160  # characters
PROVEN = "Proven: the method finds all branches, and each was verified with Pinocchio."
SEARCHED = "Searched: each branch was verified with Pinocchio, but there may be others."
WRITTEN_OUT = "(see `conditions`)"  # what a sentence says of an equation that is too long for it


def direct_kinematics(asked: Asked) -> Answer:
    """Return the pose of the tool as a function of q, and its numbers at the posture."""
    found = formulas(asked.robot, PoseTask(frame=asked.frame))
    T = found.value
    names = dict(zip([str(q) for q in found.q], asked.robot.joint_names, strict=True))
    named = ", ".join(f"{symbol} is {name}" for symbol, name in names.items())
    text = "" if all(symbol == name for symbol, name in names.items()) else paragraphs(f"Here {named}.")
    if found.cleaned > EXACT_ANGLE:
        text += note(f"Angles of the file were made exact, by at most {found.cleaned:.1e} rad.")
    text += "".join(equation(symbol, T[i, 3]) for i, symbol in enumerate(("x", "y", "z")))
    axes = "".join(equation(f"{name}(q)", T[:3, i]) for i, name in enumerate("nsa"))
    text += '<p>The tool\'s axes in the world, the columns of R = (n s a):</p><div class="side">' + axes + "</div>"
    at = forward_kinematics(asked.robot, asked.q, frame=asked.frame)
    text += folded(
        "Numbers at the posture",
        paragraphs(f"q = {vector(asked.q)}", f"p = {vector(at.translation)} m")
        + table(
            ("R", "n", "s", "a"), [(axis, *map(number, row)) for axis, row in zip("xyz", at.rotation, strict=True)]
        ),
    )
    return Answer(text)


def jacobian(asked: Asked) -> Answer:
    """Return the columns of J in formulas, and J at the posture."""
    task = asked.require_task()
    found = formulas(asked.robot, task)
    J, moving = found.jacobian, _moving(found)
    rows, units = ", ".join(found.row_names), ", ".join(dict.fromkeys(task.row_units))
    text = paragraphs(f"ṙ = J(q) q̇ with r = ({rows}) [{units}], in world axes. Column i belongs to joint i.")
    text += '<div class="side">' + "".join(equation(f"J{i + 1}(q)", J[:, i]) for i in moving) + "</div>"
    still = [f"q{i + 1}" for i in range(J.cols) if i not in moving]
    text += paragraphs(
        f"{enumeration(still)}: these columns are zero, as the joints do not move the task." if still else ""
    )
    numbers = task.jacobian(asked.robot, asked.q)
    headings = ("", *(f"q{i + 1}" for i in range(J.cols)))
    values = [(name, *map(number, row)) for name, row in zip(task.row_names, numbers, strict=True)]
    text += folded("Numbers at the posture", paragraphs(f"q = {vector(asked.q)}") + table(headings, values))
    return Answer(text, f"{J.rows} × {len(moving)}, rows ({rows})")


def _moving(found: Formulas) -> list[int]:
    """Return the columns of J that are not zero."""
    return [i for i in range(found.jacobian.cols) if any(found.jacobian[:, i])]


def determinant(asked: Asked) -> Answer:
    """Return det J, or what takes its place where J is not square."""
    found = formulas(asked.robot, asked.require_task())
    m, moving = found.jacobian.rows, _moving(found)
    n = len(moving)
    if m == n:
        det = found.minors[tuple(i for i in range(len(found.q)) if i not in moving)]
        det = readable(det, lengths_in(asked.robot, asked.require_task()))
        if not det.free_symbols & set(found.q):
            return Answer(
                equation("det J", det) + paragraphs("It is the same everywhere."), f"det J = {line_text(det)}"
            )
        text = equation("det J", det) + paragraphs("The arm is singular exactly where one of its factors is zero.")
        return Answer(text, _short(f"det J = {line_text(det)}"))
    rank = "minors of its largest order"
    text = paragraphs(f"J is {m} × {n}: it has no determinant. It loses rank where all {rank} vanish together.")
    gram = equation("det(J Jᵀ)" if m < n else "det(Jᵀ J)", found.gram_determinant) if abs(n - m) == 1 and n < 5 else ""
    return Answer(text + gram, f"J is {m} × {n} and has none")


def _short(fact: str) -> str:
    return fact if len(fact) < LONGEST_FACT else f"{fact[:LONGEST_FACT].rstrip()} …"


def singular_set(asked: Asked) -> Answer:
    """Return the singular set in sentences, and whether it is proven to be complete."""
    found = find_singularities(asked.robot, asked.require_task(), time_limit=SINGULAR_SET_TIME)
    places = [place(branch) for branch in found.branches]
    shown = "; or ".join(places[:SHOWN_PLACES]) + ("; or elsewhere" if len(places) > SHOWN_PLACES else "")
    fact = _short(f"singular where {shown}" if places else found.status.value)
    inside, outside, other = found.explain().partition("\nOutside the joint limits")
    said = inside.replace(WRITTEN_OUT, "(written out above)") + (outside + other).replace(f" {WRITTEN_OUT}", "")
    return Answer(
        _equations(found) + sentences(said) + note(PROVEN if found.complete else SEARCHED),
        fact.replace(f" {WRITTEN_OUT}", ""),
    )


def _equations(found: SingularSet) -> str:
    """Return the branches as a short list of equations above the sentences."""
    rows = []
    for i, branch in enumerate(found.branches, 1):
        where = place(branch).replace(WRITTEN_OUT, "(below)")
        rows.append((i, where, branch.rank, branch.dimension, "by numbers" if branch.formulas is None else "exact"))
    long = "".join(
        folded(f"The equations of branch {i}", "".join(equation("", condition) for condition in branch.conditions))
        for i, branch in enumerate(found.branches, 1)
        if WRITTEN_OUT in place(branch)
    )
    return (table(("branch", "where", "rank", "dimension", "found"), rows) if rows else "") + long
