"""The Jacobian of a task in exact form, compared with Pinocchio."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import sympy

from robotics1.analysis.singular_points import SingularPoints
from robotics1.analysis.spaces import subspaces
from robotics1.errors import FormulaError
from robotics1.symbolic.kinematics.mid_chain import MidChainJacobian
from robotics1.symbolic.tasks.reading import Reading

VERIFIED = 1e-9  # relative to the largest entry of J


def exact_rows(reading: Reading, in_world: bool) -> MidChainJacobian:
    """Return J as X M, with M seen from the middle of the chain where the task's axes are the world's."""
    rows = reading.mid_chain if in_world else MidChainJacobian(reading.rows)
    return replace(rows, leads_back=reading.factored.is_plain)


def verify_rows(
    rows: MidChainJacobian, points: SingularPoints, parameters: Mapping[sympy.Symbol, float], rng: np.random.Generator
) -> None:
    """Compare J = X M, or of a task with quotients the null space of M, with Pinocchio.

    Raises:
        FormulaError: they differ.
    """
    for q in points.box.random(rng, 3):
        J = points.task.jacobian(points.robot, q)
        ours = rows.numbers(q, parameters)
        error = ours - J if rows.leads_back else J @ subspaces(ours).null
        if np.abs(error).max(initial=0.0) > VERIFIED * np.abs(J).max():
            raise FormulaError(f"the formula of J differs from Pinocchio by {np.abs(error).max():.1e}")
