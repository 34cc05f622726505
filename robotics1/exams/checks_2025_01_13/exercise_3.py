"""Exercise 3: the rendez-vous of the 2R robot."""

import numpy as np

from robotics1.exams.comparison import Comparison
from robotics1.exams.exam_2025_01_13 import TARGET, Exercise3
from robotics1.inputs import Array
from robotics1.trajectories.meeting import MeetingBranch, meeting_time
from robotics1.trajectories.polynomial import cubic
from robotics1.trajectories.target_motion import LinearMotion

# For each arm: q, q̇, then the coefficients of τ² τ³, t² t³ of q and τ τ², t t² of q̇, joint by joint.
BRANCHES = {
    "right": {
        "q": "1.0294 1.4250",
        "q̇": "-0.7359 -0.6278",
        "q(τ)": "4.1040 5.1415 -3.0746 -3.7165",
        "q(t)": "2.1539 2.6984 -1.1690 -1.4130",
        "q̇(τ)": "5.9462 7.4495 -6.6821 -8.0773",
        "q̇(t)": "4.3077 5.3967 -3.5069 -4.2391",
    },
    "left": {
        "q": "2.1122 -1.4250",
        "q̇": "-1.1508 0.6278",
        "q(τ)": "7.9251 -5.1415 -5.8129 3.7165",
        "q(t)": "4.1593 -2.6984 -2.2101 1.4130",
        "q̇(τ)": "11.4826 -7.4495 -12.6334 8.0773",
        "q̇(t)": "8.3185 -5.3967 -6.6303 4.2391",
    },
}


def check_exercise_3(comparison: Comparison, three: Exercise3) -> None:
    """Check exercise 3."""
    meeting = three.meeting
    comparison.formula("3", "p_T(t)", "p0 + v t (cos δ, sin δ)", lambda seed: _target_line(seed)[0])
    comparison.formula("3", "t_rv", "−p0x / (v cos δ)", lambda seed: _target_line(seed)[1])
    comparison.formula("3", "p_Ty(t_rv)", "p0y + v t_rv sin δ", lambda seed: _target_line(seed)[2])
    comparison.formula("3", "q_d(τ)", "(3 q_rv − T q̇_rv) τ² + (−2 q_rv + T q̇_rv) τ³", lambda seed: _cubic(seed)[0])
    comparison.formula(
        "3", "q̇_d(τ)", "2/T (3 q_rv − T q̇_rv) τ + 3/T (−2 q_rv + T q̇_rv) τ²", lambda seed: _cubic(seed)[1]
    )
    comparison.numbers("3b", "t_rv, number", "1.380", meeting.time)
    comparison.numbers("3", "p_Ty(t_rv), number", "1.5359", meeting.position[1])
    comparison.numbers("3", "p_rv", "0 1.5359", meeting.position)
    comparison.numbers("3", "ṗ_T", "1.4489 0.3882", TARGET.velocity(meeting.time))
    comparison.numbers("3", "number of inverse kinematics solutions", "2", len(meeting.branches))
    for name, branch in (("right", three.right), ("left", three.left)):
        _branch(comparison, name, branch)


def _branch(comparison: Comparison, name: str, branch: MeetingBranch) -> None:
    trajectory = branch.trajectory
    computed = {
        "q": branch.q,
        "q̇": branch.qdot,
        "q(τ)": trajectory.coefficients[2:].ravel(),
        "q(t)": trajectory.coefficients_t[2:].ravel(),
        "q̇(τ)": trajectory.rate.coefficients[1:].ravel(),
        "q̇(t)": trajectory.rate.coefficients_t[1:].ravel(),
    }
    for quantity, printed in BRANCHES[name].items():
        comparison.numbers("3b", f"{name} arm, {quantity}", printed, computed[quantity])
    comparison.formula(
        "3a",
        f"{name} arm, start and end of the trajectory",
        "q(0) = 0, q̇(0) = 0, q(t_rv) = q_rv, q̇(t_rv) = q̇_rv",
        lambda _: np.concatenate(
            [
                trajectory(0.0),
                trajectory.velocity(0.0),
                trajectory(trajectory.duration) - branch.q,
                trajectory.velocity(trajectory.duration) - branch.qdot,
            ]
        ),
    )


def _target_line(seed: int) -> tuple[Array, Array, Array]:
    """The target's line, the time at which it crosses the y axis and where, for random data."""
    rng = np.random.default_rng(seed)
    (x, y), speed, angle = rng.uniform([-3, -1], [-0.5, 1]), rng.uniform(0.5, 2), rng.uniform(-1.2, 1.2)
    direction = np.array([np.cos(angle), np.sin(angle)])
    motion = LinearMotion([x, y], speed * direction)
    t, T = rng.uniform(0, 2), meeting_time(motion, lambda t, p: p[0])
    printed = -x / (speed * direction[0])
    line = motion(t) - (np.array([x, y]) + speed * t * direction)
    return line, np.array(T - printed), np.array(motion(T)[1] - (y + speed * printed * direction[1]))


def _cubic(seed: int) -> tuple[Array, Array]:
    """The printed cubic from rest at zero to (q_rv, q̇_rv) and its rate, for random data."""
    rng = np.random.default_rng(seed)
    q_rv, qdot_rv, T, tau = rng.uniform(-3, 3, 2), rng.uniform(-2, 2, 2), rng.uniform(0.5, 3), rng.uniform()
    trajectory = cubic(np.zeros(2), q_rv, T, 0.0, qdot_rv)
    a, b = 3 * q_rv - T * qdot_rv, -2 * q_rv + T * qdot_rv
    position = trajectory(tau * T) - (a * tau**2 + b * tau**3)
    return position, trajectory.velocity(tau * T) - (2 / T * a * tau + 3 / T * b * tau**2)
