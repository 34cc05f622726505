"""Forty arms drawn at random beside plain NumPy; `make fuzz` tries 300."""

import pytest
from arms_at_random import LARGEST, arm_number, errors_of


@pytest.mark.parametrize("number", range(30))
def test_an_arm_drawn_at_random_is_the_plain_chain(number, tmp_path):
    assert_right(errors_of(number, tmp_path, seconds=0.5, sets=5, longest=3))


@pytest.mark.sweep
@pytest.mark.parametrize("number", range(30, 40))
def test_so_it_is_with_formulas_of_longer_arms_and_every_singular_set(number, tmp_path):
    assert_right(errors_of(number, tmp_path))


def assert_right(found):
    assert {"fk", "jacobian", "rate"} <= set(found)
    assert {name: error for name, error in found.items() if not error <= LARGEST[name]} == {}


def test_the_same_number_is_the_same_arm_and_the_arms_are_of_many_kinds():
    assert arm_number(5)[1] == arm_number(5)[1]
    arms = [arm_number(number)[0] for number in range(30)]
    assert {len(arm.joints) for arm in arms} == set(range(1, 9))
    assert any(joint.leader != i for arm in arms for i, joint in enumerate(arm.joints))
    assert min(arm.size for arm in arms) < 0.01
    assert max(arm.size for arm in arms) > 10
