"""Which files a robot's meshes may be: those of its package and of the packages given, and nothing of a network."""

import pinocchio as pin
import pytest
from malformed import BASE, SHAPE

import robotics1 as r1

STL = (
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
)


@pytest.fixture
def robot(tmp_path):
    """Load a robot with a mesh of a name, from a file at a place; `files` are meshes, `links` are symlinks."""

    def load(name, at="pkg/urdf/arm.urdf", files=(), links=(), manifests=(), **options):
        path = tmp_path / at
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(BASE.replace(SHAPE, f'<mesh filename="{name}"/>'), encoding="utf-8")
        for file in files:
            (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / file).write_text(STL, encoding="utf-8")
        for folder in manifests:
            (tmp_path / folder / "package.xml").write_text("<package/>", encoding="utf-8")
        for link, target in links:
            (tmp_path / link).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / link).symlink_to(tmp_path / target)
        return r1.load_robot(path, **options)

    return load


def drawn(robot):
    """The mesh files that a viewer would read."""
    visuals = pin.buildGeomFromUrdfString(robot.model, robot.urdf, pin.GeometryType.VISUAL)
    return [visual.meshPath for visual in visuals.geometryObjects]


WITHIN = {  # name of the mesh, place of the robot, place of the mesh, and more
    "beside the file": ("a.stl", "arm.urdf", "a.stl", {}),
    "in a folder below": ("meshes/a.stl", "arm.urdf", "meshes/a.stl", {}),
    "beside the folder urdf": ("../meshes/a.stl", "pkg/urdf/arm.urdf", "pkg/meshes/a.stl", {}),
    "a folder of its own name": ("../visual/a.stl", "pkg/robots/arm.urdf", "pkg/visual/a.stl", {}),
    "meshes one folder higher": ("../../meshes/a.stl", "pkg/x/y/arm.urdf", "pkg/meshes/a.stl", {}),
    "in the package of a manifest": ("../../3d/a.stl", "pkg/x/y/arm.urdf", "pkg/3d/a.stl", {"manifests": ["pkg"]}),
    "in the file's package": ("package://pkg/meshes/a.stl", "pkg/urdf/arm.urdf", "pkg/meshes/a.stl", {}),
    "in the package beside": ("package://other/a.stl", "pkg/urdf/arm.urdf", "other/a.stl", {}),
    "by a link inside the package": (
        "../meshes/a.stl",
        "pkg/urdf/arm.urdf",
        "pkg/real/a.stl",
        {"links": [("pkg/meshes/a.stl", "pkg/real/a.stl")]},
    ),
}


@pytest.mark.parametrize(("name", "at", "file", "more"), WITHIN.values(), ids=WITHIN)
def test_a_mesh_of_the_robots_own_package_is_drawn(robot, tmp_path, name, at, file, more):
    found = robot(name, at, files=[file], **more)
    assert found.warnings == ()
    assert drawn(found) == [str(tmp_path / file)]


def test_the_installed_file_may_be_a_link_into_the_sources(robot, tmp_path):
    robot("../meshes/a.stl", "src/pkg/urdf/arm.urdf", files=["src/pkg/meshes/a.stl"])
    (tmp_path / "install/urdf").mkdir(parents=True)
    (tmp_path / "install/meshes").mkdir()
    (tmp_path / "install/urdf/arm.urdf").symlink_to(tmp_path / "src/pkg/urdf/arm.urdf")
    (tmp_path / "install/meshes/a.stl").symlink_to(tmp_path / "src/pkg/meshes/a.stl")
    found = r1.load_robot(tmp_path / "install/urdf/arm.urdf")
    assert found.warnings == ()
    assert drawn(found) == [str(tmp_path / "src/pkg/meshes/a.stl")]


OUTSIDE = {
    "an absolute path": ("{}/secret.stl", {}),
    "an address of a file": ("file://{}/secret.stl", {}),
    "above the folder": ("../secret.stl", {"at": "pkg/x/arm.urdf", "secret": "pkg/secret.stl"}),
    "far above": ("../../secret.stl", {}),
    "above a package": ("package://pkg/../secret.stl", {}),
    "a link": ("a.stl", {"links": [("pkg/urdf/a.stl", "secret.stl")]}),
    "a link to a folder": (
        "../meshes/secret.stl",
        {"links": [("pkg/meshes", "private")], "secret": "private/secret.stl"},
    ),
}


