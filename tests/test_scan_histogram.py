import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays

from robotics1 import InputError
from robotics1.singularities.reduction import BINS, distribution_of

POSITIVE = np.random.default_rng(0).lognormal(-1, 3, 20_000)
EXTREMES = np.array([0.0, 5e-324, 2.0**-61, 2.0**-60, 1 - 2**-53, 1.0, 1 + 2**-7, 2.0**60, 1e300, np.inf])


def test_every_value_is_between_the_edges_of_its_bin():
    edges, counts = distribution_of(POSITIVE).histogram(128)
    assert np.array_equal(counts, np.histogram(POSITIVE, edges)[0])
    assert np.all(np.diff(edges) / edges[:-1] <= 1 / 128 * (1 + 1e-15))


def test_what_is_smaller_than_2_to_the_minus_60_or_not_smaller_than_2_to_the_60_is_in_an_outer_bin():
    bins = distribution_of(EXTREMES).bins
    assert (bins[0], bins[-1]) == (3, 3)
    assert bins[1] == 1  # 2⁻⁶⁰ itself
    assert len(bins) == BINS
    edges, counts = distribution_of(EXTREMES).histogram()
    assert (edges[0], edges[-1]) == (0, np.inf)
    assert counts.sum() == len(EXTREMES)


@pytest.mark.parametrize("per_octave", [1, 2, 16])
def test_coarse_bins_hold_what_the_fine_ones_hold(per_octave):
    edges, counts = distribution_of(POSITIVE).histogram(per_octave)
    assert np.array_equal(counts, np.histogram(POSITIVE, edges)[0])
    assert edges[1:] / edges[:-1] == pytest.approx(np.full(len(counts), 2 ** (1 / per_octave)), rel=0.1)


def test_an_octave_has_edges_that_are_powers_of_two():
    edges, counts = distribution_of(np.array([0.3, 0.5, 0.6, 2.5])).histogram()
    assert list(edges) == [0.25, 0.5, 1, 2, 4]
    assert list(counts) == [1, 2, 0, 1]


@given(arrays(float, st.integers(1, 40), elements=st.floats(1e-15, 1e15)), st.floats(0, 1))
def test_a_quantile_is_the_inverse_of_the_distribution_to_0_4_percent(values, p):
    exact = float(np.quantile(values, p, method="inverted_cdf"))
    assert distribution_of(values).quantile(p) == pytest.approx(exact, rel=1 / 256)


def test_minimum_and_maximum_are_exact():
    found = distribution_of(POSITIVE)
    assert (found.quantile(0), found.quantile(1)) == (found.minimum, found.maximum) == (POSITIVE.min(), POSITIVE.max())


def test_two_distributions_joined_are_that_of_all_values():
    joined = distribution_of(POSITIVE[:7000]).joined(distribution_of(POSITIVE[7000:]))
    every = distribution_of(POSITIVE)
    assert np.array_equal(joined.bins, every.bins)
    assert (joined.count, joined.minimum, joined.maximum) == (every.count, every.minimum, every.maximum)


def test_no_values_join_with_any_and_have_no_quantile():
    nothing = distribution_of(np.empty(0))
    assert nothing.joined(distribution_of(POSITIVE)).minimum == POSITIVE.min()
    assert nothing.histogram()[1].size == 0
    with pytest.raises(InputError, match="there are no values"):
        nothing.quantile(0.5)


@pytest.mark.parametrize("p", [-0.1, 1.1, np.nan, "half"])
def test_a_part_that_is_none_is_refused(p):
    with pytest.raises(InputError):
        distribution_of(POSITIVE).quantile(p)


@pytest.mark.parametrize("per_octave", [0, 3, 256, 1.5])
def test_bins_that_do_not_fit_an_octave_are_refused(per_octave):
    with pytest.raises(InputError, match="per_octave must be"):
        distribution_of(POSITIVE).histogram(per_octave)
