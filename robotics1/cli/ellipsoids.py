"""The command `robotics1 manipulability`."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli.arguments import parse_vector
from robotics1.cli.options import AsJson, Figure, Frame, Q, TaskName, TypedRobot, robot_command

if TYPE_CHECKING:
    from robotics1.singularities.dexterity import Manipulability, Transmission

EXAMPLES = (
    "manipulability planar_2r --q 0.3,1.1 --figure ellipses.svg",
    "manipulability ur5 --task position --q 0,-60,90,0,45,0 --degrees --along 0,0,1",
)


@robot_command
def manipulability(
    arm: TypedRobot,
    q: Q = None,
    task: TaskName = None,
    frame: Frame = None,
    along: Annotated[str | None, typer.Option(help="A direction u: how velocity and force are transmitted.")] = None,
    figure: Figure = None,
    json: AsJson = False,
) -> None:
    """The velocity and force ellipsoids at q, w = √det(J Jᵀ), and the largest speed within the limits of the joints.

    Without --task it is the position: in a pose, metres and radians would count alike.
    """
    import numpy as np

    from robotics1.cli.output import PlainConsole, say_configuration, units, write_json
    from robotics1.singularities.dexterity import manipulability as at_configuration
    from robotics1.singularities.polytopes import MOST, velocity_polytope
    from robotics1.viewer.arm_data import is_planar

    robot, values = arm.robot, arm.configuration(q)
    what = arm.task(task or ("position:xy" if is_planar(robot) else "position"), frame)
    found = at_configuration(robot, what, values)
    passed = None if along is None else found.transmission(parse_vector(along))
    limits = robot.max_velocity
    bounded = 0 < robot.nv <= MOST and bool((np.isfinite(limits) & (limits > 0)).all())
    fastest = velocity_polytope(robot, what, values).largest if bounded else None
    if figure is not None:
        from robotics1.plots.ellipses import plot_ellipses

        plot_ellipses(robot, what, values, file=figure, title=robot.name)
    if json:
        write_json({"q": values, **_as_json(found, passed), "largest_speed": fastest, "units": {"q": units(robot)}})
        return
    out = PlainConsole()
    say_configuration(out, robot, values, q)
    for line in _lines(found, passed):
        out.print(line, markup=False)
    if fastest is not None:
        out.print(f"within the limits of the joints the largest speed is {fastest:.6g}", markup=False)
    if figure is not None:
        out.print(f"written: {figure}", markup=False, soft_wrap=True)


def _as_json(found: "Manipulability", passed: "Transmission | None") -> dict[str, Any]:
    from robotics1.cli.output import attributes

    return {
        **attributes(found, "measure condition"),
        "axes": found.velocity_ellipsoid.axes.T,
        "velocity_lengths": found.velocity_ellipsoid.lengths,
        "force_lengths": found.force_ellipsoid.lengths,
        "transmission": None if passed is None else attributes(passed, "velocity force"),
        "status": found.status.name,
    }


def _lines(found: "Manipulability", passed: "Transmission | None") -> list[str]:
    from robotics1.notation import vector

    fast, strong = found.velocity_ellipsoid, found.force_ellipsoid
    axes = [
        f"along {vector(axis)}: velocity {speed:.6g}, force {force:.6g}"
        for axis, speed, force in zip(fast.axes.T, fast.lengths, strong.lengths, strict=True)
    ]
    along = [] if passed is None else [f"along u: velocity {passed.velocity:.6g}, force {passed.force:.6g}"]
    return [found.explain(), *axes, *along]
