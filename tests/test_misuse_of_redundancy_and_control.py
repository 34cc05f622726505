"""Whatever is handed to redundancy, control and the tasks at points: an answer or a Robotics1Error, never another."""

from contextlib import suppress

import numpy as np
import pytest

import robotics1 as r1
from robotics1 import control, redundancy, tasks

ROBOT = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
XY, Q, V = r1.PositionTask("xy"), [0.4, 0.7, -0.9], [0.1, 0.2]
LAW = control.joint_law(ROBOT, [0, 0, 0], 1.0)
H = redundancy.NearObjective([0, 0, 0])
LEVELS = [(XY, V)]
JUNK = {
    "None": None,
    "text": "x",
    "nan": float("nan"),
    "empty": [],
    "nested": [[1]],
    "negative": -1,
    "infinite": np.inf,
    "object": object(),
    "mixed": [1, "a", 2],
    "mapping": {},
    "large": [1e300] * 3,
    "fails": lambda q: 1 / 0,
    "class": r1.PositionTask,
    "cube": np.zeros((2, 2, 2)),
    "ragged": [[1, 2], [3]],
}
CALLS = {
    "projected_gradient": (redundancy.projected_gradient, [ROBOT, XY, V, Q, H], {"gain": 1.0}),
    "reduced_gradient": (redundancy.reduced_gradient, [ROBOT, XY, V, Q, H], {"gain": 1.0}),
    "priority_velocity": (
        redundancy.priority_velocity,
        [ROBOT, LEVELS, Q],
        {"method": "stacked", "null_velocity": None, "damping": 0.0, "weights": None},
    ),
    "priority_acceleration": (
        redundancy.priority_acceleration,
        [ROBOT, LEVELS, Q, Q],
        {"method": "levels", "null_acceleration": None, "damping": 0.0},
    ),
    "saturated_velocity": (
        redundancy.saturated_velocity,
        [ROBOT, XY, V, Q],
        {"limits": 1.0, "lower": None, "method": "sns"},
    ),
    "saturated_acceleration": (
        redundancy.saturated_acceleration,
        [ROBOT, XY, V, Q, Q],
        {"limits": 1.0, "lower": None, "method": "optimal"},
    ),
    "saturated_priority_velocity": (
        redundancy.saturated_priority_velocity,
        [ROBOT, LEVELS, Q],
        {"limits": 1.0, "lower": None},
    ),
    "saturated_priority_acceleration": (
        redundancy.saturated_priority_acceleration,
        [ROBOT, LEVELS, Q, Q],
        {"limits": 1.0, "lower": None, "max_velocity": 1.0, "step": 0.1},
    ),
    "ik_by_priority": (
        redundancy.ik_by_priority,
        [ROBOT, [(XY, [1, 1])], Q],
        {"tolerance": 1e-9, "most_steps": 20, "starts": 2},
    ),
    "weighted_pseudoinverse": (redundancy.weighted_pseudoinverse, [[[1.0, 2.0, 3.0]]], {"weights": None}),
    "JointRangeObjective": (redundancy.JointRangeObjective, [ROBOT, [-1] * 3, [1] * 3], {}),
    "ObstacleObjective": (redundancy.ObstacleObjective, [ROBOT, [0, 0, 0]], {"frame": None, "point": None}),
    "NearObjective": (redundancy.NearObjective, [[0, 0, 0]], {"weights": None}),
    "joint_law": (control.joint_law, [ROBOT, [0, 0, 0], 1.0, None], {"feedforward": True}),
    "cartesian_law": (
        control.cartesian_law,
        [ROBOT, XY, [1, 1], 1.0, None],
        {"axes": None, "method": "newton", "feedforward": True, "resolution": None},
    ),
    "simulate_law": (
        control.simulate_law,
        [LAW, Q],
        {"qdot0": None, "duration": 0.1, "limits": None, "samples": 3},
    ),
    "gains_for_decay": (control.gains_for_decay, [0.1, 1.0], {"order": 1, "damping_ratio": 1.0}),
    "largest_gains": (
        control.largest_gains,
        [ROBOT, XY, [1, 1], Q],
        {"limits": 1.0, "criterion": "error", "t": 0.0},
    ),
    "lyapunov_rate": (control.lyapunov_rate, [ROBOT, XY, [1, 1], Q, 1.0], {"method": "gradient"}),
    "command": (LAW.command, [Q], {"qdot": None, "t": 0.0}),
    "FunctionTask": (
        r1.FunctionTask,
        [lambda p, R, q: [p[0]], 1],
        {"parameters": None, "point": None, "units": None},
    ),
    "PolarTask": (tasks.PolarTask, ["xy"], {"frame": None, "reference": "world", "point": None}),
    "frame_jacobian": (r1.frame_jacobian, [ROBOT, Q], {"point": None}),
}


@pytest.mark.parametrize("name", CALLS)
def test_any_argument_ends_in_an_answer_or_a_typed_error(name):
    function, arguments, options = CALLS[name]
    function(*arguments, **options)
    for junk in JUNK.values():
        changed = [([*arguments[:i], junk, *arguments[i + 1 :]], options) for i in range(len(arguments))]
        changed += [(arguments, {**options, key: junk}) for key in options]
        for given, chosen in changed:
            with suppress(r1.Robotics1Error):
                function(*given, **chosen)
