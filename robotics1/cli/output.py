"""How the commands print: JSON for programs, degrees and warnings for people."""

import json
import sys
from typing import Any

import numpy as np
import pinocchio as pin
from rich.console import Console

from robotics1.inputs import Array
from robotics1.robot.model import Robot


def write_json(answer: Any) -> None:
    """Print an answer as JSON on stdout."""
    json.dump(plain(answer), sys.stdout, indent=2, ensure_ascii=False)
    sys.stdout.write("\n")


def plain(value: Any) -> Any:
    """Return a value made of what JSON knows; NaN and infinity become null."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, pin.SE3):
        return plain(value.homogeneous)
    if isinstance(value, np.ndarray | list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.bool_ | np.integer):
        return value.item()
    return value


def in_degrees(robot: Robot, q: Array, degrees: bool) -> Array:
    """Return q for printing: its angles in degrees where asked."""
    return np.where(robot.revolute, np.degrees(q), q) if degrees else q


def say_outside_limits(console: Console, robot: Robot, q: Array) -> None:
    """Say which joints are beyond their limits."""
    for name, value, low, high in zip(robot.joint_names, q, robot.lower, robot.upper, strict=True):
        if not low - 1e-9 <= value <= high + 1e-9:
            console.print(f"[yellow]{name} = {value:.4g} is outside its limits [{low:.4g}, {high:.4g}][/yellow]")
