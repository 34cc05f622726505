"""A sound robot, and what can be wrong with it: one replacement in its text, and what must be said of it."""

from typing import NamedTuple

BASE = """\
<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <joint name="turn" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <origin xyz="0 0 0.3" rpy="0 0 0.5"/>
    <axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="3" effort="50"/>
  </joint>
  <link name="upper">
    <inertial>
      <origin xyz="0.1 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>
    </inertial>
    <visual name="bar">
      <geometry><box size="0.3 0.1 0.1"/></geometry>
    </visual>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="upper"/>
    <child link="slider"/>
    <axis xyz="1 0 0"/>
    <limit lower="-0.5" upper="1" velocity="1" effort="100"/>
  </joint>
  <link name="slider">
    <inertial>
      <mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
  </link>
  <joint name="finger" type="prismatic">
    <parent link="slider"/>
    <child link="jaw"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" velocity="1" effort="10"/>
    <mimic joint="slide" multiplier="-0.5" offset="0.1"/>
  </joint>
  <link name="jaw">
    <inertial>
      <mass value="0.1"/>
      <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/>
    </inertial>
  </link>
  <joint name="mount" type="fixed">
    <parent link="slider"/>
    <child link="tool"/>
    <origin xyz="0.2 0 0"/>
  </joint>
  <link name="tool"/>
</robot>
"""


class Case(NamedTuple):
    """What is replaced in the base (once), and what must be said of it."""

    name: str
    old: str
    new: str
    message: str
    line: int | None
    element: str | None

    @property
    def text(self):
        assert BASE.count(self.old) >= 1, f"{self.name}: the base has no {self.old!r}"
        return BASE.replace(self.old, self.new, 1)


def joint(name, kind, parent, inside=""):
    """A joint at the end of the file, and its child, a link named after it."""
    limit = '<limit lower="-1" upper="1" velocity="1" effort="1"/>' if kind in ("revolute", "prismatic") else ""
    ends = f'<parent link="{parent}"/><child link="{name}_link"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{limit}{inside}</joint><link name="{name}_link"/>'


AXIS = '<axis xyz="0 0 1"/>'
LIMIT = '<limit lower="-2" upper="2" velocity="3" effort="50"/>'
MIMIC = '<mimic joint="slide" multiplier="-0.5" offset="0.1"/>'
SHAPE = '<box size="0.3 0.1 0.1"/>'
TURN = '<joint name="turn" type="revolute">'
END = "</robot>"
DECLARATION = '<?xml version="1.0"?>'
BOMB = '<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
EXTERNAL = '<!DOCTYPE robot [<!ENTITY secret SYSTEM "file:///etc/hostname">]>'

NOT_ROBOTS = [
    Case("an element that is not closed", "</joint>", "", "not well-formed XML: mismatched tag", 52, None),
    Case("an attribute without quotes", 'name="base"', "name=base", "not well-formed XML", 3, None),
    Case(
        "an attribute twice", 'name="base"', 'name="base" name="b"', "not well-formed XML: duplicate attribute", 3, None
    ),
    Case("text after the end", END, END + "<robot/>", "not well-formed XML: junk after document element", 52, None),
    Case("an unknown entity", 'name="base"', 'name="&base;"', "not well-formed XML: undefined entity", 3, None),
    Case("a cut file", END, "", "not well-formed XML: no element found", 53, None),
    Case("a DOCTYPE", DECLARATION, DECLARATION + "<!DOCTYPE robot>", "has a DOCTYPE", 1, None),
    Case("an entity bomb", DECLARATION, DECLARATION + BOMB, "has a DOCTYPE", 1, None),
    Case("an external entity", DECLARATION, DECLARATION + EXTERNAL, "has a DOCTYPE", 1, None),
    Case("another root", BASE, "<model name='arm'>\n<link name='a'/>\n</model>", "not the root of a URDF", 1, "arm"),
    Case("a page", BASE, "<html><body/></html>", "<html> is not the root of a URDF", 1, None),
    Case("no name", '<robot name="arm">', "<robot>", "<robot> has no name", 2, None),
    Case("an empty name", '<robot name="arm">', '<robot name=" ">', "has no name", 2, " "),
    Case("no link", BASE, '<robot name="arm">\n</robot>', "robot 'arm' has no <link>", 1, "arm"),
    Case("xacro in an attribute", 'xyz="0 0 0.3"', 'xyz="0 0 ${l1}"', "unprocessed xacro", 7, None),
    Case("a xacro argument", 'xyz="0 0 0.3"', 'xyz="0 0 $(arg l1)"', "unprocessed xacro", 7, None),
    Case("a xacro element", '<link name="base"/>', '<xacro:bar name="base"/>', "suffix .xacro", 3, "base"),
]

