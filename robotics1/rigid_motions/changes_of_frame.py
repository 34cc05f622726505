"""Twists and wrenches, read in one frame and written in another."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_array, true_or_false
from robotics1.robot.placements import homogeneous

SIX = "(v, ω), or (ω, v) with angular_first"


def adjoint(T: Any, *, angular_first: bool = False) -> Array:
    """Return Ad_T, (6, 6), that moves a twist from frame b to frame a, with T = T_ab = (R, p): V_a = Ad_T V_b.

        Ad_T = [R  [p]× R]      for V = (v, ω);      [  R    0]      for V = (ω, v).
               [0     R  ]                           [[p]× R  R]

    v is the velocity [m/s] of the point of the moving body that is at the frame's origin, ω its angular velocity
    [rad/s].

    Args:
        T: T_ab, the pose of frame b in frame a: a `pin.SE3`, or a homogeneous matrix (4, 4).
        angular_first: twists are (ω, v), as Lynch and Park write them; otherwise (v, ω), as all Jacobians here.

    Raises:
        InputError: T is no pose.

    Source: Lynch, Park, Modern Robotics, 2017, section 3.3.2.
    """
    return _in_order(homogeneous("T", T).action, angular_first)


def transform_wrench(T: Any, F: npt.ArrayLike, *, angular_first: bool = False) -> Array:
    """Return the wrench F_b, given in frame b, in frame a: F_a = Ad_{T⁻¹}ᵀ F_b, (6,), with T = T_ab = (R, p).

    For F = (f, m): f_a = R f_b and m_a = R m_b + p × f_a. The power is the same in both: F_aᵀ V_a = F_bᵀ V_b.

    Args:
        T: T_ab, the pose of frame b in frame a: a `pin.SE3`, or a homogeneous matrix (4, 4).
        F: (6,) the force f [N] and the moment m about the origin of frame b [N m], in the axes of b.
        angular_first: wrenches are (m, f), as Lynch and Park write them; otherwise (f, m).

    Raises:
        InputError: T is no pose, or F is not six numbers.

    Source: Lynch, Park, Modern Robotics, 2017, section 3.4; Craig, Introduction to Robotics, 2005, section 5.10.
    """
    force = real_array("F", F, (6,), "(f, m), or (m, f) with angular_first")
    return np.asarray(_in_order(homogeneous("T", T).inverse().action, angular_first).T @ force)


def linear_first(name: str, V: npt.ArrayLike, angular_first: bool) -> Array:
    """Return a twist as (v, ω), (6,), with v [m or m/s] and ω [rad or rad/s].

    Raises:
        InputError: it is not six numbers.
    """
    twist = real_array(name, V, (6,), SIX)
    return np.roll(twist, 3) if true_or_false("angular_first", angular_first) else twist


def _in_order(action: Any, angular_first: bool) -> Array:
    """Return a matrix for (v, ω), or the same for (ω, v)."""
    first = true_or_false("angular_first", angular_first)
    return np.roll(action, (3, 3), axis=(0, 1)) if first else np.array(action)
