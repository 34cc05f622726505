"""xacro files: named parameters, includes and packages, what is refused, and no trace of one load in the next."""

from math import inf, nan, pi

import pytest
import xacro
from xacro import substitution_args

from robotics1 import InputError, RobotFileError, UnknownNameError, forward_kinematics, load_robot

ARM = """\
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
{head}
<link name="base"/>
<joint name="q1" type="revolute">
<parent link="base"/><child link="{link}"/><origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>
<limit lower="{lower}" upper="2" velocity="1" effort="1"/>
</joint>
<link name="{link}"/>
{tail}
</robot>
"""
DEFAULTS = {"head": "", "tail": "", "link": "tool", "xyz": "0 0 0", "rpy": "0 0 0", "axis": "0 0 1", "lower": "-1"}
LENGTH = '<xacro:arg name="l" default="0.5"/>'
AS_PROPERTY = LENGTH + '<xacro:property name="l" value="$(arg l)"/>'


@pytest.fixture
def load(tmp_path):
    """Write an arm, and files beside it, and load it."""

    def from_parts(parameters=None, *, files=(), name="arm.urdf.xacro", packages=(), trusted=False, **parts):
        for file, text in dict(files).items():
            (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / file).write_text(text, encoding="utf-8")
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(ARM.format(**DEFAULTS | parts), encoding="utf-8")
        return load_robot(path, parameters=parameters, packages=packages, trusted=trusted)

    return from_parts


@pytest.fixture(autouse=True)
def silent_and_restored(capfd):
    """Nothing is printed, and xacro has its own functions afterwards, also after an error."""

    def functions():
        symbols = {key: value for key, value in xacro._global_symbols.items() if key != "__builtins__"}
        modules = [{k: v for k, v in vars(m).items() if callable(v)} for m in (xacro, substitution_args)]
        return [*modules, dict(substitution_args._eval_dict), symbols, dict(symbols["xacro"])]

    before = functions()
    yield
    assert functions() == before
    assert capfd.readouterr() == ("", "")


def x(robot, q=0.0):
    return forward_kinematics(robot, [q]).translation[0]


def refused(load, message, *arguments, error=RobotFileError, **parts):
    with pytest.raises(error, match=message) as caught:
        load(*arguments, **parts)
    return caught.value


# --- parameters


@pytest.mark.parametrize(
    ("head", "xyz", "value"),
    [
        (LENGTH, "$(arg l) 0 0", 0.7),
        (AS_PROPERTY, "${l} 0 0", 0.7),
        (AS_PROPERTY, "${2*l + 0.1} 0 0", 1.5),
        (AS_PROPERTY, "${l**2/2} 0 0", 0.245),
        (AS_PROPERTY, "${sin(l)} 0 0", 0.644217687237691),
        (AS_PROPERTY, "${-l if l > 0.6 else l} 0 0", -0.7),
        (AS_PROPERTY + '<xacro:property name="half" value="${l/2}"/>', "${half} 0 0", 0.35),
        (LENGTH, "$(eval l*2) 0 0", 1.4),
        (LENGTH, "${xacro.arg('l')} 0 0", 0.7),
    ],
)
def test_a_parameter_serves_in_numbers_properties_and_arithmetic(load, head, xyz, value):
    robot = load({"l": 0.7}, head=head, xyz=xyz)
    assert x(robot) == pytest.approx(value, rel=1e-15)
    assert dict(robot.parameters) == {"l": 0.7}


def test_a_parameter_serves_in_angles_axes_and_limits(load):
    robot = load({"l": 0.7}, head=AS_PROPERTY, rpy="0 0 ${l}", axis="0 ${sin(l)} ${cos(l)}", lower="${-l}")
    R = forward_kinematics(robot, [0]).rotation
    assert R[1, 0] == pytest.approx(0.644217687237691)
    assert robot.lower.tolist() == [-0.7]
    assert robot.warnings == load(head=LENGTH).warnings


