"""The configurations of a scan, in chunks that any process can make: random, Sobol's, or those of a grid."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number
from robotics1.robot.box import JointBox

CHUNK = 2**14  # configurations; a power of two, as Sobol's sequence wants
MOST = 2**62  # configurations: they are numbered with 64 bits
METHODS = ("random", "sobol", "grid")


class Chunk(Protocol):
    """Some of the configurations; it can be sent to another process."""

    def points(self) -> Array:
        """Return them, (n, N), one a column."""


class Samples(Protocol):
    """All configurations of a scan."""

    @property
    def count(self) -> int:
        """How many there are."""

    def chunks(self) -> Iterator[Chunk]:
        """Return them in chunks, always the same."""


def samples_of(
    method: str, box: JointBox, samples: int | float | Sequence[int], seed: int, moving: npt.NDArray[np.bool_]
) -> Samples:
    """Return the samples of a method.

    Args:
        method: one of `METHODS`.
        box: where they lie.
        samples: how many, as an integer or a whole float such as 1e6; of a grid at most so many, or how many values
            of each joint.
        moving: (n,) the joints that move the task; of the others a grid has one value.
        seed: of the random numbers; a grid has none.

    Raises:
        InputError: the number is none, or too small for a grid.
    """
    if len(box.lower) == 0:
        return RandomSamples(box.lower, box.upper, 1, seed)  # there is one configuration, ()
    if method == "grid":
        return GridSamples(_grid_axes(box, samples, moving))
    count = _whole("samples", samples)
    if count >= MOST:
        raise InputError(f"{count} configurations have no end; ask for fewer")
    kind = RandomSamples if method == "random" else SobolSamples
    return kind(box.lower, box.upper, count, seed)


@dataclass(frozen=True, eq=False)
class RandomSamples:
    """Uniform in the box. Each chunk has its own stream, named by the seed and its number, and is the beginning of a
    full one: fewer samples are the first of more.
    """

    lower: Array
    upper: Array
    count: int
    seed: int

    def chunks(self) -> Iterator[Chunk]:
        """Return them in chunks, always the same."""
        for number, start in enumerate(range(0, self.count, CHUNK)):
            yield RandomChunk(self.lower, self.upper, self.seed, number, min(CHUNK, self.count - start))


@dataclass(frozen=True, eq=False)
class RandomChunk:
    """One chunk of `RandomSamples`."""

    lower: Array
    upper: Array
    seed: int
    number: int
    size: int

    def points(self) -> Array:
        """Return them, (n, N), one a column."""
        stream = np.random.SFC64(np.random.SeedSequence([self.seed, self.number]))
        unit = np.random.Generator(stream).random((len(self.lower), CHUNK))[:, : self.size]
        return _in_box(self.lower, self.upper, np.ascontiguousarray(unit))


@dataclass(frozen=True, eq=False)
class SobolSamples:
    """Sobol's sequence, scrambled: it fills the box more evenly than random numbers do.

    Source: Sobol, 1967; the scrambled sequence is SciPy's, with the direction numbers of Joe and Kuo, 2008.
    """

    lower: Array
    upper: Array
    count: int
    seed: int

    def chunks(self) -> Iterator[Chunk]:
        """Return them in chunks, always the same; the sequence itself is cheap, but has to be made in order."""
        from scipy.stats import qmc

        sequence = qmc.Sobol(len(self.lower), rng=self.seed, bits=max(30, self.count.bit_length()))
        for start in range(0, self.count, CHUNK):
            unit = sequence.random(CHUNK)[: self.count - start]
            yield GivenChunk(_in_box(self.lower, self.upper, np.ascontiguousarray(unit.T)))


@dataclass(frozen=True, eq=False)
class GivenChunk:
    """A chunk of points that are already made."""

    given: Array

    def points(self) -> Array:
        """Return them, (n, N), one a column."""
        return self.given


@dataclass(frozen=True, eq=False)
class GridSamples:
    """All combinations of the joints' values; the last joint's change first."""

    axes: tuple[Array, ...]

    @property
    def count(self) -> int:
        """How many there are."""
        return math.prod(map(len, self.axes))

    def chunks(self) -> Iterator[Chunk]:
        """Return them in chunks, always the same."""
        for start in range(0, self.count, CHUNK):
            yield GridChunk(self.axes, start, min(start + CHUNK, self.count))


@dataclass(frozen=True, eq=False)
class GridChunk:
    """One chunk of `GridSamples`."""

    axes: tuple[Array, ...]
    start: int
    stop: int

    def points(self) -> Array:
        """Return them, (n, N), one a column."""
        places = np.unravel_index(np.arange(self.start, self.stop), tuple(map(len, self.axes)))
        return np.array([axis[place] for axis, place in zip(self.axes, places, strict=True)])


def _in_box(lower: Array, upper: Array, unit: Array) -> Array:
    unit *= (upper - lower)[:, None]
    unit += lower[:, None]
    return unit


def _grid_axes(box: JointBox, samples: int | float | Sequence[int], moving: npt.NDArray[np.bool_]) -> tuple[Array, ...]:
    """Return the values of each joint: limits included, of a circle both ends once, a single value in the middle."""
    n = len(box.lower)
    if isinstance(samples, list | tuple) or (isinstance(samples, np.ndarray) and samples.ndim > 0):
        if len(samples) != n:
            raise InputError(f"a grid wants the number of values of each of {n} joints; samples has {len(samples)}")
        sizes = [_whole(f"samples[{i}]", value) for i, value in enumerate(samples)]
    else:
        sizes = np.where(moving, _each(_whole("samples", samples), int(moving.sum())), 1).tolist()
    if math.prod(sizes) >= MOST:
        raise InputError(f"{' × '.join(map(str, sizes))} configurations have no end; ask for fewer")
    return tuple(_axis(*joint) for joint in zip(box.lower, box.upper, box.circular, sizes, strict=True))


def _each(total: int, joints: int) -> int:
    """Return the largest k with k^joints ≤ total."""
    if total >= MOST:
        raise InputError(f"{total} configurations have no end; ask for fewer")
    k: int = round(total ** (1 / joints))
    if k**joints > total:
        k -= 1
    if k < 2:
        raise InputError(f"a grid over {joints} joints has at least {2**joints} configurations; samples is {total}")
    return k


def _axis(lower: float, upper: float, circular: bool, size: int) -> Array:
    if circular and size > 1:
        return upper - (upper - lower) * np.arange(size)[::-1] / size
    return np.linspace(lower, upper, size) if size > 1 else np.array([(lower + upper) / 2])


def _whole(name: str, value: Any) -> int:
    """Return a positive integer, also if it comes as a float, such as 1e6."""
    if isinstance(value, float | np.floating) and float(value).is_integer():
        value = int(value)
    return counting_number(name, value, least=1)
