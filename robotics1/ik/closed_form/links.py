"""The links between moving joints: how a vector goes from one to the next, and the points that stay on an axis.

Link i is behind joint i, with the frame of that joint after it has moved; link 0 is the world. A point on the axis of
joint i is fixed in links i − 1 and i; where two axes meet, the point is fixed in three links. That is what makes the
joints of a spherical wrist disappear from an equation.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from robotics1.symbolic.kinematics.chain import Chain, Pose, cross
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial


@dataclass(frozen=True, eq=False)
class Step:
    """The way from link i − 1 over joint i to link i.

    Attributes:
        R, p: the placement of the joint in link i − 1.
        turn, slide: its motion.
        axis: (3,) the unit axis, in the frame of the joint.
        turns: whether it is revolute.
    """

    R: Matrix
    p: Matrix
    turn: Matrix
    slide: Matrix
    axis: Matrix
    turns: bool

    def point(self, v: Matrix) -> Matrix:
        """Return a point of link i in link i − 1."""
        return np.asarray(self.p + self.R @ (self.slide + self.turn @ v))

    def direction(self, v: Matrix) -> Matrix:
        """Return directions of link i, (3,) or (3, k), in link i − 1."""
        return np.asarray(self.R @ (self.turn @ v))

    def point_behind(self, v: Matrix) -> Matrix:
        """Return a point of link i − 1 in link i."""
        return np.asarray(self.turn.T @ (self.R.T @ (v - self.p) - self.slide))

    def direction_behind(self, v: Matrix) -> Matrix:
        """Return directions of link i − 1 in link i."""
        return np.asarray(self.turn.T @ (self.R.T @ v))


@dataclass(frozen=True, eq=False)
class Links:
    """The links of a chain.

    Attributes:
        steps: the way over each moving joint; step i − 1 leads to link i.
        tool: R and p of the frame in the last link.
        points: of each link, points on the axes before and behind it.
    """

    steps: tuple[Step, ...]
    tool: Pose
    points: tuple[tuple[Matrix, ...], ...]

    @property
    def pose(self) -> Pose:
        """R and p of the frame in the world."""
        R, p = self.tool
        for step in reversed(self.steps):
            R, p = step.direction(R), step.point(p)
        return R, p


def links_of(chain: Chain, axes: Matrix | None = None) -> Links:
    """Return the links of a chain; `axes` is the constant rotation Rᵀ to the axes that are meant."""
    R, p = chain.still
    if axes is not None:
        R = axes
    steps = []
    for joint in chain.joints:
        R_joint, p_joint = chain.placement(joint)
        R, p = R @ R_joint, p + R @ p_joint
        if joint.kind != "fixed":
            axis = chain._vector(np.array(joint.axis))
            steps.append(Step(R, p, *chain.motion(joint), axis, joint.kind == "revolute"))
            R, p = chain.still
    points = tuple(_points(chain, steps, i, p) for i in range(len(steps) + 1))
    return Links(tuple(steps), (R, p), points)


def with_the_frame_as_a_link(chain: Chain, links: Links) -> Links:
    """Return the links with the frame itself as the last: a target may give an axis of the frame, and no other."""
    (R, p), (one, origin) = links.tool, chain.still
    step = Step(R, p, one, origin, one[:, 2], turns=False)
    behind = [step.point_behind(point) for point in links.points[-1]]
    return Links((*links.steps, step), chain.still, (*links.points, (origin, *behind)))


def from_the_first_joint(chain: Chain, links: Links) -> Links:
    """Return the links with the placement of the first joint as link 0."""
    first, (one, origin) = links.steps[0], chain.still
    steps = (replace(first, R=one, p=origin), *links.steps[1:])
    points = tuple(np.asarray(first.R.T @ (point - first.p)) for point in links.points[0])
    return Links(steps, links.tool, (points, *links.points[1:]))


def _points(chain: Chain, steps: list[Step], i: int, tool: Matrix) -> tuple[Matrix, ...]:
    """Return points of link i on the axes of joints i and i + 1: feet of common normals, and the joints' origins."""
    origin = chain.still[1]
    found: list[Matrix] = []
    if i > 0:
        found += [foot for j in (i, i - 1) if (foot := _foot_on(chain, steps, i, j)) is not None]
    if i < len(steps):
        own = [foot for j in (i, i + 1) if (foot := _foot_on(chain, steps, i + 1, j)) is not None]
        step = steps[i]
        found += [step.p + step.R @ foot for foot in own]
        found.append(step.p)
    found.append(origin)
    distinct: list[Matrix] = []
    for point in found:
        if all(any(point - other) for other in distinct):
            distinct.append(point)
    return tuple(distinct)


def _foot_on(chain: Chain, steps: list[Step], i: int, link: int) -> Matrix | None:
    """Return the foot, on axis i, of the common normal with the next axis in a link, in the frame of joint i.

    The link is i − 1 or i: the other axis is that of joint i − 1, or of i + 1.
    """
    if not 0 < link < len(steps) or not (steps[link - 1].turns and steps[link].turns):
        return None
    before, behind = steps[link - 1], steps[link]  # the joints at both ends of the link
    lines = (chain.still[1], before.axis), (behind.p, behind.R @ behind.axis)
    (a, n), (b, m) = lines if link == i else lines[::-1]
    normal = cross(n, m)
    square: Any = normal @ normal
    inverse = _inverse(chain, square)
    if inverse is None:
        return None
    along = (cross(b - a, m) @ normal) * inverse
    return np.asarray(steps[i - 1].axis * along)


def _inverse(chain: Chain, f: TrigPolynomial) -> TrigPolynomial | None:
    """Return 1/f of a rational number; None of anything else."""
    F = chain.trig_ring
    if set(f.terms) != {F.zero} or not f.terms[F.zero].is_ground:
        return None
    number = f.terms[F.zero].LC
    return F.constant(F.ring(F.ring.domain.one / number))
