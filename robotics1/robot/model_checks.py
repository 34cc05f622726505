"""The numbers of a model of Pinocchio, checked: nothing has read its file before, and Pinocchio takes any."""

import re

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError
from robotics1.robot.checking import MOST_DEGREES, MOST_LINKS
from robotics1.robot.findings import LARGEST
from robotics1.robot.placements import ROTATION_TOLERANCE

NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")  # characters that no URDF can hold


def check_model(model: pin.Model) -> None:
    """Check size, names and placements of a model.

    Raises:
        InputError: there is no joint, or more than can be computed with; a name is empty, or none that a file can
            hold; a placement is not finite, is too large, or has no rotation.
    """
    if not model.njoints > 1:
        raise InputError("the model has no joints")
    if model.nv > MOST_DEGREES or model.njoints > MOST_LINKS:
        most = f"at most {MOST_DEGREES} and {MOST_LINKS} can be computed with"
        raise InputError(f"the model has {model.nv} degrees of freedom and {model.njoints} joints; {most}")
    placements = [(f"joint {name!r}", T) for name, T in zip(model.names, model.jointPlacements, strict=True)]
    for what, T in [*placements, *((f"frame {frame.name!r}", frame.placement) for frame in model.frames)]:
        _check_placement(what, T)
    for name in (*model.names, *(frame.name for frame in model.frames)):
        if not name.strip() or NO_XML.search(name):
            raise InputError(f"a joint or a frame of the model is called {name!r}, which can be no name in a file")


def check_limits(name: str, lower: float, upper: float, velocity: float, effort: float) -> None:
    """Check the limits of a joint.

    Raises:
        InputError: lower is above upper, or one of the others is negative; or one is no number.
    """
    if not lower <= upper:
        numbers = f"they are {lower:g} and {upper:g}"
        raise InputError(f"the limits of joint {name!r} of the model must have lower ≤ upper; {numbers}")
    if not (velocity >= 0 and effort >= 0):
        numbers = f"they are {velocity:g} and {effort:g}"
        raise InputError(f"velocity and effort of joint {name!r} of the model must have limits ≥ 0; {numbers}")


def _check_placement(what: str, T: pin.SE3) -> None:
    numbers, R = np.array(T.homogeneous), np.array(T.rotation)
    if not np.abs(numbers).max() <= LARGEST:
        place = f"is placed at {numbers[:3, 3].tolist()}"
        raise InputError(f"{what} of the model {place}; at most {LARGEST:g} can be computed with")
    if np.abs(R.T @ R - np.eye(3)).max() > ROTATION_TOLERANCE or np.linalg.det(R) < 0:
        raise InputError(f"the placement of {what} of the model has no rotation: its columns must be orthonormal")
