"""What there is to draw: every visual of a robot's file as a record, where Pinocchio puts it."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from malformed import BASE, SHAPE
from sweeps import core_first

import robotics1 as r1
from robotics1.robot.sources import example_robots
from robotics1.robot.visuals import Box, Capsule, Cylinder, MeshFile, Sphere, read_visuals

REFUSED = {"ur", "alex_psyonic_hands"}  # no robots: no name, and a joint that is not there
ROBOTS = [name for name in example_robots() if name not in REFUSED]


@pytest.mark.parametrize("name", core_first(ROBOTS, ["panda", "tiago", "romeo_small"], 8))
def test_visuals_are_where_pinocchio_puts_them(name):
    robot = r1.load_robot(name)
    drawn = [visual for visual in read_visuals(robot) if getattr(visual.shape, "found", True)]
    shapes = pin.buildGeomFromUrdfString(robot.model, robot.urdf, pin.GeometryType.VISUAL).geometryObjects
    assert len(shapes) == len(drawn)
    by_link = {}
    for shape in shapes:
        by_link.setdefault(robot.model.frames[shape.parentFrame].name, []).append(shape)
    for visual in drawn:
        shape = by_link[visual.link].pop(0)
        assert visual.joint == shape.parentJoint
        assert visual.placement.homogeneous == pytest.approx(shape.placement.homogeneous, abs=1e-12)
        if isinstance(visual.shape, MeshFile):
            assert visual.shape.path == shape.meshPath
            assert visual.shape.scale == pytest.approx(tuple(shape.meshScale))
        if visual.color is not None:
            assert visual.color == pytest.approx(tuple(shape.meshColor), abs=1e-6)


def shaped(*geometries):
    """The visuals of BASE with other shapes in the place of its own, in order."""
    bar = f'<visual name="bar">\n      <geometry>{SHAPE}</geometry>\n    </visual>'
    assert bar in BASE
    return BASE.replace(bar, "".join(f"<visual><geometry>{shape}</geometry></visual>" for shape in geometries))


def test_each_shape_of_a_urdf_has_a_record():
    text = shaped(
        '<box size="1 2 3"/>', '<cylinder radius="0.1" length="2"/>', '<sphere radius="0.3"/>',
        '<capsule radius="0.1" length="2"/>', '<mesh filename="nowhere.stl" scale="1 -1 2"/>',
    )  # fmt: skip
    visuals = read_visuals(r1.load_robot(text))
    assert [visual.shape for visual in visuals] == [
        Box((1, 2, 3)),
        Cylinder(0.1, 2),
        Sphere(0.3),
        Capsule(0.1, 2),
        MeshFile("nowhere.stl", (1, -1, 2), found=False),
    ]
    assert {(visual.link, visual.joint, visual.color) for visual in visuals} == {("upper", 1, None)}


def test_a_visual_of_a_link_on_a_fixed_joint_moves_with_the_joint_before():
    ball = '<origin xyz="0 0 1" rpy="0 0 1"/><geometry><sphere radius="1"/></geometry>'
    shape = f'<link name="tool"><visual>{ball}</visual></link>'
    robot = r1.load_robot(BASE.replace('<link name="tool"/>', shape))
    visual = read_visuals(robot)[-1]
    assert (visual.link, robot.model.names[visual.joint]) == ("tool", "slide")
    assert visual.placement.translation == pytest.approx(np.array([0.2, 0, 1]))
    assert pin.rpy.matrixToRpy(visual.placement.rotation) == pytest.approx(np.array([0, 0, 1]))
    world = r1.load_robot(BASE.replace('<link name="base"/>', shape.replace("tool", "base")))
    assert read_visuals(world)[0].joint == 0


def test_a_colour_is_the_shapes_own_or_that_of_its_name():
    named = '<material name="red"><color rgba="1 0 0 0.5"/></material>'
    text = BASE.replace("</visual>", '<material name="red"/></visual>').replace("</robot>", f"{named}</robot>")
    (visual,) = read_visuals(r1.load_robot(text))
    assert visual.color == (1, 0, 0, 0.5)


def test_a_mesh_that_was_not_found_keeps_its_place_and_the_name_in_the_file():
    text = shaped('<mesh filename="package://nowhere/a.stl"/>', SHAPE)
    missing, box = read_visuals(r1.load_robot(text))
    assert missing.shape == MeshFile("package://nowhere/a.stl", found=False)
    assert missing.joint == box.joint == 1
    assert isinstance(box.shape, Box)
    rebased = r1.load_robot(text, base="upper")
    assert [visual.joint for visual in read_visuals(rebased)] == [0, 0]


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ('size="0.3 0.1 0.1"', 'size="nan 0.1 0.1"', "has a <box> whose size is 'nan 0.1 0.1'"),
        ('size="0.3 0.1 0.1"', 'size="0.3 1e30 0.1"', "has a <box> whose size is '0.3 1e30 0.1'"),
        ('size="0.3 0.1 0.1"', 'size="0.3"', "has a <box> whose size is '0.3'"),
        ('size="0.3 0.1 0.1"', "", "has a <box> whose size is None"),
        ('box size="0.3 0.1 0.1"', 'cone size="1"', "has the unknown shape <cone>"),
        ('<box size="0.3 0.1 0.1" />', "", "has no shape"),
    ],
)
def test_a_malformed_visual_is_left_out_with_a_warning(old, new, fault):
    robot = r1.load_robot(BASE)
    assert old in robot.urdf
    with pytest.warns(r1.RobotWarning, match=f"a visual of link 'upper' {fault}, so it is not drawn"):
        assert read_visuals(replace(robot, urdf=robot.urdf.replace(old, new))) == ()


def test_records_cannot_be_changed_and_can_be_pickled():
    import pickle

    (visual,) = pickle.loads(pickle.dumps(read_visuals(r1.load_robot(BASE))))
    assert visual.shape == Box((0.3, 0.1, 0.1))
    with pytest.raises(AttributeError):
        visual.joint = 3
