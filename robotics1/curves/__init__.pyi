"""The public names of `robotics1.curves`, and where they are."""

from .arcs import arc_path, arc_through, circle_path, ellipse_path, helix_path, line_path
from .composition import PathTrajectory, by_arc_length, stretched
from .curve import Curve
from .frenet import FrenetFrame, frenet_frame, frenet_path
from .harmonic import HarmonicCurve
from .interpolants import Extreme
from .later import LaterMotion, starting_at
from .piecewise_polynomial import PiecewisePolynomial
from .polyline import parabolic_blends, polyline_path
from .pose_path import PosePath, pose_line, screw_path
from .rotations import euler_path, slerp_path, turn_path
from .samples import MotionSamples
from .sequence import CurveSequence, Join
from .stack import JointTrajectory, StackedCurve, stacked_path
from .symbolic_path import FormulaPath, FrenetFormulas, formula_path, frenet_formulas

__all__ = [
    "Curve",
    "CurveSequence",
    "Extreme",
    "FormulaPath",
    "FrenetFormulas",
    "FrenetFrame",
    "HarmonicCurve",
    "Join",
    "JointTrajectory",
    "LaterMotion",
    "MotionSamples",
    "PathTrajectory",
    "PiecewisePolynomial",
    "PosePath",
    "StackedCurve",
    "arc_path",
    "arc_through",
    "by_arc_length",
    "circle_path",
    "ellipse_path",
    "euler_path",
    "formula_path",
    "frenet_formulas",
    "frenet_frame",
    "frenet_path",
    "helix_path",
    "line_path",
    "parabolic_blends",
    "polyline_path",
    "pose_line",
    "screw_path",
    "slerp_path",
    "stacked_path",
    "starting_at",
    "stretched",
    "turn_path",
]
