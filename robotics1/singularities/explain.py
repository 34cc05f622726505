"""Singularities in sentences, in the words a student would write."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.notation import enumeration, joint_value, vector
from robotics1.singularities.spaces import echelon
from robotics1.tasks.task import turns_of

if TYPE_CHECKING:
    from robotics1.robot.model import Robot
    from robotics1.singularities.result import Intersections, SingularBranch, SingularSet
    from robotics1.symbolic.singular_sets.branch_formulas import BranchFormulas

LONGEST = 40  # operations of a basis vector that is still read
SHORT = 12  # characters of a value that is read as it is
WIDEST = 160  # characters of an equation that is still read


def set_sentences(found: "SingularSet") -> str:
    """Return the sentences about the whole set, then about each branch."""
    rows, rank = found.task.rows, found.generic_rank
    lines = [found.note] if found.note else []
    if rank < min(rows, found.robot.nv):
        lines.append(
            f"The task has {rows} rows, but the rank of its Jacobian is {rank}{' almost' if found.branches else ''} "
            "everywhere; "
            f"below, singular means a rank lower than {rank}."
        )
    status = found.status.value[0].upper() + found.status.value[1:]
    if not found.branches:
        none = f"{status}{' inside the joint limits' if found.outside else ''}."
        return "\n".join([*lines, none, *_almost_everywhere(found), *_besides(found)])
    lines += [*_names(found), *_turns(found)]
    if found.free_joints:
        verb = "matters" if len(found.free_joints) == 1 else "matter"
        free = _called(found.free_joints, found.robot, symbols=_in_symbols(found))
        lines.append(f"{enumeration(free)} never {verb}.")
    lines += [_family(number, family) for number, family in _families(found.branches)]
    return "\n".join([*lines, f"{status}.", *_besides(found)])


def _families(branches: "Sequence[SingularBranch]") -> "list[tuple[int, list[SingularBranch]]]":
    """Return the branches with the number of the first, those that differ in the value of one joint together."""
    families: list[tuple[int, list[SingularBranch]]] = []
    for number, branch in enumerate(branches, start=1):
        before = families[-1][1][-1] if families else None
        if before is not None and _alike(before, branch):
            families[-1][1].append(branch)
        else:
            families.append((number, [branch]))
    return families


def _alike(a: "SingularBranch", b: "SingularBranch") -> bool:
    """Whether one joint alone has a value on both branches, and nothing else is different but that value."""
    same_joint = len(a.values) == 1 == len(b.values) and a.values.keys() == b.values.keys()
    same_place = len(a.conditions) == 1 == len(b.conditions)
    said = (a.rank, a.free_joints, a.note, _because(a)) == (b.rank, b.free_joints, b.note, _because(b))
    return same_joint and same_place and said


def _family(number: int, family: "list[SingularBranch]") -> str:
    """Return the sentences about one branch, or about several that differ in the value of one joint."""
    numbers = f"{number}" if len(family) == 1 else f"{number}–{number + len(family) - 1}"
    return f"{numbers}. {branch_sentences(*family)}"


def _almost_everywhere(found: "SingularSet") -> list[str]:
    """Say what is lost, and what does not move the task, where nothing is singular."""
    if found.generic_bases is None:
        return []
    lost, still = (_written(found.generic_bases, name, found) for name in ("left_null", "null"))
    lines = [*_lost(", ".join(found.task.row_names), lost), *_still(still)]
    return ["Almost everywhere", *lines[:-1], lines[-1][:-1] + "."] if lines else []


def _in_symbols(found: "SingularSet") -> bool:
    """Whether the joints are called q1, q2, ...: where formulas are written."""
    exact = [branch.formulas is not None for branch in found.branches]
    return found.jacobian is not None and (any(exact) or not exact)


def _names(found: "SingularSet") -> list[str]:
    """Say which joint is q1, q2, ..., where formulas are written and the joints have other names."""
    names = found.robot.joint_names
    symbols = _symbols(names)
    if not _in_symbols(found) or list(names) == symbols:
        return []
    return [f"Here {', '.join(f'{q} is {name}' for q, name in zip(symbols, names, strict=True))}."]


def _turns(found: "SingularSet") -> list[str]:
    """Say how far the values of a joint without limits go, where others turn by fractions of its angle."""
    robot, lines = found.robot, []
    for i, number in enumerate(turns_of(robot, found.task) if robot.nq == robot.nv else ()):
        if number == 1 or np.isfinite([robot.lower[i], robot.upper[i]]).any():
            continue
        (name,) = _called([robot.joint_names[i]], robot, symbols=_in_symbols(found))
        if np.isfinite(number):
            lines.append(
                f"The joints that follow {name} are back after {number:g} turns of it: its values count modulo "
                f"{joint_value(number * 2 * np.pi)}."
            )
        else:
            lines.append(
                f"No number of turns of {name} brings the joints that follow it back: without a box, two turns "
                "to both sides are searched."
            )
    return lines


def _symbols(names: Sequence[str]) -> list[str]:
    return [f"q{i}" for i in range(1, len(names) + 1)]


def _called(joints: Iterable[str], robot: "Robot", *, symbols: bool) -> list[str]:
    """Return the joints by name, or as q1, q2, ..., as the formulas call them."""
    if not symbols:
        return list(joints)
    known = dict(zip(robot.joint_names, _symbols(robot.joint_names), strict=True))
    return [known[name] for name in joints]


def _besides(found: "SingularSet") -> list[str]:
    """Return what is singular outside the joint limits, or would be at other lengths."""
    from robotics1.singularities.other_lengths import parameter_conditions

    lines = []
    if found.outside:
        places = "; ".join(place(branch) for branch in found.outside)
        lines.append(f"Outside the joint limits the arm would be singular at {places}.")
    equations = "; ".join(map(_line, parameter_conditions(found)))
    if equations:
        lines.append(f"At other lengths more is singular, namely where this has a solution: {equations}.")
    return lines


def intersection_sentences(found: "Intersections") -> str:
    """Return where branches meet or the rank falls further, one line for each piece."""
    pieces = [f"{place(piece)}: the rank is {piece.rank}." for piece in found.branches]
    if not found.complete:
        pieces.append("There may be more: this is what was found in the time.")
    if not pieces:
        return "No two branches meet, and nowhere does the rank fall further."
    return "\n".join(["Where branches meet, or the rank falls further:", *pieces])


def place(branch: "SingularBranch") -> str:
    """Return where a branch is: q2 = π/2, or l2·cos(q2) + l3·cos(q2 + q3) = 0."""
    if branch.formulas is not None:
        texts = [(_equation(branch, condition), condition) for condition in branch.conditions]
        return ", ".join(text if len(text) <= WIDEST else _described(condition) for text, condition in texts)
    where = [f"{name} = {joint_value(value)}" for name, value in branch.values.items()]
    if branch.tied_joints:
        where.append(f"{enumeration(branch.tied_joints)} tied by σ_min = 0")
    return ", ".join(where)


def _equation(branch: "SingularBranch", condition: Any) -> str:
    """Return an equation, whose coefficients are lengths in metres where they can be."""
    from robotics1.symbolic.writing.decimals import lengths_in
    from robotics1.symbolic.writing.readable import readable

    if condition.lhs.is_Symbol and condition.rhs.is_number:
        return f"{condition.lhs} = {_value(condition.rhs)}"
    return _line(readable(condition, lengths_in(branch.robot, branch.task)))


def _line(formula: Any) -> str:
    from robotics1.symbolic.writing.printing import line_text

    return line_text(formula)


def _value(exact: Any) -> str:
    """Return the value of a joint: exact where it is short, as −π/3 or atan(3/4), else four decimals."""
    text = _line(exact)
    return text if len(text) <= SHORT else joint_value(float(exact))


def _because(branch: "SingularBranch") -> str:
    """Say which relation between the lengths the branch owes itself to."""
    if branch.formulas is None or not branch.formulas.lengths:
        return ""
    return f" (since {enumeration(_line(equation) for equation in branch.formulas.lengths)})"


def _described(condition: Any) -> str:
    joints = sorted((symbol.name for symbol in condition.free_symbols), key=lambda name: (len(name), name))
    terms = len(condition.lhs.expand().args)
    return f"an equation of {terms} terms between {enumeration(joints)} (see `conditions`)"


def branch_sentences(first: "SingularBranch", *others: "SingularBranch") -> str:
    """Return where a branch is, and what the robot cannot do, can do, and holds there; of several that differ in the
    value of one joint too.
    """
    family = [first, *others]
    places = [place(branch) for branch in family]
    where = " or ".join([places[0], *(other.partition(" = ")[2] for other in places[1:])])
    lines = [
        f"{where}{_because(first)}{_whatever(first)}: the rank is {first.rank} instead of {first.generic_rank}.",
        *([f"   {first.note}"] if first.note else []),
    ]
    for branch, at in zip(family, places, strict=True):
        lines += _body(branch, f"Where {at}" if others else "There")
        lines[-1] = lines[-1][:-1] + "."
    return "\n".join(lines)


def _whatever(branch: "SingularBranch") -> str:
    free = _called(branch.free_joints, branch.robot, symbols=branch.formulas is not None)
    return f", whatever {enumeration(free)}" if free else ""


def _body(branch: "SingularBranch", there: str) -> list[str]:
    """Return what the robot cannot do, can do, and holds on a branch."""
    rows = ", ".join(branch.task.row_names)
    if branch.rank == 0:
        return _nothing_moves(rows, there)
    lines = []
    lost, still = (
        None if branch.formulas is None else _written(branch.formulas, name, branch) for name in ("left_null", "null")
    )
    in_symbols = [*_lost(rows, lost), *_still(still)]
    in_numbers = [] if lost is not None else _lost(rows, directions(branch.left_null))
    in_numbers += [] if still is not None else _still(directions(branch.null))
    if in_symbols:
        lines += [f"   {there}", *in_symbols]
    if in_numbers:
        lines += [f"   For example at q = {vector(branch.q)}:", *in_numbers]
    return lines


def _nothing_moves(rows: str, there: str) -> list[str]:
    """Say what J = 0 means, where every vector is lost or does not move the task."""
    return [
        f"   {there} J = 0:",
        f"   - no task velocity ({rows}) but zero can be realised;",
        "   - no force needs joint torques;",
        "   - no joint velocity moves the task.",
    ]


def _lost(rows: str, along: str | None) -> list[str]:
    if not along:
        return []
    return [
        f"   - a task velocity ({rows}) with a part along {along} cannot be realised;",
        f"   - a force along {along} needs no joint torque;",
    ]


def _still(along: str | None) -> list[str]:
    return [f"   - joint velocities along {along} do not move the task;"] if along else []


def _written(formulas: "BranchFormulas", name: str, found: "SingularSet | SingularBranch") -> str | None:
    """Return a basis in symbols, or None where there is none, or it is too long to be read."""
    if not formulas.is_short(name):
        return None
    try:
        basis = getattr(formulas, name)
    except FormulaError:
        return None
    if sum(entry.count_ops() for entry in basis) > LONGEST * max(basis.cols, 1):
        return None
    from robotics1.symbolic.writing.decimals import lengths_in
    from robotics1.symbolic.writing.readable import readable_vector

    lengths = lengths_in(found.robot, found.task)
    return " or ".join(_line(readable_vector(basis.col(i), lengths)) for i in range(basis.cols))


def directions(basis: Array) -> str:
    """Return the columns of a basis, as they are written by hand."""
    return " or ".join(vector(column) for column in echelon(basis).T)
