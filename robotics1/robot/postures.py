"""Configurations as people write them: by the names of the joints, or by the name of a posture."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError, RobotFileError, UnknownNameError
from robotics1.inputs import Array, real_number
from robotics1.robot.markup import Element, parse_xml
from robotics1.robot.sources import robot_text


def in_numbers(
    name: str, values: str | Mapping[Any, Any], joints: Sequence[str], postures: Mapping[str, Array]
) -> Array:
    """Return q, (n,), of a posture's name, or of a mapping joint → value [rad or m].

    Raises:
        UnknownNameError: there is no such posture or joint.
        InputError: a joint has no value, or one that is no number.
    """
    if isinstance(values, str):
        if values not in postures:
            raise UnknownNameError("posture named", values, postures, "; numbers stand in a list, as [0.1, 0.2]")
        return np.array(postures[values])
    for joint in values:
        if joint not in joints:
            raise UnknownNameError(f"joint in {name} named", joint, joints)
    missing = [joint for joint in joints if joint not in values]
    if missing:
        raise InputError(f"{name} has no value for {', '.join(missing)}; give one for each joint")
    return np.array([real_number(f"{name} of joint {joint!r}", values[joint]) for joint in joints])


def named_postures(path: Path, joints: Sequence[str], lower: Array, upper: Array) -> dict[str, Array]:
    """Return posture → q, (n,): "zero", moved inside the limits, and those of an SRDF beside the robot's file.

    An SRDF is in the folder of the file or in its sibling `srdf/`, and has the name of the file, or that without
    `_robot`. A joint that a posture leaves out stays at zero.
    """
    zero = np.clip(np.zeros(len(joints)), lower, upper)
    found: dict[str, Array] = {"zero": zero}
    for root in _srdf(path):
        for state in root.iterfind("group_state"):
            values = {joint.get("name", ""): joint.get("value", "") for joint in state.iterfind("joint")}
            q = zero.copy()
            for i, joint in enumerate(joints):
                if joint in values:
                    q[i] = _number(values[joint])
            if np.isfinite(q).all():
                found.setdefault(state.get("name", ""), q)
    return found


def _srdf(path: Path) -> Iterator[Element]:
    """Yield the SRDF of a robot's file, if there is one; a file that is none is left out."""
    stem = path.name.split(".")[0]
    names = [f"{name}.srdf" for name in (stem, stem.removesuffix("_robot"))]
    candidates = [folder / name for folder in (path.parent, path.parent.parent / "srdf") for name in names]
    for file in dict.fromkeys(candidates):
        if file.is_file():
            with suppress(RobotFileError):
                yield parse_xml(robot_text(file, file), file)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:  # of a joint with several coordinates
        return np.nan
