"""Starts of a batch: one for all of its targets, or one for each."""

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, dimensions, real_array
from robotics1.robot.model import Robot


def starts_of_all(robot: Robot, q0: npt.ArrayLike, k: int) -> Array:
    """Return the starts of k targets, (k, nq), of q0 for all of them, (nq,), or for each.

    Raises:
        InputError: it is neither, or not finite.
    """
    if dimensions("q0", q0) < 2:
        return np.tile(robot.configuration(q0, "q0"), (k, 1))
    return real_array("q0", q0, (k, robot.nq), "one start for each target")
