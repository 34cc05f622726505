"""A box in the world around what is reached."""

from itertools import product

import numpy as np

from robotics1.inputs import Array

ROOM = 0.02  # of the box's size, beyond what is known to be reached


def corners_of_box(z: Array, heights: tuple[float, float] | None, frame: Array, origin: Array) -> Array:
    """Return the corners (8, 3) of a box around a section [m].

    Args:
        z: (k, 2) points of the section's boundary: (ρ, h) where no heights are given, else the first two coordinates.
        heights: the range of the third coordinate.
        frame, origin: p = frame (P − origin), with the axis of the turn, or of the slide, as the last row.
    """
    if heights is None:
        far = float(np.abs(z[:, 0]).max())
        low, high = np.array([-far, -far, z[:, 1].min()]), np.array([far, far, z[:, 1].max()])
    else:
        low, high = np.array([*z.min(axis=0), heights[0]]), np.array([*z.max(axis=0), heights[1]])
    room = ROOM * float((high - low).max())
    ends = np.array([low - room, high + room])
    return np.array([[ends[i, k] for k, i in enumerate(pick)] for pick in product((0, 1), repeat=3)]) @ frame + origin
