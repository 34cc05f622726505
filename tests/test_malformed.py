"""Wrong files are refused with the line and the name, odd ones load with a warning, and nothing is printed."""

import os

import numpy as np
import pinocchio as pin
import pytest
from malformed import BASE, CASES, SOUND, WARNINGS, joint

from robotics1 import RobotFileError, forward_kinematics, load_robot

NAMES_OF = {"ids": lambda case: case.name}
DESCRIPTORS = "/proc/self/fd" if os.path.isdir("/proc/self/fd") else "/dev/fd"


@pytest.fixture(autouse=True)
def silent_and_tidy(capfd):
    """Nothing is printed, also not by C++, and no file stays open."""
    before = len(os.listdir(DESCRIPTORS))
    yield
    assert len(os.listdir(DESCRIPTORS)) == before
    assert capfd.readouterr() == ("", "")


@pytest.fixture
def file(tmp_path):
    def write(text, name="arm.urdf"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def refused(path):
    with pytest.raises(RobotFileError) as caught:
        load_robot(path)
    return caught.value


def test_the_sound_robot_loads_without_warnings(file):
    robot = load_robot(file(BASE))
    assert robot.joint_names == ("turn", "slide")
    assert robot.warnings == ()


def test_the_corpus_has_names_of_its_own():
    assert len({case.name for case in CASES}) == len(CASES) >= 60


# --- what is wrong


@pytest.mark.parametrize("case", CASES, **NAMES_OF)
def test_a_wrong_file_is_refused_with_message_line_and_name(file, case):
    path = file(case.text)
    error = refused(path)
    assert case.message in str(error)
    assert (error.path, error.line, error.element) == (path, case.line, case.element)
    assert str(error).startswith(f"{path}:{case.line}: ")


def test_the_first_error_is_told_and_the_others_counted(file):
    text = BASE.replace('xyz="0 0 1"', 'xyz="0 0 0"').replace('value="2"', 'value="two"').replace('"1 0 0"', '"1 0"')
    error = refused(file(text))
    assert "joint 'turn' has the axis '0 0 0'" in str(error)
    assert str(error).endswith("(and 2 more errors)")


def test_more_than_a_thousand_links_are_refused(file):
    assert "has 1001 links or joints; at most 1000" in str(refused(file(chain(1001))))


def test_a_chain_of_a_thousand_links_loads(file):
    robot = load_robot(file(chain(1000)))
    assert forward_kinematics(robot, [], frame="l999").translation == pytest.approx([999, 0, 0])


def test_more_than_128_degrees_of_freedom_are_refused(file):
    assert "has 129 degrees of freedom; at most 128" in str(refused(file(hedgehog(129))))
    assert load_robot(file(hedgehog(128))).nv == 128


def chain(count):
    """Links in a row, 1 m apart, all fixed."""
    links = "".join(f'<link name="l{i}"/>' for i in range(count))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i}"/><child link="l{i + 1}"/><origin xyz="1 0 0"/></joint>'
        for i in range(count - 1)
    )
    return f'<robot name="chain">{links}{joints}</robot>'


def hedgehog(count):
    """Revolute joints side by side."""
    joints = "".join(joint(f"j{i}", "revolute", "body") for i in range(count))
    return f'<robot name="hedgehog"><link name="body"/>{joints}</robot>'


@pytest.mark.parametrize("depth", [100, 100_000])
def test_elements_nested_more_than_a_hundred_deep_are_refused(file, depth):
    error = refused(file(BASE.replace("</robot>", "<a>" * depth + "</a>" * depth + "</robot>")))
    assert "its elements are nested more than 100 deep" in str(error)
    assert error.line == 52
    assert load_robot(file(BASE.replace("</robot>", "<a>" * 99 + "</a>" * 99 + "</robot>"))).nv == 2


def test_a_file_beyond_the_limit_of_size_is_refused(file):
    most = 20_000_000
    longest = BASE.ljust(most)
    assert load_robot(file(longest)).nv == 2
    assert f"it has {most + 1} characters; at most {most} are read" in str(refused(file(longest + " ")))


# --- what is no text, or no file


