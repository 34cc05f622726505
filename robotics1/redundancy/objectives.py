"""What a redundant arm does besides its task: objective functions H(q), to be made large, and their gradients."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from robotics1.differentiation import configuration_derivative
from robotics1.errors import InputError
from robotics1.inputs import Array, answer_of, moderate, real_array, real_number
from robotics1.kinematics import forward_kinematics, frame_jacobian
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task

TOUCHES = 1e-12  # of the reach: a distance that is rounding


class Objective(Protocol):
    """A function H(q) that the null-space motion shall increase."""

    def value(self, q: npt.ArrayLike) -> float:
        """Return H(q)."""

    def gradient(self, q: npt.ArrayLike) -> Array:
        """Return ∂H/∂q, (nv,)."""


@dataclass(frozen=True, eq=False)
class ManipulabilityObjective:
    """H = √det(J Jᵀ), Yoshikawa's measure: the product of the singular values of the task's Jacobian.

    Its gradient is found by central differences, exact to about 1e-10.

    Source: Yoshikawa, Manipulability of robotic mechanisms, Int. J. Robotics Research 4, 1985.
    """

    robot: Robot
    task: Task

    def __init__(self, robot: RobotLike, task: TaskLike) -> None:
        for name, value in zip(("robot", "task"), robot_and_task(robot, task), strict=True):
            object.__setattr__(self, name, value)

    def value(self, q: npt.ArrayLike) -> float:
        """Return w(q)."""
        return float(np.prod(np.linalg.svd(self.task.jacobian(self.robot, q), compute_uv=False)))

    def gradient(self, q: npt.ArrayLike) -> Array:
        """Return ∂w/∂q, (nv,)."""
        return configuration_derivative(lambda x: np.array(self.value(x)), self.robot, q)


@dataclass(frozen=True, eq=False)
class JointRangeObjective(Frozen):
    """H = −1/(2n) Σ ((qᵢ − q̄ᵢ)/(q_M,ᵢ − q_m,ᵢ))²: joints near the middle of their ranges, over the n with limits.

    Attributes:
        robot: whose limits count.
        lower, upper: (nv,) other limits [rad or m]; None for those of the robot.

    Source: Liégeois, Automatic supervisory control of the configuration and behavior of multibody mechanisms, IEEE
    Trans. SMC 7, 1977; Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.5.1.
    """

    robot: Robot
    lower: npt.ArrayLike | None = None
    upper: npt.ArrayLike | None = None

    def __post_init__(self) -> None:
        """Refuse limits that are no ranges, and a robot without any."""
        object.__setattr__(self, "robot", robot_from(self.robot))
        self.robot.require_single_coordinates("have a middle of their ranges")
        for name in ("lower", "upper"):
            given = getattr(self, name)
            if given is not None:
                limits = real_array(name, given, (self.robot.nv,), "one number for each joint")
                object.__setattr__(self, name, limits)
        low, high = self._ends
        if not (high > low).all():
            raise InputError(f"each upper limit must be above the lower one; they are {low.tolist()}, {high.tolist()}")
        if self.robot.nv and not self._counts.any():
            raise InputError(f"no joint of robot {self.robot.name!r} has limits; give lower= and upper=")
        super().__post_init__()

    @property
    def _ends(self) -> tuple[Array, Array]:
        low = self.robot.lower if self.lower is None else np.asarray(self.lower, dtype=float)
        return low, self.robot.upper if self.upper is None else np.asarray(self.upper, dtype=float)

    @property
    def _counts(self) -> npt.NDArray[np.bool_]:
        return np.isfinite(self._ends[0]) & np.isfinite(self._ends[1])

    @property
    def _n(self) -> int:
        return max(1, int(np.count_nonzero(self._counts)))

    def value(self, q: npt.ArrayLike) -> float:
        """Return H(q)."""
        return -0.5 * float(np.sum(self._from_the_middle(q) ** 2)) / self._n

    def gradient(self, q: npt.ArrayLike) -> Array:
        """Return ∂H/∂q, (nv,): −(qᵢ − q̄ᵢ)/(n (q_M,ᵢ − q_m,ᵢ)²), and 0 for a joint without limits."""
        low, high = self._ends
        span = np.where(self._counts, high - low, 1.0)
        return np.asarray(-self._from_the_middle(q) / (span * self._n))

    def _from_the_middle(self, q: npt.ArrayLike) -> Array:
        """Return (q − q̄)/(q_M − q_m), and 0 without limits."""
        x, has = self.robot.configuration(q), self._counts
        low, high = (np.where(has, end, 0.0) for end in self._ends)
        return np.where(has, (x - 0.5 * (low + high)) / np.where(has, high - low, 1.0), 0.0)


@dataclass(frozen=True, eq=False)
class ObstacleObjective(Frozen):
    """H = min |p(q) − o|: how far the arm is from an obstacle [m], over the points p of its links.

    The links are taken as segments between the origins of the joints on the way to the tool; the tool's frame is last.
    The gradient is uᵀ J_p of the nearest point p, with u from the obstacle to it; of two that are as near, one counts.

    Attributes:
        robot: the arm.
        obstacle: (3,) o, in world axes [m].
        frame: a frame that alone counts, with its point; None for all links.
        point: (3,) a point of that frame, in its axes [m]; None for its origin.

    Source: Maciejewski, Klein, Obstacle avoidance for kinematically redundant manipulators, Int. J. Robotics Research
    4, 1985.
    """

    robot: Robot
    obstacle: npt.ArrayLike
    frame: str | None = None
    point: npt.ArrayLike | None = None

    def __post_init__(self) -> None:
        """Refuse what is no robot, no point, or no frame."""
        object.__setattr__(self, "robot", robot_from(self.robot))
        object.__setattr__(self, "obstacle", real_array("obstacle", self.obstacle, (3,), "in world axes [m]"))
        self.robot.frame_id(self.frame)
        if self.point is not None:
            if self.frame is None:
                raise InputError("a point needs its frame: give frame= too")
            object.__setattr__(self, "point", real_array("point", self.point, (3,), "in the axes of the frame [m]"))
        super().__post_init__()

    def value(self, q: npt.ArrayLike) -> float:
        """Return the distance [m]."""
        return float(np.linalg.norm(self._nearest(q).position - self._o))

    def gradient(self, q: npt.ArrayLike) -> Array:
        """Return ∂H/∂q, (nv,); 0 where the arm touches the obstacle, since no direction is away from it."""
        near = self._nearest(q)
        away = near.position - self._o
        distance = float(np.linalg.norm(away))
        if distance <= TOUCHES * self.robot.reach:
            return np.zeros(self.robot.nv)
        velocities = [
            share * frame_jacobian(self.robot, q, frame=frame, point=self.point)[:3] for frame, share in near.shares
        ]
        return np.asarray(away / distance @ np.sum(velocities, axis=0))

    @property
    def _o(self) -> Array:
        return np.asarray(self.obstacle, dtype=float)

    def _nearest(self, q: npt.ArrayLike) -> NearestPoint:
        """Return the nearest point of the arm."""
        if self.frame is not None:
            at = forward_kinematics(self.robot, q, frame=self.frame, point=self.point).translation
            return NearestPoint(np.array(at), ((self.frame, 1.0),))
        links = [joint.child for joint in self.robot.joints_to(None)]
        if not links:
            return NearestPoint(np.array(forward_kinematics(self.robot, q).translation), ((None, 1.0),))
        origins = [np.array(forward_kinematics(self.robot, q, frame=link).translation) for link in links]
        found = []
        for i, j in [*pairwise(range(len(links)))] or [(0, 0)]:
            along = origins[j] - origins[i]
            square = float(along @ along)
            share = float(np.clip((self._o - origins[i]) @ along / square, 0.0, 1.0)) if square > 0 else 0.0
            found.append(NearestPoint(origins[i] + share * along, ((links[i], 1 - share), (links[j], share))))
        return min(found, key=lambda point: float(np.linalg.norm(point.position - self._o)))


class NearestPoint(NamedTuple):
    """The nearest point of an arm: where it is, and the frames between whose origins it stands, with their shares.

    Its velocity has the same shares, also where a prismatic joint makes the segment longer.
    """

    position: Array
    shares: tuple[tuple[str | None, float], ...]


@dataclass(frozen=True, eq=False)
class NearObjective(Frozen):
    """H = −½ (q − q₀)ᵀ W (q − q₀): the joints stay near q₀.

    Attributes:
        q0: (n,) [rad or m].
        weights: (n,) not negative, the diagonal of W; None for 1.
    """

    q0: npt.ArrayLike
    weights: npt.ArrayLike | None = None

    def __post_init__(self) -> None:
        """Refuse what are no joints, and negative weights."""
        q0 = real_array("q0", self.q0, (None,), "one number for each joint")
        object.__setattr__(self, "q0", q0)
        w = np.ones(len(q0)) if self.weights is None else self.weights
        w = real_array("weights", w, (len(q0),), "one number for each joint")
        if (w < 0).any():
            raise InputError(f"weights must not be negative; they are {w.tolist()}")
        object.__setattr__(self, "weights", w)
        super().__post_init__()

    def value(self, q: npt.ArrayLike) -> float:
        """Return H(q)."""
        return 0.5 * float(self.gradient(q) @ (self._q(q) - np.asarray(self.q0)))

    def gradient(self, q: npt.ArrayLike) -> Array:
        """Return W (q₀ − q), (n,)."""
        return np.asarray(self.weights) * (np.asarray(self.q0) - self._q(q))

    def _q(self, q: npt.ArrayLike) -> Array:
        return moderate("q", real_array("q", q, np.shape(self.q0), "one number for each joint"))


@dataclass(frozen=True, eq=False)
class FunctionObjective:
    """H(q), a function of the user's own, with its gradient by central differences where it is not given.

    Attributes:
        robot: whose configuration q is.
        f: q → H.
        derivative: q → ∂H/∂q, (nv,); None for differences.
    """

    robot: Robot
    f: Callable[[Array], float]
    derivative: Callable[[Array], npt.ArrayLike] | None = None

    def __post_init__(self) -> None:
        """Refuse what is no robot and no function."""
        object.__setattr__(self, "robot", robot_from(self.robot))
        if not callable(self.f):
            raise InputError(f"f must be a function of q; it is {self.f!r}")

    def value(self, q: npt.ArrayLike) -> float:
        """Return H(q)."""
        return real_number("the objective", answer_of("the objective", self.f, self.robot.configuration(q)))

    def gradient(self, q: npt.ArrayLike) -> Array:
        """Return ∂H/∂q, (nv,)."""
        if self.derivative is None:
            return configuration_derivative(lambda x: np.array(self.value(x)), self.robot, q)
        slope: Any = answer_of("the derivative of the objective", self.derivative, self.robot.configuration(q))
        return real_array("the derivative of the objective", slope, (self.robot.nv,), "one number for each joint")
