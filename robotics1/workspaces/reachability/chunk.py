"""A chunk of a map: some positions, with all orientations."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.reachability.evaluation import Codes, PoseStatus, evaluator_of
from robotics1.workspaces.reachability.poses import goals_of
from robotics1.workspaces.reachability.result import ReachabilityMap

CHUNKS = 256  # of a map of middle size
LEAST, MOST = 2**13, 2**17  # poses in a chunk, or those of one position if these are more; and the most positions


class ChunkOfMap(NamedTuple):
    """What is known of some positions; the attributes are those of `ReachabilityMap`."""

    status: Codes
    solutions: Codes
    manipulability: Array
    limit_margin: Array
    q: Array
    orientation: npt.NDArray[np.int32]

    def part(self, some: slice) -> "ChunkOfMap":
        """Return what is known of some of the positions."""
        arrays: Any = [values[some] for values in self.arrays]
        return ChunkOfMap(*arrays)

    @property
    def arrays(self) -> tuple[npt.NDArray[Any], ...]:
        """The arrays, in the order of their names."""
        return tuple(self)


def positions_in_a_chunk(k: int, o: int) -> int:
    """Return how many of k positions with o orientations make up a chunk: it depends on nothing else.

    A small map has chunks for every core; in a large one they are so long that handing them out costs little.
    """
    poses = min(max(k * o // CHUNKS, LEAST), MOST)
    return min(max(1, poses // o), LEAST)


def chunk_of_map(packed: bytes, coordinates: str, orientations: Array, place: tuple[int, Array]) -> ChunkOfMap:
    """Return what is known of some positions, given as the number of the first and (k, d): this runs in the workers."""
    _, positions = place
    k, o = len(positions), len(orientations)
    answer = evaluator_of(packed).answers(goals_of(coordinates, positions, orientations))
    manipulability = answer.manipulability.reshape(k, o)
    best = np.argmax(manipulability, axis=1)  # the first of equal ones
    none = (answer.status.reshape(k, o) != PoseStatus.REACHED).all(axis=1)
    margin = answer.limit_margin.reshape(k, o).max(axis=1)
    return ChunkOfMap(
        answer.status.reshape(k, o),
        answer.solutions.reshape(k, o),
        np.where(none, np.nan, manipulability.max(axis=1)),
        np.where(none, np.nan, margin),
        answer.q.reshape(k, o, -1)[np.arange(k), best],
        np.where(none, -1, best).astype(np.int32),
    )


def empty_chunk(k: int, o: int, nq: int) -> ChunkOfMap:
    """Return arrays for k positions with o orientations, of a robot with nq joint values."""
    return ChunkOfMap(
        np.empty((k, o), dtype=np.uint8),
        np.empty((k, o), dtype=np.uint8),
        np.empty(k),
        np.empty(k),
        np.empty((k, nq)),
        np.empty(k, dtype=np.int32),
    )


class Description(NamedTuple):
    """What a map is of; the attributes are those of `ReachabilityMap`, and `counts` whether there are `solutions`."""

    robot: str
    joint_names: tuple[str, ...]
    task: tuple[str, ...]
    coordinates: str
    positions: Array
    orientations: Array
    grid: tuple[Array, ...] | None
    counts: bool

    def finished(self, found: ChunkOfMap) -> ReachabilityMap:
        """Return the map with what was found."""
        solutions = found.solutions if self.counts else None
        return ReachabilityMap(*self[:-1], found.status, solutions, *found[2:])

    @property
    def parts(self) -> list[slice]:
        """The positions of each chunk."""
        k = len(self.positions)
        size = positions_in_a_chunk(k, len(self.orientations))
        return [slice(start, min(start + size, k)) for start in range(0, k, size)]
