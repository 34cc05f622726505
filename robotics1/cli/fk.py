"""The command `robotics1 fk`."""

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Frame, Packages, Parameters, Q, RobotName, Tool
from robotics1.cli.output import PlainConsole, in_degrees, say_outside_limits, write_json
from robotics1.names import printable
from robotics1.notation import vector


def fk(
    robot: RobotName,
    q: Q = None,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    packages: Packages = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """Forward kinematics: where a frame is."""
    from robotics1.kinematics import forward_kinematics
    from robotics1.tables import matrix_table

    arm = arguments.parse_robot(robot, param, tool, packages)
    values = arguments.configuration(arm, q, degrees)
    T = forward_kinematics(arm, values, frame=frame)
    if json:
        write_json({"q": values, "position": T.translation, "rotation": T.rotation})
        return
    out = PlainConsole()
    say_outside_limits(out, arm, values)
    where = f"{printable(frame or arm.tool or '')} of {printable(arm.name)}"
    out.print(f"{where} at q = {vector(in_degrees(arm, values, degrees))}")
    out.print(f"p = {vector(T.translation)} m")
    out.print(matrix_table(T.rotation, title="R"))