@pytest.mark.parametrize("name", ["arm.urdf", "arm.urdf.xacro"])
@pytest.mark.parametrize(
    "data",
    [
        b"",
        b" \n",
        b"\x00" * 64,
        bytes(range(256)),
        b"\xff\xfe<\x00r\x00o\x00b\x00o\x00t\x00",
        b"solid bar\n",
        b"\x89PNG",
    ],
    ids=["empty", "blank", "zeros", "every byte", "utf-16", "stl", "png"],
)
def test_what_is_no_xml_is_not_well_formed(file, data, name):
    path = file(data, name)
    error = refused(path)
    assert "not well-formed XML" in str(error)
    assert (error.path, error.line) == (path, error.line or 1)


def test_a_xacro_handed_in_as_urdf_is_told_so(file):
    text = '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">\n<xacro:arg name="l" default="1"/>\n</robot>'
    error = refused(file(text))
    assert "is unprocessed xacro; expand the file, or give its name the suffix .xacro" in str(error)
    assert error.line == 2


def test_a_folder_is_refused(tmp_path):
    (tmp_path / "arm.urdf").mkdir()
    assert "it is a folder, and no file" in str(refused(tmp_path / "arm.urdf"))


def test_a_file_that_may_not_be_read_is_refused(file, monkeypatch):
    path = file(BASE)

    def forbidden(*_, **__):
        raise PermissionError(13, "Permission denied")

    with monkeypatch.context() as patch:
        patch.setattr(type(path), "read_text", forbidden)
        patch.setattr(type(path), "read_bytes", forbidden)
        error = refused(path)
    assert "it cannot be read: Permission denied" in str(error)
    assert error.path == path


@pytest.mark.parametrize("name", ["arm.urdf", "arm.urdf.xacro"])
@pytest.mark.parametrize(
    "data",
    [b"\xef\xbb\xbf" + BASE.encode(), BASE.replace("<link", "<!-- größe -->\n<link", 1).encode("latin-1")],
    ids=["byte order mark", "latin-1 comment"],
)
def test_a_byte_order_mark_and_a_latin_1_comment_are_no_error(file, data, name):
    assert load_robot(file(data, name)).joint_names == ("turn", "slide")


def test_a_name_beyond_ascii_is_kept_whatever_encoding_is_declared(file):
    text = BASE.replace('version="1.0"', 'version="1.0" encoding="ISO-8859-1"').replace('"tool"', '"größe"')
    assert load_robot(file(text), tool="größe").tool == "größe"


# --- what is odd


@pytest.mark.parametrize("case", WARNINGS, **NAMES_OF)
def test_an_odd_file_loads_with_one_warning(file, case):
    robot = load_robot(file(case.text))
    (warning,) = robot.warnings
    assert case.message in warning
    assert warning.startswith(f"line {case.line}: " if case.line else "mesh ")
    assert robot.joint_names == ("turn", "slide")


def test_an_axis_not_of_unit_length_is_a_direction(file):
    plain, long = (load_robot(file(BASE.replace('xyz="1 0 0"', f'xyz="{x} 0 0"'))) for x in (1, 2.5))
    a, b = (forward_kinematics(robot, [0.4, 0.3]).homogeneous for robot in (plain, long))
    assert a == pytest.approx(b, abs=1e-15)


def test_odd_masses_do_not_change_the_kinematics(file):
    plain, odd = (load_robot(file(text)) for text in (BASE, BASE.replace('value="2"', 'value="-2"')))
    assert forward_kinematics(odd, [0.4, 0.3]) == forward_kinematics(plain, [0.4, 0.3])


def test_a_joint_limited_to_zero_has_zero_limits(file):
    robot = load_robot(file(BASE.replace('lower="-2" upper="2" ', "")))
    assert (robot.lower[0], robot.upper[0]) == (0, 0)


# --- what is fine


@pytest.mark.parametrize(("old", "new"), [case[1:] for case in SOUND], ids=[case[0] for case in SOUND])
def test_a_sound_variation_loads(file, old, new):
    assert old in BASE
    robot = load_robot(file(BASE.replace(old, new, 1)), tool="tool")
    assert robot.joint_names[:2] == ("turn", "slide")
    T = forward_kinematics(robot, pin.neutral(robot.model))
    assert np.hypot(*T.translation[:2]) == pytest.approx(0.2)
    assert not [warning for warning in robot.warnings if "without inertia" not in warning]
