"""A product of rotations recognised: a sequence of angles between two constant rotations."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations
from typing import Any

import numpy as np

from robotics1.errors import FormulaError, InputError
from robotics1.orientation.elementary import turn
from robotics1.orientation.expressions import expressions, simplified

MOST = 5  # angles
TRIALS = 4
AGREES = 1e-10


@dataclass(frozen=True)
class RecognisedSequence:
    """R = B · Rot(e₁, φ₁) Rot(e₂, φ₂) ⋯ · C, in SymPy.

    Attributes:
        sequence: the axes, such as "ZYZ" or "Z-YX", as `euler_formulas` takes them; fewer letters of fewer angles.
        angles: φ₁, φ₂, ...: the symbols, or sums of them with constants left to C.
        left: B, constant; the identity where the axes are those of the frame.
        right: C, constant.
    """

    sequence: str
    angles: tuple[Any, ...]
    left: Any
    right: Any

    def explain(self) -> str:
        """Return the product as it is written on paper."""
        import sympy

        names = ", ".join(map(str, self.angles))
        before = "" if self.left == sympy.eye(3) else "B "
        after = "" if self.right == sympy.eye(3) else " C"
        constants = [f"{n} = {M.tolist()}" for n, M in (("B", self.left), ("C", self.right)) if sympy.eye(3) != M]
        return "; ".join([f"R = {before}R_{self.sequence}({names}){after}", *constants])


def recognise_sequence(R: Any, angles: Sequence[Any] | None = None) -> RecognisedSequence:
    """Return the sequence of rotations about moving axes that a symbolic rotation is, times constant rotations.

    R(x) = Rot(a₁, x₁) Rot(a₂, x₂) ⋯ R(0), with aᵢ the axis of ∂R/∂xᵢ Rᵀ at x = 0 (a product of exponentials). Where
    the aᵢ are coordinate axes, or those of one constant frame B, they spell a sequence. So Rz(a) Rx(π/2) Ry(b) Rx(−π/2)
    is one turn Z by a + b, and Rz(a) Rx(−π/2) Rz(b) Rx(π/2) Rz(c), of a spherical wrist, is ZYZ.

    Args:
        R: (3, 3) in SymPy, of up to five angles; each is multiplied by 1 or −1.
        angles: the symbols, or their names; by default all that are in R.

    Raises:
        InputError: R is no matrix of expressions, or has no angle.
        FormulaError: R is no product of rotations about constant axes by these angles, or its axes are those of no
            sequence: consecutive ones are not perpendicular.

    Source: Lynch, Park, Modern Robotics, 2017, section 4.1.
    """
    import sympy

    entries = expressions("R", R, (3, 3))
    if entries.dtype != object:
        raise InputError("R must hold SymPy expressions of its angles; it holds numbers alone")
    M = sympy.Matrix(entries)
    symbols = _angles(M, angles)
    at_zero = dict.fromkeys(symbols, 0)
    C = M.subs(at_zero).applyfunc(sympy.simplify)
    if C.free_symbols or (C.T * C - sympy.eye(3)).applyfunc(sympy.simplify) != sympy.zeros(3, 3):
        raise FormulaError(f"at zero angles R is no constant rotation; it is {C.tolist()}")
    axes = {x: _axis(M, C, x, at_zero) for x in symbols}
    order = _order(M, C, axes)
    merged = _merged(order, axes)
    left, letters = _spelled([axis for axis, _ in merged])
    return RecognisedSequence(letters, tuple(angle for _, angle in merged), left, (left.T * C).applyfunc(simplified))


def _angles(M: Any, angles: Sequence[Any] | None) -> list[Any]:
    """Return the symbols of the angles, as they are in R."""
    inside = {symbol.name: symbol for symbol in M.free_symbols}
    if angles is not None and not isinstance(angles, Sequence):
        raise InputError(f"angles must be symbols or their names, as ['a', 'b']; it is {angles!r}")
    names = sorted(inside) if angles is None else [str(angle) for angle in angles]
    missing = [name for name in names if name not in inside]
    if missing or not 1 <= len(names) <= MOST or len(inside) != len(names):
        raise InputError(f"R must be in 1 to {MOST} angles, the ones that are given; it has {sorted(inside)}")
    return [inside[name] for name in names]


def _axis(M: Any, C: Any, x: Any, at_zero: dict[Any, Any]) -> Any:
    """Return the axis a of R at zero, (3, 1), a unit vector of exact numbers."""
    import sympy

    S = (M.diff(x).subs(at_zero) * C.T).applyfunc(sympy.simplify)
    if (S + S.T).applyfunc(sympy.simplify) != sympy.zeros(3, 3):
        raise FormulaError(f"R does not turn with {x}: ∂R/∂{x} Rᵀ is not skew-symmetric")
    a = sympy.Matrix([S[2, 1], S[0, 2], S[1, 0]])
    length = sympy.simplify(a.dot(a))
    if length != 1:
        raise FormulaError(f"R must turn by {x} or −{x}, and it turns by √{length} times it")
    return a


def _order(M: Any, C: Any, axes: dict[Any, Any]) -> list[Any]:
    """Return the angles in the order of the product, that agrees with R in numbers.

    Raises:
        FormulaError: none does.
    """
    import sympy

    symbols = list(axes)
    numbers = sympy.lambdify(symbols, M, "numpy")
    rng = np.random.default_rng(0)
    points = rng.uniform(-2, 2, (TRIALS, len(symbols)))
    theirs = [np.array(numbers(*x), dtype=float) for x in points]
    vectors = {x: np.array(a.evalf(), dtype=float).ravel() for x, a in axes.items()}
    constant = np.array(C.evalf(), dtype=float)
    for order in permutations(symbols):
        ours = []
        for x in points:
            values = dict(zip(symbols, x.tolist(), strict=True))
            product = np.eye(3)
            for symbol in order:
                product = product @ turn(vectors[symbol], values[symbol])
            ours.append(product @ constant)
        if np.allclose(ours, theirs, atol=AGREES, rtol=0):
            return list(order)
    raise FormulaError("R is no product of rotations about constant axes, each by one of its angles")


def _merged(order: list[Any], axes: dict[Any, Any]) -> list[tuple[Any, Any]]:
    """Return axis and angle of each rotation; two about one line, one after the other, are one by the sum."""
    import sympy

    found: list[tuple[Any, Any]] = []
    for x in order:
        a = axes[x]
        if found and (found[-1][0].cross(a)).applyfunc(sympy.simplify) == sympy.zeros(3, 1):
            axis, angle = found[-1]
            found[-1] = (axis, angle + sympy.sign(axis.dot(a)) * x)
        else:
            found.append((a, x))
    return found


def _spelled(axes: list[Any]) -> tuple[Any, str]:
    """Return the constant frame B (3, 3) and the letters of the axes in it.

    Raises:
        FormulaError: consecutive axes are not perpendicular, or a later one is along no axis of B.
    """
    import sympy

    named = [_letter(a) for a in axes]
    if all(named):
        return sympy.eye(3), "".join(named)
    frame = [axes[0]]
    if len(axes) > 1:
        if sympy.simplify(axes[0].dot(axes[1])) != 0:
            raise FormulaError("two consecutive axes are not perpendicular: no sequence of coordinate axes has them")
        frame.append(axes[1])
    z = frame[0]
    y = frame[1] if len(frame) > 1 else _normal(z)
    B = sympy.Matrix.hstack(y.cross(z), y, z).applyfunc(sympy.simplify)
    named = [_letter((B.T * a).applyfunc(sympy.simplify)) for a in axes]
    if not all(named):
        raise FormulaError("an axis is along none of the frame of the others: no sequence of coordinate axes has them")
    return B, "".join(named)


def _letter(a: Any) -> str:
    """Return "X", "-X", ... of a coordinate axis, else ""."""
    for i, letter in enumerate("XYZ"):
        if [a[j] for j in range(3) if j != i] == [0, 0]:
            return letter if a[i] == 1 else f"-{letter}"
    return ""


def _normal(z: Any) -> Any:
    """Return a unit vector normal to z."""
    import sympy

    smallest = min(range(3), key=lambda i: abs(float(z[i])))
    e = sympy.zeros(3, 1)
    e[smallest] = 1
    n = z.cross(e)
    return (n / sympy.sqrt(n.dot(n))).applyfunc(sympy.simplify)
