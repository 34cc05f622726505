"""The named parameters of a robot, and how the placements of its joints depend on them.

A xacro file is expanded again at other values, and each number is fitted by a polynomial of the lowest degree up to
two that further expansions confirm.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations_with_replacement
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.errors import UnknownNameError
from robotics1.inputs import Array, real_number
from robotics1.robot.joints import Joint

HIGHEST_DEGREE = 2
CONFIRMATIONS = 2  # expansions beyond those that determine a polynomial
SPREAD = 0.3  # of the values, to both sides
CONFIRMS = 1e-9  # difference of a fitted and an expanded number that is rounding, beside its size
SHORTEST = 1e-6  # length beside the longest, below which rounding may be more than a billionth of it
FEW_DIGITS = 1e-11  # relative: a coefficient this near to one of ten digits is that

Monomial = tuple[str, ...]  # the parameters that are multiplied; () is the constant
Polynomial = Mapping[Monomial, float]


class Parameters(Mapping[str, float]):
    """Name → value, as a mapping that cannot be written to.

    `types.MappingProxyType` is such a mapping too, but it can be neither pickled nor copied.
    """

    def __init__(self, values: Mapping[str, float] | None = None) -> None:
        self._values = dict(values or {})

    def __getitem__(self, name: str) -> float:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return repr(self._values)


def with_values(of: str, known: Mapping[str, float], values: Mapping[str, float]) -> Parameters:
    """Return the known parameters with these values; those that are not named stay.

    Raises:
        InputError: a value is not a finite number.
        UnknownNameError: there is no such parameter `of` what has them.
    """
    for name in values:
        if name not in known:
            raise UnknownNameError(f"parameter of {of} named", name, known)
    return Parameters({**known, **{name: real_number(f"parameter {name!r}", value) for name, value in values.items()}})


class Placement(NamedTuple):
    """The placement of a joint in its parent link, as polynomials in the parameters [m, rad]."""

    xyz: tuple[Polynomial, ...]
    rpy: tuple[Polynomial, ...]

    def at(self, parameters: Mapping[str, float]) -> Array:
        """Return x, y, z, roll, pitch and yaw at these values of the parameters, (6,)."""
        return np.array(
            [
                sum(c * float(np.prod([parameters[name] for name in m])) for m, c in number.items())
                for number in (*self.xyz, *self.rpy)
            ],
            dtype=float,
        )


Placements = Mapping[str, Placement | str]  # of the joints; or the sentence that says why there are no polynomials


def placement_of(coefficients: Sequence[Polynomial]) -> Placement:
    """Return the placement of six polynomials, without their zeros."""
    numbers = [{m: float(c) for m, c in number.items() if c != 0} for number in coefficients]
    return Placement(tuple(numbers[:3]), tuple(numbers[3:]))


def constant_placements(joints: Sequence[Joint]) -> dict[str, Placement | str]:
    """Return the placements of joints that do not depend on parameters."""
    return {joint.name: placement_of([{(): x} for x in (*joint.xyz, *joint.rpy)]) for joint in joints}


def agree(placements: Placements, joints: Sequence[Joint], parameters: Mapping[str, float]) -> bool:
    """Whether polynomials give the placements of these joints, of all of them, at these values of the parameters."""
    if [joint.name for joint in joints] != list(placements):
        return False
    found = [placements[joint.name] for joint in joints]
    known = [placement.at(parameters) for placement in found if not isinstance(placement, str)]
    if len(known) < len(found):
        return False
    numbers = _numbers(joints)
    return bool((np.abs(np.ravel(known) - numbers) <= CONFIRMS * _sizes(numbers[None])).all())


def fitted_placements(
    joints: Sequence[Joint], parameters: Mapping[str, float], joints_at: Callable[[dict[str, float]], Sequence[Joint]]
) -> dict[str, Placement | str]:
    """Return the placements of joints as polynomials in the parameters.

    Args:
        joints: the joints at the values of the parameters.
        parameters: name → value.
        joints_at: gives the joints at other values.
    """
    names, rng = tuple(parameters), np.random.default_rng(0)
    centre = np.array(list(parameters.values()))
    points, numbers = [centre], [_numbers(joints)]
    polynomials: list[dict[Monomial, float]] = [{} for _ in numbers[0]]
    unknown = set(range(len(polynomials)))
    failed: dict[str, str] = {}
    for degree in range(HIGHEST_DEGREE + 1):
        monomials = [m for d in range(degree + 1) for m in combinations_with_replacement(names, d)]
        while len(points) < len(monomials) + CONFIRMATIONS:
            point = centre + np.where(centre == 0, 1.0, np.abs(centre)) * rng.uniform(-SPREAD, SPREAD, len(names))
            others = {joint.name: joint for joint in joints_at(dict(zip(names, map(float, point), strict=True)))}
            failed |= {joint.name: why for joint in joints if (why := _differs(joint, others.get(joint.name)))}
            points.append(point)
            numbers.append(_numbers([others.get(joint.name, joint) for joint in joints]))
        coefficients, wrong = _fit(names, monomials, points, numbers)
        for i in [i for i in unknown if not wrong[i]]:
            polynomials[i] = dict(zip(monomials, coefficients[:, i], strict=True))
            unknown.remove(i)
        if not unknown:
            break
    for i in sorted(unknown):
        name, attribute = joints[i // 6].name, ("xyz", "rpy")[i % 6 // 3]
        failed.setdefault(
            name, f"{attribute} of joint {name!r} is no polynomial of degree {HIGHEST_DEGREE} in the parameters"
        )
    return {j.name: failed.get(j.name) or placement_of(polynomials[6 * k : 6 * k + 6]) for k, j in enumerate(joints)}


def _numbers(joints: Sequence[Joint]) -> Array:
    """Return x, y, z, roll, pitch and yaw of all joints, (6k,)."""
    return np.array([x for joint in joints for x in (*joint.xyz, *joint.rpy)], dtype=float)


def _sizes(numbers: Array) -> Array:
    """Return what counts as one of such numbers of joints, (p, 6k): of a length its largest value, but at least 1e-6 of
    the longest, and of an angle 1 rad; (6k,).
    """
    largest = np.abs(numbers).max(axis=0, initial=0.0).reshape(-1, 2, 3)
    lengths = largest[:, 0]
    longest = lengths.max(initial=0.0)
    largest[:, 0] = np.maximum(lengths, SHORTEST * longest) if longest > 0 else 1.0
    largest[:, 1] = 1.0
    return np.asarray(largest.ravel())


def _differs(joint: Joint, other: Joint | None) -> str | None:
    """Return what differs, beside its placement, in a joint at other values of the parameters."""
    if other is None or (joint.kind, joint.parent, joint.child) != (other.kind, other.parent, other.child):
        return "the joints themselves depend on a parameter"
    if np.abs(np.subtract(joint.axis, other.axis)).max() > CONFIRMS:
        return f"the axis of joint {joint.name!r} depends on a parameter"
    if (joint.leader, joint.multiplier, joint.offset) != (other.leader, other.multiplier, other.offset):
        return f"how joint {joint.name!r} mimics {joint.leader!r} depends on a parameter"
    return None


def _fit(
    names: tuple[str, ...], monomials: list[Monomial], points: list[Array], numbers: list[Array]
) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Return the coefficients of the monomials, (monomials, 6k), and which numbers the last points contradict."""
    matrix = np.array([[np.prod([p[names.index(name)] for name in m]) for m in monomials] for p in points])
    columns = np.maximum(np.abs(matrix).max(axis=0), np.finfo(float).tiny)
    sizes = _sizes(np.array(numbers))
    matrix, flat = matrix / columns, np.array(numbers) / sizes
    count = len(points) - CONFIRMATIONS
    solution = np.linalg.lstsq(matrix[:count], flat[:count], rcond=None)[0]
    wrong = np.abs(matrix @ solution - flat).max(axis=0, initial=0.0) > CONFIRMS
    solution = np.where(np.abs(solution) < CONFIRMS, 0.0, solution) / columns[:, None] * sizes
    rounded = np.array([float(f"{x:.10g}") for x in solution.flat]).reshape(solution.shape)
    return np.where(np.abs(solution - rounded) <= FEW_DIGITS * np.abs(solution), rounded, solution), wrong
