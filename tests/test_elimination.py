"""Echelon forms, null spaces and greatest common divisors of trigonometric polynomials, against numbers."""

import numpy as np
import pytest
from polynomials import VALUES, F, a, b, c, equal, poly, q1, q2, q3, q4, value
from sympy import cos, sin
from test_locus import BOX, loci

from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.elimination import echelon_form, in_whole_angles, primitive_row
from robotics1.symbolic.singular_sets.locus import Locus, Piece
from robotics1.symbolic.singular_sets.locus_sampler import LocusSampler

PLANAR = [
    [
        -a * sin(q1) - b * sin(q1 + q2) - c * sin(q1 + q2 + q3),
        -b * sin(q1 + q2) - c * sin(q1 + q2 + q3),
        -c * sin(q1 + q2 + q3),
    ],
    [
        a * cos(q1) + b * cos(q1 + q2) + c * cos(q1 + q2 + q3),
        b * cos(q1 + q2) + c * cos(q1 + q2 + q3),
        c * cos(q1 + q2 + q3),
    ],
]
POLAR = [
    [-q4 * sin(q1) * sin(q2), q4 * cos(q1) * cos(q2), cos(q1) * sin(q2)],
    [q4 * cos(q1) * sin(q2), q4 * sin(q1) * cos(q2), sin(q1) * sin(q2)],
    [0, q4 * sin(q2), -cos(q2)],
]
ANTHROPOMORPHIC = [
    [
        -sin(q1) * (a * cos(q2) + b * cos(q2 + q3)),
        -cos(q1) * (a * sin(q2) + b * sin(q2 + q3)),
        -b * cos(q1) * sin(q2 + q3),
    ],
    [
        cos(q1) * (a * cos(q2) + b * cos(q2 + q3)),
        -sin(q1) * (a * sin(q2) + b * sin(q2 + q3)),
        -b * sin(q1) * sin(q2 + q3),
    ],
    [0, a * cos(q2) + b * cos(q2 + q3), b * cos(q2 + q3)],
]
SHOULDER = a * cos(q2) + b * cos(q2 + q3)
CASES = {  # matrix, equations of the locus, rank there
    "planar 3R": (PLANAR, (), 2),
    "planar 3R in line": (PLANAR, (sin(q2), sin(q3)), 1),
    "polar": (POLAR, (), 3),
    "polar on the axis": (POLAR, (sin(q2),), 2),
    "polar at the centre": (POLAR, (q4,), 1),
    "anthropomorphic": (ANTHROPOMORPHIC, (), 3),
    "anthropomorphic elbow": (ANTHROPOMORPHIC, (sin(q3),), 2),
    "anthropomorphic shoulder": (ANTHROPOMORPHIC, (SHOULDER,), 2),
    "anthropomorphic elbow and shoulder": (ANTHROPOMORPHIC, (SHOULDER, sin(q3)), 1),
    "zero": ([[0, 0], [0, 0]], (), 0),
}


def numbers(M, q, n=None):
    """A matrix of polynomials, or a list of vectors (n,), at q."""
    return np.array([[value(f, q).real for f in row] for row in M]).reshape(len(M), -1 if n is None else n)


def polynomials(M):
    return np.array([[poly(entry) for entry in row] for row in M], dtype=object)


@pytest.mark.parametrize("transposed", [False, True])
@pytest.mark.parametrize("name", CASES)
def test_row_space_and_null_space_are_those_of_the_singular_values(name, transposed):
    entries, equations, rank = CASES[name]
    M = polynomials(entries).T if transposed else polynomials(entries)
    n = M.shape[1]
    rng = np.random.default_rng(1)
    for locus in loci(*equations) if equations else [Locus(F)]:
        form = echelon_form(M, locus, VALUES)
        assert (len(form.row_space), len(form.null)) == (rank, n - rank)
        piece = Piece(locus, VALUES, {})
        sampler = LocusSampler(piece, BOX)
        for q in (sampler.draw(rng) for _ in range(4)):
            J, rows, null = numbers(M, q), numbers(form.row_space, q, n), numbers(form.null, q, n)
            assert np.linalg.matrix_rank(J, tol=1e-9) == rank
            assert np.linalg.matrix_rank(rows, tol=1e-9) == rank
            assert np.linalg.matrix_rank(np.vstack([J, rows]), tol=1e-9) == rank
            assert np.linalg.matrix_rank(null, tol=1e-9) == n - rank
            assert np.abs(J @ null.T).max(initial=0) <= 1e-10 * max(1, np.abs(null).max(initial=0))


def test_in_the_column_of_a_pivot_all_other_rows_have_zero():
    form = echelon_form(polynomials(PLANAR), Locus(F), VALUES)
    for i, pivot in enumerate(form.pivots):
        assert [bool(row[pivot]) for row in form.row_space] == [k == i for k in range(len(form.pivots))]


def test_what_only_the_given_lengths_make_zero_is_no_pivot():
    """(a − b − 0.1) is no zero, a − b is one at a = b: there the rank is 1 and the null space has two columns."""
    M = polynomials([[a - b, sin(q1)], [0, (a - b) * cos(q1)]])
    apart, same = (echelon_form(M, Locus(F), {**VALUES, b: x}) for x in (0.4, 0.5))
    assert [(len(form.row_space), len(form.null)) for form in (apart, same)] == [(2, 0), (1, 1)]
    assert numbers(same.null, [0.3, 0, 0, 0], 2) @ [0, 1] == pytest.approx([0])


def test_on_the_shoulder_only_the_first_joint_does_not_move_the_anthropomorphic_arm():
    (locus,) = loci(SHOULDER)
    (vector,) = echelon_form(polynomials(ANTHROPOMORPHIC), locus, VALUES).null
    assert [bool(entry) for entry in vector] == [True, False, False]


@pytest.mark.parametrize(
    ("vector", "bare"),
    [
        ((sin(2 * q1), sin(q1)), (2 * cos(q1), 1)),
        ((SHOULDER * sin(q3), SHOULDER * cos(q3)), (sin(q3), cos(q3))),
        ((a * b * sin(q1), b * c * cos(q1)), (a * sin(q1), c * cos(q1))),
        (((1 + cos(q1)) * cos(q2), (1 + cos(q1)) * sin(q2)), (cos(q2), sin(q2))),
        ((q4 * a, q4**2, 0), (a, q4, 0)),
    ],
    ids=str,
)
def test_a_vector_without_its_divisor_is_parallel_to_it_and_shorter(vector, bare):
    found = in_whole_angles(F, primitive_row([poly(entry) for entry in vector], Locus(F)))
    wanted = [poly(entry) for entry in bare]
    ratios = [f.terms[max(f.terms)] for f in (found[0], wanted[0])]
    assert all(equal(f * F.constant(ratios[1]), g * F.constant(ratios[0])) for f, g in zip(found, wanted, strict=True))


def test_the_time_limit_is_kept():
    with TimeLimit(-1).kept(), pytest.raises(OutOfTime):
        echelon_form(polynomials(ANTHROPOMORPHIC), Locus(F), VALUES)
