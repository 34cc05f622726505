"""Helpers of the tests of motions: samples, derivatives by differences, dense peaks; kinds of laws, random bounds."""

from itertools import pairwise

import numpy as np
from hypothesis import strategies as st

import robotics1 as r1

RATES = ("velocity", "acceleration", "jerk")


def ends_of(motion):
    """0, the switching times, T."""
    return np.array([0.0, *motion.breakpoints, motion.duration])


def inside(motion, count=7):
    """Instants inside each of the sections between switching times."""
    ends = ends_of(motion)
    shares = np.linspace(0.07, 0.93, count)
    return np.concatenate([a + (b - a) * shares for a, b in pairwise(ends)])


def assert_derivatives(motion, tolerance=1e-6):
    """Velocity, acceleration and jerk are the central differences of what is before them."""
    t = inside(motion)
    ends = ends_of(motion)
    h = 1e-3 * np.diff(ends).min()
    quantities = [motion, *(getattr(motion, name) for name in RATES)]
    for f, rate in pairwise(quantities):
        slope = (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)
        size = max(1.0, np.abs(rate(t)).max(), np.abs(f(t)).max() / h * 1e-9)
        assert np.abs(slope - rate(t)).max() <= tolerance * size


def dense_peak(motion, order, count=2001):
    """The largest |derivative| among many samples, from both sides at each instant."""
    t = np.unique(np.concatenate([np.linspace(0, motion.duration, count), ends_of(motion)]))
    rate = getattr(motion, RATES[order - 1])
    return max(np.abs(rate(t, side=side)).max() for side in ("right", "left"))


# --- minimum time

KINDS = ["trapezoidal", "double_s", "bang_bang", "cubic", "quintic", "septic", "cosine", "cycloidal"]
MOVING = KINDS[:6]
JERK_FREE = {"trapezoidal", "bang_bang"}
bound = st.floats(0.3, 4)
share = st.floats(-1, 1)
distance = st.floats(-4, 4).filter(lambda d: abs(d) > 1e-3)


def limits_of(kind, V, A, J):
    """The bounds that a kind of law can keep."""
    return r1.MotionLimits(V, A) if kind in JERK_FREE else r1.MotionLimits(V, A, J)
