"""The public names of `robotics1.ik`, and where they are."""

from .closed_form.family import IKBranch, IKFormulas, SingularTarget
from .closed_form.find import ik_formulas
from .closed_form.trig_equation import TrigSolutions, solve_trig
from .iterate import IKIterate, IKIteration, iterate_ik
from .result import IKBatch, IKResult, IKStatus
from .solution_batch import IKSolutionsBatch
from .solution_set import IKSolutions
from .solution_solver import SolutionSolver
from .solutions import ik_solutions
from .solver import IKSolver, solve_ik

__all__ = [
    "IKBatch",
    "IKBranch",
    "IKFormulas",
    "IKIterate",
    "IKIteration",
    "IKResult",
    "IKSolutions",
    "IKSolutionsBatch",
    "IKSolver",
    "IKStatus",
    "SingularTarget",
    "SolutionSolver",
    "TrigSolutions",
    "ik_formulas",
    "ik_solutions",
    "iterate_ik",
    "solve_ik",
    "solve_trig",
]
