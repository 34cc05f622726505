"""Files as people have them: encodings, texts instead of paths, unused xacro, sizes, and names of any kind."""

import codecs
import os
import stat
import threading

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings, strategies as st
from joint_kinds import KINDS
from malformed import BASE

import robotics1 as r1

NAMED = BASE.replace('"tool"', '"größe"')
XMLNS = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


@pytest.fixture
def file(tmp_path):
    def write(text, name="arm.urdf"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def declared(encoding, text=NAMED):
    return text.replace('<?xml version="1.0"?>', f'<?xml version="1.0" encoding="{encoding}"?>')


def refused(source, **options):
    with pytest.raises(r1.RobotFileError) as caught:
        r1.load_robot(source, **options)
    return str(caught.value)


# --- encodings


@pytest.mark.parametrize("name", ["arm.urdf", "arm.urdf.xacro"])
@pytest.mark.parametrize(
    ("encoding", "codec", "mark"),
    [
        ("ISO-8859-1", "latin-1", b""),
        ("iso-8859-15", "iso-8859-15", b""),
        ("windows-1252", "cp1252", b""),
        ("UTF-8", "utf-8", b""),
        ("UTF-8", "utf-8", codecs.BOM_UTF8),
        ("UTF-16", "utf-16-le", codecs.BOM_UTF16_LE),
        ("UTF-16", "utf-16-be", codecs.BOM_UTF16_BE),
        ("UTF-16LE", "utf-16-le", b""),
        ("utf-16be", "utf-16-be", b""),
        ("UTF-32", "utf-32-le", codecs.BOM_UTF32_LE),
        ("GB18030", "gb18030", b""),
    ],
)
def test_a_file_is_read_in_the_encoding_that_it_declares(file, encoding, codec, mark, name):
    robot = r1.load_robot(file(mark + declared(encoding).encode(codec), name))
    assert robot.frame_names[-1] == "größe"
    assert robot.joint_names == ("turn", "slide")


@pytest.mark.parametrize("codec", ["utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("mark", [True, False])
def test_utf_16_needs_no_declaration(file, codec, mark):
    bom = {"utf-16-le": codecs.BOM_UTF16_LE, "utf-16-be": codecs.BOM_UTF16_BE}[codec] if mark else b""
    assert r1.load_robot(file(bom + NAMED.encode(codec))).frame_names[-1] == "größe"


@settings(max_examples=10)
@given(st.text(st.characters(codec="latin-1", categories=["L"]), min_size=1, max_size=8))
def test_a_name_is_the_same_in_every_encoding_of_it(tmp_path_factory, name):
    path = tmp_path_factory.mktemp("names") / "arm.urdf"
    text = BASE.replace('"tool"', f'"{name}"').replace('link="jaw"', 'link="jaw."').replace('"jaw"', '"jaw."')
    for encoding in ("iso-8859-1", "utf-8", "utf-16"):
        path.write_bytes(declared(encoding, text).encode(encoding))
        assert name in r1.load_robot(path).frame_names


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (declared("UTF-16").encode(), "declares the encoding utf-16, and its first bytes are not of it"),
        (codecs.BOM_UTF16_LE + declared("UTF-8").encode("utf-16-le"), "utf-8, and its first bytes are those of utf-16"),
        (declared("UTF-8").encode("latin-1"), "its encoding is utf-8, and line 48 has bytes that are no character"),
        (NAMED.encode("latin-1"), "it declares no encoding, which means UTF-8, and line 48 has bytes"),
        (declared("us-ascii").encode("latin-1"), "its encoding is ascii, and line 48 has bytes"),
        (declared("klingon").encode(), "declares the unknown encoding 'klingon'"),
        (declared("hex").encode(), "declares the unknown encoding 'hex'"),
        (declared("unicode_escape").encode(), "declares the unknown encoding 'unicode_escape'"),
        (declared("../../evil").encode(), "declares the unknown encoding '../../evil'"),
    ],
)
@pytest.mark.parametrize("name", ["arm.urdf", "arm.urdf.xacro"])
def test_a_wrong_declaration_is_refused_with_its_reason(file, data, reason, name):
    message = refused(file(data, name))
    assert reason in message
    assert "save the file as UTF-8" in message


# --- a text instead of a path


@pytest.mark.parametrize("before", ["", "\n  ", "\ufeff"])
def test_a_text_is_loaded_in_place_of_a_path(before):
    text = before + BASE[BASE.index("<robot") :]
    q = [0.4, 0.3]
    assert r1.forward_kinematics(r1.load_robot(text), q) == r1.forward_kinematics(r1.load_robot(BASE), q)


def test_a_text_may_declare_any_encoding_since_it_is_decoded():
    assert r1.load_robot(declared("UTF-16"), tool="größe").tool == "größe"


def test_an_error_in_a_text_has_its_line():
    with pytest.raises(r1.RobotFileError, match=r"^<text>:8: joint 'turn' has the axis '0 0 0'") as caught:
        r1.load_robot(BASE.replace('xyz="0 0 1"', 'xyz="0 0 0"'))
    assert caught.value.line == 8


def test_meshes_of_a_text_are_looked_for_in_the_working_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.stl").write_bytes(b"")
    text = BASE.replace('<box size="0.3 0.1 0.1"/>', '<mesh filename="a.stl"/>')
    assert r1.load_robot(text).warnings == ()


@pytest.mark.parametrize(
    "source",
    ["robot: " + BASE, "a" * 5000, "a\0b.urdf", "x/" * 3000, b"<robot/>", 3.0, True, ["prr"], {"a": 1}, object()],
    ids=lambda source: repr(source)[:12],
)
def test_what_is_neither_a_name_nor_a_path_nor_a_text_says_what_would_be_right(source):
    with pytest.raises(r1.InputError, match="named by a name or a path, or is the text of a URDF") as caught:
        r1.load_robot(source)
    assert len(str(caught.value)) < 300


def test_a_name_that_no_file_can_have_is_refused(tmp_path):
    assert "it cannot be read: File name too long" in refused(tmp_path / ("a" * 300 + ".urdf"))
    assert "there is no such file" in refused("[/x]\x9b\u202e.urdf")
    with pytest.raises(r1.UnknownNameError):
        r1.load_robot("[bold]\x1b[31m")


def test_folders_and_pipes_are_no_files(tmp_path):
    assert "it is a folder, and no file" in refused(tmp_path)
    os.mkfifo(tmp_path / "pipe.urdf")
    assert "it is a device, a pipe or a socket" in refused(tmp_path / "pipe.urdf")
    assert "there is no such file" in refused(tmp_path / "arm.urdf" / "arm.urdf")


def test_an_empty_file_is_not_well_formed(file):
    assert "not well-formed XML: no element found" in refused(file(""))


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_a_file_without_permission_is_refused(file):
    path = file(BASE)
    path.chmod(0)
    assert "it cannot be read: Permission denied" in refused(path)
    path.chmod(stat.S_IRUSR)


def test_examine_reads_encodings_and_texts_too(file):
    assert r1.check_robot(file(declared("ISO-8859-1").encode("latin-1"))).sound
    (error,) = r1.check_robot(file(declared("klingon"))).errors
    assert "unknown encoding 'klingon'" in error.message


# --- xacro that nothing uses

UNUSED = [
    '<xacro:property name="width" value="0.2"/>',
    '<xacro:property name="double" value="${2*width}"/>',
    '<xacro:arg name="prefix" default=""/>',
    '<xacro:macro name="finger" params="n"><link name="${n}"/><xacro:if value="1"/></xacro:macro>',
    '<gazebo reference="${x}"><xacro:insert_block name="b"/></gazebo>',
    '<transmission name="${t}"/>',
]


@pytest.mark.parametrize("unused", UNUSED)
def test_xacro_that_nothing_uses_does_not_matter(file, unused):
    plain = r1.load_robot(BASE)
    robot = r1.load_robot(file(BASE.replace('<robot name="arm">', f'<robot name="arm" {XMLNS}>{unused}')))
    assert robot.model == plain.model
    assert "xacro" not in robot.urdf
    inside = BASE.replace('<link name="base"/>', f'<link name="base">{UNUSED[0]}</link>')
    assert r1.load_robot(inside).model == plain.model


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('xyz="0 0 0.3"', 'xyz="0 0 ${width}"'),
        ('name="jaw"', 'name="$(arg prefix)jaw"'),
        ('<robot name="arm">', '<robot name="${arm}">'),
        ("</robot>", '<xacro:finger n="f"/></robot>'),
        ("</robot>", '<xacro:if value="1"><link name="x"/></xacro:if></robot>'),
        ("</robot>", '<xacro:include filename="x.xacro"/></robot>'),
        ('<link name="base"/>', '<link name="base"><xacro:shape/></link>'),
        ('<box size="0.3 0.1 0.1"/>', '<mesh filename="$(find p)/a.stl"/>'),
    ],
)
def test_xacro_that_is_used_is_refused_in_a_plain_urdf(file, old, new):
    text = BASE.replace(old, new, 1).replace("</robot>", UNUSED[0] + "</robot>")
    assert "is unprocessed xacro; expand the file, or give its name the suffix .xacro" in refused(file(text))


