"""The frames of a model by their names."""

from collections.abc import Sequence

import pinocchio as pin

from robotics1.errors import UnknownNameError
from robotics1.robot.joints import Joint, tips

USUAL_TOOLS = ("tool0", "tool")


def links_of(model: pin.Model) -> tuple[str, ...]:
    """Return the links of a model, in its order."""
    return tuple(frame.name for frame in model.frames if frame.type == pin.FrameType.BODY)


def frame_number(model: pin.Model, name: object) -> int | None:
    """Return Pinocchio's number of the link of a name, else of the joint of that name, or None.

    A link and a joint may share a name, and Pinocchio then wants to know which is meant.
    """
    for kind in (pin.FrameType.BODY, pin.FrameType.JOINT, pin.FrameType.FIXED_JOINT):
        if isinstance(name, str) and model.existFrame(name, kind):
            return int(model.getFrameId(name, kind))
    return None


def tool_frame(model: pin.Model, joints: Sequence[Joint], named: str | None) -> str | None:
    """Return the tool: the named frame, the only tip, or the tip with a usual name.

    Raises:
        UnknownNameError: there is no frame of that name.
    """
    links = links_of(model)
    if named is not None:
        if frame_number(model, named) is None:
            raise UnknownNameError(f"frame of robot {model.name!r} named", named, links)
        return named
    candidates = tips(links, joints)
    return candidates[0] if len(candidates) == 1 else next((name for name in USUAL_TOOLS if name in candidates), None)
