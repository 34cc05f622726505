"""The public names of `robotics1.orientation`, and where they are."""

from .axis_angle import AxisAngle, axis_angle_to_rotation, rotation_to_axis_angle
from .completion import CompletedRotations, complete_rotation
from .elementary import skew, vee
from .euler import EulerSolutions, euler_to_rotation, rotation_to_euler
from .nearest import NearestRotation, nearest_rotation
from .pointing import Alignment, FrameAlignment, align_direction, align_two_directions
from .quaternion import UnitQuaternions, quaternion_rate_map, quaternion_to_rotation, rotation_to_quaternion
from .rates import EulerRates, angular_velocity, euler_rate_map, euler_rates
from .recognition import RecognisedSequence, recognise_sequence
from .second_order import (
    EulerAccelerations,
    RotationRates,
    angular_acceleration,
    euler_accelerations,
    euler_rate_map_derivative,
    rotation_rates,
)
from .sequence import EulerSequence
from .sequence_formulas import EulerFormulas, SingularAngle, euler_formulas

__all__ = [
    "Alignment",
    "AxisAngle",
    "CompletedRotations",
    "EulerAccelerations",
    "EulerFormulas",
    "EulerRates",
    "EulerSequence",
    "EulerSolutions",
    "FrameAlignment",
    "NearestRotation",
    "RecognisedSequence",
    "RotationRates",
    "SingularAngle",
    "UnitQuaternions",
    "align_direction",
    "align_two_directions",
    "angular_acceleration",
    "angular_velocity",
    "axis_angle_to_rotation",
    "complete_rotation",
    "euler_accelerations",
    "euler_formulas",
    "euler_rate_map",
    "euler_rate_map_derivative",
    "euler_rates",
    "euler_to_rotation",
    "nearest_rotation",
    "quaternion_rate_map",
    "quaternion_to_rotation",
    "recognise_sequence",
    "rotation_rates",
    "rotation_to_axis_angle",
    "rotation_to_euler",
    "rotation_to_quaternion",
    "skew",
    "vee",
]