# --- sizes, counted while the file is read

HEAD = '<robot name="a">'
LARGE = {
    "elements": (HEAD + "<x/>" * 4_900_000 + "</robot>", "it has more than 200000 elements"),
    "attributes": (
        HEAD + "<link " + " ".join(f'a{i}=""' for i in range(300_000)) + "/></robot>",
        "an element has 300000 attributes; at most 100 are read",
    ),
    "depth": (HEAD + "<a>" * 3_000_000, "nested more than 100 deep"),
    "an attribute": (HEAD + f'<link name="{"a" * 10_000_000}"/></robot>', "has more than 20000 characters"),
    "a tag": (HEAD + f"<{'a' * 10_000_000}/></robot>", "has more than 20000 characters"),
    "a number": (HEAD + f'<link name="l"><a xyz="{"9" * 30_000}"/></link></robot>', "has more than 20000 characters"),
    "links": (HEAD + "".join(f'<link name="l{i}"/>' for i in range(100_000)) + "</robot>", "has 100000 links"),
    "bytes": (" " * 80_000_001, "at most 20000000 characters are read"),
}


@pytest.mark.parametrize("what", LARGE)
@pytest.mark.parametrize("name", ["arm.urdf", "arm.urdf.xacro"])
def test_a_file_that_is_too_large_is_refused(file, what, name):
    text, reason = LARGE[what]
    if what == "links" and name.endswith("xacro"):
        pytest.skip("expansion has limits of its own")
    message = refused(file(text, name))
    assert reason in message
    assert len(message) < 500


