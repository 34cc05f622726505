"""What a reader of a URDF would overlook in silence is said: misspelt names, elements twice or in the wrong place."""

import re
import warnings

import pytest
from hypothesis import given, strategies as st
from malformed import BASE, LIMIT

from robotics1 import RobotFileError, RobotWarning, check_robot, load_robot

# An element of the sound robot, and its attributes; what each stands for is kept only where its name is right.
PARTS = {
    "origin": '<origin xyz="0 0 0.3" rpy="0 0 0.5"/>',
    "axis": '<axis xyz="0 0 1"/>',
    "mimic": '<mimic joint="slide" multiplier="-0.5" offset="0.1"/>',
}


def said(text):
    """The warnings of a text, and the errors as `check_robot` tells them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RobotWarning)
        try:
            return load_robot(text).warnings
        except RobotFileError as error:
            return (str(error),)


def slips(name):
    """A name with two letters swapped, one left out, one doubled, or in capitals."""
    places = st.integers(0, len(name) - 1)
    return st.one_of(
        places.map(lambda i: name[:i] + name[i + 1 : i + 2] + name[i : i + 1] + name[i + 2 :]),
        places.map(lambda i: name[: i + 1] + name[i:]),
        st.just(name.capitalize()),
        st.just(name.upper()),
        st.just(name + "s"),
    ).filter(lambda slip: slip != name)


@given(data=st.data(), name=st.sampled_from(sorted(PARTS)))
def test_a_misspelt_element_of_a_joint_is_named_with_the_one_that_is_meant(data, name):
    slip = data.draw(slips(name))
    text = BASE.replace(PARTS[name], PARTS[name].replace(f"<{name}", f"<{slip}"), 1)
    assert any(f"has <{slip}>, which is not read; is <{name}> meant?" in warning for warning in said(text))


@given(data=st.data(), part=st.sampled_from(["origin", "mimic"]))
def test_a_misspelt_attribute_is_named_with_the_one_that_is_meant(data, part):
    name = data.draw(st.sampled_from({"origin": ["xyz", "rpy"], "mimic": ["multiplier", "offset"]}[part]))
    slip = data.draw(slips(name))
    text = BASE.replace(PARTS[part], PARTS[part].replace(f"{name}=", f"{slip}="), 1)
    expected = f"has '{slip}' in its <{part}>, which is not read; is '{name}' meant?"
    assert any(expected in warning for warning in said(text))


@pytest.mark.parametrize("part", [*PARTS.values(), LIMIT])
def test_of_an_element_that_is_there_twice_the_first_is_read_and_that_is_said(part):
    other = re.sub(r'(xyz|offset|upper)="[^"]*"', lambda old: old[0].replace("1", "2").replace("0.3", "0.4"), part)
    robot = load_robot(BASE.replace(part, part + other, 1))
    tag = part[1 : part.index(" ")]
    assert any(f"has 2 <{tag}> elements; the first is read" in warning for warning in robot.warnings)
    plain = load_robot(BASE)
    assert [(j.xyz, j.axis, j.upper, j.offset) for j in robot.joints] == [
        (j.xyz, j.axis, j.upper, j.offset) for j in plain.joints
    ]


@pytest.mark.parametrize("end", ["parent", "child"])
def test_a_joint_with_two_parents_or_two_children_is_refused_in_these_words(end):
    text = BASE.replace(f'<{end} link="upper"/>', f'<{end} link="upper"/><{end} link="jaw"/>', 1)
    with pytest.raises(RobotFileError, match=rf"has 2 <{end}> elements; it needs one"):
        load_robot(text)


@pytest.mark.parametrize("tag", ["group", "link", "joints"])
def test_a_joint_inside_another_element_is_told_to_stand_in_the_robot(tag):
    inner = '<joint name="n" type="fixed"><parent link="tool"/><child link="more"/></joint>'
    text = BASE.replace("</robot>", f'<link name="more"/><{tag} name="g">{inner}</{tag}></robot>')
    messages = [finding.message for finding in check_robot(text).errors]
    if tag == "link":  # a link's own parts are read by name; the joint shows as a link that hangs on nothing
        assert any("hangs on nothing" in message for message in messages)
    else:
        assert any(f"joint 'n' stands inside <{tag}>" in message for message in messages)


def test_a_joint_of_a_simulator_is_none_of_the_robots():
    inner = '<gazebo><joint name="loop"><parent>tool</parent><child>jaw</child></joint></gazebo>'
    assert load_robot(BASE.replace("</robot>", f"{inner}</robot>")).warnings == ()


def test_a_quaternion_in_the_place_of_rpy_is_refused():
    text = BASE.replace('rpy="0 0 0.5"', 'quat_xyzw="0 0 0.247 0.969"')
    with pytest.raises(RobotFileError, match="quat_xyzw in its <origin>, which is not read; write the rotation as rpy"):
        load_robot(text)


@given(name=st.sampled_from(["upper", "slider", "jaw"]), data=st.data())
def test_a_link_that_is_not_there_is_named_with_the_one_that_is_meant(name, data):
    slip = data.draw(slips(name))
    text = BASE.replace(f'<child link="{name}"/>', f'<child link="{slip}"/>', 1)
    (message,) = (finding.message for finding in check_robot(text).errors)
    assert message.endswith(f"has the child {slip!r}, and there is no such link; is {name!r} meant?")


def test_a_limit_that_is_left_out_means_zero_and_that_is_said():
    with pytest.raises(RobotFileError, match="lower 1 is above upper 0; upper is not given, which means 0"):
        load_robot(BASE.replace('lower="-2" upper="2"', 'lower="1"'))


@pytest.mark.parametrize(
    ("old", "new", "angle"),
    [
        ('rpy="0 0 0.5"', 'rpy="90 0 0"', "90 in the rpy of its <origin>"),
        ('rpy="0 0 0.5"', 'rpy="0 0 -22.5"', "-22.5 in the rpy of its <origin>"),
        ('lower="-2" upper="2"', 'lower="-180" upper="180"', "-180 in its limits"),
        ('lower="-2" upper="2"', 'lower="0" upper="135"', "135 in its limits"),
    ],
)
def test_degrees_in_a_file_are_asked_about(old, new, angle):
    with pytest.warns(RobotWarning, match=re.escape(f"has the angle {angle}: a URDF is in radians")):
        load_robot(BASE.replace(old, new))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('lower="-2" upper="2"', 'lower="-10" upper="10"'),  # no limits, as several makers write them
        ('lower="-0.5" upper="1"', 'lower="-0.5" upper="90"'),  # metres
        ('rpy="0 0 0.5"', 'rpy="3.14159 -1.5708 6.28319"'),
    ],
)
def test_other_numbers_of_that_size_are_no_degrees(old, new):
    assert load_robot(BASE.replace(old, new)).warnings == ()
