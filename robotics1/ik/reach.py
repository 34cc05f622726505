"""How far a chain can reach at most: what proves a target out of reach."""

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays


def excess(chain: ChainArrays, limits: Array, counted: Array, goal: Array) -> float:
    """Return by how much a goal, (4, 4), is farther than the chain can reach; negative if that proves nothing.

    No configuration reaches a point farther from the origin o of the first joint than the sum of the distances from
    joint to joint, with the travel of prismatic joints:  |p_d − o| ≤ Σ |pᵢ| + Σ max |qᵢ|. Of a full pose the origin
    of the last joint is known too, if that joint turns, and takes the place of p_d. Of coordinates that do not count
    nothing is known, so just the others enter |p_d − o|.

    Args:
        chain: its constants.
        limits: (3, n): lower and upper limits of each coordinate, and whether it needs none.
        counted: (6,) 1 for the rows of the pose error that count.
        goal: (4, 4), lengths in the units of the chain.
    """
    if not len(chain.coordinate):
        return -np.inf
    steps = np.linalg.norm(chain.placements[1:, :, 3], axis=1)
    travel = chain.ratio * np.abs(limits[:2, chain.coordinate]).max(axis=0)
    point = goal[:3, 3]
    if counted.all() and not chain.prismatic[-1]:
        R, p = chain.placements[-1, :, :3], chain.placements[-1, :, 3]
        point = point - goal[:3, :3] @ R.T @ p
        steps = steps[:-1]
    distance = (point - chain.placements[0, :, 3]) * counted[:3]
    return float(np.linalg.norm(distance) - steps.sum() - travel[chain.prismatic == 1].sum())
