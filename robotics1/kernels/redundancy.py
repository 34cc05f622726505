"""The solution of a redundant arm that is nearest to a wished configuration, along its null space."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.damped_step import damped_step
from robotics1.kernels.descent import DAMPING, descend, move
from robotics1.kernels.inverse import from_units, in_units, to_units, wind
from robotics1.kernels.pose import TOLERANCE, forward_kinematics, geometric_jacobian, leave_out, pose_error, task_parts

STEPS_ASIDE = 200  # along the null space of a solution, at most
LONGEST_ASIDE = 0.2  # of one of them [rad]
ARRIVED = 1e-9  # of a step that leads no nearer [rad]


@compiled()
def approach(links: Array, limits: Array, counted: Array, axis: Array, goal: Array, wished: Array, x: Array) -> None:
    """Move a solution x, (n,), along its null space, as near to a wished configuration as that leads.

    x ← x + w + Jᵀ (J Jᵀ + λ² 1)⁻¹ (e − J w) with w = x_wished − x, the projected gradient of −½ |x_wished − x|²; the
    step is half as long at most once one has led no nearer. The solution is kept but for terms of second order.

    Source: Liégeois, IEEE Trans. Systems, Man and Cybernetics 7 (1977).
    """
    n = len(x)
    T, joint_axes, M, columns = np.empty((3, 4)), np.empty((len(links) - 1, 6)), np.empty((3, 3)), np.empty((n, 6))
    e, A, y, held, wish, step = np.empty(6), np.empty((6, 6)), np.empty(6), np.empty(n), np.empty(n), np.empty(n)
    longest, last = LONGEST_ASIDE, np.inf
    for _ in range(STEPS_ASIDE):
        forward_kinematics(links, x, T, joint_axes)
        pose_error(goal, axis, T, M, e)
        geometric_jacobian(links, T, joint_axes, columns.T)
        leave_out(counted, axis, T, columns, e)
        for j in range(n):
            wish[j] = wished[j] - x[j]
        far = norm(wish)
        longest = longest if far < last else 0.5 * longest
        last = far
        damped_step(columns, e, wish, DAMPING, limits, x, held, A, y, step)
        length = norm(step)
        if length < ARRIVED or longest < ARRIVED:
            return
        if length > longest:
            for j in range(n):
                step[j] *= longest / length
        move(limits, step, x)


@compiled(inner=True)
def distance(x: Array, y: Array) -> float:
    """Return |x − y|."""
    square = 0.0
    for j in range(len(x)):
        square += (x[j] - y[j]) * (x[j] - y[j])
    return math.sqrt(square)


@compiled(inner=True)
def norm(x: Array) -> float:
    """Return |x|."""
    square = 0.0
    for value in x:
        square += value * value
    return math.sqrt(square)


@compiled()
def nullspace_descent(
    links: Array, coordinates: Array, active: Indices, task: Array, target: Array, wished: Array, q: Array,
    error: float,
) -> float:  # fmt: skip
    """Bring a solution q, (nq,), with its |e|, near to a wished one, (nq,), unless that loses it; return its |e|.

    The other arguments are those of `inverse.solve`.
    """
    n = len(active)
    x, near, same, around = np.empty(n), np.empty(n), np.empty(n), np.empty(n)
    goal, limits = np.empty((3, 4)), np.empty((3, n))
    counted, axis, unit, tolerance = task_parts(task)
    in_units(target, unit, goal)
    to_units(coordinates, active, wished, around, limits)
    to_units(coordinates, active, q, x, limits)
    wind(limits, around, x)
    approach(links, limits, counted, axis, goal, around, x)
    wind(limits, around, x)
    moved = descend(links, limits, counted, axis, unit, tolerance, goal, x, near)
    to_units(coordinates, active, q, x, limits)
    wind(limits, around, x)
    kept = descend(links, limits, counted, axis, unit, tolerance, goal, x, same)
    if moved <= tolerance and (kept > tolerance or distance(near, around) < distance(same, around)):
        from_units(coordinates, active, near, q)
        return moved
    if kept <= tolerance:
        from_units(coordinates, active, same, q)
        return kept
    return error


@compiled()
def all_nullspace_descents(
    links: Array, coordinates: Array, active: Indices, task: Array, targets: Array, wished: Array, q: Array,
    errors: Array,
) -> None:  # fmt: skip
    """Do what `nullspace_descent` does for every target, (k, 4, 4), that is reached; wished and q are (k, nq)."""
    for i in range(len(targets)):
        if errors[i] <= task[TOLERANCE]:
            errors[i] = nullspace_descent(links, coordinates, active, task, targets[i], wished[i], q[i], errors[i])
