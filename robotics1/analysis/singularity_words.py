"""Singularities in sentences, in the words a student would write."""

from typing import TYPE_CHECKING

from robotics1.analysis.spaces import echelon
from robotics1.inputs import Array
from robotics1.notation import enumeration, joint_value, vector

if TYPE_CHECKING:
    from robotics1.analysis.singular_set import SingularBranch, SingularSet


def set_sentences(found: "SingularSet") -> str:
    """Return what is to be said of the whole set, then of each branch."""
    rows, rank = found.task.rows, found.generic_rank
    lines = []
    if rank < min(rows, found.robot.nv):
        lines.append(
            f"The task has {rows} rows, but the rank of its Jacobian is {rank} everywhere; "
            f"below, singular means a rank lower than {rank}."
        )
    if not found.branches:
        return "\n".join([*lines, "No singular configuration was found."])
    if found.free_joints:
        verb = "matters" if len(found.free_joints) == 1 else "matter"
        lines.append(f"{enumeration(found.free_joints)} never {verb}.")
    lines += [f"{number}. {branch.explain()}" for number, branch in enumerate(found.branches, start=1)]
    if not found.complete:
        lines.append("This was a search: it does not prove that there are no others.")
    return "\n".join(lines)


def branch_sentences(branch: "SingularBranch") -> str:
    """Return where the branch is, and what the robot cannot do, can do, and holds there."""
    where = [f"{name} = {joint_value(value)}" for name, value in branch.values.items()]
    if branch.tied_joints:
        where.append(f"{enumeration(branch.tied_joints)} tied by σ_min = 0")
    whatever = f", whatever {enumeration(branch.free_joints)}" if branch.free_joints else ""
    lines = [f"{', '.join(where)}{whatever}: the rank is {branch.rank} instead of {branch.points.rank}."]
    rows = ", ".join(branch.points.task.row_names)
    lost, still = directions(branch.left_null), directions(branch.null)
    lines.append(f"   For example at q = {vector(branch.q)}:")
    if lost:
        lines.append(f"   - a task velocity ({rows}) with a part along {lost} cannot be realised;")
        lines.append(f"   - a force along {lost} needs no joint torque;")
    if still:
        lines.append(f"   - joint velocities along {still} do not move the task;")
    return "\n".join(lines)[:-1] + "."


def directions(basis: Array) -> str:
    """Return the columns of a basis, as they are written by hand."""
    return " and ".join(vector(column) for column in echelon(basis).T)
