"""Configurations exactly at singularities: joints set to known singular values, or one joint driven to det J = 0."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pinocchio as pin
from scipy.optimize import brentq

from benchmarks.arms import Arm, Array

SINGULAR = 1e-9  # σ_min ≤ 1e-9 σ_1
TRIES = 200
GRID = 60  # points of a joint's range between which det J may change its sign


@dataclass(frozen=True)
class Family:
    """One kind of singularity; joints are counted from 0.

    Attributes:
        fixed: joint → its value.
        along: the joint that is driven to a zero of det J; None where the fixed values are singular by themselves.
        dropped: of a 7R arm, the joint whose axis coincides with another, so that its column is left out of det J.
    """

    fixed: dict[int, float] = field(default_factory=dict)
    along: int | None = None
    dropped: int | None = None


FAMILIES = {
    "UR5": {
        "wrist: q5 = 0": Family({4: 0.0}),
        "elbow: q3 = 0": Family({2: 0.0}),
        "shoulder: det J = 0 along q2": Family(along=1),
    },
    # offsets of 0.44 mm keep its elbow and shoulder from q4 = 0 and q2 = 0; where axes 5 and 7 coincide, six are left
    "iiwa": {
        "q6 = 0, det of the others = 0 along q2": Family({5: 0.0}, along=1, dropped=6),
        "q6 = 0, det of the others = 0 along q5": Family({5: 0.0}, along=4, dropped=6),
    },
    "Panda": {  # its elbow cannot stretch; where axes 1 and 3 coincide, six columns are left
        "q2 = 0, det of the others = 0 along q3": Family({1: 0.0}, along=2, dropped=0),
        "q2 = 0, det of the others = 0 along q5": Family({1: 0.0}, along=4, dropped=0),
        "q2 = 0, det of the others = 0 along q6": Family({1: 0.0}, along=5, dropped=0),
    },
}


def singular_configurations(arm: Arm, count: int, rng: np.random.Generator) -> Array:
    """Return (count, n) singular configurations inside the limits, of the arm's families in turn.

    Raises:
        ArithmeticError: one of them is not singular.
    """
    families = list(FAMILIES[arm.name].values())
    found = np.array([_one_of(arm, families[i % len(families)], rng) for i in range(count)])
    for q in found:
        sigma = np.linalg.svd(jacobian(arm, q), compute_uv=False)
        if sigma[-1] > SINGULAR * sigma[0] or not arm.inside(q):
            raise ArithmeticError(f"{arm.name}: q = {q} is not singular, or outside the limits: σ = {sigma}")
    return found


def jacobian(arm: Arm, q: Array) -> Array:
    """Return J (6, n) of the tool by Pinocchio, in world axes."""
    model = arm.robot.model
    return pin.computeFrameJacobian(
        model, model.createData(), q, model.getFrameId(arm.tool), pin.LOCAL_WORLD_ALIGNED
    ).reshape(6, -1)


def _one_of(arm: Arm, family: Family, rng: np.random.Generator) -> Array:
    for _ in range(TRIES):
        q = arm.random(rng)
        q[list(family.fixed)] = list(family.fixed.values())
        if family.along is None:
            return q
        root = _root(_determinant(arm, family, q), *_range(arm, family.along), rng)
        if root is not None:
            q[family.along] = root
            return q
    raise ArithmeticError(f"{arm.name}: det J has no zero along joint {family.along} in {TRIES} tries")


def _determinant(arm: Arm, family: Family, q: Array) -> Callable[[float], float]:
    columns = [j for j in range(len(q)) if j != family.dropped]

    def determinant(x: float) -> float:
        moved = q.copy()
        moved[family.along] = x
        return float(np.linalg.det(jacobian(arm, moved)[:, columns]))

    return determinant


def _range(arm: Arm, joint: int) -> tuple[float, float]:
    return float(arm.robot.lower[joint]), float(arm.robot.upper[joint])


def _root(f: Callable[[float], float], lower: float, upper: float, rng: np.random.Generator) -> float | None:
    """Return a zero of f between two points of a grid, chosen at random; None where its sign does not change."""
    x = np.linspace(lower, upper, GRID)
    values = np.array([f(point) for point in x])
    changes = np.flatnonzero(values[:-1] * values[1:] < 0)
    if not len(changes):
        return None
    i = rng.choice(changes)
    return float(brentq(f, x[i], x[i + 1], xtol=1e-15, rtol=1e-15))
