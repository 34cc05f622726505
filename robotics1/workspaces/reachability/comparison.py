"""Two maps of the same poses: what either reaches, and what only one of them does."""

from dataclasses import replace

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.workspaces.reachability.evaluation import NOT_COUNTED, Codes, PoseStatus
from robotics1.workspaces.reachability.result import ReachabilityMap


def map_union(a: ReachabilityMap, b: ReachabilityMap) -> ReachabilityMap:
    """Return which poses a or b reaches: two tools that one arm changes between, or two arms in one cell.

    A pose has the solutions of both, and the better of their manipulabilities and limit margins. The configurations
    q are those of the better one, if both maps are of the same joints; else there are none, (k, 0).

    Raises:
        InputError: one is no map, or they are of different poses.
    """
    _refuse_different_poses(a, b)
    better = _number(b.manipulability) > _number(a.manipulability)
    one_arm = a.joint_names == b.joint_names
    return replace(
        a,
        robot=a.robot if a.robot == b.robot else f"{a.robot} or {b.robot}",
        joint_names=a.joint_names if one_arm else (),
        status=np.maximum(a.status, b.status),
        solutions=_sum(a.solutions, b.solutions),
        manipulability=np.fmax(a.manipulability, b.manipulability),
        limit_margin=np.fmax(a.limit_margin, b.limit_margin),
        q=np.where(better[:, None], b.q, a.q) if one_arm else np.zeros((len(a), 0)),
        orientation=np.where(better, b.orientation, a.orientation),
    )


def map_difference(a: ReachabilityMap, b: ReachabilityMap) -> ReachabilityMap:
    """Return which poses a reaches and b does not; of b that means proven out of reach, or not found.

    Of the poses that both reach the status is UNREACHABLE. The measures of a position are a's where the orientation
    they belong to is left; else NaN.

    Raises:
        InputError: one is no map, or they are of different poses.
    """
    _refuse_different_poses(a, b)
    status = np.where(b.reached, np.uint8(PoseStatus.UNREACHABLE), a.status)
    k = np.arange(len(a))
    kept = (a.orientation >= 0) & (status[k, a.orientation] == PoseStatus.REACHED)
    return replace(
        a,
        robot=f"{a.robot} without {b.robot}",
        status=status,
        solutions=None if a.solutions is None else np.where(b.reached, np.uint8(0), a.solutions),
        manipulability=np.where(kept, a.manipulability, np.nan),
        limit_margin=np.where(kept, a.limit_margin, np.nan),
        q=np.where(kept[:, None], a.q, np.nan),
        orientation=np.where(kept, a.orientation, np.int32(-1)),
    )


def _refuse_different_poses(a: ReachabilityMap, b: ReachabilityMap) -> None:
    for known in (a, b):
        if not isinstance(known, ReachabilityMap):
            raise InputError(f"a map is what reachability_map returns, not {known!r}")
    same = a.coordinates == b.coordinates and np.array_equal(a.positions, b.positions)
    if not (same and np.array_equal(a.orientations, b.orientations)):
        raise InputError("two maps are compared pose by pose: make them with the same positions and orientations")


def _number(values: Array) -> Array:
    return np.where(np.isnan(values), -1.0, values)


def _sum(a: Codes | None, b: Codes | None) -> Codes | None:
    if a is None or b is None:
        return None
    total = np.minimum(a.astype(int) + b, NOT_COUNTED - 1)
    return np.where((a == NOT_COUNTED) | (b == NOT_COUNTED), NOT_COUNTED, total).astype(np.uint8)