@pytest.mark.parametrize("name", ["tool$(arg n)", "tool${n}", "tool${int(n)}"])
def test_a_whole_parameter_serves_in_names(load, name):
    head = '<xacro:arg name="n" default="1"/><xacro:property name="n" value="$(arg n)"/>'
    assert load(head=head, link=name).tool == "tool1"
    assert load({"n": 2}, head=head, link=name).tool == "tool2"


@pytest.mark.parametrize("condition", ["$(arg far)", "${far}", "${far == 1}", "$(eval far == 1)"])
@pytest.mark.parametrize(("value", "length"), [(True, 1.0), (1, 1.0), (False, 0.2), (0, 0.2), (None, 0.2)])
def test_a_parameter_serves_in_conditions(load, condition, value, length):
    head = f"""<xacro:arg name="far" default="0"/><xacro:property name="far" value="$(arg far)"/>
    <xacro:if value="{condition}"><xacro:property name="a" value="1"/></xacro:if>
    <xacro:unless value="{condition}"><xacro:property name="a" value="0.2"/></xacro:unless>"""
    assert x(load(None if value is None else {"far": value}, head=head, xyz="${a} 0 0")) == length


def test_a_parameter_serves_in_macros_and_their_blocks(load):
    head = """<xacro:macro name="part" params="name length *place">
    <link name="${name}"/><joint name="${name}_j" type="fixed"><parent link="tip"/><child link="${name}"/>
    <xacro:insert_block name="place"/></joint></xacro:macro>"""
    tail = '<xacro:part name="tool" length="$(arg l)"><origin xyz="${2*l} 0 0"/></xacro:part>'
    assert x(load({"l": 0.4}, head=AS_PROPERTY + head, tail=tail, link="tip")) == 0.8


def test_parameters_without_number_keep_their_default_and_are_not_listed(load):
    head = LENGTH + '<xacro:arg name="prefix" default="left_"/>'
    robot = load({"l": 1}, head=head, link="$(arg prefix)hand")
    assert (robot.tool, dict(robot.parameters)) == ("left_hand", {"l": 1.0})


def test_an_unknown_parameter_lists_those_of_the_file(load):
    error = refused(load, "no parameter .* 'k'; there is 'l'", {"k": 1.0}, head=LENGTH, error=UnknownNameError)
    assert error.candidates == ("l",)


@pytest.mark.parametrize("value", [nan, inf, -inf, "0.5m", None, [0.5], 1j])
def test_a_parameter_is_a_finite_number(load, value):
    refused(load, "parameter 'l' must be a finite number", {"l": value}, head=LENGTH, error=InputError)


def test_a_parameter_without_default_must_be_given(load):
    head = '<xacro:arg name="l"/>'
    assert refused(load, "parameter 'l' has no default: give it a value", head=head).element == "l"
    assert x(load({"l": 0.3}, head=head, xyz="$(arg l) 0 0")) == 0.3


@pytest.mark.parametrize("length", [0.1 + 0.2, 1e-7, 123456789.125, 1 / 3, pi])
def test_a_parameter_keeps_every_digit(load, length):
    assert x(load({"l": length}, head=AS_PROPERTY, xyz="${l} 0 0")) == length


# --- no trace


def test_loads_with_other_values_do_not_see_each_other(load):
    for length in (0.1, 0.9, 0.1, None, 0.3, None):
        assert x(load(length and {"l": length}, head=AS_PROPERTY, xyz="${l} 0 0")) == (length or 0.5)


def test_properties_and_macros_of_one_file_are_unknown_to_the_next(load):
    head = '<xacro:property name="secret" value="1"/><xacro:macro name="m" params=""><link name="a"/></xacro:macro>'
    load(head=head)
    refused(load, "secret", xyz="${secret} 0 0")
    refused(load, "unknown macro name: xacro:m", tail="<xacro:m/>")


def test_a_load_after_an_error_is_as_if_there_had_been_none(load):
    refused(load, "division by zero", {"l": 0.9}, head=AS_PROPERTY, xyz="${1/0} 0 0")
    assert x(load(head=AS_PROPERTY, xyz="${l} 0 0")) == 0.5


