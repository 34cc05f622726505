"""Real robots in the page: every shape of the file has its triangles in the scene, and all is inside the window."""

import numpy as np
import pinocchio as pin
import pytest
from pages import OpenPage, data_behind
from sweeps import core_first

import robotics1 as r1

ROBOTS = core_first(["ur5", "panda", "icub", "kinova", "tiago", "anymal", "talos_reduced"], {"ur5", "panda"}, 2)
MOST = {"ur5": 3e6, "panda": 4e6}  # bytes of the page


def triangles(robot, data):
    """How many triangles the packed meshes have, one of each mesh file that Pinocchio finds."""
    drawn = [shape["mesh"] for shape in data["arms"][0]["shapes"] if shape["kind"] == "mesh"]
    files = pin.buildGeomFromUrdfString(robot.model, robot.urdf, pin.GeometryType.VISUAL).geometryObjects
    assert {shape["link"] for shape in data["arms"][0]["shapes"]} >= {
        robot.model.frames[f.parentFrame].name for f in files
    }
    return sum(data["meshes"][n]["triangles"] for n in drawn)


@pytest.mark.parametrize("name", ROBOTS)
def test_every_mesh_of_a_real_robot_is_in_the_scene_and_inside_the_window(browser, name, tmp_path):
    robot = r1.load_robot(name)
    shown = r1.view(robot, None, tmp_path / f"{name}.html")
    file = shown.file
    assert file.stat().st_size < MOST.get(name, 16e6)
    page = OpenPage(browser, file)
    drawn = page.ask(
        "app.drawing.links.concat([app.drawing.base]).flatMap(g => g.children)"
        ".filter(m => m.userData.drawn && m.userData.drawn.kind === 'mesh')"
        ".map(m => m.geometry.attributes.position.count / 3)"
    )
    assert sum(drawn) == triangles(robot, data_behind(shown.html))
    for low, high in page.inside_windows():
        assert low > -1.001
        assert high < 1.001
    q = np.clip(np.full(robot.nq, 0.2), robot.lower, robot.upper) if robot.nq == robot.nv else None
    if q is not None:
        page.move(q)
        frame = page.ask("app.arm.tool.name")
        assert page.place("tool frame") == pytest.approx(
            r1.forward_kinematics(robot, q, frame=frame).translation, abs=1e-5
        )
    page.picture(name)
    assert page.faults == []
    page.tab.close()
