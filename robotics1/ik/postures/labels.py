"""The names of postures: "shoulder right", "elbow up", "wrist not flipped"."""

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from robotics1.errors import TaskError
from robotics1.ik.joint_chain import FixedChain, chain_and_rows
from robotics1.ik.postures.determinant import Determinant, determinant
from robotics1.ik.postures.factors import EXACT, Factor, posture_factors, some_coordinates
from robotics1.ik.scaled_task import kept_for_poses, scaled_task
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

NO_POSTURE = 1e-6  # of a factor, beside its largest value, that is zero but for rounding: at a singularity
SAMPLES = 64  # configurations at which the largest values are taken


@dataclass(frozen=True, eq=False)
class Postures:
    """What distinguishes the postures of an arm.

    Attributes:
        chain: of the joints that move the task.
        factors: what vanishes between two postures; none where the arm has no postures with names.
        sizes: (f,) the largest values of the factors.
        rounded: whether its axes are parallel, or meet, but for rounding only.
        determinant: det J, whose sign stands in for names; None where J is not square.
    """

    chain: FixedChain | None
    factors: tuple[Factor, ...]
    sizes: Array
    rounded: bool
    determinant: Determinant | None

    @property
    def remark(self) -> str:
        """What is to be said of an arm whose axes are parallel, or meet, but for rounding."""
        return (
            " Its axes are taken as parallel, or meeting, where they are so but for rounding." if self.rounded else ""
        )

    def values(self, q: Array) -> Array:
        """Return the factors relative to their largest values at configurations (k, nq): (k, f)."""
        if self.chain is None or not self.factors:
            return np.zeros((len(q), 0))
        lines = self.chain.lines(q[:, list(self.chain.coordinate)])
        return np.stack([factor.values(lines) for factor in self.factors], axis=1) / self.sizes

    def labels(self, q: Array) -> tuple[tuple[str, ...], ...]:
        """Return the names of the postures at configurations (k, nq)."""
        if self.factors:
            return tuple(tuple(map(_word, self.factors, row)) for row in self.values(q))
        if self.determinant is None:
            return ((),) * len(q)
        signs = np.sign(np.where(np.abs(values := self.determinant(q)) < NO_POSTURE, 0.0, values))
        return tuple((f"det J {'<=>'[int(sign) + 1]} 0",) for sign in signs)


@kept_for_poses
def postures(robot: Robot, task: Task) -> Postures:
    """Return what distinguishes the postures of a robot in a task."""
    problem = scaled_task(robot, task, open_ranges=True)
    chain, rows = chain_and_rows(problem)
    factors = () if chain is None else posture_factors(chain, rows)
    if chain is None or not factors:
        square = None
        with suppress(TaskError):
            square = determinant(robot, task)
        return Postures(chain, (), np.zeros(0), False, square)
    lines = chain.lines(some_coordinates(chain, SAMPLES))
    sizes = np.array([np.abs(factor.values(lines)).max() for factor in factors])
    exact = posture_factors(chain, rows, EXACT)
    rounded = [factor.part for factor in exact] != [factor.part for factor in factors]
    return Postures(chain, factors, sizes, rounded, None)


def _word(factor: Factor, value: float) -> str:
    if abs(value) < NO_POSTURE:
        return f"{factor.part} singular"
    return f"{factor.part} {factor.positive if value > 0 else factor.negative}"
