"""The kernel of one configuration, called from Python."""

import numpy as np

from robotics1.kernels.pose import forward_kinematics, geometric_jacobian


def pose_and_jacobian(chain, q, nv):
    """The pose (3, 4) and the Jacobian (6, nv) of a chain at q, linear rows over angular."""
    T, joint_axes, J = np.empty((3, 4)), np.empty((len(chain.coordinate), 6)), np.empty((6, nv))
    forward_kinematics(chain.links(), q, T, joint_axes)
    geometric_jacobian(chain.links(), T, joint_axes, J)
    return T, J
