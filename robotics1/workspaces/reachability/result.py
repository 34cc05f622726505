"""The map of what an arm reaches, and its sentences."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.names import printable
from robotics1.notation import vector
from robotics1.results import Frozen
from robotics1.workspaces.reachability.evaluation import NOT_COUNTED, Codes, PoseStatus


@dataclass(frozen=True, eq=False)
class ReachabilityMap(Frozen):
    """What an arm reaches of many poses: k positions, each with the same o orientations.

    Attributes:
        robot: the name of the robot.
        joint_names: the names of its joints.
        task: what the rows of the task are, such as ("x", "y", "z").
        coordinates: the letters of the coordinates of a position, such as "xyz".
        positions: (k, d) [m], in the axes of the task.
        orientations: (o, 3, 3); one identity where orientation does not count.
        grid: (d,) the values of each coordinate if the positions are a grid, the last one changing first; else None.
        status: (k, o) of `PoseStatus`: 0 proven out of reach, 1 not found, 2 reached by a q inside the limits.
        solutions: (k, o) how many configurations reach the pose, 255 where that is not known; None where they are not
            counted, for example of a redundant arm.
        manipulability: (k,) the largest of √det(J Jᵀ), in SI units, of the configurations found at a position, over
            all orientations; NaN where none is reached. Where solutions are counted these are all; of a redundant arm
            as many of each pose as `configurations` asked for, so that the largest of all may be larger.
        limit_margin: (k,) the largest distance from the joint limits of those configurations: of each the least over
            its joints of 2 min(q − lower, upper − q)/(upper − lower), 1 in the middle, 0 at a limit; NaN likewise.
        q: (k, nq) a configuration with that manipulability [rad or m]; NaN likewise.
        orientation: (k,) the number of the orientation that it has; −1 where none is reached.
    """

    robot: str
    joint_names: tuple[str, ...]
    task: tuple[str, ...]
    coordinates: str
    positions: Array
    orientations: Array
    grid: tuple[Array, ...] | None
    status: Codes
    solutions: Codes | None
    manipulability: Array = field(repr=False)
    limit_margin: Array = field(repr=False)
    q: Array = field(repr=False)
    orientation: npt.NDArray[np.int32] = field(repr=False)

    def __len__(self) -> int:
        return len(self.positions)

    @cached_property
    def reached(self) -> npt.NDArray[np.bool_]:
        """(k, o) which poses are reached."""
        return np.asarray(self.status == PoseStatus.REACHED)

    @cached_property
    def capability(self) -> Array:
        """(k,) the share of the orientations that is reached at each position."""
        return np.asarray(self.reached.mean(axis=1))

    @cached_property
    def most_solutions(self) -> npt.NDArray[np.int64] | None:
        """(k,) the largest number of solutions that is known at a position; None where they are not counted."""
        if self.solutions is None:
            return None
        counted = np.where(self.solutions == NOT_COUNTED, 0, self.solutions)
        return np.asarray(counted.max(axis=1), dtype=np.int64)

    def counts(self) -> dict[PoseStatus, int]:
        """Return how many poses have each status."""
        return {status: int(np.count_nonzero(self.status == status)) for status in PoseStatus}

    @property
    def complete(self) -> bool:
        """Whether every pose that is not reached is proven to be out of reach."""
        return bool((self.status != PoseStatus.NOT_FOUND).all())

    @property
    def volume(self) -> float | None:
        """The volume [m³] (or area, or length) of the cells of a grid whose position is reached; None without a grid.

        A cell reaches halfway to the next values of each coordinate; a coordinate with one value does not count.
        """
        if self.grid is None:
            return None
        size = np.ones(1)
        for axis in self.grid:
            size = np.outer(size, _widths(axis)).ravel()
        return float(size[self.reached.any(axis=1)].sum())

    def on_grid(self, values: Array) -> Array:
        """Return values (k, ...) of the positions by the numbers of their coordinates in the grid.

        Raises:
            ValueError: the positions are no grid.
        """
        if self.grid is None:
            raise ValueError("the positions are no grid")
        return values.reshape(*(len(axis) for axis in self.grid), *values.shape[1:])

    def explain(self) -> str:
        """Return what is reached, and how sure that is, in sentences."""
        return printable(_sentences(self), keep="\n")


def _widths(axis: Array) -> Array:
    """Return how much of a coordinate belongs to each of its values."""
    if len(axis) == 1:
        return np.ones(1)
    middle = (axis[1:] + axis[:-1]) / 2
    return np.diff(np.concatenate([[2 * axis[0] - middle[0]], middle, [2 * axis[-1] - middle[-1]]]))


def _sentences(known: ReachabilityMap) -> str:
    counts, k, o = known.counts(), len(known), len(known.orientations)
    reached, some = counts[PoseStatus.REACHED], int(known.reached.any(axis=1).sum())
    what = f"{k} positions" if o == 1 else f"{k} positions with {o} orientations each, {k * o} poses"
    lines = [
        f"{known.robot}, task ({', '.join(known.task)}): of {what}, {reached} are reached inside the joint limits, "
        f"{counts[PoseStatus.UNREACHABLE]} are proven to be out of reach, and {counts[PoseStatus.NOT_FOUND]} were not "
        f"found{', which proves nothing' if counts[PoseStatus.NOT_FOUND] else ''}."
    ]
    if not some:
        return lines[0]
    if o > 1:
        full = int((known.capability == 1).sum())
        lines.append(
            f"{some} positions are reached with some orientation, {full} with all; the mean share of the orientations "
            f"at those is {100 * known.capability.sum() / some:.3g} %."
        )
    volume = known.volume
    if volume is not None:
        unit = ("", "m", "m²", "m³")[sum(len(axis) > 1 for axis in known.grid or ())]
        lines.append(f"The cells of the grid that are reached make up {volume:.4g} {unit}.".replace(" .", "."))
    if known.solutions is not None:
        counted = known.solutions[known.reached & (known.solutions != NOT_COUNTED)]
        if counted.size:
            lines.append(
                f"A pose that is reached has up to {counted.max()} solutions, {counted.mean():.3g} on average."
            )
    best = int(np.nanargmax(known.manipulability))
    lines.append(
        f"The largest manipulability is {known.manipulability[best]:.4g}, at ({', '.join(known.coordinates)}) = "
        f"{vector(known.positions[best])} with q = {vector(known.q[best])}."
    )
    return "\n".join(lines)