NAMES = [
    Case("a link without name", '<link name="base"/>', "<link/>", "<link> has no name", 3, None),
    Case("a joint with an empty name", 'joint name="turn"', 'joint name=""', "<joint> has no name", 4, ""),
    Case("a link twice", END, '<link name="tool"/>' + END, "link 'tool' is there twice", 52, "tool"),
    Case("a joint twice", 'joint name="finger"', 'joint name="slide"', "joint 'slide' is there twice", 33, "slide"),
    Case("a link called universe", '<link name="base"/>', '<link name="universe"/>', "reserved name", 3, "universe"),
    Case("a joint called universe", 'joint name="turn"', 'joint name="universe"', "reserved name", 4, "universe"),
]

STRUCTURE = [
    Case("two roots", END, '<link name="table"/>' + END, "there are 2 roots: 'base', 'table'", 52, "table"),
    Case("a second parent", '<child link="tool"/>', '<child link="jaw"/>', "second parent of link 'jaw'", 46, "mount"),
    Case("a loop", '<parent link="base"/>', '<parent link="tool"/>', "closes a loop of links", 4, "turn"),
    Case("a loop of one", '<parent link="base"/>', '<parent link="upper"/>', "closes a loop of links", 4, "turn"),
    Case("no parent", '<parent link="base"/>', "", "joint 'turn' has no <parent link='...'/>", 4, "turn"),
    Case("no child", '<child link="upper"/>', "", "joint 'turn' has no <child link='...'/>", 4, "turn"),
    Case("a parent without link", '<parent link="base"/>', "<parent/>", "has no <parent link='...'/>", 5, "turn"),
    Case("an unknown parent", 'parent link="base"', 'parent link="bse"', "has the parent 'bse'", 5, "turn"),
    Case("an unknown child", 'child link="tool"', 'child link="tol"', "has the child 'tol'", 48, "mount"),
]

JOINTS = [
    Case("no type", TURN, '<joint name="turn">', "has no type; it can be revolute, prismatic", 4, "turn"),
    Case("an unknown type", '"revolute"', '"rotary"', "has the unknown type 'rotary'; it can be", 4, "turn"),
    Case("a type in capitals", '"revolute"', '"Revolute"', "has the unknown type 'Revolute'", 4, "turn"),
    Case("revolute, no limit", LIMIT, "", "is revolute and has no <limit>", 4, "turn"),
    Case("prismatic, no limit", '<limit lower="-0.5"', '<limits lower="-0.5"', "is prismatic and has no", 21, "slide"),
    Case("swapped limits", 'lower="-2" upper="2"', 'lower="2" upper="-2"', "lower 2 is above upper -2", 9, "turn"),
    Case("upper below zero, no lower", 'lower="-2" upper="2"', 'upper="-2"', "lower 0 is above upper -2", 9, "turn"),
    Case("no velocity", ' velocity="3"', "", "has a <limit> without velocity", 9, "turn"),
    Case("no effort", ' effort="50"', "", "has a <limit> without effort", 9, "turn"),
    Case("negative velocity", 'velocity="3"', 'velocity="-3"', "has a negative velocity limit, -3", 9, "turn"),
    Case("negative effort", 'effort="50"', 'effort="-50"', "has a negative effort limit, -50", 9, "turn"),
    Case("a zero axis", AXIS, '<axis xyz="0 0 0"/>', "has the axis '0 0 0', which gives no direction", 8, "turn"),
    Case("a tiny axis", AXIS, '<axis xyz="0 0 1e-300"/>', "which gives no direction", 8, "turn"),
    Case("a huge axis", AXIS, '<axis xyz="0 0 1e12"/>', "which gives no direction", 8, "turn"),
    Case(
        "a huge angle", 'rpy="0 0 0.5"', 'rpy="0 0 1e19"', "'0 0 1e19' in rpy of its <origin>; at most 1e+18", 7, "turn"
    ),
    Case("a huge factor", 'multiplier="-0.5"', 'multiplier="-1e19"', "at most 1e+18", 38, "finger"),
    Case("an axis without xyz", AXIS, "<axis/>", "has an <axis> without xyz", 8, "turn"),
    Case(
        "a zero axis of a planar joint", END, joint("p", "planar", "tool", '<axis xyz="0 0 0"/>') + END, "axis", 52, "p"
    ),
]

