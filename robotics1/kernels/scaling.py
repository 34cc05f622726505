"""An arm and a goal with lengths in units of about the arm, so that rounding is the same for small and large arms."""

import math

from robotics1.inputs import Array
from robotics1.kernels.compilation import compiled
from robotics1.kernels.inverse import in_units, is_pose


@compiled(contract=True, inner=True)
def scaled_links(links: Array, unit: float, scaled: Array) -> None:
    """Write links with lengths in units."""
    for i in range(len(links)):
        for j in range(links.shape[1]):
            scaled[i, j] = links[i, j] / unit if j < 12 and j % 4 == 3 else links[i, j]


@compiled(contract=True, inner=True)
def unit_of(links: Array, goal: Array, length: float) -> float:
    """Return what counts as one length: that of the arm and of the way to the goal."""
    x, y, z = goal[0, 3] - links[0, 3], goal[1, 3] - links[0, 7], goal[2, 3] - links[0, 11]
    unit = length + math.sqrt(x * x + y * y + z * z)
    return unit if unit > 0.0 else 1.0


@compiled(contract=True, inner=True)
def in_own_units(links: Array, target: Array, length: float, scaled: Array, goal: Array) -> float:
    """Write links and target with lengths in units to scaled and goal; return the unit [m], 0 for what is no pose."""
    if not is_pose(target):
        return 0.0
    unit = unit_of(links, target, length)
    scaled_links(links, unit, scaled)
    in_units(target, unit, goal)
    return unit
