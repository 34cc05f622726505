"""The public names of `robotics1.control`, and where they are."""

from .decay import ErrorDecay
from .gain_choice import Gains, gains_for_decay, largest_gains
from .law import ControlCommand, ControlLaw
from .law_formulas import law_formula
from .laws import cartesian_law, joint_law
from .lyapunov import LyapunovRate, LyapunovStatus, lyapunov_rate
from .simulation import ControlRun, simulate_law
from .tracking import GainChoice, GainStatus, Tracking, simulate_tracking, smallest_gain

__all__ = [
    "ControlCommand",
    "ControlLaw",
    "ControlRun",
    "ErrorDecay",
    "GainChoice",
    "GainStatus",
    "Gains",
    "LyapunovRate",
    "LyapunovStatus",
    "Tracking",
    "cartesian_law",
    "gains_for_decay",
    "joint_law",
    "largest_gains",
    "law_formula",
    "lyapunov_rate",
    "simulate_law",
    "simulate_tracking",
    "smallest_gain",
]
