"""The command `robotics1 statics`."""

from typing import Annotated

import typer

from robotics1.cli import arguments
from robotics1.cli.jacobian import singularity_as_json
from robotics1.cli.options import AsJson, Degrees, Frame, Locked, Packages, Parameters, Q, RobotName, TaskName, Tool

EXAMPLES = (
    "statics prr --task position:xy --q 0.5,pi/2,pi --force 3,1",
    "statics planar_2r --q 0,90 --force 0,-9.81 --degrees",
)


def statics(
    robot: RobotName,
    force: Annotated[str, typer.Option(help="The force on the tool by the environment, one number a task row.")],
    q: Q = None,
    task: TaskName = None,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    packages: Packages = None,
    lock: Locked = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """The torques that balance a force on the tool, τ = −Jᵀ f."""
    import numpy as np

    from robotics1.cli.output import PlainConsole, effort_units, joint_names, say_configuration, units, write_json
    from robotics1.notation import vector
    from robotics1.singularities.explain import directions
    from robotics1.singularities.rounding import singularity_within_rounding
    from robotics1.singularities.statics import balancing_torque

    arm = arguments.parse_robot(robot, param, tool, packages, lock, degrees)
    values = arguments.configuration(arm, q, degrees)
    what = arguments.task_for(arm, task, frame)
    rounded = singularity_within_rounding(arm, what, values)
    torque = balancing_torque(rounded.spaces.J, arguments.parse_vector(force))
    free, there = rounded.spaces.left_null, rounded.at_singularity
    within = np.abs(torque) <= arm.max_effort
    if json:
        answer = {
            "q": values,
            "torque": torque,
            "within_limits": within,
            "forces_without_torque": free.T,
            "units": {"q": units(arm), "torque": effort_units(arm)},
        }
        write_json(answer | {"status": rounded.status.name, "at_singularity": singularity_as_json(rounded)})
        return
    out = PlainConsole()
    say_configuration(out, arm, values, q)
    out.print(f"τ = −Jᵀ f = {vector(torque)} for ({', '.join(joint_names(arm))}) [N m, for a prismatic joint N]")
    for name, value, ok, limit in zip(joint_names(arm), torque, within, arm.max_effort, strict=True):
        if not ok:
            out.print(f"{name} would need {value:.4g}, beyond its effort limit {limit:.4g}", style="yellow")
    if free.size:
        out.print(f"forces along {directions(free)} need no torque")
    if there is not None:
        out.print(rounded.explain(), style="yellow", markup=False)
        out.print(f"there forces along {directions(there.left_null)} need no torque")
