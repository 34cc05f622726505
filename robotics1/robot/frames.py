"""The frames of a model by their names."""

import pinocchio as pin


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