@pytest.mark.parametrize("number", ["9" * 400, "1" + "0" * 19_000, "1e999", "-" + "9" * 5000, "0." + "0" * 9000 + "1"])
@pytest.mark.parametrize(("old", "new"), [("0 0 0.3", "0 0 {}"), ('lower="-2"', 'lower="{}"'), ('"0.1"', '"{}"')])
def test_numbers_of_any_size_end_in_a_robot_or_a_typed_error(file, number, old, new):
    try:
        robot = r1.load_robot(file(BASE.replace(old, new.format(number))))
    except r1.RobotFileError:
        return
    assert np.isfinite(r1.forward_kinematics(robot, [0.1, 0.2]).homogeneous).all()


@pytest.mark.parametrize("name", ["a\u009bb", "a\u202eb", "&#x9b;", "[/x]", "&lt;script&gt;", "a&quot;b", "${", "../x"])
def test_names_are_texts_whatever_they_hold(file, name):
    text = BASE.replace('"tool"', f'"{name}"').replace('"turn"', f'"{name}"')
    if "${" in name:
        assert "unprocessed xacro" in refused(file(text))
        return
    robot = r1.load_robot(file(text))
    link = robot.frame_names[-1]
    assert robot.joint_names[0] == link
    assert r1.forward_kinematics(robot, [0, 0], frame=link).translation == pytest.approx(
        [0.2 * np.cos(0.5), 0.2 * np.sin(0.5), 0.3]
    )