# --- other files

WITHIN = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">{}</robot>'
PART = WITHIN.format('<xacro:property name="far" value="0.25"/>')


@pytest.mark.parametrize("file", ["part.xacro", "sub/part.xacro", "../part.xacro", "p*.xacro", "sub/?art.xacro"])
def test_an_included_file_is_looked_for_beside_the_robots_file(load, file):
    head = f'<xacro:include filename="{file}"/>'
    files = {f"robots/{file.replace('p*', 'part').replace('?', 'p')}": PART, "package.xml": "<package/>"}
    assert x(load(files=files, name="robots/arm.xacro", head=head, xyz="${far} 0 0")) == 0.25


@pytest.mark.parametrize("file", ["../part.xacro", "../../part.xacro"])
def test_an_included_file_is_in_the_folder_of_the_robot_or_in_its_package_or_given(load, tmp_path, file):
    head, name = f'<xacro:include filename="{file}"/>', "a/robots/arm.xacro"
    files = {"part.xacro": PART, "a/part.xacro": PART}
    message = r"'\.\./.*part\.xacro' leads by '\.\.' out of the file's own folder and the packages; give its folder"
    refused(load, message, files=files, name=name, head=head)
    for allowed in ({"packages": [tmp_path]}, {"trusted": True}):
        assert x(load(files=files, name=name, head=head, xyz="${far} 0 0", **allowed)) == 0.25
    assert x(load(files={"package.xml": ""}, name=name, head=head, xyz="${far} 0 0")) == 0.25


def test_a_package_has_the_name_in_its_package_xml(load, tmp_path):
    head = '<xacro:include filename="$(find parts)/part.xacro"/>'
    manifest = '<package format="3"><name>parts</name></package>'
    files = {"src/repository/v2/part.xacro": PART, "src/repository/v2/package.xml": manifest}
    assert x(load(files=files, packages=[tmp_path / "src"], head=head, xyz="${far} 0 0")) == 0.25


