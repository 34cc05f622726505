"""The usual way to a workspace: configurations uniform in the joint limits, and where each puts the tool."""

from collections.abc import Callable

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.report import absence

Sampler = Callable[[Array], Array]  # configurations (k, n) → positions (k, 3) in the base
LOOP, TORCH = "Pinocchio, a loop in Python", "pytorch-kinematics, in batches"


def samplers(arm: Arm) -> dict[str, Sampler | str]:
    """Return the ways to sample, or why one is missing."""
    try:
        torch: Sampler | str = by_torch(arm)
    except ImportError as error:
        torch = absence(error)
    return {LOOP: by_loop(arm), TORCH: torch}


def by_loop(arm: Arm) -> Sampler:
    """Return Pinocchio's forward kinematics, one configuration after the other."""
    model = arm.robot.model
    data, frame = model.createData(), model.getFrameId(arm.tool)

    def positions(q: Array) -> Array:
        p = np.empty((len(q), 3))
        for place, x in zip(p, q, strict=True):
            pin.forwardKinematics(model, data, x)
            place[:] = pin.updateFramePlacement(model, data, frame).translation
        return p

    return positions


def by_torch(arm: Arm) -> Sampler:
    """Return the forward kinematics of pytorch-kinematics, all configurations at once.

    Raises:
        ImportError: it is not installed.
    """
    import pytorch_kinematics
    import torch

    torch.set_num_threads(1)
    chain = pytorch_kinematics.build_serial_chain_from_urdf(arm.urdf.encode(), arm.tool, arm.base)
    chain = chain.to(dtype=torch.float64)

    def positions(q: Array) -> Array:
        return np.asarray(chain.forward_kinematics(torch.from_numpy(q)).get_matrix()[:, :3, 3].numpy())

    return positions
