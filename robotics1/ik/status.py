"""Why an inverse kinematics ended."""

from enum import Enum


class IKStatus(Enum):
    """Why an inverse kinematics ended."""

    CONVERGED = "the error is within the tolerance"
    SINGULAR = "J is singular, so Newton's step does not exist; 'pseudoinverse' or 'damped' go on from here"
    STALLED = "Jᵀe = 0 with e ≠ 0: no step along J reduces the error; start elsewhere"
    MAX_ITERATIONS = "the number of iterations is used up"
    DIVERGED = "the iterates grow without bound; a smaller gain or 'damped' would not"
    UNREACHABLE = "it is proven that no q inside the limits reaches the target"
    NOT_FOUND = "no start led to the target within the time limit; that proves nothing, but it is likely out of reach"
