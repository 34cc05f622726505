"""The shapes to draw: all visuals of a robot whose meshes can be read."""

import warnings
import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin

from robotics1.errors import RobotWarning
from robotics1.robot.model import Robot

LARGEST = 1e18  # m: beyond it a box round a shape has no size


def drawable_visuals(robot: Robot) -> pin.GeometryModel:
    """Return the visuals of a robot; a mesh that cannot be read is left out, and a `RobotWarning` names it."""
    try:
        visuals = _visuals(robot.model, robot.urdf)
    except Exception:  # the mesh reader raises several kinds; which mesh it was, is found out below
        visuals = _visuals(robot.model, _without_unreadable(robot.urdf))
    for visual in list(visuals.geometryObjects):
        if not _has_a_size(visual):
            _warn(visual.meshPath or visual.name, "has corners that are no finite numbers")
            visuals.removeGeometryObject(visual.name)
    return visuals


def _visuals(model: pin.Model, urdf: str) -> pin.GeometryModel:
    return pin.buildGeomFromUrdfString(model, urdf, pin.GeometryType.VISUAL)


def _without_unreadable(urdf: str) -> str:
    """Return a URDF text without the visuals whose meshes cannot be read."""
    root = ET.fromstring(urdf)
    known: dict[str, bool] = {}
    for link in root.findall("link"):
        for visual in link.findall("visual"):
            for mesh in visual.iter("mesh"):
                file = mesh.get("filename", "")
                if file not in known:
                    known[file] = _is_readable(file)
                    if not known[file]:
                        _warn(file, "cannot be read as a mesh")
                if not known[file]:
                    link.remove(visual)
                    break
    return ET.tostring(root, encoding="unicode")


def _is_readable(file: str) -> bool:
    """Return whether the reader takes a mesh: in a robot of one link."""
    robot = ET.Element("robot", name="one")
    visual = ET.SubElement(ET.SubElement(robot, "link", name="link"), "visual")
    ET.SubElement(ET.SubElement(visual, "geometry"), "mesh", filename=file)
    text = ET.tostring(robot, encoding="unicode")
    try:
        _visuals(pin.buildModelFromXML(text), text)
    except Exception:
        return False
    return True


def _has_a_size(visual: pin.GeometryObject) -> bool:
    visual.geometry.computeLocalAABB()
    box = visual.geometry.aabb_local
    corners = np.array([box.min_, box.max_])
    return bool(np.isfinite(corners).all() and np.abs(corners).max() < LARGEST)


def _warn(mesh: str, fault: str) -> None:
    warnings.warn(f"{mesh!r} {fault}, so it is not drawn", RobotWarning, stacklevel=6)
