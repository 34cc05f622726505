"""The public names of `robotics1.ik`, and where they are."""

from .closed_form.family import IKBranch, IKFormulas, SingularTarget
from .closed_form.find import ik_formulas
from .closed_form.trig_equation import TrigSolutions, solve_trig
from .human_arm import arm_angle, solutions_at_arm_angle
from .iterate import IKIterate, IKIteration, iterate_ik
from .postures.aspects import Aspects, group_by_aspect
from .postures.cuspidal import Cuspidality, CuspidalityStatus, is_cuspidal
from .postures.path_between import PostureChange, PostureChangeStatus, posture_change
from .result import IKBatch, IKResult, IKStatus
from .self_motions import SelfMotion, SelfMotionCurve, self_motion
from .solution_batch import IKSolutionsBatch
from .solution_set import IKSolutions
from .solution_solver import SolutionSolver
from .solutions import ik_solutions
from .solver import IKSolver, solve_ik

__all__ = [
    "Aspects",
    "Cuspidality",
    "CuspidalityStatus",
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
    "PostureChange",
    "PostureChangeStatus",
    "SelfMotion",
    "SelfMotionCurve",
    "SingularTarget",
    "SolutionSolver",
    "TrigSolutions",
    "arm_angle",
    "group_by_aspect",
    "ik_formulas",
    "ik_solutions",
    "is_cuspidal",
    "iterate_ik",
    "posture_change",
    "self_motion",
    "solutions_at_arm_angle",
    "solve_ik",
    "solve_trig",
]
