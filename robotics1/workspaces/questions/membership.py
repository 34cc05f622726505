"""Whether a point is in a workspace, with what proves it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.results import Frozen
from robotics1.workspaces.result import Workspace, check_workspace


@dataclass(frozen=True, eq=False)
class Membership(Frozen):
    """Whether a point is reached, and why.

    Attributes:
        inside: whether it is.
        q: (k, nq) configurations that reach it [rad or m]; of a redundant arm some, or none.
        distance: from the boundary [m].
        proven: whether the answer is: inside by a configuration or by the number of solutions, outside by that number.
            A sampled workspace proves nothing outside.
    """

    inside: bool
    q: Array
    distance: float
    proven: bool

    def explain(self) -> str:
        """Return the answer and its proof, in sentences."""
        far = f" It is {self.distance:.6g} m from the boundary."
        if not self.inside:
            why = "No configuration was found that reaches it; that there is none is not proven."
            if self.proven:
                why = "The critical curves make no turn around it, so that it has no solution."
            return f"The point is not reached. {why}{far}"
        if not len(self.q):
            return f"The point is reached: the critical curves around it say that it has solutions.{far}"
        values = ", ".join(f"{value:.6g}" for value in self.q[0])
        return f"The point is reached, as with q = ({values}).{far}"


def is_reached(ws: Workspace, p: npt.ArrayLike) -> Membership:
    """Return whether a point is in a workspace, with configurations that prove it.

    Args:
        ws: what `workspace(robot, task)` returns.
        p: (m,) the task's coordinates [m].

    Raises:
        InputError: ws is no workspace, or p has another shape or is not finite.
    """
    check_workspace(ws)
    inside = ws.contains(p)
    q = ws.configurations(p)
    return Membership(inside, q if inside else q[:0], ws.distance(p), bool(len(q)) or not ws.resolution)
