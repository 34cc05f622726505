"""The pose and the Jacobian of a frame, put together from the middle of the chain.

Seen from a link in the middle, and with its origin as the point, each column of J depends only on the joints between
its own and the middle one, which keeps it short. From there the point is moved by p to the frame, v + ω × p, and one
rotation turns to the axes that are asked for. Neither changes the rank nor the null space of J nor, for whole rows,
its minors.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from sys import maxsize

import numpy as np
import sympy

from robotics1.inputs import Array
from robotics1.orientation.elementary import cross_matrix
from robotics1.robot.joints import Joint
from robotics1.symbolic.kinematics.chain import Chain, Pose
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial
from robotics1.symbolic.writing.term_budget import TermBudget

Joints = tuple[Joint, ...]
TWIST = ("x", "y", "z", "ωx", "ωy", "ωz")
WHOLE = (TWIST, TWIST[:3], TWIST[3:])


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
        return all(isinstance(entry, TrigPolynomial) for M in (self.p, self.R, self.J) for entry in M.flat)


@dataclass(frozen=True, eq=False)
class MidChainJacobian:
    """J = X M, with M shorter.

    Attributes:
        M: (m, n) the Jacobian in the axes and, of six rows, at the origin of a link in the middle.
        X: (m, m) leads velocities back to the task's own axes and point; None where M is J itself.
        X_force: (m, m) X⁻ᵀ, which leads forces back: the power uᵀ M q̇ stays what it is.
        leads_back: whether X is known; not of a task with quotients, whose rows are combinations of these.
    """

    M: Matrix
    X: Matrix | None = None
    X_force: Matrix | None = None
    leads_back: bool = True

    def velocity(self, u: Matrix) -> Matrix:
        """Return X u, a task velocity (m,)."""
        return u if self.X is None else np.asarray(self.X @ u)

    def force(self, u: Matrix) -> Matrix:
        """Return X⁻ᵀ u, a force (m,)."""
        return u if self.X_force is None else np.asarray(self.X_force @ u)

    def numbers(self, q: Array, parameters: Mapping[sympy.Symbol, float]) -> Array:
        """Return X M at q (n,), (m, n)."""
        at = np.vectorize(lambda f: Evaluated(f, parameters)(q), otypes=[float])
        return np.asarray(at(self.M) if self.X is None else at(self.X) @ at(self.M))


def mid_chain_jacobian(chain: Chain, row_names: tuple[str, ...], J: Matrix, budget: TermBudget) -> MidChainJacobian:
    """Return the shorter form of J, of these rows in world axes, in polynomials of any length; J itself if its rows
    are not whole.
    """
    if row_names not in WHOLE or all(joint.kind == "fixed" for joint in chain.joints):
        return MidChainJacobian(J)
    exact = replace(budget, most_products=maxsize, most_terms=maxsize)
    links = _links_from_the_middle(chain, exact)
    M = _jacobian_at_the_middle(chain, links, exact)
    R, p = links[0][0].T, links[-1][1]
    if row_names == TWIST:
        zero, moment = R - R, -R @ cross_matrix(p)  # v of the point is R (v + ω × p)
        return MidChainJacobian(M, np.block([[R, moment], [zero, R]]), np.block([[R, zero], [moment, R]]))
    return MidChainJacobian(exact.sum(M[:3], exact.cross(M[3:], p)) if row_names == TWIST[:3] else M[3:], R, R)


def frame_motion(chain: Chain, reference: Joints, budget: TermBudget) -> FrameMotion:
    """Return the motion of the chain's frame, in the axes of the link that the joints of `reference` lead to."""
    product, plus = budget.product, budget.sum
    links = _links_from_the_middle(chain, budget)
    (_, p_world), (R_frame, p_frame) = links[0], links[-1]
    M = _jacobian_at_the_middle(chain, links, budget)
    v, w = plus(M[:3], budget.cross(M[3:], p_frame)), M[3:]

    same = [a.name == b.name for a, b in zip(chain.joints, reference, strict=False)]
    shared = same.index(False) if False in same else len(same)
    A = links[shared][0].T  # the axes of the middle, seen from the last link that is shared
    R = chain.turn(chain.joints[shared:]) if shared > len(chain.joints) // 2 else product(A, R_frame)
    if shared < len(reference):
        back = chain.turn(reference[shared:]).T
        A, R = product(back, A), product(back, R)
    p = plus(product(A, -p_world), product(A, p_frame))
    return FrameMotion(p, R, np.vstack([product(A, v), product(A, w)]))


def _links_from_the_middle(chain: Chain, budget: TermBudget) -> list[Pose]:
    """Return the pose of the world and of the link behind each joint, seen from the link behind the middle joint."""
    moving = [i for i, joint in enumerate(chain.joints) if joint.kind != "fixed"] or [len(chain.joints) - 1]
    middle = moving[len(moving) // 2] + 1
    product, plus = budget.product, budget.sum
    steps = [chain.step(joint) for joint in chain.joints]
    links: list[Pose] = [chain.still]
    for R_step, p_step in steps[middle:]:
        R, p = links[-1]
        links.append((product(R, R_step), plus(p, product(R, p_step))))
    for R_step, p_step in reversed(steps[:middle]):
        R, p = links[0]
        R = product(R, R_step.T)
        links.insert(0, (R, plus(p, -product(R, p_step))))
    return links


def _jacobian_at_the_middle(chain: Chain, links: list[Pose], budget: TermBudget) -> Matrix:
    """Return J (6, n) of the point of the last link that is at the origin of the middle one, in its axes."""
    zero = budget.trig_ring.constant(0)
    J = np.array([[zero] * len(chain.q) for _ in range(6)], dtype=object)
    for joint, (R, _), (_, p) in zip(chain.joints, links[:-1], links[1:], strict=True):
        if joint.kind == "fixed":
            continue
        i = chain.robot.joint_names.index(joint.leader)
        axis = budget.product(R, chain.velocity(joint)[:, None])
        if joint.kind == "prismatic":
            J[:3, [i]] = budget.sum(J[:3, [i]], axis)
        else:
            J[:, [i]] = budget.sum(J[:, [i]], np.vstack([budget.cross(-axis, p), axis]))
    return J
