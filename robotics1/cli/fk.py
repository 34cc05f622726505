"""The command `robotics1 fk`."""

from robotics1.cli.options import AsJson, Frame, Q, TypedRobot, robot_command

EXAMPLES = ("fk prr --q 0.5,pi/2,0.3pi", "fk ur5 --q 0,-90,90,0,0,0 --degrees", "fk arm.urdf --q zero --json")


@robot_command
def fk(
    arm: TypedRobot,
    q: Q = None,
    frame: Frame = None,
    json: AsJson = False,
) -> None:
    """Forward kinematics: where a frame is."""
    from robotics1.cli.output import PlainConsole, say_outside_limits, units, write_json
    from robotics1.kinematics import forward_kinematics
    from robotics1.names import printable
    from robotics1.notation import vector

    robot, values = arm.robot, arm.configuration(q)
    T = forward_kinematics(robot, values, frame=frame)
    if json:
        known = {"q": units(robot), "position": "m"}
        write_json({"q": values, "position": T.translation, "rotation": T.rotation, "units": known})
        return
    from robotics1.terminal_tables import matrix_table

    out = PlainConsole()
    say_outside_limits(out, robot, values)
    where = f"{printable(frame or robot.tool or '')} of {printable(robot.name)}"
    out.print(f"{where} at q = {vector(arm.shown(values))}")
    out.print(f"p = {vector(T.translation)} m")
    out.print(matrix_table(T.rotation, title="R"))
