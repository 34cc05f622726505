"""The command `robotics1 statics`."""

from typing import Annotated

import typer

from robotics1.cli.arguments import parse_vector
from robotics1.cli.jacobian import singularity_as_json
from robotics1.cli.options import AsJson, Frame, Q, TaskName, TypedRobot, robot_command

EXAMPLES = (
    "statics prr --task position:xy --q 0.5,pi/2,pi --force 3,1",
    "statics planar_2r --q 0,90 --force 0,-9.81 --degrees",
)


@robot_command
def statics(
    arm: TypedRobot,
    force: Annotated[str, typer.Option(help="The force on the tool by the environment, one number a task row.")],
    q: Q = None,
    task: TaskName = None,
    frame: Frame = None,
    json: AsJson = False,
) -> None:
    """The torques that balance a force on the tool, τ = −Jᵀ f."""
    import numpy as np

    from robotics1.cli.output import PlainConsole, effort_units, joint_names, say_configuration, units, write_json
    from robotics1.notation import vector
    from robotics1.singularities.explain import directions
    from robotics1.singularities.rounding import singularity_within_rounding
    from robotics1.singularities.statics import balancing_torque

    robot, values = arm.robot, arm.configuration(q)
    rounded = singularity_within_rounding(robot, arm.task(task, frame), values)
    torque = balancing_torque(rounded.spaces.J, parse_vector(force))
    free, there = rounded.spaces.left_null, rounded.at_singularity
    within = np.abs(torque) <= robot.max_effort
    if json:
        answer = {
            "q": values,
            "torque": torque,
            "within_limits": within,
            "forces_without_torque": free.T,
            "units": {"q": units(robot), "torque": effort_units(robot)},
        }
        write_json(answer | {"status": rounded.status.name, "at_singularity": singularity_as_json(rounded)})
        return
    out = PlainConsole()
    say_configuration(out, robot, values, q)
    out.print(f"τ = −Jᵀ f = {vector(torque)} for ({', '.join(joint_names(robot))}) [N m, for a prismatic joint N]")
    for name, value, ok, limit in zip(joint_names(robot), torque, within, robot.max_effort, strict=True):
        if not ok:
            out.print(f"{name} would need {value:.4g}, beyond its effort limit {limit:.4g}", style="yellow")
    if free.size:
        out.print(f"forces along {directions(free)} need no torque")
    if there is not None:
        out.print(rounded.explain(), style="yellow", markup=False)
        out.print(f"there forces along {directions(there.left_null)} need no torque")