@pytest.mark.parametrize(("name", "more"), OUTSIDE.values(), ids=OUTSIDE)
def test_a_mesh_from_elsewhere_is_left_out_with_a_warning_unless_the_file_is_trusted(robot, tmp_path, name, more):
    name, more = name.format(tmp_path), dict(more)
    secret = more.pop("secret", "secret.stl")
    found = robot(name, files=[secret], **more)
    (warning,) = found.warnings
    assert warning.startswith(f"mesh {name!r} was left out: it lies outside")
    assert drawn(found) == []
    options = {key: value for key, value in more.items() if key == "at"}
    trusted = robot(name, trusted=True, **options)
    assert (trusted.warnings, drawn(trusted)) == ((), [str(tmp_path / secret)])


def test_a_mesh_inside_a_folder_given_as_package_is_drawn(robot, tmp_path):
    for name in (f"{tmp_path}/lib/a.stl", f"file://{tmp_path}/lib/a.stl", "../../lib/a.stl", "package://lib/a.stl"):
        found = robot(name, files=["lib/a.stl"], packages=[tmp_path / "lib"])
        assert (found.warnings, drawn(found)) == ((), [str(tmp_path / "lib/a.stl")])


@pytest.mark.parametrize("trusted", [False, True])
@pytest.mark.parametrize(
    "address", ["http://a.example/a.stl", "https://a.example/a.stl", "ftp://a.example/a", "data:a"]
)
def test_nothing_is_read_from_a_network(robot, address, trusted):
    found = robot(address, trusted=trusted)
    assert found.warnings == (f"mesh {address!r} was left out: only files, and package:// of this computer, are read",)
    assert drawn(found) == []


@pytest.mark.parametrize("name", ["package://etc/hostname", "package://../x", "package:///x", "package://./x"])
def test_folders_of_the_computer_are_no_packages(robot, name):
    assert robot(name).warnings == (f"mesh {name!r} was not found",)


@pytest.mark.parametrize("name", ["a" * 300 + ".stl", "a/" * 3000, ".", "..", "", "/dev/zero", "loop"])
def test_a_name_that_is_no_file_is_not_found(robot, name):
    if name == "":
        with pytest.raises(r1.RobotFileError, match="mesh without filename"):
            robot(name)
        return
    links = [("pkg/urdf/loop", "pkg/urdf/loop")] if name == "loop" else []
    assert robot(name, links=links).warnings == (f"mesh {name!r} was not found",)


def test_one_name_has_one_warning_and_every_shape_of_it_is_left_out(tmp_path):
    shape = '<visual><geometry><mesh filename="/x/a.stl"/></geometry></visual>'
    collision = shape.replace("visual>", "collision>")
    text = BASE.replace("</visual>", "</visual>" + shape * 3 + collision)
    robot = r1.load_robot(text)
    assert robot.warnings == ("mesh '/x/a.stl' was not found",)
    assert drawn(robot) == ["BOX"]
    assert (robot.urdf.count("<undrawn>"), robot.urdf.count("<collision"), robot.urdf.count("<mesh")) == (3, 0, 3)


SHAPED = "<box size='0.1\t0.1\n0.1'/>"


@pytest.mark.parametrize(
    "inside",
    [
        "<material/>",
        '<material name="nowhere"/>',
        '<material name="a"><color rgba="1 0 0"/></material>',
        '<material name="a"><color rgba="red"/></material>',
        '<material name="a"><texture filename="/dev/zero"/></material>',
        '<material name="a"><color rgba="1 0 0 1"/></material><material name="a"/>',
    ],
)
def test_what_a_viewer_reads_is_whole(inside, capfd):
    other = '<safety_controller/><calibration rising="x"/><dynamics/>'
    text = BASE.replace(f"<geometry>{SHAPE}</geometry>", f"<geometry>{SHAPED}</geometry>{inside}")
    text = text.replace("</joint>", other + "</joint>", 1).replace("</robot>", "<material/>" * 2 + "</robot>")
    robot = r1.load_robot(text.replace('<robot name="arm">', '<robot name="arm" version="7">'))
    assert len(drawn(robot)) == 1
    assert "texture" not in robot.urdf
    assert capfd.readouterr() == ("", "")


def test_a_colour_named_elsewhere_is_the_shapes():
    red = '<material name="red"><color rgba="1 0 0 1"/></material>'
    text = BASE.replace("</visual>", '<material name="red"/></visual>').replace("</robot>", red + "</robot>")
    robot = r1.load_robot(text)
    visuals = pin.buildGeomFromUrdfString(robot.model, robot.urdf, pin.GeometryType.VISUAL)
    assert visuals.geometryObjects[0].meshColor == pytest.approx([1, 0, 0, 1])