FOLLOWERS = [
    Case("no leader named", ' joint="slide"', "", "has a <mimic> without the joint it follows", 38, "finger"),
    Case(
        "an unknown leader", 'joint="slide"', 'joint="slid"', "mimics joint 'slid', and there is no such", 38, "finger"
    ),
    Case("a fixed leader", 'joint="slide"', 'joint="mount"', "mimics joint 'mount', which is fixed", 38, "finger"),
    Case("itself", 'joint="slide"', 'joint="finger"', "mimics itself", 33, "finger"),
    Case(
        "a loop of two followers",
        '<limit lower="-0.5"',
        '<mimic joint="finger"/><limit lower="-0.5"',
        "joint 'slide' mimics itself, through a loop",
        21,
        "slide",
    ),
    Case(
        "a loop of three followers",
        END,
        "".join(joint(a, "revolute", "tool", f'<mimic joint="{b}"/>') for a, b in ("xy", "yz", "zx")) + END,
        "joint 'x' mimics itself, through a loop",
        52,
        "x",
    ),
    Case(
        "a floating leader",
        END,
        joint("f", "floating", "tool") + joint("g", "revolute", "tool", '<mimic joint="f"/>') + END,
        "mimics joint 'f', which is floating and has not one coordinate",
        52,
        "g",
    ),
    Case(
        "a floating follower",
        END,
        joint("f", "floating", "tool", '<mimic joint="slide"/>') + END,
        "is floating and cannot mimic",
        52,
        "f",
    ),
]

SHAPES = [
    Case("an empty geometry", SHAPE, "", "has a <visual> without a shape in its <geometry>", 17, "upper"),
    Case("no geometry", f"<geometry>{SHAPE}</geometry>", "", "has a <visual> without a shape", 17, "upper"),
    Case("an unknown shape", SHAPE, '<cone radius="1"/>', "has the unknown shape <cone>; it can be box", 18, "upper"),
    Case("no size", SHAPE, "<box/>", "has a box without size", 18, "upper"),
    Case("a negative size", SHAPE, '<box size="1 -1 1"/>', "has a box with a negative size, '1 -1 1'", 18, "upper"),
    Case("no radius", SHAPE, '<cylinder length="1"/>', "has a cylinder without radius", 18, "upper"),
    Case("no length", SHAPE, '<cylinder radius="1"/>', "has a cylinder without length", 18, "upper"),
    Case("a negative radius", SHAPE, '<sphere radius="-1"/>', "has a sphere with a negative radius", 18, "upper"),
    Case("a mesh without file", SHAPE, "<mesh/>", "has a mesh without filename", 18, "upper"),
    Case("a mesh with an empty name", SHAPE, '<mesh filename=" "/>', "has a mesh without filename", 18, "upper"),
]

NUMBERS = [  # the attribute as it stands in the base, its count of numbers, its line, whose it is, and in which element
    ('xyz="0 0 0.3"', 3, 7, "turn", "origin"),
    ('rpy="0 0 0.5"', 3, 7, "turn", "origin"),
    ('xyz="0 0 1"', 3, 8, "turn", "axis"),
    ('lower="-2"', 1, 9, "turn", "limit"),
    ('upper="2"', 1, 9, "turn", "limit"),
    ('velocity="3"', 1, 9, "turn", "limit"),
    ('effort="50"', 1, 9, "turn", "limit"),
    ('xyz="0.1 0 0"', 3, 13, "upper", "origin"),
    ('value="2"', 1, 14, "upper", "mass"),
    ('ixx="0.01"', 1, 15, "upper", "inertia"),
    ('size="0.3 0.1 0.1"', 3, 18, "upper", "box"),
    ('multiplier="-0.5"', 1, 38, "finger", "mimic"),
    ('offset="0.1"', 1, 38, "finger", "mimic"),
]


