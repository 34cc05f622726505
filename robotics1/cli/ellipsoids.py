"""The command `robotics1 manipulability`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Frame, Locked, Packages, Parameters, Q, RobotName, TaskName, Tool

if TYPE_CHECKING:
    from robotics1.singularities.dexterity import Manipulability, Transmission

EXAMPLES = (
    "manipulability planar_2r --q 0.3,1.1 --figure ellipses.svg",
    "manipulability ur5 --task position --q 0,-60,90,0,45,0 --degrees --along 0,0,1",
)


def manipulability(
    robot: RobotName,
    q: Q = None,
    task: TaskName = None,
    frame: Frame = None,
    along: Annotated[str | None, typer.Option(help="A direction u: how velocity and force are transmitted.")] = None,
    figure: Annotated[Path | None, typer.Option(help="A file for the ellipses: .svg, .pdf or .png.")] = None,
    param: Parameters = None,
    tool: Tool = None,
    packages: Packages = None,
    lock: Locked = None,
    degrees: Degrees = False,
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

    arm = arguments.parse_robot(robot, param, tool, packages, lock, degrees)
    values = arguments.configuration(arm, q, degrees)
    what = arguments.task_for(arm, task or ("position:xy" if is_planar(arm) else "position"), frame)
    found = at_configuration(arm, what, values)
    passed = None if along is None else found.transmission(arguments.parse_vector(along))
    bounded = 0 < arm.nv <= MOST and np.isfinite(arm.max_velocity).all()
    fastest = velocity_polytope(arm, what, values).largest if bounded else None
    if figure is not None:
        from robotics1.plots.ellipses import plot_ellipses

        plot_ellipses(arm, what, values, file=figure, title=arm.name)
    if json:
        write_json({"q": values, **_as_json(found, passed), "largest_speed": fastest, "units": {"q": units(arm)}})
        return
    out = PlainConsole()
    say_configuration(out, arm, values, q)
    for line in _lines(found, passed):
        out.print(line, markup=False)
    if fastest is not None:
        out.print(f"within the limits of the joints the largest speed is {fastest:.6g}", markup=False)
    if figure is not None:
        out.print(f"written: {figure}", markup=False, soft_wrap=True)


def _as_json(found: "Manipulability", passed: "Transmission | None") -> dict[str, Any]:
    return {
        "measure": found.measure,
        "condition": found.condition,
        "axes": found.velocity_ellipsoid.axes.T,
        "velocity_lengths": found.velocity_ellipsoid.lengths,
        "force_lengths": found.force_ellipsoid.lengths,
        "transmission": None if passed is None else {"velocity": passed.velocity, "force": passed.force},
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
