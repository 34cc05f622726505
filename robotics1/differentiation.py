"""Numeric derivatives: of functions of time, and of functions of the configuration of a robot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.inputs import Array
from robotics1.robot.model import ConfigurationLike, Robot

STEP = 1e-4  # of differences of fourth order: error about STEP⁴ from the curve and 1e-16/STEP from rounding
STRIDE = 5e-3  # of differences of sixth order: error about STRIDE⁶/140 from the curve and 1e-16/STRIDE from rounding
SHRINK = 1.6  # from one step of the extrapolation to the next
LEVELS = 9  # steps of the extrapolation: the least is the first over 1.6⁸ = 43
SHARP = 1e-9  # relative error above which smaller steps are tried
FINER = 40.0  # how much smaller
ROUNDING = 4 * np.finfo(float).eps  # of a value of f, relative to it
NODES = 5  # values of a one-sided difference; its error is of the order of SPACING⁴
SPACING = 2e-3  # from one of them to the next, of the interval


class Estimate(NamedTuple):
    """A number, or an array, and a bound of its error that was estimated with it, entry by entry."""

    value: Array
    error: Array


def derivative(f: Callable[[float], Any], *, step: float = 0.1, noise: npt.ArrayLike = 0.0) -> Estimate:
    """Return df/dt at t = 0 of an array that depends smoothly on t, and an estimate of its error.

    Central differences D(h) = (f(h) − f(−h))/2h = f′ + c₁h² + c₂h⁴ + … at h = step/1.6ᵏ are extrapolated to h = 0. Of
    all entries of the table the one is taken whose error is least: what the last elimination changed, and rounding
    over h. Where f is so sharp that the error is large, the same is done with smaller steps.

    Args:
        f: of a time; it may return a number or an array.
        step: the largest |t| at which f is taken.
        noise: the error of the values of f, beyond their rounding.

    Source: Ridders, Accurate computation of F'(x) and F'(x)F''(x), Advances in Engineering Software 4, 1982.
    """
    best = _extrapolated(f, step, noise)
    for k in (1, 2):
        if (best.error <= SHARP * (1 + np.abs(best.value))).all():
            break
        other = _extrapolated(f, step / FINER**k, noise)
        better = other.error < best.error
        best = Estimate(*(np.where(better, new, old) for new, old in zip(other, best, strict=True)))
    return best


def _extrapolated(f: Callable[[float], Any], step: float, noise: npt.ArrayLike) -> Estimate:
    """Return the best entry of Ridders' table that begins with this step."""
    table: list[Array] = []
    best, error = np.zeros(()), np.asarray(np.inf)
    for level in range(LEVELS):
        h = step / SHRINK**level
        ahead, behind = np.asarray(f(h), dtype=float), np.asarray(f(-h), dtype=float)
        rounding = (ROUNDING * np.maximum(np.abs(ahead), np.abs(behind)) + noise) / h
        row = [(ahead - behind) / (2 * h)]
        for order, coarser in enumerate(table, start=1):
            row.append(row[-1] + (row[-1] - coarser) / (SHRINK ** (2 * order) - 1))
            change = np.maximum(np.abs(row[-1] - row[-2]), np.abs(row[-1] - coarser)) + rounding
            better = change < error
            best, error = np.where(better, row[-1], best), np.where(better, change, error)
        table = row
    return Estimate(best, error)


def configuration_derivative(f: Callable[[Array], Array], robot: Robot, q: ConfigurationLike) -> Array:
    """Return ∂f/∂q by central differences of fourth order, shape f(q).shape + (nv,): exact to about 1e-11 for smooth f.

    f may be vector or matrix valued. The steps are 1e-4 rad, and 1e-4 of the size of an arm or of its slide.
    """
    q = robot.configuration(q)
    steps = STEP * _unit_steps(robot, q)

    def along(i: int) -> Array:
        step = steps[i] * np.eye(robot.nv)[i]
        near, far = (
            f(pin.integrate(robot.own_model, q, k * step)) - f(pin.integrate(robot.own_model, q, -k * step))
            for k in (1, 2)
        )
        return np.asarray((8 * near - far) / (12 * steps[i]))

    columns = [along(i) for i in range(robot.nv)]
    return np.stack(columns, axis=-1) if columns else np.zeros((*np.shape(f(q)), 0))


def directional_derivative(f: Callable[[Array], Array], robot: Robot, q: Array, qdot: Array) -> Array:
    """Return d f(q)/dt while the joints move with q̇, in the shape of f(q): by central differences of sixth order.

    The joints move by multiples of 0.005 rad, or of 0.005 of the size of an arm or of its slide, at most; for smooth f
    it is exact to about 1e-12.
    """
    speed = float(np.abs(qdot / _unit_steps(robot, q)).max(initial=0.0))
    if speed == 0:
        return np.zeros_like(f(q))
    step = STRIDE / speed

    def difference(k: int) -> Array:
        ahead, back = (f(pin.integrate(robot.own_model, q, sign * k * step * qdot)) for sign in (1, -1))
        return np.asarray(ahead - back)

    return np.asarray((45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * step))


def derivative_inside(
    f: Callable[[float, Any], Array], t: float, ends: Sequence[float], side: Literal["left", "right"]
) -> Array:
    """Return df/dt at t from five values inside the interval between two ends in which t is; at an end, `side` decides.

    Args:
        f: (t, side) → array; it is called at the ends with the side that is inside.
        t: when.
        ends: 0, the switching times, and the duration.
        side: "right" or "left".
    """
    number = int(np.searchsorted(ends, t, side="right" if side == "right" else "left"))
    number = min(max(number, 1), len(ends) - 1)
    a, b = ends[number - 1], ends[number]
    h = SPACING * (b - a)
    first = min(max(t - 2 * h, a), b - (NODES - 1) * h)
    nodes = first + h * np.arange(NODES)
    powers = np.vander((nodes - t) / h, NODES, increasing=True).T
    weights = np.linalg.solve(powers, np.eye(NODES)[1]) / h
    values = [f(float(min(max(x, a), b)), "left" if x >= b else "right") for x in nodes]
    return np.asarray(np.tensordot(weights, np.array(values), axes=1))


def _unit_steps(robot: Robot, q: Array) -> Array:
    """Return (nv,) one of each coordinate: 1 rad; of a slide the arm's size up to 1 m, or |q| where that is more."""
    if robot.nq != robot.nv:
        return np.ones(robot.nv)
    return np.where(robot.revolute, 1.0, np.maximum(min(1.0, robot.reach), np.abs(q)))
