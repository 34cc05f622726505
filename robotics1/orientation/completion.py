"""A rotation matrix with some entries known: all rotations that have them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from robotics1.errors import InputError, NotConverged
from robotics1.inputs import Array, real_number
from robotics1.notation import count
from robotics1.orientation.elementary import cross_matrix
from robotics1.orientation.nearest import PRINTED
from robotics1.orientation.rotation_roots import rotation_candidates
from robotics1.results import Frozen

STARTS = 600  # rotations, spread over all; Newton's method runs from each
ROUNDS = 60
EXACT = 1e-10  # the residual of entries that are exact
SAME = 1e-5  # entries of one solution
MOST = 16  # isolated solutions; more are members of a family
SHOWN = 8  # members of a family
FEWEST, MANY = 3, 12  # decimals of a printed number
LONGEST = 0.7  # rad, of one step
UNIT = 1e-9  # |Σ x² − 1| of known entries that fill a row or a column


@dataclass(frozen=True, eq=False)
class CompletedRotations(Frozen):
    """The rotations with given entries.

    Attributes:
        rotations: (k, 3, 3) all of them; of a family, some members.
        names: of the unknown entries that have one.
        values: (k, len(names)) theirs, in each rotation.
        dimension: 0 where the rotations are isolated; else how many parameters the family has.
        complete: whether the number of roots says that there is no other rotation; a family shows some members.
        correction: the largest change of a given entry: of entries printed with few digits, their rounding.
    """

    rotations: Array
    names: tuple[str, ...]
    values: Array
    dimension: int
    correction: float
    complete: bool

    def explain(self) -> str:
        """Return how many there are, in a sentence."""
        if not len(self.rotations):
            return "no rotation has these entries"
        if self.dimension:
            return f"infinitely many rotations have these entries: a family of {count(self.dimension, 'parameter')}"
        return f"{count(len(self.rotations), 'rotation')} with these entries"

    def require(self) -> CompletedRotations:
        """Return this, if there is a rotation.

        Raises:
            NotConverged: there is none.
        """
        if not len(self.rotations):
            raise NotConverged(self.explain(), self)
        return self


def complete_rotation(M: Any, *, tolerance: float = PRINTED) -> CompletedRotations:
    """Return all rotations that have the known entries of a matrix.

        complete_rotation([[None, 0.5, None], ["a", None, 0], [0.5, "b", None]])

    Entries that fill a row or a column leave zeros in it. The others are quadratic forms of the quaternion of R: where
    they have finitely many roots over the complex numbers, all are found by eigenvalues, and `complete` is true. Else,
    and for printed entries, Newton's method searches from 600 rotations that are spread over all. The solutions have
    the entries to 1e-10, or to their printed digits.

    Args:
        M: (3, 3) of numbers; None or a name for an entry that is not known. A name that comes twice is one number.
        tolerance: the largest correction of a given entry that is accepted, where the entries are printed ones.

    Raises:
        InputError: M is not (3, 3), or an entry is neither a number between −1 and 1, nor None, nor a name.

    Source: Dreesen, Batselier, De Moor, Back to the roots, IFAC SYSID 2012 (`rotation_roots.py`).
    """
    known, names = _read(M)
    slack = real_number("tolerance", tolerance, non_negative=True)
    conditions = _conditions(_filled(known), names)
    candidates = rotation_candidates(conditions)
    R = _improved(conditions, _spread() if candidates is None else candidates, EXACT)
    complete = candidates is not None
    if not len(R):
        R = _improved(conditions, _spread(), slack)
        complete = complete and not len(R)
    R = _distinct(R)
    dimension = 0
    if len(R) > MOST or (not len(conditions) and len(R)):
        dimension = 3 - max(int(np.linalg.matrix_rank(x, tol=1e-6)) for x in _slopes(conditions, R))
        R = R[:SHOWN]
    labels = tuple(dict.fromkeys(name for name in names.flat if name))
    places = [next(zip(*np.nonzero(names == name), strict=True)) for name in labels]
    values = np.array([[x[place] for place in places] for x in R]).reshape(len(R), len(labels))
    given = ~np.isnan(known)
    correction = max((float(np.abs(x - known)[given].max(initial=0.0)) for x in R), default=0.0)
    return CompletedRotations(R, labels, values, int(dimension), correction, complete)


def _read(M: Any) -> tuple[Array, Any]:
    """Return the entries, NaN where they are not known, and the names of those, "" where they have none."""
    try:
        raw = np.array([[M[i][j] for j in range(3)] for i in range(3)], dtype=object)
        right = len(M) == 3 and all(len(row) == 3 for row in M)
    except (TypeError, IndexError, KeyError) as error:
        raise InputError(f"M must have 3 rows of 3 entries; it is {M!r}") from error
    if not right:
        raise InputError(f"M must have 3 rows of 3 entries; it is {M!r}")
    known, names = np.full((3, 3), np.nan), np.full((3, 3), "", dtype=object)
    for place, entry in np.ndenumerate(raw):
        if entry is None:
            continue
        if isinstance(entry, str) or getattr(entry, "is_Symbol", False):
            names[place] = str(entry)
            continue
        number = real_number("an entry of M", entry)
        if abs(number) > 1 + PRINTED:
            raise InputError(f"an entry of M must be between −1 and 1; it is {number:g}")
        known[place] = number
    return known, names


def _filled(known: Array) -> Array:
    """Return the entries with the zeros that a full row or column leaves, so that no solution is a double one."""
    found = known.copy()
    for _ in range(3):
        for lines in (found, found.T):
            for line in lines:
                if abs(np.nansum(line**2) - 1) <= UNIT + sum(map(_rounding, line)):
                    line[np.isnan(line)] = 0.0
    return found


def _rounding(x: float) -> float:
    """Return what half a unit of the last of three decimals or more changes in x²; 0 of another number."""
    decimals = len(repr(float(x)).partition(".")[2])
    return float(abs(x) * 10.0**-decimals) if FEWEST <= decimals <= MANY else 0.0


def _conditions(known: Array, names: Any) -> list[tuple[Array, float]]:
    """Return (W, x) with Σ W ∘ R = x of each known entry, and of each pair of entries with one name."""
    found: list[tuple[Array, float]] = []
    for place, value in np.ndenumerate(known):
        if not np.isnan(value):
            W = np.zeros((3, 3))
            W[place] = 1.0
            found.append((W, float(value)))
    for a, b in combinations([place for place, name in np.ndenumerate(names) if name], 2):
        if names[a] == names[b]:
            W = np.zeros((3, 3))
            W[a], W[b] = 1.0, -1.0
            found.append((W, 0.0))
    return found


def _slopes(conditions: list[tuple[Array, float]], R: Array) -> Array:
    """Return the derivatives of the conditions along turns of each R (s, 3, 3) about the world's axes, (s, k, 3)."""
    W = np.array([w for w, _ in conditions]).reshape(-1, 3, 3)
    turned = np.array([cross_matrix(e) for e in np.eye(3)])
    return np.asarray(np.einsum("kij,aim,smj->ska", W, turned, R))


