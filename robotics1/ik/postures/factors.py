"""The factors of det J that name the postures of an arm: of its shoulder, its elbow, its reach and its wrist.

v_i is the velocity of a point c that joint i causes: z_i × (c − o_i), or z_i of a prismatic joint. If two joints move c
in a plane with the normal n, and a third joint k moves it too, then

    det [v_i v_j v_k] = [n · (v_i × v_j)] [n · v_k]        (the elbow, or the reach; and the shoulder)

and with a spherical wrist, c its centre, det J = det [v₁ v₂ v₃] · z₄ · (z₅ × z₆). Each factor belongs to an equation
with two solutions, such as A cos(q₁ − φ) = k, and has another sign at each, so that there is one solution for each
pattern of signs.

Source: Lee and Ziegler, A geometric approach in solving the inverse kinematics of PUMA robots, IEEE Trans. Aerospace
and Electronic Systems, 1984 (the indicators ARM, ELBOW, WRIST); Pieper, 1968.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.ik.joint_chain import FixedChain, JointLines
from robotics1.inputs import Array

SEEN_FROM = np.array([1.0, -1.0, 1.0])  # planes yz, xz and xy are seen from +x, −y and +z: up is y or z on paper
ROUNDED, EXACT = 1e-5, 1e-10  # sine of an angle that counts as 0; distance, beside the arm, of axes that meet
Quantity = Callable[[JointLines], Array]


@dataclass(frozen=True, eq=False)
class Factor:
    """One choice between two postures, by the sign of a quantity that vanishes at singularities only.

    Attributes:
        part: "shoulder", "elbow", "reach" or "wrist".
        positive, negative: the words for its signs.
        values: joint lines → (k,).
    """

    part: str
    positive: str
    negative: str
    values: Quantity


@dataclass(frozen=True, eq=False)
class Arm:
    """A chain at a few configurations, where it is asked which of its axes are parallel or meet."""

    chain: FixedChain
    lines: JointLines
    tolerance: float

    def turn(self, *joints: int) -> bool:
        """Whether all of these joints are revolute."""
        return not any(self.chain.prismatic[i] for i in joints)

    def parallel(self, i: int, j: int) -> bool:
        """Whether the axes of joints i and j are parallel everywhere."""
        return _are_parallel(self.lines.z[:, i], self.lines.z[:, j], self.tolerance)

    def meet(self, joints: Sequence[int]) -> bool:
        """Whether the axes of revolute joints go through one point, neighbours not being parallel."""
        z, o = self.lines.z[:, joints], self.lines.o[:, joints]
        apart = float(meeting_point(z, o)[1].max())
        turned = any(map(self.parallel, joints[1:], joints[:-1]))
        return self.turn(*joints) and not turned and apart < self.tolerance * (self.chain.length or 1.0)

    def planar(self, i: int, j: int) -> bool:
        """Whether joints i and j move points in one plane: parallel turns, slides across a turn, or two slides."""
        if self.turn(i, j):
            return self.parallel(i, j)
        if self.turn(i) or self.turn(j):
            return _are_perpendicular(self.lines.z[:, i], self.lines.z[:, j], self.tolerance)
        return not self.parallel(i, j)

    def normal(self, lines: JointLines, i: int, j: int) -> Array:
        """Return the normal (k, 3) of the plane in which joints i and j move points."""
        if self.turn(i) or self.turn(j):
            return lines.z[:, i if self.turn(i) else j]
        return np.cross(lines.z[:, i], lines.z[:, j])

    def crosses(self, k: int, i: int, j: int) -> bool:
        """Whether joint k moves points out of the plane of joints i and j."""
        n = self.normal(self.lines, i, j)
        return not (_are_parallel if self.turn(k) else _are_perpendicular)(self.lines.z[:, k], n, ROUNDED)


def posture_factors(chain: FixedChain, rows: Sequence[int], tolerance: float = ROUNDED) -> tuple[Factor, ...]:
    """Return the factors that name the postures of a chain; none where it has no such postures.

    Args:
        chain: of the joints that move the task.
        rows: which of (x, y, z, and the turns about them) the task has.
        tolerance: by how much axes may miss each other, or a parallel.
    """
    n = len(chain.prismatic)
    arm = Arm(chain, chain.lines(some_coordinates(chain, 4)), tolerance)
    if max(rows) < 3:
        return _of_a_point(arm, lambda lines: lines.p) if len(rows) == n else ()
    if n == 3:
        return _of_a_wrist(arm) if min(rows) >= 3 else _of_a_planar_pose(arm) if len(rows) == 3 else ()
    if n == 4:
        return _of_parallel_turns(arm)
    return _of_a_pose(arm) if n in (5, 6) and len(rows) == 6 else ()


def some_coordinates(chain: FixedChain, count: int) -> Array:
    """Return random coordinates (count, n) of a chain [rad or m]."""
    x = np.random.default_rng(0).uniform(-np.pi, np.pi, (count, len(chain.prismatic)))
    return np.where(chain.prismatic, x / np.pi * (chain.length or 1.0), x)


def _of_a_pose(arm: Arm) -> tuple[Factor, ...]:
    """Return the factors of three joints with a wrist, or of an arm with three parallel axes as UR arms have."""
    n = len(arm.chain.prismatic)
    wrist = list(range(3, n))
    if arm.meet(wrist):
        first = _of_a_point(arm, _crossing(wrist), joints=3)
        return (*first, _wrist(3)) if first and n == 6 else first
    if n == 6 and arm.turn(*range(6)) and arm.parallel(1, 2) and arm.parallel(2, 3) and arm.meet([4, 5]):
        shoulder, elbow = _third(arm, 0, (1, 2), _crossing([4, 5])), _pair(arm, 1, 2, _on(3))
        return (_shoulder(shoulder), _raised_elbow(elbow, shoulder), _wrist(3))
    return ()


def _of_a_point(arm: Arm, c: Quantity, joints: int | None = None) -> tuple[Factor, ...]:
    """Return the factors of two or three joints that move a point."""
    n = len(arm.chain.prismatic) if joints is None else joints
    if n == 2:
        return _flat(arm, 0, 1, c, ("up", "down")) if arm.planar(0, 1) else ()
    if n == 3 and arm.planar(1, 2) and arm.crosses(0, 1, 2):
        return _behind_a_first(arm, c)
    if n == 3 and arm.planar(0, 1) and not arm.turn(2) and arm.crosses(2, 0, 1):
        return _flat(arm, 0, 1, c, ("left", "right"))
    return ()


def _behind_a_first(arm: Arm, c: Quantity) -> tuple[Factor, ...]:
    """Return the factors of two joints that move a point in a plane, behind a first joint that crosses it."""
    if not arm.turn(0):
        return _flat(arm, 1, 2, c, ("up", "down"))
    shoulder = _third(arm, 0, (1, 2), c)
    if arm.turn(1, 2):
        return (_shoulder(shoulder), _raised_elbow(_pair(arm, 1, 2, c), shoulder))
    if arm.turn(1) or arm.turn(2):
        return (_shoulder(shoulder), *_flat(arm, 1, 2, c, ("", "")))
    outward = 1 if np.abs(np.cross(arm.lines.z[:, 0], arm.lines.z[:, 1])).max() > 0.5 else 2
    n, z = arm.normal(arm.lines, 1, 2), arm.lines.z
    side = float(np.sign(np.cross(n[0], z[0, 0]) @ z[0, outward]))
    return (_reach(lambda lines: -side * shoulder(lines)),)


def _of_a_wrist(arm: Arm) -> tuple[Factor, ...]:
    skew = not (arm.parallel(0, 1) or arm.parallel(1, 2))
    return (_wrist(0),) if arm.turn(0, 1, 2) and skew else ()


def _of_a_planar_pose(arm: Arm) -> tuple[Factor, ...]:
    """Return the factor of three joints in a plane: of the other two at the last joint that turns."""
    turning = [i for i in range(3) if arm.turn(i)]
    if not turning or not all(arm.planar(i, j) for i, j in ((0, 1), (1, 2), (0, 2))):
        return ()
    last = turning[-1]
    i, j = (k for k in range(3) if k != last)
    return _flat(arm, i, j, _on(last), ("up", "down"))


def _of_parallel_turns(arm: Arm) -> tuple[Factor, ...]:
    """Return the factor of a SCARA arm: three parallel turns, and a slide along them."""
    turning = [i for i in range(4) if arm.turn(i)]
    if len(turning) != 3 or not all(arm.parallel(turning[0], i) for i in range(4)):
        return ()
    i, j, last = turning
    return _flat(arm, i, j, _on(last), ("left", "right"))


def _flat(arm: Arm, i: int, j: int, c: Quantity, words: tuple[str, str]) -> tuple[Factor, ...]:
    """Return the factor of two joints in a plane that does not turn, seen so that its axes point right and up."""
    if arm.turn(i, j):
        n = arm.normal(arm.lines, i, j)[0]
        seen = float(np.sign((SEEN_FROM * n)[np.argmax(np.abs(n))]))
        pair = _pair(arm, i, j, c)
        return (Factor("elbow", *words, lambda lines: -seen * pair(lines)),)
    if not (arm.turn(i) or arm.turn(j)):
        return ()
    turn, slide = (i, j) if arm.turn(i) else (j, i)
    return (_reach(lambda lines: _dot(c(lines) - lines.o[:, turn], lines.z[:, slide])),)


def _pair(arm: Arm, i: int, j: int, c: Quantity) -> Quantity:
    """Return n · (v_i × v_j)."""

    def values(lines: JointLines) -> Array:
        at = c(lines)
        v_i, v_j = (np.cross(lines.z[:, k], at - lines.o[:, k]) for k in (i, j))
        return _dot(arm.normal(lines, i, j), np.cross(v_i, v_j))

    return values


def _third(arm: Arm, k: int, pair: tuple[int, int], c: Quantity) -> Quantity:
    """Return −n · v_k = (z_k × n) · (c − o_k), of a joint k that turns."""
    return lambda lines: _dot(np.cross(lines.z[:, k], arm.normal(lines, *pair)), c(lines) - lines.o[:, k])


def _shoulder(third: Quantity) -> Factor:
    return Factor("shoulder", "right", "left", third)


def _raised_elbow(pair: Quantity, third: Quantity) -> Factor:
    return Factor("elbow", "up", "down", lambda lines: -pair(lines) * third(lines))


def _reach(values: Quantity) -> Factor:
    return Factor("reach", "forward", "backward", values)


def _wrist(first: int) -> Factor:
    """Return the factor of three turns: (z₄ × z₆) · z₅ = sin q₅, if q₅ = 0 is where axes 4 and 6 point the same way."""
    return Factor(
        "wrist",
        "not flipped",
        "flipped",
        lambda lines: _dot(np.cross(lines.z[:, first], lines.z[:, first + 2]), lines.z[:, first + 1]),
    )


def _crossing(joints: Sequence[int]) -> Quantity:
    """Return the point in which the axes of joints meet."""
    return lambda lines: meeting_point(lines.z[:, joints], lines.o[:, joints])[0]


def _on(joint: int) -> Quantity:
    """Return a point on the axis of a joint."""
    return lambda lines: lines.o[:, joint]


def meeting_point(z: Array, o: Array) -> tuple[Array, Array]:
    """Return the point next to several lines, (k, 3), and its distance from the farthest of them, (k,).

    Args:
        z: (k, j, 3) unit directions.
        o: (k, j, 3) a point on each [m].
    """
    across = np.eye(3) - z[..., :, None] * z[..., None, :]
    A, b = across.sum(axis=1), (across @ o[..., None])[..., 0].sum(axis=1)
    c = (np.linalg.pinv(A, rcond=1e-9) @ b[..., None])[..., 0]
    apart = np.linalg.norm((across @ (c[:, None] - o)[..., None])[..., 0], axis=2)
    return c, apart.max(axis=1)


def _are_parallel(a: Array, b: Array, tolerance: float) -> bool:
    """Whether unit vectors (k, 3) are parallel or opposite at all k configurations."""
    return bool(np.linalg.norm(np.cross(a, b), axis=1).max() < tolerance)


def _are_perpendicular(a: Array, b: Array, tolerance: float) -> bool:
    """Whether unit vectors (k, 3) are perpendicular at all k configurations."""
    return bool(np.abs(_dot(a, b)).max() < tolerance)


def _dot(a: Array, b: Array) -> Array:
    return np.asarray((a * b).sum(axis=-1))
