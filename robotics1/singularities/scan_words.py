"""A scan in sentences."""

from typing import TYPE_CHECKING

from robotics1.notation import count, enumeration, joint_value, vector
from robotics1.singularities.explain import place

if TYPE_CHECKING:
    from robotics1.singularities.refinement import RefinedGroup, Refinement
    from robotics1.singularities.scan_result import SingularityScan

CHOSEN = {"random": "random configurations", "sobol": "configurations of Sobol's sequence", "grid": "points of a grid"}
SHOWN = 3  # configurations of a group that are written out


def scan_sentences(scan: "SingularityScan") -> str:
    """Return what was scanned, each measure in a line, the nearest configuration, and what was refined."""
    rows = ", ".join(scan.task.row_names)
    if scan.robot.nv == 0:
        return f"{scan.robot.name}, task ({rows}): the robot has no joints, so that J has no σ that could vanish."
    lines = [f"{scan.robot.name}, task ({rows}): {scan.count} {CHOSEN[scan.method]}; {units(scan)}."]
    if scan.rank < min(scan.task.rows, scan.robot.nv):
        lines.append(f"The rank of J is {scan.rank} almost everywhere, so the measures count {scan.rank} σ only.")
    if scan.undefined:
        lines.append(f"At {scan.undefined} of them the task has no Jacobian.")
    lines += [_measure(scan, measure) for measure in scan.measures]
    first = symbols(scan)[scan.measures[0]]
    lines.append(f"The nearest to singular is q = {vector(scan.worst[0])}, with {first} = {scan.worst_values[0]:.4g}.")
    if scan.refined is not None:
        lines += _refinement(scan.refined, scan.robot.joint_names)
    return "\n".join(lines)


def symbols(scan: "SingularityScan") -> dict[str, str]:
    """Return measure → its symbol."""
    last = "σ_min" if scan.rank == min(scan.task.rows, scan.robot.nv) else f"σ_{scan.rank}"
    return {"sigma_min": last, "condition": f"σ_max/{last}", "manipulability": "the product of the σ"}


def units(scan: "SingularityScan") -> str:
    """Say in which units J is."""
    if scan.length == 1:
        return "J in SI units"
    reach = ", the arm's reach" if scan.length == scan.robot.reach else ""
    return f"J with lengths in units of {scan.length:.4g} m{reach}"


def _measure(scan: "SingularityScan", measure: str) -> str:
    known = scan.distributions[measure]
    parts = [f"{known.quantile(p):.4g} at {name}" for p, name in ((0.01, "1 %"), (0.5, "half"), (0.99, "99 %"))]
    return (
        f"{symbols(scan)[measure]} is between {known.minimum:.4g} and {known.maximum:.4g}; it is at most "
        f"{enumeration(parts)} of them."
    )


def _refinement(refined: "Refinement", joints: tuple[str, ...]) -> list[str]:
    starts = sum(len(group.starts) for group in refined.groups)
    total = starts + len(refined.unreached)
    if not refined.groups:
        return [f"None of the {total} worst is next to a singular configuration inside the limits."]
    order = (
        "" if joints == tuple(f"q{i + 1}" for i in range(len(joints))) else f" (q1, q2, ... are {', '.join(joints)})"
    )
    lines = [refined.note] if refined.note else []
    lines.append(f"Of the {total} worst, {starts} lead to singular configurations{order}:")
    lines += [f"- {_group(refined, group)}" for group in refined.groups]
    if refined.unreached:
        lines.append(f"The other {len(refined.unreached)} are next to no singular configuration inside the limits.")
    if refined.missed:
        names = enumeration(str(number + 1) for number in refined.missed)
        what = "Branch" if len(refined.missed) == 1 else "Branches"
        lines.append(f"{what} {names} of `find_singularities` met none of them.")
    return lines


def _group(refined: "Refinement", group: "RefinedGroup") -> str:
    if group.branch is not None:
        where = f"on branch {group.branch + 1}, {place(refined.branches[group.branch])}"
    else:
        none = "on none of the branches of `find_singularities`" if refined.branches else "alike"
        where = f"{none}{_still(group)}"
    shown = "; ".join(vector(q) for q in group.configurations[:SHOWN])
    more = ", ..." if len(group.configurations) > SHOWN else ""
    distinct = count(len(group.configurations), "distinct configuration")
    return f"{len(group.starts)} {where}: {distinct}, of rank {min(group.ranks)}, q = {shown}{more}"


def _still(group: "RefinedGroup") -> str:
    values = [f"{name} = {joint_value(value)}" for name, value in group.values.items()]
    return f", with {enumeration(values)}" if values else ""
