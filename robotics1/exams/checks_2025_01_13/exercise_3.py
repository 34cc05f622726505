"""Exercise 3: the rendez-vous of the 2R robot."""

import numpy.typing as npt

from robotics1.exams.comparison import Comparison
from robotics1.exams.exam_2025_01_13 import TARGET, Exercise3
from robotics1.trajectories.meeting import MeetingBranch

# For each arm: q and q̇, what the trajectory starts and ends with, then the coefficients of τ² τ³, t² t³ of q and of
# τ τ², t t² of q̇, joint by joint.
BRANCHES = {
    "right": {
        "q": "1.0294 1.4250",
        "q̇": "-0.7359 -0.6278",
        "q, q̇ at t = 0": "0 0 0 0",
        "q, q̇ at t = t_rv": "1.0294 1.4250 -0.7359 -0.6278",
        "q(τ)": "4.1040 5.1415 -3.0746 -3.7165",
        "q(t)": "2.1539 2.6984 -1.1690 -1.4130",
        "q̇(τ)": "5.9462 7.4495 -6.6821 -8.0773",
        "q̇(t)": "4.3077 5.3967 -3.5069 -4.2391",
    },
    "left": {
        "q": "2.1122 -1.4250",
        "q̇": "-1.1508 0.6278",
        "q, q̇ at t = 0": "0 0 0 0",
        "q, q̇ at t = t_rv": "2.1122 -1.4250 -1.1508 0.6278",
        "q(τ)": "7.9251 -5.1415 -5.8129 3.7165",
        "q(t)": "4.1593 -2.6984 -2.2101 1.4130",
        "q̇(τ)": "11.4826 -7.4495 -12.6334 8.0773",
        "q̇(t)": "8.3185 -5.3967 -6.6303 4.2391",
    },
}


def check_exercise_3(comparison: Comparison, three: Exercise3) -> None:
    """Check the numbers of exercise 3."""
    meeting = three.meeting
    comparison.numbers("3b", "t_rv, number", "1.380", meeting.time)
    comparison.numbers("3", "p_Ty(t_rv), number", "1.5359", meeting.position[1])
    comparison.numbers("3", "p_rv", "0 1.5359", meeting.position)
    comparison.numbers("3", "ṗ_T", "1.4489 0.3882", TARGET.velocity(meeting.time))
    comparison.numbers("3", "number of inverse kinematics solutions", "2", len(meeting.branches))
    for name, branch in (("right", three.right), ("left", three.left)):
        _branch(comparison, name, branch)


def _branch(comparison: Comparison, name: str, branch: MeetingBranch) -> None:
    trajectory = branch.trajectory
    computed: dict[str, npt.ArrayLike] = {
        "q": branch.q,
        "q̇": branch.qdot,
        "q, q̇ at t = 0": [*trajectory(0.0), *trajectory.velocity(0.0)],
        "q, q̇ at t = t_rv": [*trajectory(trajectory.duration), *trajectory.velocity(trajectory.duration)],
        "q(τ)": trajectory.coefficients[2:].ravel(),
        "q(t)": trajectory.coefficients_t[2:].ravel(),
        "q̇(τ)": trajectory.rate.coefficients[1:].ravel(),
        "q̇(t)": trajectory.rate.coefficients_t[1:].ravel(),
    }
    for quantity, printed in BRANCHES[name].items():
        comparison.numbers("3b", f"{name} arm, {quantity}", printed, computed[quantity])
