import pytest
from exams.comparison import Comparison, agreement
from sympy import Symbol, sin


@pytest.mark.parametrize(
    ("printed", "computed", "found"),
    [
        ("0.4392", 0.43918, "rounded"),
        ("0.06895", 0.0689569, "truncated"),
        ("-1.3452", -1.3452787, "truncated"),
        ("0.06895", 0.068961, None),
        ("0.06895", 0.068949, "rounded"),
        ("1.380", 1.38037, "rounded"),
        ("2", -2.0, None),
        ("3", 3.00004, "rounded"),
        ("3", 3.0002, None),
        ("0", -2.2e-16, "rounded"),
        ("-0.0000", 2.2e-16, "rounded"),
    ],
)
def test_a_printed_number_holds_when_the_computed_one_rounds_or_truncates_to_it(printed, computed, found):
    assert agreement(printed, computed) == found


def test_an_erratum_is_a_known_wrong_sign_and_nothing_else():
    comparison = Comparison(frozenset({"a", "b", "c"}))
    comparison.numbers("1", "a", "2", -2.0)  # the known print error
    comparison.numbers("1", "b", "2", -2.1)  # known, but the value is another
    comparison.numbers("1", "c", "2", 2.0)  # known, but printed right after all
    comparison.numbers("1", "d", "2", -2.0)  # not known
    assert [check.agreement for check in comparison.checks] == ["erratum", None, "rounded", None]
    assert [check.name for check in comparison.failures()] == ["b", "d"]


def test_a_formula_holds_when_it_is_equal_in_symbols_and_its_text_is_kept():
    x = Symbol("x", real=True)
    comparison = Comparison()
    comparison.formula("1", "right", "2*sin(x)*cos(x)", sin(2 * x))
    comparison.formula("1", "wrong by little", "sin(x)*1.000000001", sin(x))
    assert [check.agreement for check in comparison.checks] == ["formula", None]
    assert [check.computed for check in comparison.checks] == ["sin(2*x)", "sin(x)"]
    assert [check.printed for check in comparison.failures()] == ["sin(x)*1.000000001"]


def test_two_checks_of_one_name_and_rows_of_other_lengths_are_refused():
    comparison = Comparison()
    comparison.numbers("1", "a", "2", 2.0)
    with pytest.raises(ValueError, match="two checks have the name 'a'"):
        comparison.numbers("1", "a", "2", 2.0)
    with pytest.raises(ValueError, match="3 numbers are printed and 2 computed"):
        comparison.numbers("1", "b", "1 2 3", [1.0, 2.0])
