"""Singularities in sentences, in the words a student would write."""

from typing import TYPE_CHECKING

import numpy as np

from robotics1.inputs import Array

if TYPE_CHECKING:
    from robotics1.analysis.singularity import SingularBranch, SingularSet


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
        lines.append(f"{_list(found.free_joints)} never {verb}.")
    lines += [f"{number}. {branch.explain()}" for number, branch in enumerate(found.branches, start=1)]
    if not found.complete:
        lines.append("This was a search: it does not prove that there are no others.")
    return "\n".join(lines)


def branch_sentences(branch: "SingularBranch") -> str:
    """Return where the branch is, and what the robot cannot do, can do, and holds there."""
    task = branch.points.task
    where = [f"{name} = {angle(value)}" for name, value in branch.values.items()]
    if branch.tied_joints:
        where.append(f"{_list(branch.tied_joints)} tied by σ_min = 0")
    sentences = [f"{', '.join(where)}: the rank is {branch.rank} instead of {branch.points.rank}"]
    if branch.free_joints:
        sentences[0] += f", whatever {_list(branch.free_joints, 'and')}"
    rows = f"({', '.join(task.row_names)})"
    lost = " and ".join(vector(direction) for direction in branch.left_null.T)
    still = " and ".join(vector(direction) for direction in branch.null.T)
    sentences.append(f"For example at q = {vector(branch.q)}:")
    if lost:
        sentences.append(f"a task velocity {rows} with a part along {lost} cannot be realised;")
        sentences.append(f"a force along {lost} needs no joint torque;")
    if still:
        sentences.append(f"joint velocities along {still} do not move the task;")
    return f"{sentences[0]}. {' '.join(sentences[1:])[:-1]}."


def angle(value: float) -> str:
    """Return a joint value as a person writes it: a simple multiple of π, else four decimals."""
    from robotics1.analysis.singularity import pi_fraction

    fraction = pi_fraction(value)
    if fraction is None:
        return f"{value:.4f}"
    if fraction == 0:
        return "0"
    top = {1: "π", -1: "−π"}.get(fraction.numerator, f"{fraction.numerator}π".replace("-", "−"))
    return top if fraction.denominator == 1 else f"{top}/{fraction.denominator}"


def vector(values: Array) -> str:
    """Return a vector with four decimals."""
    return "(" + ", ".join(f"{v:.4f}" for v in np.asarray(values) + 0.0) + ")"


def _list(names: tuple[str, ...], conjunction: str = "and") -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} {conjunction} {names[-1]}"
