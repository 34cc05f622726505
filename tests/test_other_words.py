"""Words of other packages: each names an attribute or a call that there is."""

import copy
import inspect
import pickle

import pytest
from hypothesis import given, strategies as st
from public_objects import INSTANCES

import robotics1 as r1
from robotics1.other_words import ATTRIBUTES, FUNCTIONS, OF_OBJECTS, PLOTS

KINDS = ("Robot", "Formulas", "IKSolver", "IKResult", "IKSolutions", "SolutionSolver", "SingularSet", "PositionTask")
OTHERS = ("PiecewisePolynomial", "Workspace", "MotionSamples", "Rendezvous")
OBJECTS = [*(INSTANCES[kind]()[0] for kind in (*KINDS, *OTHERS)), r1.view("planar_2r")]
PUBLIC = {name for space in (r1, *r1.SPACES) for name in space.__all__}


def test_each_function_that_is_meant_is_public():
    meant = [text.split()[0].rstrip(",") for text in (*FUNCTIONS.values(), *OF_OBJECTS.values(), *PLOTS.values())]
    assert set(meant) <= PUBLIC


def test_each_attribute_that_is_meant_is_one_of_a_public_object():
    known = {name for value in OBJECTS for name in (*dir(value), *dir(type(value)))}
    assert {name for text in ATTRIBUTES.values() for name in text.split()} <= known


@given(
    value=st.sampled_from(OBJECTS), word=st.sampled_from([*ATTRIBUTES, *FUNCTIONS]) | st.from_regex("[a-z_]{1,12}\\Z")
)
def test_an_unknown_attribute_is_none_and_its_error_is_one_sentence(value, word):
    if word in dir(value):
        return
    assert not hasattr(value, word)
    with pytest.raises(AttributeError) as raised:
        getattr(value, word)
    assert "\n" not in str(raised.value)
    assert len(str(raised.value)) < 320
    for again in (pickle.loads(pickle.dumps(raised.value)), copy.copy(raised.value)):
        assert str(again) == str(raised.value)


@pytest.mark.parametrize("function", ["forward_kinematics", "ik_solutions", "urdf_to_dh", "manipulability"])
def test_a_function_asked_of_a_robot_is_written_with_the_arguments_it_needs(function):
    with pytest.raises(AttributeError) as raised:
        getattr(r1.load_robot("planar_2r"), function)
    needed = [p.name for p in inspect.signature(getattr(r1, function)).parameters.values() if p.default is p.empty]
    assert str(raised.value).endswith(f"write robotics1.{function}({', '.join(needed)})")


def test_what_a_property_raises_is_not_hidden():
    class Broken(r1.PositionTask):
        @property
        def half(self):
            return self.not_there

    with pytest.raises(AttributeError, match="'not_there'"):
        Broken().half  # noqa: B018
