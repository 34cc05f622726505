"""The pseudoinverse of a weighted norm, or of a semi-norm, in numbers and in symbols."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import FormulaError, InputError
from robotics1.inputs import Array, dimensions, real_array
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse

SEMIDEFINITE = 1e-12  # of the largest eigenvalue: a negative one above this is rounding


def weighted_pseudoinverse(J: Any, weights: Any = None) -> Any:
    """Return J#, (n, m): of all q̇ with the least |ṙ − J q̇|, q̇ = J# ṙ has the least q̇ᵀ W q̇.

    With N of a basis of the null space of J: J# = J⁺ − N (NᵀWN)⁺ NᵀW J⁺. Where W is positive definite and J has full
    row rank this is W⁻¹Jᵀ(J W⁻¹Jᵀ)⁻¹. W may be semidefinite, a semi-norm: joints of weight zero cost nothing. Where it
    then leaves a choice, as two such joints can, the shortest q̇ is taken.

    Args:
        J: (m, n) numbers; or a SymPy matrix of full row rank, for a formula.
        weights: (n,) not negative, the diagonal of W, or (n, n) symmetric and positive semidefinite; None for 1. Of a
            SymPy matrix they may be expressions.

    Raises:
        InputError: J is no matrix, or the weights are none.
        FormulaError: in symbols, J has not full row rank, or W leaves a choice.

    Source: Whitney, IEEE Trans. Man-Machine Systems 10, 1969 (weights); Ben-Israel, Greville, Generalized Inverses,
    2003, section 3.4 (semi-norms).
    """
    if hasattr(J, "free_symbols"):
        return weighted_pseudoinverse_formula(J, weights)
    J = real_array("J", J, (None, None), "a matrix")
    W = _semidefinite(weights, J.shape[1])
    found = generalized_inverse(J)
    N, inverse = found.null, found.solve(np.eye(len(J)))
    return inverse - N @ np.linalg.pinv(N.T @ W @ N, rcond=RANK_TOLERANCE, hermitian=True) @ (N.T @ W @ inverse)


def _semidefinite(weights: npt.ArrayLike | None, n: int) -> Array:
    """Return W, (n, n).

    Raises:
        InputError: it is not symmetric and positive semidefinite.
    """
    if weights is None:
        return np.eye(n)
    if dimensions("weights", weights) < 2:
        w = real_array("weights", weights, (n,), "one number for each column of J")
        if (w < 0).any():
            raise InputError(f"weights must not be negative; they are {w.tolist()}")
        return np.diag(w)
    W = real_array("weights", weights, (n, n), "a symmetric matrix")
    values = np.linalg.eigvalsh(0.5 * (W + W.T))
    if not np.allclose(W, W.T, rtol=1e-12) or values[:1] < -SEMIDEFINITE * np.abs(values).max(initial=0.0):
        raise InputError(f"weights must be a symmetric, positive semidefinite matrix; it is {W.tolist()}")
    return W


def weighted_pseudoinverse_formula(J: Any, weights: Any, minors: Mapping[tuple[int, ...], Any] | None = None) -> Any:
    """Return J# in symbols: of all sets C of m columns, Σ w_C det J_C adj J_C / Σ w_C (det J_C)² (Cauchy and Binet).

    For a diagonal W, w_C is the product of the weights of the other columns, so that weights may be zero. Another W is
    read from [[W, Jᵀ], [J, 0]]⁻¹, since W q̇ + Jᵀλ = 0 and J q̇ = ṙ. `minors` are known det J_C: the columns that are
    left out → the minor.
    """
    import sympy

    m, n = J.shape
    if weights is None:
        W = sympy.eye(n)
    else:
        W = sympy.Matrix(weights) if np.ndim(weights) == 2 or hasattr(weights, "rows") else sympy.diag(*weights)
    if W.shape != (n, n) or W != W.T:
        raise InputError(f"weights must be {n} numbers or expressions, or a symmetric {n} × {n} matrix")
    if not W.is_diagonal():
        K = sympy.Matrix(sympy.BlockMatrix([[W, J.T], [J, sympy.zeros(m, m)]]))
        return _divided(K.adjugate()[:n, n:], K.det(method="berkowitz"))
    above, below = sympy.zeros(n, m), sympy.S.Zero
    for columns in combinations(range(n), m):
        out = tuple(i for i in range(n) if i not in columns)
        others, chosen = sympy.Mul(*(W[i, i] for i in out)), J[:, list(columns)]
        minor = short(sympy.expand(chosen.det(method="berkowitz"))) if minors is None else minors[out]
        adjugate = chosen.adjugate()
        for row, column in enumerate(columns):
            for i in range(m):
                above[column, i] += others * minor * adjugate[row, i]
        below += others * minor**2
    return _divided(above, below)


def _divided(numerator: Any, determinant: Any) -> Any:
    below = short(determinant)
    if below == 0:
        raise FormulaError(
            "the pseudoinverse has no such formula: J has not full row rank, or the weights leave a choice"
        )
    return numerator.applyfunc(lambda entry: short(short(entry) / below))


MOST_OPERATIONS = 25  # of an expression that is simplified: longer ones stay as they are


def short(expression: Any) -> Any:
    """Return an expression with trigonometric identities applied, where it is short and they make it shorter."""
    import sympy

    if sympy.count_ops(expression) > MOST_OPERATIONS:
        return expression
    candidates = [expression, sympy.trigsimp(expression)]
    return min(candidates, key=lambda e: (sympy.count_ops(e), str(e)))


def null_vectors(
    J: Any, pivots: tuple[int, ...], minors: Mapping[tuple[int, ...], Any] | None = None
) -> list[list[Any]]:
    """Return n − m vectors in the null space of J, of its minors: polynomials in its entries, so that none jumps.

    For each other column k, with c₀ < c₁ < ... of the pivots and k: v[cᵢ] = (−1)ⁱ det of these without cᵢ (Cramer).

    Args:
        J: (m, n) numbers; or in symbols, with its minors.
        pivots: m columns whose minor is not zero.
        minors: the minors of J, if they are known: the columns that are left out → the minor.
    """
    m, n = J.shape
    found = []
    for k in (k for k in range(n) if k not in pivots):
        columns, v = sorted({*pivots, k}), [0 * J[0, 0] if m else 0] * n
        for i, c in enumerate(columns):
            rest = [other for other in columns if other != c]
            out = tuple(other for other in range(n) if other not in rest)
            v[c] = (-1) ** i * (np.linalg.det(J[:, rest]) if minors is None else minors[out])
        found.append(v)
    return found


def pivot_columns(J: Array) -> tuple[int, ...]:
    """Return the m columns with the largest minor, of a matrix (m, n) of full row rank and of moderate size."""
    m, n = J.shape
    return max(combinations(range(n), m), key=lambda columns: abs(float(np.linalg.det(J[:, list(columns)]))))
