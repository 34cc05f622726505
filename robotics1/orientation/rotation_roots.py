"""All rotations with linear conditions on their entries, as the roots of quadratic forms of the quaternion."""

from collections.abc import Sequence
from itertools import combinations_with_replacement

import numpy as np

from robotics1.inputs import Array

DEGREES = (4, 5)  # of the polynomials in which roots are counted: three quadrics are regular from degree 3 on
ZERO = 1e-9  # of the largest singular value
REAL = 0.05  # an imaginary part that may be rounding: of a root of multiplicity m, the m-th root of it
VARIABLES = 4

Monomial = tuple[int, ...]


def rotation_candidates(conditions: list[tuple[Array, float]]) -> Array | None:
    """Return rotations (k, 3, 3), among them all with Σ W ∘ R = x for each (W, x); None if there may be a family.

    With the quaternion u of R each condition is a quadratic form, uᵀ (M − x 1) u = 0. All multiples of these forms of
    degree d have the rank r: if the number of monomials less r is the same N for two degrees, there are N roots over
    the complex numbers, with multiplicity. They are the eigenvalues of the multiplication by a variable, in the null
    space of the multiples. Where N grows there is a family over the complex numbers, and None is returned.

    Source: Cox, Little, O'Shea, Using Algebraic Geometry, 2005, chapters 2 and 3; Dreesen, Batselier, De Moor, Back to
    the roots: polynomial system solving, linear algebra, systems theory, IFAC SYSID 2012.
    """
    from scipy.spatial.transform import Rotation

    forms = [_form(W) - x * np.eye(VARIABLES) for W, x in conditions]
    if len(forms) < VARIABLES - 1:
        return None
    spaces = [_null_space(forms, degree) for degree in DEGREES]
    count = spaces[0].shape[1]
    if spaces[1].shape[1] != count:
        return None
    if not count:
        return np.zeros((0, 3, 3))
    roots = np.reshape(_roots(spaces[1], DEGREES[1]), (-1, VARIABLES))
    return np.asarray(Rotation.from_quat(np.roll(roots, -1, axis=1)).as_matrix()) if len(roots) else np.zeros((0, 3, 3))


def _form(W: Array) -> Array:
    """Return M with Σ W ∘ R(u) = uᵀ M u of a unit quaternion u = (w, x, y, z)."""
    M = np.zeros((4, 4))
    skewed = np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]])
    M[0, 0] = np.trace(W)
    M[0, 1:] = M[1:, 0] = skewed
    M[1:, 1:] = W + W.T - np.trace(W) * np.eye(3)
    return M


def _monomials(degree: int) -> list[Monomial]:
    return list(combinations_with_replacement(range(VARIABLES), degree))


def _null_space(forms: Sequence[Array], degree: int) -> Array:
    """Return an orthonormal basis (monomials, N) of what all multiples of the forms leave."""
    places = {monomial: i for i, monomial in enumerate(_monomials(degree))}
    rows = []
    for form in forms:
        for factor in _monomials(degree - 2):
            row = np.zeros(len(places))
            for i in range(VARIABLES):
                for j in range(VARIABLES):
                    row[places[tuple(sorted((*factor, i, j)))]] += form[i, j]
            rows.append(row / max(1.0, float(np.abs(form).max())))
    _, sigma, Vt = np.linalg.svd(np.array(rows))
    return np.asarray(Vt[int(np.count_nonzero(sigma > ZERO * sigma[:1])) :].T)


def _roots(space: Array, degree: int) -> list[Array]:
    """Return the real roots, up to a factor, in the null space of a degree."""
    places = {monomial: i for i, monomial in enumerate(_monomials(degree))}
    shifted = [
        space[[places[tuple(sorted((*factor, i)))] for factor in _monomials(degree - 1)]] for i in range(VARIABLES)
    ]
    rng = np.random.default_rng(0)
    below = np.linalg.pinv(sum(a * x for a, x in zip(rng.normal(size=VARIABLES), shifted, strict=True)))
    multiplications = [below @ x for x in shifted]  # by each variable, over a linear form that is 1
    mixed = sum(a * x for a, x in zip(rng.normal(size=VARIABLES), multiplications, strict=True))
    _, vectors = np.linalg.eig(mixed)
    found = []
    for v in vectors.T:
        u = np.array([v.conj() @ x @ v for x in multiplications])
        u = u / np.linalg.norm(u) * np.exp(-1j * np.angle(u[np.argmax(np.abs(u))]))
        if np.abs(u.imag).max() <= REAL:
            found.append(u.real)
    return found
