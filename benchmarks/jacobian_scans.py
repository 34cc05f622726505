"""Ways to get J and σ_min of many configurations: loops and batches that people write today, and ours.

Each takes q, (N, n), and returns σ_min, (N,).
"""

from collections.abc import Callable

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array

Scan = Callable[[Array], Array]
BEST_PEER = "Pinocchio loop, then eigvalsh(J Jᵀ) of all"


def pinocchio_loop(arm: Arm) -> Scan:
    """Return Pinocchio's J and NumPy's SVD, configuration by configuration."""
    one = _one_jacobian(arm)
    return lambda q: np.array([np.linalg.svd(one(row), compute_uv=False)[-1] for row in q])


def pinocchio_then_svd(arm: Arm) -> Scan:
    """Return Pinocchio's J in a loop, and one call of the SVD for all."""
    return lambda q: np.linalg.svd(pinocchio_jacobians(arm, q), compute_uv=False)[:, -1]


def pinocchio_then_eigvalsh(arm: Arm) -> Scan:
    """Return Pinocchio's J in a loop, and σ_min² of all as the least eigenvalue of J Jᵀ, to half of the digits."""
    return lambda q: _by_eigenvalues(pinocchio_jacobians(arm, q))


def robotics_toolbox(arm: Arm) -> Scan:
    """Return `jacob0` of Robotics Toolbox in a loop, and one call of the SVD for all."""
    from benchmarks.peers.robotics_toolbox import elementary_transforms

    ets = elementary_transforms(arm)
    return lambda q: np.linalg.svd(np.array([ets.jacob0(row) for row in q]), compute_uv=False)[:, -1]


def numpy_batch(arm: Arm) -> Scan:
    """Return J of all by NumPy's products of whole arrays, and σ_min by eigenvalues."""
    model = arm.robot.model
    placements = [T.homogeneous for T in list(model.jointPlacements)[1:]]
    frame = model.frames[model.getFrameId(arm.tool)].placement.homogeneous

    def scan(q: Array) -> Array:
        T = np.tile(np.eye(4), (len(q), 1, 1))
        axes, points = [], []
        for placement, angle in zip(placements, q.T, strict=True):
            T = T @ placement
            axes.append(T[:, :3, 2])  # all joints of the Panda turn about z
            points.append(T[:, :3, 3])
            T = T @ _turns_about_z(angle)
        tool = (T @ frame)[:, :3, 3]
        columns = [np.hstack([np.cross(z, tool - p), z]) for z, p in zip(axes, points, strict=True)]
        return _by_eigenvalues(np.stack(columns, axis=2))

    return scan


def our_kernel(arm: Arm) -> Scan:
    """Return our kernel with J written."""
    return _our_kernel(arm, with_J=True)


def our_kernel_without_J(arm: Arm) -> Scan:
    """Return our kernel, J kept to itself."""
    return _our_kernel(arm, with_J=False)


SCANS: dict[str, Callable[[Arm], Scan]] = {
    "Pinocchio loop, SVD each": pinocchio_loop,
    "Pinocchio loop, then SVD of all": pinocchio_then_svd,
    BEST_PEER: pinocchio_then_eigvalsh,
    "Robotics Toolbox `jacob0` loop, then SVD of all": robotics_toolbox,
    "NumPy on whole arrays, then eigvalsh(J Jᵀ)": numpy_batch,
    "robotics1 kernel, J written": our_kernel,
    "robotics1 kernel, σ_min only": our_kernel_without_J,
}


def pinocchio_jacobians(arm: Arm, q: Array) -> Array:
    """Return J (N, 6, n) by a loop over Pinocchio."""
    one, J = _one_jacobian(arm), np.empty((len(q), 6, q.shape[1]))
    for i, row in enumerate(q):
        J[i] = one(row)
    return J


def _one_jacobian(arm: Arm) -> Callable[[Array], Array]:
    model = arm.robot.model
    data, frame = model.createData(), model.getFrameId(arm.tool)
    return lambda q: pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL_WORLD_ALIGNED)


def _by_eigenvalues(J: Array) -> Array:
    return np.sqrt(np.maximum(np.linalg.eigvalsh(J @ J.transpose(0, 2, 1))[:, 0], 0.0))


def _turns_about_z(angle: Array) -> Array:
    T = np.zeros((len(angle), 4, 4))
    T[:, 0, 0] = T[:, 1, 1] = np.cos(angle)
    T[:, 1, 0] = np.sin(angle)
    T[:, 0, 1] = -T[:, 1, 0]
    T[:, 2, 2] = T[:, 3, 3] = 1.0
    return T


def _our_kernel(arm: Arm, *, with_J: bool) -> Scan:
    from robotics1.kernels.chain import chain_arrays
    from robotics1.kernels.singularity_measures import singularity_measures

    chain, S = chain_arrays(arm.robot), np.eye(6)

    def scan(q: Array) -> Array:
        J = np.empty((6, q.shape[1], len(q))) if with_J else None
        return singularity_measures(chain, S, np.ascontiguousarray(q.T), J=J).smallest

    return scan
