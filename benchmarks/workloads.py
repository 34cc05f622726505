"""What the solvers are asked: targets that the arm reaches inside its limits, and where to start."""

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.singular_targets import singular_configurations

SEED = 20250113
NEAR = 0.05  # [rad]


@dataclass(frozen=True, eq=False)
class Workload:
    """Targets and starts of one arm: `targets[i]` is the pose at an in-limit q, `starts[i]` (n,) is in the limits."""

    arm: Arm
    targets: list[pin.SE3]
    starts: Array


def far(arm: Arm, count: int) -> Workload:
    """Return poses of uniform q, started from other uniform q."""
    rng = np.random.default_rng(SEED)
    goals = np.array([arm.random(rng) for _ in range(count)])
    return Workload(arm, [arm.pose(q) for q in goals], np.array([arm.random(rng) for _ in range(count)]))


def tracking(arm: Arm, count: int) -> Workload:
    """Return poses of uniform q, started at most 0.05 rad a joint from it, as the next point of a motion is."""
    rng = np.random.default_rng(SEED + 1)
    goals = np.array([arm.random(rng) for _ in range(count)])
    starts = np.clip(goals + rng.uniform(-NEAR, NEAR, goals.shape), arm.robot.lower, arm.robot.upper)
    return Workload(arm, [arm.pose(q) for q in goals], starts)


def singular(arm: Arm, count: int) -> Workload:
    """Return poses of singular q, started from uniform q."""
    rng = np.random.default_rng(SEED + 2)
    goals = singular_configurations(arm, count, rng)
    return Workload(arm, [arm.pose(q) for q in goals], np.array([arm.random(rng) for _ in range(count)]))
