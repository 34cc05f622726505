"""The pose and the Jacobian of a frame, put together from the middle of the chain.

Seen from a link in the middle, and with its origin as the point, each column of J depends only on the joints between.
From there the point is moved by p to the frame, v + ω × p, and one rotation turns to the axes that are asked for.
"""

from dataclasses import dataclass, replace

import numpy as np

from robotics1.symbolic.kinematics.chain import Chain, Pose
from robotics1.symbolic.kinematics.parameters import JointNumbers
from robotics1.symbolic.polynomials.laurent import Laurent, Matrix
from robotics1.symbolic.writing.composition import Composition

Joints = tuple[JointNumbers, ...]


@dataclass(frozen=True, eq=False)
class FrameMotion:
    """A frame in the axes of a reference; each entry is a polynomial, or an expression where that would be long.

    Attributes:
        p: (3,) its position.
        R: (3, 3) its axes.
        J: (6, n) its Jacobian.
    """

    p: Matrix
    R: Matrix
    J: Matrix

    @property
    def is_polynomial(self) -> bool:
        """Whether no entry was too long."""
        return all(isinstance(entry, Laurent) for M in (self.p, self.R, self.J) for entry in M.flat)


def frame_motion(chain: Chain, reference: Joints, composition: Composition) -> FrameMotion:
    """Return the motion of the chain's frame, in the axes of the link that the joints of `reference` lead to."""
    product, plus = composition.product, composition.sum
    links = _links_from_the_middle(chain, composition)
    (_, p_world), (R_frame, p_frame) = links[0], links[-1]
    M = _jacobian_at_the_middle(chain, links, composition)
    v, w = plus(M[:3], composition.cross(M[3:], p_frame)), M[3:]

    shared = _shared(chain.joints, reference)
    A = links[shared][0].T  # the axes of the middle, seen from the last link that is shared
    R = _turn(chain, chain.joints[shared:]) if shared > len(chain.joints) // 2 else product(A, R_frame)
    if shared < len(reference):
        back = _turn(chain, reference[shared:]).T
        A, R = product(back, A), product(back, R)
    p = plus(product(A, -p_world), product(A, p_frame))
    return FrameMotion(p, R, np.vstack([product(A, v), product(A, w)]))


def _links_from_the_middle(chain: Chain, composition: Composition) -> list[Pose]:
    """Return the pose of the world and of the link behind each joint, seen from the link behind the middle joint."""
    moving = [i for i, joint in enumerate(chain.joints) if joint.kind != "fixed"] or [len(chain.joints) - 1]
    middle = moving[len(moving) // 2] + 1
    product, plus = composition.product, composition.sum
    steps = [_part(chain, (joint,)).poses[-1] for joint in chain.joints]
    links: list[Pose] = [chain.still]
    for R_step, p_step in steps[middle:]:
        R, p = links[-1]
        links.append((product(R, R_step), plus(p, product(R, p_step))))
    for R_step, p_step in reversed(steps[:middle]):
        R, p = links[0]
        R = product(R, R_step.T)
        links.insert(0, (R, plus(p, -product(R, p_step))))
    return links


def _jacobian_at_the_middle(chain: Chain, links: list[Pose], composition: Composition) -> Matrix:
    """Return J (6, n) of the point of the last link that is at the origin of the middle one, in its axes."""
    zero = composition.frequencies.constant(0)
    J = np.array([[zero] * len(chain.q) for _ in range(6)], dtype=object)
    for joint, (R, _), (_, p) in zip(chain.joints, links[:-1], links[1:], strict=True):
        if joint.kind == "fixed":
            continue
        i = chain.robot.joint_names.index(joint.leader)
        own = _part(chain, (joint,)).jacobian[:, [i]]
        v, w = composition.product(R, own[:3]), composition.product(R, own[3:])
        v = composition.sum(v, composition.cross(-w, p))
        J[:, [i]] = composition.sum(J[:, [i]], np.vstack([v, w]))
    return J


def _shared(joints: Joints, others: Joints) -> int:
    """Return how many joints two chains have in common."""
    same = [a.name == b.name for a, b in zip(joints, others, strict=False)]
    return same.index(False) if False in same else len(same)


def _turn(chain: Chain, joints: Joints) -> Matrix:
    return _part(chain, joints).poses[-1][0]


def _part(chain: Chain, joints: Joints) -> Chain:
    return replace(chain, joints=joints, base=chain.base or chain)
