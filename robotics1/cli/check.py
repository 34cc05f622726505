"""The command `robotics1 check`: the verdict on a robot file, and what was understood of it."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

from robotics1.cli.arguments import parse_number, read_text
from robotics1.cli.options import AsJson, RobotOfFormulas, robot_command
from robotics1.errors import InputError
from robotics1.names import printable

if TYPE_CHECKING:
    from rich.text import Text
    from rich.tree import Tree

    from robotics1.cli.output import PlainConsole
    from robotics1.robot.findings import RobotReport
    from robotics1.robot.model import Robot

EXAMPLES = (
    "check arm.urdf",
    "check arm.urdf --dh table.csv --convention modified",
    "check arm.urdf --packages ros/src",
)
COLUMNS = ["type", "a", "alpha", "d", "theta"]


@robot_command
def check(
    arm: RobotOfFormulas,
    dh: Annotated[Path | None, typer.Option("--dh", help="A CSV file type,a,alpha,d,theta to compare with.")] = None,
    convention: Annotated[str, typer.Option(help="Of the DH table: standard or modified.")] = "standard",
    json: AsJson = False,
) -> None:
    """The verdict on a robot file, and what was understood of it."""
    from robotics1.cli.output import PlainConsole, write_json
    from robotics1.dh.to_robot import robot_from_dh
    from robotics1.robot.findings import AGREES
    from robotics1.robot.loading import check_robot

    found = check_robot(arm.source, **arm.loading)
    difference = None
    if dh is not None and found.robot is not None:
        difference = _difference_from(found.robot, robot_from_dh(read_dh_table(dh), convention=cast(Any, convention)))
    sound = found.sound and (difference is None or difference <= AGREES)
    if json:
        write_json(_as_json(found, difference, sound))
    else:
        _print(PlainConsole(), found, difference)
    raise typer.Exit(0 if sound else 1)


def read_dh_table(path: Path) -> list[tuple[str, float, float, float, float]]:
    """Return the rows of a DH table from a CSV file with the columns type, a, alpha, d, theta.

    Raises:
        InputError: there is no such file, it is no text, or it has other columns.
    """
    lines = [line for line in read_text(path).splitlines() if line.strip()]
    rows = [[cell.strip() for cell in row] for row in csv.reader(lines)]
    if not rows or [cell.lower() for cell in rows[0]] != COLUMNS:
        raise InputError(f"{path} must begin with the line {','.join(COLUMNS)}")
    wrong = next((row for row in rows[1:] if len(row) != len(COLUMNS)), None)
    if wrong is not None:
        raise InputError(f"a row of {path} has {len(wrong)} values instead of 5: {','.join(wrong)}")
    return [(row[0], *(parse_number(cell) for cell in row[1:])) for row in rows[1:]]  # type: ignore[misc]


def _difference_from(robot: Robot, other: Robot) -> float:
    """Return the largest difference of the tools' poses of two robots with the same number of joints.

    Raises:
        InputError: the numbers of joints differ.
    """
    import numpy as np

    from robotics1.kinematics import forward_kinematics
    from robotics1.robot.findings import random_configurations, relative_difference

    if robot.nq != other.nq:
        raise InputError(f"the DH table has {other.nq} joints, and the tool of the robot hangs on {robot.nq}")
    worst = 0.0
    for q in random_configurations(robot, 20, np.random.default_rng(0)):
        poses = (forward_kinematics(arm, q).homogeneous for arm in (robot, other))
        worst = max(worst, relative_difference(*poses))
    return worst


def _as_json(found: RobotReport, dh_difference: float | None, sound: bool) -> dict[str, Any]:
    """Return the report as plain data."""
    from robotics1.cli.output import attributes, units
    from robotics1.robot.joints import tips

    answer: dict[str, Any] = {
        "path": str(found.path),
        "sound": sound,
        "errors": [attributes(finding, "line element message") for finding in found.errors],
        "warnings": [attributes(finding, "line element message") for finding in found.warnings],
        "fk_difference": found.fk_difference,
        "dh_difference": dh_difference,
    }
    robot = found.robot
    if robot is not None:
        answer |= {
            **attributes(robot, "name nq nv lower upper tool"),
            "joints": list(robot.joint_names),
            "units": {"q": units(robot), "parameters": "m"},
            "tips": list(tips(robot.frame_names, robot.joints)),
            "parameters": dict(robot.parameters),
        }
    return answer


def _print(out: PlainConsole, found: RobotReport, dh_difference: float | None) -> None:
    """Print the verdict, and the robot as it was understood."""
    from rich.text import Text

    from robotics1.notation import count
    from robotics1.robot.description import joint_table
    from robotics1.robot.joints import tips
    from robotics1.terminal_tables import table

    for finding in found.errors:
        out.print(Text.assemble(("error", "red"), f" {printable(str(finding))}"), soft_wrap=True)
    for finding in found.warnings:
        out.print(Text.assemble(("warning", "yellow"), f" {printable(str(finding))}"), soft_wrap=True)
    robot, path = found.robot, printable(str(found.path))
    if robot is None:
        out.print(f"{path} is no robot: {count(len(found.errors), 'error')}.", soft_wrap=True)
        return
    out.print(_link_tree(robot))
    joints = joint_table(robot)
    out.print(table(joints.headings, joints.rows, left=("joint", "kind")))
    listed = ", ".join(map(printable, tips(robot.frame_names, robot.joints)))
    out.print(f"tips: {listed}; tool: {printable(robot.tool or 'open, name it with --tool')}")
    out.print(_agreement("yourdfpy's parser", found.fk_difference))
    if dh_difference is not None:
        out.print(_agreement("the DH table", dh_difference))
    out.print(f"{path} is a robot with {count(robot.nv, 'degree')} of freedom.", soft_wrap=True)


def _link_tree(robot: Robot) -> Tree:
    """Return the links as a tree, each with the joint it hangs on."""
    from rich.text import Text
    from rich.tree import Tree

    model = robot.own_model
    nodes: dict[int, Tree] = {}
    tree = Tree(printable(robot.name))
    for i, frame in enumerate(model.frames):
        parent = nodes.get(frame.parentFrame, tree)
        if frame.name in robot.frame_names and frame.type.name == "BODY":
            joint = model.frames[frame.parentFrame]
            above = {"JOINT": f" ({joint.name})", "FIXED_JOINT": f" (fixed: {joint.name})"}.get(joint.type.name, "")
            label = "" if joint.name == "universe" else above
            nodes[i] = parent.add(Text.assemble(printable(frame.name), (printable(label), "dim")))
        else:
            nodes[i] = parent
    return tree


def _agreement(other: str, difference: float | None) -> Text:
    from rich.text import Text

    from robotics1.robot.findings import AGREES

    if difference is None:
        return Text(f"forward kinematics was not compared with {other}")
    verdict = ("agrees with", "") if difference <= AGREES else ("differs from", "red")
    return Text.assemble("forward kinematics ", verdict, f" {other}: largest difference {difference:.1e}")
