"""The command `robotics1 fk`."""

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Frame, Locked, Packages, Parameters, Q, RobotName, Tool

EXAMPLES = ("fk prr --q 0.5,pi/2,0.3pi", "fk ur5 --q 0,-90,90,0,0,0 --degrees", "fk arm.urdf --q zero --json")


def fk(
    robot: RobotName,
    q: Q = None,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    packages: Packages = None,
    lock: Locked = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """Forward kinematics: where a frame is."""
    from robotics1.cli.output import PlainConsole, in_degrees, say_outside_limits, units, write_json
    from robotics1.kinematics import forward_kinematics
    from robotics1.names import printable
    from robotics1.notation import vector

    arm = arguments.parse_robot(robot, param, tool, packages, lock, degrees)
    values = arguments.configuration(arm, q, degrees)
    T = forward_kinematics(arm, values, frame=frame)
    if json:
        known = {"q": units(arm), "position": "m"}
        write_json({"q": values, "position": T.translation, "rotation": T.rotation, "units": known})
        return
    from robotics1.terminal_tables import matrix_table

    out = PlainConsole()
    say_outside_limits(out, arm, values)
    where = f"{printable(frame or arm.tool or '')} of {printable(arm.name)}"
    out.print(f"{where} at q = {vector(in_degrees(arm, values, degrees))}")
    out.print(f"p = {vector(T.translation)} m")
    out.print(matrix_table(T.rotation, title="R"))