# --- nothing of the process is changed


def test_a_load_says_nothing_on_stderr_and_moves_no_descriptor(file, capfd):
    import subprocess
    import sys

    path = file(BASE.replace('value="2"', 'value="-2"'))
    here = os.fstat(2)
    r1.load_robot(path)
    after = os.fstat(2)
    assert (here.st_dev, here.st_ino) == (after.st_dev, after.st_ino)
    code = f"import os; dup2 = os.dup2; os.dup2 = None; import robotics1; robotics1.load_robot({str(path)!r})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert capfd.readouterr() == ("", "")


def test_threads_that_load_good_and_bad_files_get_their_own_robots_and_reasons(file, capfd):
    wrong = []
    bad = file(BASE.replace('xyz="0 0 1"', 'xyz="0 0 0"'), "bad.urdf")

    def work(k):
        try:
            for i in range(10):
                height = round(0.1 * k + 0.01 * i, 3)
                robot = r1.load_robot(BASE.replace("0 0 0.3", f"0 0 {height}"))
                if r1.forward_kinematics(robot, [0, 0]).translation[2] != height:
                    wrong.append((k, i))
                if "joint 'turn' has the axis '0 0 0'" not in refused(bad):
                    wrong.append((k, "reason"))
        except BaseException as error:  # a thread's exception would be printed only
            wrong.append(error)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []
    assert capfd.readouterr() == ("", "")


# --- the model


@pytest.mark.parametrize("kind", [kind for kind in KINDS if "continuous" not in kind and kind != "mixed"])
def test_the_model_is_the_one_that_pinocchios_own_reader_makes(kind):
    robot = r1.load_robot(KINDS[kind][0])
    text = robot.urdf
    if kind == "leader after its follower":  # its reader takes "z" for late only where names sort so
        text = KINDS[kind][0]
    other = pin.buildModelFromXML(text, True)
    same(robot.model, other)


def same(a, b):
    for name in ("nq", "nv", "njoints", "nframes", "nvExtended", "name"):
        assert getattr(a, name) == getattr(b, name), name
    for name in ("names", "parents", "idx_qs", "idx_vs", "nqs", "nvs", "mimicking_joints", "mimicked_joints"):
        assert list(getattr(a, name)) == list(getattr(b, name)), name
    assert [joint.shortname() for joint in a.joints] == [joint.shortname() for joint in b.joints]
    for one, two in zip(a.jointPlacements, b.jointPlacements, strict=True):
        assert one.isApprox(two, 1e-12)
    for one, two in zip(a.inertias, b.inertias, strict=True):
        assert one.matrix() == pytest.approx(two.matrix(), abs=1e-12)
    for one, two in zip(a.frames, b.frames, strict=True):
        assert (one.name, one.parentJoint, one.parentFrame, one.type) == (
            two.name,
            two.parentJoint,
            two.parentFrame,
            two.type,
        )
        assert one.placement.isApprox(two.placement, 1e-12)
        assert one.inertia.matrix() == pytest.approx(two.inertia.matrix(), abs=1e-12)


def test_inertias_are_those_of_the_file_about_the_joint():
    text = BASE.replace('<origin xyz="0.1 0 0"/>', '<origin xyz="0.1 0.2 0" rpy="0 0 1.5707963267948966"/>')
    same(r1.load_robot(text).model, pin.buildModelFromXML(text, True))
