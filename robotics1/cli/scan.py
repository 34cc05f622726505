"""The command `robotics1 scan`."""

from typing import Annotated

import typer

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Frame, Parameters, RobotName, TaskName, Tool
from robotics1.cli.output import PlainConsole


def scan(
    robot: RobotName,
    task: TaskName = "pose",
    samples: Annotated[str, typer.Option(help="How many configurations, as 1e6; of a grid at most so many.")] = "1e6",
    measure: Annotated[
        list[str] | None, typer.Option(help="sigma_min, condition or manipulability; the first tells what is worst.")
    ] = None,
    method: Annotated[str, typer.Option(help="random, sobol or grid.")] = "random",
    seed: Annotated[int, typer.Option(help="Of the random numbers.")] = 0,
    refine: Annotated[int, typer.Option(help="How many of the worst are moved to singular configurations.")] = 0,
    box: Annotated[list[str] | None, typer.Option(help="An interval of a joint, as in q1=-1:pi/2.")] = None,
    length: Annotated[str, typer.Option(help="The length in metres that counts as one, or reach.")] = "1",
    workers: Annotated[int, typer.Option(help="In how many threads.")] = 1,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """How near to singular a task is, over millions of configurations."""
    from robotics1.cli.scan_answer import parse_box, print_scan, run_scan

    arm = arguments.parse_robot(robot, param or [], tool)
    done = run_scan(
        PlainConsole(stderr=True),
        workers,
        arm,
        arguments.parse_task(task, frame),
        samples=arguments.parse_number(samples),
        measures=measure or ["sigma_min"],
        method=method,
        seed=seed,
        refine=refine,
        box=parse_box(arm, box or [], degrees),
        length=arm.reach if length == "reach" else arguments.parse_number(length),
    )
    print_scan(PlainConsole(), done, degrees=degrees, json=json)
