"""The joints of a robot as numbers, read once from its file: model, formulas and DH tables are made of these."""

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin

Triple = tuple[float, float, float]
TURNING = {"revolute": (1,), "prismatic": (0,), "planar": (0, 0, 1), "floating": (0, 0, 0, 1, 1, 1)}


@dataclass(frozen=True)
class Joint:
    """A joint: T_parent_child(q) = placement · motion about or along the axis.

    Attributes:
        name: its name.
        kind: "revolute" (also of a `continuous` one), "prismatic", "fixed", "planar" or "floating".
        parent, child: the links that it connects.
        xyz, rpy: its placement in the parent link [m, rad]: R = Rot_z(yaw) Rot_y(pitch) Rot_x(roll).
        axis: the unit vector about which it turns, or along which it slides.
        lower, upper, max_velocity, max_effort: its limits [rad or m, and per s, N m or N]; ∓∞ where there is none.
        friction, damping: of its motion [N m or N, and times s].
        leader: the joint whose coordinate q it has: the one that it mimics, by default itself.
        multiplier, offset: it moves by multiplier · q + offset.
    """

    name: str
    kind: str
    parent: str
    child: str
    xyz: Triple = (0.0, 0.0, 0.0)
    rpy: Triple = (0.0, 0.0, 0.0)
    axis: Triple = (1.0, 0.0, 0.0)
    lower: float = -np.inf
    upper: float = np.inf
    max_velocity: float = np.inf
    max_effort: float = np.inf
    friction: float = 0.0
    damping: float = 0.0
    leader: str = ""
    multiplier: float = 1.0
    offset: float = 0.0

    def __post_init__(self) -> None:
        """Let a joint that mimics no other lead itself."""
        object.__setattr__(self, "leader", self.leader or self.name)

    @property
    def turning(self) -> tuple[int, ...]:
        """Of each rate of the joint, 1 if it is that of an angle, 0 if it is that of a length."""
        return TURNING.get(self.kind, ())

    @property
    def placement(self) -> pin.SE3:
        """The joint's frame in the parent link, before it moves."""
        return pin.SE3(pin.rpy.rpyToMatrix(np.array(self.rpy)), np.array(self.xyz))

    @property
    def follows(self) -> bool:
        """Whether it mimics another joint."""
        return self.leader != self.name


def placed(joint: Joint, T: pin.SE3) -> Joint:
    """Return a joint with another placement in its parent link."""
    x, y, z = map(float, T.translation)
    roll, pitch, yaw = map(float, pin.rpy.matrixToRpy(np.array(T.rotation)))
    return replace(joint, xyz=(x, y, z), rpy=(roll, pitch, yaw))


def free_name(name: str, taken: Container[str]) -> str:
    """Return a name for something new, with "_" behind it as often as it is taken."""
    while name in taken:
        name += "_"
    return name


def joints_to(joints: Sequence[Joint], link: str) -> tuple[Joint, ...]:
    """Return the joints on the way from the root to a link."""
    above = {joint.child: joint for joint in joints}
    way: list[Joint] = []
    at = link
    while at in above:
        way.append(above[at])
        at = above[at].parent
    return tuple(way[::-1])


def root_of(links: Sequence[str], joints: Sequence[Joint]) -> str:
    """Return the link that hangs on no joint."""
    children = {joint.child for joint in joints}
    return next((link for link in links if link not in children), "")


def tips(links: Iterable[str], joints: Sequence[Joint]) -> tuple[str, ...]:
    """Return the links that carry no other link."""
    parents = {joint.parent for joint in joints}
    return tuple(link for link in links if link not in parents)