def _bad_numbers():
    for old, count, line, owner, tag in NUMBERS:
        attribute = old.split("=")[0]
        where = f"in {attribute} of its <{tag}>"
        wanted = f"needs {'a number' if count == 1 else f'{count} numbers'} {where}"
        finite = f"{where}; numbers must be finite"
        rest = "0 " * (count - 1)
        values = {f"{rest}nan": finite, f"{rest}-inf": finite, f"{rest}1e999": finite, f"{rest}one": wanted}
        values |= {"": wanted, f"{rest}0 0": wanted, f"{rest}0,5": wanted, f"{rest}0x10": wanted}
        values |= {f"{rest}1_0": wanted, f"{rest}٣": wanted}
        for text, message in values.items():
            yield Case(
                f"{attribute}={text!r} in <{tag}> of {owner}", old, f'{attribute}="{text}"', message, line, owner
            )


CASES = [*NOT_ROBOTS, *NAMES, *STRUCTURE, *JOINTS, *FOLLOWERS, *SHAPES, *_bad_numbers()]

INERTIA = '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>'
INERTIAL = BASE[BASE.index("<inertial>") : BASE.index("</inertial>") + len("</inertial>")]

WARNINGS = [
    Case("an axis not of unit length", AXIS, '<axis xyz="0 0 2"/>', "joint 'turn' has an axis of length 2", 8, "turn"),
    Case("a missing mesh", SHAPE, '<mesh filename="bar.stl"/>', "mesh 'bar.stl' was not found", None, None),
    Case("a mesh of no package", SHAPE, '<mesh filename="package://p/a.stl"/>', "mesh 'package://p/a.stl'", None, None),
    Case("no inertia", INERTIAL, "", "robot 'arm' has links without inertia", 2, "arm"),
    Case("no mass", '<mass value="2"/>', "", "has an <inertial> that lacks mass or inertia", 12, "upper"),
    Case("a mass without value", '<mass value="2"/>', "<mass/>", "lacks the value of its mass", 12, "upper"),
    Case("half an inertia", ' iyz="0" izz="0.02"', "", "has an <inertial> that lacks iyz, izz", 12, "upper"),
    Case("a negative mass", 'value="2"', 'value="-2"', "link 'upper' has the mass -2", 12, "upper"),
    Case("no weight", 'value="2"', 'value="0"', "link 'upper' has the mass 0", 12, "upper"),
    Case("an indefinite inertia", 'ixx="0.01"', 'ixx="-0.01"', "has an inertia that no body can have", 12, "upper"),
    Case(
        "an inertia beyond the triangle", 'ixx="0.01"', 'ixx="1"', "has an inertia that no body can have", 12, "upper"
    ),
    Case("limits of effort alone", 'lower="-2" upper="2" ', "", "which means [0, 0]: it cannot move", 9, "turn"),
    Case(
        "a fixed joint with mimic", END, joint("f", "fixed", "tool", MIMIC) + END, "is fixed and has a <mimic>", 52, "f"
    ),
]

SOUND = [
    ("a link and a joint of one name", 'joint name="mount"', 'joint name="tool"'),
    ("visuals of one name", "</visual>", f'</visual><visual name="bar"><geometry>{SHAPE}</geometry></visual>'),
    ("no axis", AXIS, ""),
    ("no origin", '<origin xyz="0 0 0.3" rpy="0 0 0.5"/>', ""),
    ("an origin without numbers", '<origin xyz="0 0 0.3" rpy="0 0 0.5"/>', "<origin/>"),
    ("limits of velocity and effort beyond measure", 'velocity="3" effort="50"', 'velocity="1e300" effort="1e308"'),
    ("lower alone", 'lower="-2" upper="2"', 'lower="-2"'),
    ("elements of other programs", END, '<gazebo reference="tool"><kp>1</kp></gazebo><transmission name="t"/>' + END),
    ("a collision shape", "</visual>", f"</visual><collision><geometry>{SHAPE}</geometry></collision>"),
    ("a sphere", SHAPE, '<sphere radius="0.1"/>'),
    ("a cylinder", SHAPE, '<cylinder radius="0.1" length="0.2"/>'),
    ("a coloured shape", "</visual>", '<material name="red"><color rgba="1 0 0 1"/></material></visual>'),
    ("a fixed joint with an idle axis", END, joint("f", "fixed", "tool", '<axis xyz="0 0 0"/>') + END),
    ("a fixed joint with an axis of words", END, joint("f", "fixed", "tool", '<axis xyz="up"/>') + END),
    ("a floating joint with an empty axis", END, joint("f", "floating", "tool", "<axis/>") + END),
]
