"""The robot: a Pinocchio model with a name, a tool and its named parameters."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Protocol, TypeAlias

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.angles import warn_of_degrees
from robotics1.caching import cached_property
from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import Array, by_name, real_array
from robotics1.other_words import ClassOfWords, made_by
from robotics1.robot.building import restore_followers
from robotics1.robot.description import DescribedRobot
from robotics1.robot.frames import frame_number, links_of
from robotics1.robot.joints import Joint, joints_to, tips
from robotics1.robot.parameters import Placements, constant_placements
from robotics1.robot.postures import in_numbers, named_postures

ConfigurationLike: TypeAlias = npt.ArrayLike | Mapping[str, float]  # also the name of a posture
SMALLEST = 1e-100  # length of an arm [m]
LIMITS = ("lower", "upper", "max_velocity", "max_effort")


class RobotSource(Protocol):
    """What a robot with named parameters was made from."""

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot with these values of its named parameters; the others stay."""

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the robot's joints as polynomials in its parameters."""


@made_by("load_robot('ur5')")
@dataclass(frozen=True, eq=False, repr=False)
class Robot(DescribedRobot, metaclass=ClassOfWords):
    """A robot as Pinocchio sees it.

    Threads may share a Robot: each thread has a scratch `pin.Data` of its own. A Robot can be pickled and copied. What
    is written to `robot.model` changes neither robot nor solver: `load_robot(model)` makes a robot of a changed model.

    Attributes:
        name: the robot's name in its file.
        own_model: the `pin.Model` that gives the answers; q and q̇ are in its order of joints. Nobody may change it.
        joints: all joints as numbers, in the order of the file.
        tool: the frame meant when no frame is named, or None when the file leaves it open.
        parameters: the named lengths and their values [m].
        urdf: the URDF text the model was made from.
        path: the file it came from.
        warnings: what is odd about the file, one sentence each.
        source: what the robot was made from, which `with_parameters` uses.
        lower, upper: (nq,) joint limits [rad or m]; ∓∞ where there is none.
        max_velocity: (nv,) velocity limits [rad/s or m/s]; +∞ where there is none.
        max_effort: (nv,) effort limits [N m or N]; +∞ where there is none.
    """

    name: str
    own_model: pin.Model = field(repr=False)
    joints: tuple[Joint, ...] = field(repr=False)
    tool: str | None
    parameters: Mapping[str, float]
    urdf: str = field(repr=False)
    path: Path
    warnings: tuple[str, ...] = ()
    source: RobotSource | None = field(default=None, repr=False)
    lower: Array = field(init=False, repr=False)
    upper: Array = field(init=False, repr=False)
    max_velocity: Array = field(init=False, repr=False)
    max_effort: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Copy the limits of the model, and make the place for the scratch memory of each thread."""
        model = self.own_model
        limits = (model.lowerPositionLimit, model.upperPositionLimit, model.upperVelocityLimit, model.upperEffortLimit)
        self.__setstate__(dict(zip(LIMITS, map(np.array, limits), strict=True)))

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: the fields, but no scratch memory."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _scratch=threading.local())
        if "own_model" in state:
            restore_followers(self.own_model, self.joints)
        for name in LIMITS:
            self.__dict__[name].flags.writeable = False

    @cached_property
    def model(self) -> pin.Model:
        """A copy of the model for the algorithms of Pinocchio, one for each robot, together with `data`."""
        return self.own_model.copy()

    @property
    def data(self) -> pin.Data:
        """The scratch memory of Pinocchio's algorithms, one for each thread."""
        scratch: Any = self.__dict__["_scratch"]
        try:
            return scratch.data
        except AttributeError:
            scratch.data = self.own_model.createData()
            return scratch.data

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the same robot with other values of its named parameters; those that are not named stay.

        Args:
            values: name → value, such as {"l2": 0.7} [m].

        Raises:
            InputError: the robot has no named parameters, or a value is not a finite number.
            UnknownNameError: there is no parameter of that name.
            RobotFileError: the robot's file is no robot at these values, or is there no longer.
        """
        if self.source is None or not self.parameters:
            raise InputError(f"robot {self.name!r} has no named parameters that could be given other values")
        return self.source.with_parameters(by_name("values", values, "{'l2': 0.5}"))

    @cached_property
    def placements(self) -> Placements:
        """The placement of each joint by its name, as polynomials in the parameters, or why there are none.

        They are found once: of a small xacro file when it is loaded, of a large one when they are first asked for.
        """
        if self.source is None or not self.parameters:
            return constant_placements(self.joints)
        return self.source.placements(self)

    @property
    def nq(self) -> int:
        """The length of q."""
        return int(self.own_model.nq)

    @property
    def nv(self) -> int:
        """The length of q̇: the degrees of freedom."""
        return int(self.own_model.nv)

    @cached_property
    def moving_joints(self) -> tuple[Joint, ...]:
        """The joints with a coordinate of their own, which are those that mimic no other, in the order of q."""
        named = {joint.name: joint for joint in self.joints}
        numbers = [i for i in range(1, self.own_model.njoints) if self.own_model.joints[i].nq > 0]
        return tuple(named[self.own_model.names[i]] for i in numbers)

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """The moving joints, in the order of q."""
        return tuple(joint.name for joint in self.moving_joints)

    @cached_property
    def frame_names(self) -> tuple[str, ...]:
        """The links of the robot; each is a frame."""
        return links_of(self.own_model)

    @cached_property
    def revolute(self) -> npt.NDArray[np.bool_]:
        """One entry for each of `joint_names`: True where its coordinate is an angle, False where it is a length."""
        turns = np.array([joint.kind == "revolute" for joint in self.moving_joints], dtype=bool)
        turns.flags.writeable = False
        return turns

    @cached_property
    def fixed_length(self) -> float:
        """The sum of the distances from joint to joint and to the tool [m]: the reach without any travel."""
        joints = [placement.translation for placement in self.own_model.jointPlacements][2:]
        tools = [frame.placement.translation for frame in self.own_model.frames]
        norm = np.hypot.reduce  # neither 1e200 nor 1e-200 is lost
        lengths = [*map(norm, joints), max(map(norm, tools), default=0.0)]
        return float(sum(length for length in lengths if np.isfinite(length)))

    @cached_property
    def reach(self) -> float:
        """A length of the size of the arm [m], which makes metres and radians comparable.

        The sum of the distances from joint to joint and to the tool, with the travel of prismatic joints;
        1 when that is zero, or so small (1e-100) that quotients by it are no numbers.
        """
        travels = np.zeros(0)
        if self.nq == self.nv:
            travels = np.maximum(np.abs(self.lower), np.abs(self.upper))[~self.revolute]
        length = self.fixed_length + float(sum(travel for travel in travels if np.isfinite(travel)))
        return length if length > SMALLEST else 1.0

    @property
    def units(self) -> Array:
        """(nv,) what counts as one of each entry of q̇: 1 rad, or the reach [m]."""
        turning = [turns for joint in self.moving_joints for turns in joint.turning]
        return np.where(np.array(turning, dtype=bool), 1.0, self.reach)

    @cached_property
    def postures(self) -> Mapping[str, Array]:
        """The postures that have a name, (nq,) each: "zero", and those of an SRDF beside the file."""
        if self.nq != self.nv:
            return {"zero": np.array(pin.neutral(self.own_model))}
        return named_postures(self.path, self.joint_names, self.lower, self.upper)

    def configuration(self, q: ConfigurationLike, name: str = "q") -> Array:
        """Return q as a float array (nq,): of numbers, of joint → value, or of a posture's name.

        Args:
            q: [rad or m].
            name: what an error calls it.

        Raises:
            InputError: wrong shape, not numeric, not finite, or a quaternion that is not of length 1.
            UnknownNameError: there is no joint or posture of that name.

        Warns:
            RobotWarning: an angle of 10 to 720 is a whole or half number, or is more than a turn outside its
                limits, as if in degrees.
        """
        if isinstance(q, str | Mapping):
            q = in_numbers(name, q, self.joint_names, self.postures)
        meaning = (
            f"one number for each of {', '.join(self.joint_names)}" if self.nq == self.nv else "in Pinocchio's order"
        )
        values = real_array(name, q, (self.nq,), meaning)
        if self.nq != self.nv and not pin.isNormalized(self.own_model, values, 1e-6):
            raise InputError(
                f"{name} holds a quaternion or a (cos, sin) that is not of length 1; start from pin.neutral(model)"
            )
        if self.nq == self.nv:
            warn_of_degrees(name, values, self.revolute, self.lower, self.upper)
        return values

    def configurations(self, q: Any, name: str = "q") -> Array:
        """Return several configurations as a float array (k, nq).

        Raises:
            InputError: wrong shape, not numeric or not finite.
        """
        rows = real_array(name, q, (None, self.nq), f"one row for each configuration of {', '.join(self.joint_names)}")
        return np.array([self.configuration(row, name) for row in rows]).reshape(-1, self.nq)

    def frame_id(self, frame: str | None) -> int:
        """Return Pinocchio's number of a frame; None means the tool.

        The one place where a name becomes a number: Pinocchio answers a mistyped name with a number out of
        range, and crashes the interpreter when that is used.

        Raises:
            UnknownNameError: there is no such frame.
            InputError: no frame is named and the robot has several tips, so that its tool is open.
        """
        if frame is None:
            frame = self.tool
            if frame is None:
                raise InputError(
                    f"robot {self.name!r} has several tips: name the tool, as in load_robot(..., tool='...'), --tool; "
                    f"the tips are {', '.join(map(repr, tips(self.frame_names, self.joints)))}"
                )
        number = frame_number(self.own_model, frame)
        if number is None:
            raise UnknownNameError(f"frame of robot {self.name!r} named", frame, self.frame_names)
        return number

    def link_of(self, frame: str | None) -> str:
        """Return the link that a frame is: of a joint's frame, the link that the joint moves; of None, the tool's.

        Raises:
            UnknownNameError: there is no such frame.
            InputError: no frame is named and the tool is open.
        """
        found = self.own_model.frames[self.frame_id(frame)]
        if found.type == pin.FrameType.BODY:
            return str(found.name)
        return next((joint.child for joint in self.joints if joint.name == found.name), str(found.name))

    def joints_to(self, frame: str | None) -> tuple[Joint, ...]:
        """Return the joints on the way from the root to a frame; None means the tool. Raises as `link_of`."""
        return joints_to(self.joints, self.link_of(frame))

    def require_single_coordinates(self, purpose: str) -> None:
        """Refuse a robot with a joint of several degrees of freedom.

        Args:
            purpose: what only revolute and prismatic joints can be used for, such as "can be searched".

        Raises:
            InputError: there is a planar or floating joint.
        """
        if self.nq != self.nv:
            raise InputError(
                f"robot {self.name!r} has joints with several degrees of freedom; only arms of revolute and prismatic "
                f"joints {purpose}"
            )

    def within_limits(self, q: npt.ArrayLike, tolerance: float = 1e-9) -> bool:
        """Return whether lower − tolerance ≤ q ≤ upper + tolerance for every joint."""
        q = self.configuration(q)
        return bool(np.all(q >= self.lower - tolerance) and np.all(q <= self.upper + tolerance))
