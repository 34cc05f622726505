"""Arms with fewer joints than their task has rows: joints are added, and must stand still.

An arm with n joints reaches only some of the poses. With 6 − n joints added at its tool it has finitely many solutions
at each pose, and those in which the added joints are at 0 are its own. The added axes meet in a point of the last own
axis, so that they make a spherical wrist with it wherever they can.
"""

from collections.abc import Sequence
from itertools import pairwise, product

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from robotics1.ik.general_six import Roots
from robotics1.ik.joint_chain import FixedChain, JointLines, chain_and_rows
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.structure import ClosedForm, closed_form
from robotics1.ik.subproblems import inverse
from robotics1.inputs import Array

STILL = 1e-3  # coordinate of an added joint, lengths relative to the arm, that may be 0 but for rounding
PLACES = 3  # of added joints; where rounding hides a solution with some, it does not with others
# Of added axes: no arm has them by design.
DIRECTIONS = Rotation.random(5 * PLACES, rng=np.random.default_rng(1)).as_matrix().reshape(PLACES, 5, 3, 3)
VERIFIED = 1e-9  # what a solution of the longer arm may miss, relative
REGULAR = 1e-6  # σ_min/σ_max at one of these configurations
SAMPLES = 3
PARALLEL = 1e-9  # sine of the angle between axes


def way_to_all_solutions(problem: ScaledTask) -> ClosedForm | None:
    """Return the way to all solutions of a task with as many rows as joints that move it, or more; None if unknown."""
    chain, rows = chain_and_rows(problem)
    if chain is None:
        return None
    missing = len(rows) - len(chain.prismatic)
    if missing <= 0:
        return closed_form(chain, rows) if missing == 0 else None
    squares = []
    for place, together in product(range(PLACES), (True, False)):
        longer = _longer(chain, _added(chain, rows, missing, place, together), slides=max(rows) < 3)
        square = closed_form(longer, rows) if _is_regular(longer, rows, missing) else None
        if square is not None and square.roots is None:
            return _of_own_joints([square], chain, rows)
        squares += [square] if square is not None else []
    return _of_own_joints(squares, chain, rows) if squares else None


def _added(chain: FixedChain, rows: Sequence[int], count: int, place: int, together: bool) -> list[Array]:
    """Return where added joints are in the frame of the tool; they turn about, or slide along, their z axes.

    Together, one or two meet the last own axis, and of three or more the last three meet in a point beside it. So they
    make a wrist that is spherical, which a planar arm cannot bear: there they are apart.
    """
    axes = chain.lines(np.zeros((1, len(chain.prismatic))))
    tool = axes.T[0]
    places = np.tile(np.eye(4), (count, 1, 1))
    places[:, :3, :3] = DIRECTIONS[place, :count]
    places[:, :3, 3] = (inverse(tool) @ [*_meeting_point(chain, axes), 1.0])[:3]
    beside = (chain.length or 1.0) * DIRECTIONS[place, :count, :, 0]
    if min(rows) < 3 <= max(rows) and len(rows) == 3:  # a planar pose: added axes are normal to the plane
        normal = tool[:3, :3].T @ np.eye(3)[rows[2] - 3]
        places[:, :3, :3] = Rotation.align_vectors([normal], [[0.0, 0.0, 1.0]])[0].as_matrix()
        places[:, :3, 3] += beside - np.outer(beside @ normal, normal)
    elif count > 2 or not together:
        beside[-3:] = beside[-1] if together else beside[-3:]
        places[:, :3, 3] += beside
    return list(places)


def _is_regular(longer: FixedChain, rows: Sequence[int], added: int) -> bool:
    """Whether the longer arm is not singular where the added joints stand still."""
    n = len(longer.prismatic) - added
    unit = longer.length or 1.0
    units = np.where(longer.prismatic, unit, 1.0)
    x = np.random.default_rng(0).uniform(-1, 1, (SAMPLES, n + added)) * ([1.0] * n + [0.0] * added)
    J = longer.poses_and_jacobians(x * units)[1][:, list(rows)]
    J[:, [i for i, row in enumerate(rows) if row < 3]] /= unit
    sigma = np.linalg.svd(J * units, compute_uv=False)
    return bool((sigma[:, -1] > REGULAR * sigma[:, 0]).any())


def _meeting_point(chain: FixedChain, axes: JointLines) -> Array:
    """Return the point of the last axis that is nearest to the axis before; the tool where there are no such axes."""
    if chain.prismatic[-1]:
        return np.asarray(axes.p[0])
    point, axis = axes.o[0, -1], axes.z[0, -1]
    if len(chain.prismatic) == 1 or chain.prismatic[-2]:
        return np.asarray(point)
    other, direction = axes.o[0, -2], axes.z[0, -2]
    normal = np.cross(direction, np.cross(axis, direction))
    if axis @ normal < PARALLEL**2:
        return np.asarray(point)
    return np.asarray(point + axis * ((other - point) @ normal) / (axis @ normal))


def _longer(chain: FixedChain, added: Sequence[Array], slides: bool) -> FixedChain:
    """Return the chain with joints added to its tool, which stays where it is as long as they stand at 0."""
    between = [inverse(before) @ place for before, place in pairwise(added)]
    P = (*chain.P[:-1], chain.P[-1] @ added[0], *between, inverse(added[-1]))
    length = chain.length + sum(float(np.linalg.norm(A[:3, 3])) for A in added)
    n = len(added)
    return FixedChain(P, (*chain.prismatic, *[slides] * n), (*chain.coordinate, *[-1] * n), length)


def _of_own_joints(squares: Sequence[ClosedForm], chain: FixedChain, rows: Sequence[int]) -> ClosedForm:
    """Return the solutions in which the added joints stand still, of the first of longer arms that is sure of all."""
    n = len(chain.prismatic)
    first = squares[0]

    def roots(goal: Array) -> Roots | None:
        some = None
        for square in squares:
            found = square.candidates(goal)
            if found is None:
                continue
            longer = square.chain
            x = longer.polished(found.x, goal, rows)[0]
            missed = np.abs(longer.poses_and_jacobians(x[found.real])[0] - goal).max(initial=0.0)
            proven = found.proven and missed <= VERIFIED * max(1.0, float(np.abs(goal).max()), longer.length)
            own = x[_still(longer, x, goal, n), :n]
            some = Roots(own, np.zeros(len(own), dtype=bool), bool(proven))
            if proven:
                break
        return some

    joints = "a joint" if len(first.chain.prismatic) == n + 1 else f"{len(first.chain.prismatic) - n} joints"
    method = f"{first.method}, with {joints} added"
    return ClosedForm(method, chain, first.deviation, None, roots=roots)


def _still(longer: FixedChain, x: Array, goal: Array, n: int) -> npt.NDArray[np.bool_]:
    """Return in which solutions (k, ...) all joints after the first n stand at 0."""
    added = np.where(longer.prismatic[n:], x[:, n:] / longer.unit(goal), np.sin(0.5 * x[:, n:]))
    return np.asarray(np.abs(added).max(axis=1, initial=0.0) < STILL)
