"""What `robotics1 ik --method solve` answers: for one target, or for a file of them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console

from robotics1.cli.arguments import read_text
from robotics1.cli.inverse import parse_target
from robotics1.cli.output import in_degrees, joint_names, progress_bar, write_json
from robotics1.errors import InputError
from robotics1.ik.result import IKBatch, IKResult
from robotics1.ik.solver import IKSolver
from robotics1.inputs import Array
from robotics1.notation import count, vector
from robotics1.report.tables import matrix_table, table
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask

SHOWN = 20  # targets of a file that are printed; JSON has all


@dataclass(frozen=True, eq=False)
class RobustInverse:
    """A question to `IKSolver`, and how its answer is printed."""

    console: Console
    robot: Robot
    task: FrameTask
    q0: Array | None
    options: dict[str, Any]
    degrees: bool
    json: bool

    def answer(self, text: str) -> bool:
        """Print the answer for a target as typed, and return whether it is a solution."""
        target = parse_target(self.task, text, self.degrees)
        result = IKSolver(self.robot, self.task, **self.options)(target, self.q0)
        if self.json:
            write_json(_as_json(result))
            return result.converged
        starts = count(result.starts, "start")
        self.console.print(f"{result.status.name} after {starts}: {result.status.value}")
        if not result.converged:
            self.console.print(f"the nearest miss is |e| = {result.error_norm:.4g} at")
        q = in_degrees(self.robot, result.q, self.degrees)
        self.console.print(matrix_table(q[:, None], joint_names(self.robot), ("q",)))
        if result.converged:
            self.console.print(f"|e| = {result.error_norm:.2g} by forward kinematics")
        return result.converged

    def answer_all(self, path: Path) -> bool:
        """Print the answers for the targets of a file, and return whether all are solutions."""
        targets = read_targets(path, self.task, self.degrees)
        solver = IKSolver(self.robot, self.task, **self.options)
        with progress_bar("solving", hidden=self.json) as progress:
            batch = solver.solve_batch(targets, self.q0, progress=progress)
        if self.json:
            write_json([_as_json(batch[i]) for i in range(len(batch))])
        else:
            self._print(batch)
        return bool(batch.converged.all())

    def _print(self, batch: IKBatch) -> None:
        reached = int(batch.converged.sum())
        self.console.print(f"{reached} of {count(len(batch), 'target')} reached")
        for status in dict.fromkeys(batch.status[~batch.converged]):
            self.console.print(f"{(batch.status == status).sum()} {status.name}: {status.value}")
        missed_first = np.argsort(batch.converged, kind="stable")
        rows = []
        for i in sorted(missed_first[:SHOWN].tolist()):
            q = vector(in_degrees(self.robot, batch.q[i], self.degrees))
            rows.append((str(i + 1), batch.status[i].name, str(batch.starts[i]), f"{batch.error_norm[i]:.2g}", q))
        self.console.print(table(("target", "status", "starts", "|e|", "q"), rows, left=("status",)))
        if len(batch) > SHOWN:
            self.console.print(f"and {len(batch) - SHOWN} more; --json prints all")


def read_targets(path: Path, task: FrameTask, degrees: bool) -> list[Any]:
    """Return the targets of a file, one on each line in the form of --target; # begins a comment.

    Raises:
        InputError: there is no such file, it holds no target, or a line is none; the message tells the line.
    """
    targets = []
    for n, line in enumerate(read_text(path).splitlines(), 1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        try:
            targets.append(task.target(parse_target(task, text, degrees)))
        except InputError as error:
            raise InputError(f"{path}, line {n}: {error}") from error
    if not targets:
        raise InputError(f"there is no target in {path}; write one on each line, as in 1,-1,3")
    return targets


def _as_json(result: IKResult) -> dict[str, Any]:
    return {"status": result.status.name, "q": result.q, "error_norm": result.error_norm, "starts": result.starts}