def _gaps(conditions: list[tuple[Array, float]], R: Array) -> Array:
    """Return what each condition lacks at each R, (s, k)."""
    W = np.array([w for w, _ in conditions]).reshape(-1, 3, 3)
    return np.asarray(np.array([x for _, x in conditions]) - np.einsum("kij,sij->sk", W, R))


def _spread() -> Array:
    """Return rotations that are spread over all, (s, 3, 3)."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.random(STARTS, rng=np.random.default_rng(0)).as_matrix())


def _improved(conditions: list[tuple[Array, float]], R: Array, accepted: float) -> Array:
    """Return the rotations at which Newton's method from each R ends with a residual that is accepted, (k, 3, 3)."""
    from scipy.spatial.transform import Rotation

    if not conditions or not len(R):
        return R
    for _ in range(ROUNDS):
        steps = np.einsum("sak,sk->sa", np.linalg.pinv(_slopes(conditions, R), rcond=1e-8), _gaps(conditions, R))
        lengths = np.linalg.norm(steps, axis=1, keepdims=True)
        R = Rotation.from_rotvec(steps * np.minimum(1.0, LONGEST / np.maximum(lengths, 1e-300))).as_matrix() @ R
    return np.asarray(R[np.abs(_gaps(conditions, R)).max(axis=1) <= accepted])


def _distinct(R: Array) -> Array:
    """Return the rotations without repetitions, in a fixed order, and without the last digit."""
    kept: list[Array] = []
    for x in R:
        if all(np.abs(x - y).max() > SAME for y in kept):
            kept.append(x)
    rounded = [np.where(np.abs(x - np.round(x)) < 1e-12, np.round(x), x) + 0.0 for x in kept]
    return np.array(sorted(rounded, key=lambda x: x.round(6).tolist(), reverse=True)).reshape(-1, 3, 3)
