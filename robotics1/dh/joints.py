"""The joints of a DH table.

Each A_i is two screws, and each screw is one joint of the robot, so that every entry of the table stands alone:

    standard: link i−1 ──(d, θ) and q_i──> link i_z ──(a, α)──> link i
    modified: link i−1 ──(a, α)──> link i_x ──(d, θ) and q_i──> link i

Rot_z(θ) Trans_z(d) commutes with the motion about or along z, so the constant part may come first, as in every joint.
"""

import pinocchio as pin

from robotics1.dh.table import DHTable
from robotics1.robot.joints import Joint, placed
from robotics1.robot.parameters import Placement, Placements, Polynomial, constant_placements, placement_of


def links_of_row(convention: str, i: int) -> tuple[str, str, str]:
    """Return the links of A_i: i − 1, the one after the first of its two screws, and i."""
    return f"link{i - 1}", f"link{i}_{'z' if convention == 'standard' else 'x'}", f"link{i}"


def links_of(table: DHTable) -> list[str]:
    """Return all links: base, link0, ..., tool."""
    rows = range(1, len(table.rows) + 1)
    return ["base", "link0", *(link for i in rows for link in links_of_row(table.convention, i)[1:]), "tool"]


def joints_of(table: DHTable) -> tuple[Joint, ...]:
    """Return the joints, from the base to the tool."""
    joints = [_mount("base_mount", "base", "link0", table.base_placement)]
    for i, (kind, a, alpha, d, theta) in enumerate(table.numbers, 1):
        previous, half, link = links_of_row(table.convention, i)
        moving, fixed = (
            ((previous, half), (half, link)) if table.convention == "standard" else ((half, link), (previous, half))
        )
        turns = Joint(
            f"q{i}",
            "revolute" if kind == "R" else "prismatic",
            *moving,
            xyz=(0.0, 0.0, d),
            rpy=(0.0, 0.0, theta),
            axis=(0.0, 0.0, 1.0),
            lower=float(table.lower[i - 1]),
            upper=float(table.upper[i - 1]),
        )
        still = Joint(f"x{i}", "fixed", *fixed, xyz=(a, 0.0, 0.0), rpy=(alpha, 0.0, 0.0))
        joints += [turns, still] if table.convention == "standard" else [still, turns]
    return (*joints, _mount("tool_mount", f"link{len(table.rows)}", "tool", table.tool_placement))


def placements_of(table: DHTable) -> Placements:
    """Return the placements of these joints as polynomials in the names of the table."""
    found = constant_placements(joints_of(table))
    for i, (_, a, alpha, d, theta) in enumerate(table.rows, 1):
        found[f"q{i}"] = named_placement((0.0, 0.0, d), (0.0, 0.0, theta))
        found[f"x{i}"] = named_placement((a, 0.0, 0.0), (alpha, 0.0, 0.0))
    return found


def named_placement(xyz: tuple[float | str, ...], rpy: tuple[float | str, ...]) -> Placement:
    """Return the placement of numbers and names [m, rad]."""
    return placement_of([_polynomial(entry) for entry in (*xyz, *rpy)])


def _polynomial(entry: float | str) -> Polynomial:
    if not isinstance(entry, str):
        return {(): entry}
    return {(entry.removeprefix("-"),): -1.0 if entry.startswith("-") else 1.0}


def _mount(name: str, parent: str, child: str, T: pin.SE3) -> Joint:
    return placed(Joint(name, "fixed", parent, child), T)