def test_a_relative_folder_of_packages_is_found_from_the_working_folder(load, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    head = '<xacro:include filename="$(find parts)/part.xacro"/>'
    for packages in (["src"], "src", ["./src/../src"]):
        robot = load(
            files={"src/parts/part.xacro": PART}, packages=packages, name="r/a.xacro", head=head, xyz="${far} 0 0"
        )
        assert x(robot) == 0.25


@pytest.mark.parametrize("optional", ["true", "1", "True"])
def test_an_optional_included_file_may_be_missing(load, optional):
    assert load(head=f'<xacro:include filename="missing.xacro" optional="{optional}"/>').nq == 1


def test_names_of_an_included_file_have_its_namespace(load):
    part = WITHIN.format(
        '<xacro:property name="far" value="0.25"/><xacro:macro name="m" params="a"><link name="${a}"/></xacro:macro>'
    )
    head = '<xacro:include filename="part.xacro" ns="parts"/>'
    tail = '<gazebo><xacro:parts.m a="x"/></gazebo>'
    assert x(load(files={"part.xacro": part}, head=head, xyz="${parts.far} 0 0", tail=tail)) == 0.25


def test_a_file_included_by_an_included_file_is_looked_for_beside_that(load):
    files = {"sub/middle.xacro": WITHIN.format('<xacro:include filename="part.xacro"/>'), "sub/part.xacro": PART}
    assert x(load(files=files, head='<xacro:include filename="sub/middle.xacro"/>', xyz="${far} 0 0")) == 0.25


def test_the_working_folder_does_not_matter(load, tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert x(load(files={"part.xacro": PART}, head='<xacro:include filename="part.xacro"/>', xyz="${far} 0 0")) == 0.25


@pytest.mark.parametrize("spec", ["package://parts/part.xacro", "$(find parts)/part.xacro"])
@pytest.mark.parametrize(
    ("robot", "file", "packages"),
    [
        ("arm.xacro", "lib/parts/part.xacro", ["lib"]),
        ("arm.xacro", "lib/parts/part.xacro", ["nowhere", "lib/parts"]),
        ("parts/urdf/arm.xacro", "parts/part.xacro", []),
        ("arms/urdf/arm.xacro", "parts/part.xacro", []),
    ],
    ids=["in a folder", "the folder itself", "above the file", "beside what is above the file"],
)
def test_a_package_is_found_in_the_given_folders_and_above_the_file(load, tmp_path, spec, robot, file, packages):
    packages = [tmp_path / folder for folder in packages]
    head = f'<xacro:include filename="{spec}"/>'
    assert x(load(files={file: PART}, name=robot, packages=packages, head=head, xyz="${far} 0 0")) == 0.25


@pytest.mark.parametrize("spec", ["package://parts/part.xacro", "$(find parts)/part.xacro"])
def test_a_package_that_is_nowhere_is_refused_by_name(load, spec):
    refused(load, "parts.* in none of the folders given as packages", head=f'<xacro:include filename="{spec}"/>')


def test_a_missing_included_file_is_named(load):
    refused(load, r"No such file.*missing\.xacro", head='<xacro:include filename="missing.xacro"/>')


BOMB = '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa">{}]><robot>&{};</robot>'.format(
    "".join(f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefghi", "bcdefghij", strict=True)), "j"
)


@pytest.mark.parametrize("text", ["<robot>", "", "no xml", "<robot><link name=a/></robot>", BOMB])
def test_an_ill_formed_included_file_is_named(load, text):
    refused(load, r"part\.xacro", files={"part.xacro": text}, head='<xacro:include filename="part.xacro"/>')


# --- what is refused


@pytest.mark.parametrize(
    ("part", "what"),
    [
        ({"xyz": "$(env HOME) 0 0"}, r"\$\(env\)"),
        ({"xyz": "$(optenv FAR 1) 0 0"}, r"\$\(optenv\)"),
        ({"xyz": "$(eval env_far) 0 0", "head": '<xacro:arg name="env_far" default="$(env HOME)"/>'}, r"\$\(env\)"),
        ({"head": '<xacro:arg name="a" default="$(optenv FAR 1)"/>'}, r"\$\(optenv\)"),
        ({"link": "$(cwd)"}, r"\$\(cwd\)"),
    ],
)
def test_the_environment_is_read_only_when_trusted(load, monkeypatch, part, what):
    monkeypatch.setenv("HOME", "1")
    refused(load, f"it uses {what}, which reads this computer; load it with trusted=True", **part)
    assert load(trusted=True, **part).nv == 1


# --- YAML

YAML = """\
arm: &arm {length: 0.25, names: [a, b], turned: true, off: null}
again: {<<: *arm, length: 2.5e-1}
turn: !degrees 90
back: !radians pi/2
short: !millimeters 250
date: 2001-02-03
"""


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("load_yaml('far.yaml')['arm']['length']", 0.25),
        ("xacro.load_yaml('far.yaml').arm.length", 0.25),
        ("xacro.load_yaml('$(find robots)/far.yaml').again.length", 0.25),
        ("xacro.load_yaml(xacro.abs_filename('far.yaml')).again.names[1]", "b"),
        ("xacro.load_yaml('package://robots/far.yaml').turn", pi / 2),
        ("xacro.load_yaml('far.yaml').back", pi / 2),
        ("xacro.load_yaml('far.yaml').short", 0.25),
        ("xacro.load_yaml('far.yaml').date", "2001-02-03"),
        ("xacro.load_yaml('far.yaml').arm.turned", True),
        ("len(xacro.load_yaml('far.yaml').arm.names)", 2),
        ("[k for k in xacro.load_yaml('far.yaml').arm.keys()][0]", "length"),
        ("xacro.load_yaml('far.yaml').arm.get('width', 7)", 7),
        ("xacro.dotify(dict(a=dict(b=3))).a.b", 3),
    ],
)
def test_a_yaml_file_of_the_robots_folder_is_read_without_trust(load, expression, value):
    ends = f'<parent link="tool"/><child link="${{{expression}}}"/>'
    tail = f'<link name="${{{expression}}}"/><joint name="j" type="fixed">{ends}</joint>'
    robot = load(files={"robots/far.yaml": YAML}, name="robots/arm.xacro", tail=tail)
    assert str(value) in robot.frame_names


@pytest.mark.parametrize(
    "expression",
    [
        "().__class__",
        "(lambda: ().__class__)()",
        "[a.__class__ for a in [1]]",
        "(a for a in [1]).gi_frame",
        r"'\x7b0.__globals__\x7d'.format(xacro.tokenize)",
        "python.type.__subclasses__",
    ],
)
def test_python_behind_the_expressions_is_out_of_reach(load, expression):
    refused(load, "xacro cannot expand it", tail="<gazebo>${" + expression + "}</gazebo>")


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ({"xyz": "${l} 0 0"}, "name 'l' is not defined"),
        ({"xyz": "$(arg l) 0 0"}, "l"),
        ({"xyz": "${1/0} 0 0"}, "division by zero"),
        ({"xyz": "${1 +} 0 0"}, "invalid syntax"),
        ({"xyz": "${sqrt(-1)} 0 0"}, "math domain error|expected a nonnegative input"),
        ({"xyz": "${10.0**400} 0 0"}, "Numerical result out of range|too large"),
        ({"xyz": "${[1][2]} 0 0"}, "list index out of range"),
        ({"xyz": "${'a' + 1} 0 0"}, "can only concatenate str"),
        ({"xyz": "$(eval env('HOME')) 0 0"}, "cannot expand it"),  # xacro takes no call in an eval
        ({"xyz": "$(nothing) 0 0"}, "Unknown substitution command"),
        ({"xyz": "${open('/etc/hostname').read()} 0 0"}, "name 'open' is not defined"),
        ({"tail": "<xacro:wheel/>"}, "unknown macro name: xacro:wheel"),
        ({"tail": '<xacro:if value="maybe"><link name="a"/></xacro:if>'}, "not a boolean expression"),
        ({"head": '<xacro:property name="a" value="${a}"/>', "xyz": "${a} 0 0"}, "circular variable definition"),
        ({"head": '<xacro:macro name="m" params=""><xacro:m/></xacro:macro>', "tail": "<xacro:m/>"}, "recursion"),
        ({"head": "<xacro:macro/>"}, "name"),
        ({"head": '<xacro:include filename="arm.urdf.xacro"/>'}, "cannot expand it"),
    ],
)
def test_what_xacro_cannot_expand_is_a_robot_file_error(load, part, message):
    assert refused(load, message, **part).path.name == "arm.urdf.xacro"


