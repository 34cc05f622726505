"""Which joint angles are added up: those of consecutive joints with parallel axes, as in cos(q2 + q3)."""

import numpy as np

from robotics1.kinematics import frame_jacobian
from robotics1.symbolic.kinematics.chain import Chain
from robotics1.symbolic.writing.sums_of_angles import Groups

PARALLEL = 1e-9  # |ω × ω'| of unit axes that counts as none


def parallel_groups(chain: Chain) -> Groups:
    """Return the places of the angles that are added up: consecutive revolute joints with parallel axes."""
    robot = chain.robot
    own = [robot.joint_names.index(joint.leader) for joint in chain.joints if joint.kind == "revolute"]
    columns = [i for i in dict.fromkeys(own) if robot.revolute[i]]
    places = {i: chain.trig_ring.angles.index(chain.q[i]) for i in columns}
    rng = np.random.default_rng(0)
    axes = [frame_jacobian(robot, rng.uniform(-2, 2, robot.nq), frame=chain.frame)[3:] for _ in range(2)]
    groups: list[list[int]] = []
    for before, i in zip([None, *columns], columns, strict=False):
        if before is not None and all(np.linalg.norm(np.cross(w[:, before], w[:, i])) < PARALLEL for w in axes):
            groups[-1].append(places[i])
        else:
            groups.append([places[i]])
    rest = [[j] for j in range(len(chain.trig_ring.angles)) if j not in places.values()]
    return tuple(map(tuple, groups + rest))
