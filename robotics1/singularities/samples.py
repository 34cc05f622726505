"""The configurations of a scan, in chunks that any process can make: random, Sobol's, or those of a grid."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number
from robotics1.robot.box import JointBox

CHUNK = 2**14  # configurations; a power of two, as Sobol's sequence wants
MOST = 2**62  # configurations: they are numbered with 64 bits
METHODS = ("random", "sobol", "grid")

Chunk = Callable[[], Array]  # it can be sent to another process, and returns configurations (n, N), one a column


def samples_of(
    method: str, box: JointBox, samples: int | float | Sequence[int], seed: int, moving: npt.NDArray[np.bool_]
) -> tuple[int, Iterator[Chunk]]:
    """Return how many configurations there are, and them in chunks.

    - "random": uniform in the box. Each chunk has its own stream, named by the seed and its number, and is the
      beginning of a full one: fewer samples are the first of more.
    - "sobol": Sobol's sequence, scrambled: it fills the box more evenly than random numbers do.
    - "grid": all combinations of the joints' values; the last joint's change first.

    Args:
        method: one of `METHODS`.
        box: where they lie.
        samples: how many, as an integer or a whole float such as 1e6; of a grid at most so many, or how many values
            of each joint.
        seed: of the random numbers; a grid has none.
        moving: (n,) the joints that move the task; of the others a grid has one value.

    Raises:
        InputError: the number is none, or too small for a grid.

    Source: Sobol, 1967; the scrambled sequence is SciPy's, with the direction numbers of Joe and Kuo, 2008.
    """
    if len(box.lower) == 0:
        return 1, _random_chunks(box, 1, seed)  # there is one configuration, ()
    if method == "grid":
        axes = _grid_axes(box, samples, moving)
        count = math.prod(map(len, axes))
        starts = range(0, count, CHUNK)
        return count, (partial(_grid_points, axes, start, min(start + CHUNK, count)) for start in starts)
    count = _whole("samples", samples)
    if count >= MOST:
        raise InputError(f"{count} configurations have no end; ask for fewer")
    return count, (_random_chunks if method == "random" else _sobol_chunks)(box, count, seed)


def _random_chunks(box: JointBox, count: int, seed: int) -> Iterator[Chunk]:
    for number, start in enumerate(range(0, count, CHUNK)):
        yield partial(_random_points, box, seed, number, min(CHUNK, count - start))


def _random_points(box: JointBox, seed: int, number: int, size: int) -> Array:
    stream = np.random.SFC64(np.random.SeedSequence([seed, number]))
    return _in_box(box, np.random.Generator(stream).random((len(box.lower), CHUNK))[:, :size])


def _sobol_chunks(box: JointBox, count: int, seed: int) -> Iterator[Chunk]:
    """Yield chunks of points that are made already: the sequence is cheap, but has to be made in order."""
    from scipy.stats import qmc

    sequence = qmc.Sobol(len(box.lower), rng=seed, bits=max(30, count.bit_length()))
    for start in range(0, count, CHUNK):
        yield partial(np.asarray, _in_box(box, sequence.random(CHUNK)[: count - start].T))


def _grid_points(axes: tuple[Array, ...], start: int, stop: int) -> Array:
    places = np.unravel_index(np.arange(start, stop), tuple(map(len, axes)))
    return np.array([axis[place] for axis, place in zip(axes, places, strict=True)])


def _in_box(box: JointBox, unit: Array) -> Array:
    """Return configurations (n, N) of a box from numbers in [0, 1)."""
    q = np.ascontiguousarray(unit)
    q *= (box.upper - box.lower)[:, None]
    q += box.lower[:, None]
    return q


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
