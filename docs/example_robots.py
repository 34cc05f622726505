"""Write docs/example_robots.md: every model file of example-robot-data, and what it is loaded as."""

import time
from pathlib import Path

from robotics1.errors import Robotics1Error
from robotics1.robot.loading import load_robot
from robotics1.robot.model import Robot
from robotics1.robot.sources import example_folder, example_robots

PAGE = Path(__file__).with_suffix(".md")
HEAD = """# The robots of example-robot-data

`pip install 'robotics1[robots]'`, then `load_robot("ur5")`. Written by `docs/example_robots.py`; load times are of one
run on one machine. The tool is the only tip, or the tip called `tool0` or `tool`; where it is open, name it:
`load_robot("panda", tool="panda_hand_tcp")`.

| name | file | joints | degrees of freedom | mimicking | meshes | warnings | tool | load [ms] |
|---|---|---|---|---|---|---|---|---|
"""
REFUSED = """
## Refused

| file | why |
|---|---|
"""


def main() -> None:
    """Write the page."""
    folder = example_folder()
    names = {path: name for name, path in example_robots().items()}
    rows, refused = [], []
    for path in sorted([*folder.rglob("*.urdf"), *folder.rglob("*.xacro")]):
        file = path.relative_to(folder).as_posix()
        start = time.perf_counter()
        try:
            robot = load_robot(path)
        except Robotics1Error as error:
            refused.append(f"| `{file}` | {str(error).replace(str(folder) + '/', '').replace('|', '∣')} |")
            continue
        elapsed = 1e3 * (time.perf_counter() - start)
        rows.append(row(names.get(path), file, robot, elapsed))
    PAGE.write_text(HEAD + "\n".join(rows) + "\n" + REFUSED + "\n".join(refused) + "\n", encoding="utf-8")


def row(name: str | None, file: str, robot: Robot, elapsed: float) -> str:
    """Return a line of the table."""
    mimicking = sum("Mimic" in joint.shortname() for joint in robot.model.joints)
    meshes = robot.urdf.count("<mesh ") - robot.urdf.count("<undrawn")
    cells = [
        f"`{name}`" if name else "",
        f"`{file}`",
        len(robot.joint_names),
        robot.nv,
        mimicking or "",
        meshes or "",
        len(robot.warnings) or "",
        f"`{robot.tool}`" if robot.tool else "open",
        f"{elapsed:.0f}",
    ]
    return "| " + " | ".join(map(str, cells)) + " |"


if __name__ == "__main__":
    main()
