"""The arms that all solvers are asked about, and what counts as solved."""

import atexit
import shutil
import tempfile
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1 import Robot, load_robot
from robotics1.robot.sources import robot_file

Array = npt.NDArray[np.float64]

POSITION_TOLERANCE = 1e-5  # [m]
ANGLE_TOLERANCE = 1e-4  # [rad]
LIMIT_TOLERANCE = 1e-9  # [rad]; of rounding only

IIWA = "rtbdata/xacro/kuka_description/kuka_lbr_iiwa/urdf/lbr_iiwa_14_r820.urdf"
KINEMATIC = {"parent", "child", "origin", "axis", "limit"}  # what kinematics needs of a joint


@dataclass(frozen=True, eq=False)
class Arm:
    """An arm from `base` to `tool`, as our robot and as the URDF that the peers read.

    Attributes:
        name: as in the tables.
        robot: our robot.
        base, tool: names of links.
        urdf: the text of a URDF with the same joints, without meshes, inertias and soft limits.
        path: a file with that text.
    """

    name: str
    robot: Robot
    base: str
    tool: str
    urdf: str
    path: Path

    def pose(self, q: Array) -> pin.SE3:
        """Return T(q) by Pinocchio, with a Data of its own."""
        model = self.robot.model
        data = model.createData()
        pin.framesForwardKinematics(model, data, q)
        world_base = data.oMf[model.getFrameId(self.base)]
        return world_base.actInv(data.oMf[model.getFrameId(self.tool)])

    def meets(self, q: Array, target: pin.SE3) -> bool:
        """Whether |p_d − p| < 1e-5 m and |log(R_d Rᵀ)| < 1e-4 rad, by Pinocchio."""
        if not np.all(np.isfinite(q)):
            return False
        T = self.pose(q)
        angle = np.linalg.norm(pin.log3(target.rotation @ T.rotation.T))
        return bool(np.linalg.norm(target.translation - T.translation) < POSITION_TOLERANCE and angle < ANGLE_TOLERANCE)

    def inside(self, q: Array) -> bool:
        """Whether every joint is inside its limits."""
        lower, upper = self.robot.lower - LIMIT_TOLERANCE, self.robot.upper + LIMIT_TOLERANCE
        return bool(np.all((lower <= q) & (q <= upper)))

    def random(self, rng: np.random.Generator) -> Array:
        """Return q uniform inside the limits."""
        return rng.uniform(self.robot.lower, self.robot.upper)


def panda() -> Arm:
    """Return the Panda (7R), panda_link0 → panda_link8, its finger locked."""
    return _arm("Panda", "panda", "panda_link0", "panda_link8", locked={"panda_finger_joint1": 0.0})


def ur5() -> Arm:
    """Return the UR5 (6R), base_link → tool0."""
    return _arm("UR5", "ur5", "base_link", "tool0")


def iiwa() -> Arm:
    """Return the KUKA iiwa14 R820 (7R), base_link → tool0, of the package rtb-data.

    Raises:
        ImportError: the package is not installed.
    """
    try:
        path = Path(str(distribution("rtb-data").locate_file(IIWA)))
    except PackageNotFoundError:
        raise ImportError("the package rtb-data is not installed") from None
    return _arm("iiwa", path, "base_link", "tool0")


ARMS = {"Panda": panda, "UR5": ur5, "iiwa": iiwa}


def _arm(name: str, source: str | Path, base: str, tool: str, locked: dict[str, float] | None = None) -> Arm:
    robot = load_robot(source, base=base, tool=tool, locked=locked)
    return _with_file(name, robot, base, tool, kinematic_urdf(robot_file(source).read_text(encoding="utf-8")))


def arm_of_text(name: str, urdf: str, base: str, tool: str) -> Arm:
    """Return the arm of a URDF."""
    return _with_file(name, load_robot(urdf, base=base, tool=tool), base, tool, urdf)


def _with_file(name: str, robot: Robot, base: str, tool: str, urdf: str) -> Arm:
    folder = Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    path = folder / f"{name}.urdf"
    path.write_text(urdf, encoding="utf-8")
    return Arm(name, robot, base, tool, urdf, path)


def kinematic_urdf(text: str) -> str:
    """Return the URDF with links and joints only.

    Some peers look for the meshes' packages, or read soft limits (of the Panda as zeros).
    """
    root = ET.fromstring(text)
    for part in list(root):
        if part.tag not in {"link", "joint"}:
            root.remove(part)
            continue
        for detail in list(part):
            if part.tag == "link" or detail.tag not in KINEMATIC:
                part.remove(detail)
    return ET.tostring(root, encoding="unicode")