def test_an_expanded_file_is_checked_like_any_other(load):
    assert refused(load, "gives no direction", {"l": 0}, head=AS_PROPERTY, axis="0 0 ${l}").element == "q1"
    assert refused(load, "numbers must be finite", xyz="${float('nan')} 0 0").element == "q1"


def test_no_line_of_the_expanded_text_is_told_as_one_of_the_file(load):
    error = refused(load, "there are 2 roots: 'base', 'a'", tail='<link name="a"/>')
    assert error.line is None


def test_a_link_to_a_robots_file_reads_what_is_beside_the_file(load, tmp_path):
    load(files={"real/part.xacro": PART}, name="real/arm.xacro", head='<xacro:include filename="part.xacro"/>')
    (tmp_path / "links").mkdir()
    for name in ("arm.xacro", "part.xacro"):
        (tmp_path / "links" / name).symlink_to(tmp_path / "real" / name)
    assert load_robot(tmp_path / "links" / "arm.xacro").nq == 1


@pytest.mark.parametrize("folder", ["[robots]", "a*b", "what?"])
def test_a_folder_may_have_any_name(load, folder):
    head = '<xacro:include filename="part.xacro"/>'
    assert (
        x(load(files={f"{folder}/part.xacro": PART}, name=f"{folder}/arm.xacro", head=head, xyz="${far} 0 0")) == 0.25
    )
