"""Planar arms of revolute and prismatic joints with limits, drawn at random or given."""

from functools import cache
from math import pi
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import robotics1 as r1

XY = r1.PositionTask("xy")
XYZ = r1.PositionTask()
MOUNT = (0.3, -0.2)  # where the first joint is


def chain(kinds, lengths, lower, upper, *, turns=None, tip=(0.0, 0.0), scale=1.0):
    """The arm of joints "RPR...": each turned by turns[i] about z, a length along x after the one before it.

    A prismatic joint slides along its x axis. `tip` is added to the last length. `scale` multiplies all lengths.
    """
    places = [MOUNT, *[(length, 0.0) for length in lengths[:-1]]]
    text = '<robot name="chain"><link name="l0"/>'
    for i, kind in enumerate(kinds):
        unit = 1.0 if kind == "R" else scale
        axis, name = ("0 0 1", "revolute") if kind == "R" else ("1 0 0", "prismatic")
        x, y = places[i]
        limit = f'lower="{unit * lower[i]!r}" upper="{unit * upper[i]!r}"' if lower is not None else ""
        name = name if limit else "continuous"
        text += (
            f'<link name="l{i + 1}"/><joint name="q{i + 1}" type="{name}"><parent link="l{i}"/>'
            f'<child link="l{i + 1}"/><origin xyz="{scale * x!r} {scale * y!r} 0" '
            f'rpy="0 0 {turns[i] if turns else 0}"/>'
            f'<axis xyz="{axis}"/><limit {limit} velocity="1" effort="1"/></joint>'
        )
    x, y = scale * (lengths[-1] + tip[0]), scale * tip[1]
    text += (
        f'<link name="tool"/><joint name="t" type="fixed"><parent link="l{len(kinds)}"/><child link="tool"/>'
        f'<origin xyz="{x!r} {y!r} 0"/></joint></robot>'
    )
    with TemporaryDirectory() as folder:
        path = Path(folder) / "chain.urdf"
        path.write_text(text, encoding="utf-8")
        return r1.load_robot(path, tool="tool")


@cache
def drawn_chain(seed, joints, scale=1.0):
    """The arm of a seed: kinds, lengths, directions and limits; a quarter of the revolute joints turn fully.

    Of each third seed they are multiples of half a metre and of 45°: there arcs touch, coincide and end on each other.
    """
    rng = np.random.default_rng(seed)
    kinds = "".join(rng.choice(list("RRP"), joints))
    lower, upper = np.zeros(joints), np.zeros(joints)
    for i, kind in enumerate(kinds):
        if kind == "R":
            lower[i], room = (-pi, 2 * pi) if rng.random() < 0.25 else (rng.uniform(-3, 1), rng.uniform(0.3, 4))
        else:
            lower[i], room = rng.uniform(-1, 0.5), rng.uniform(0.2, 1.5)
        if seed % 3 == 0:
            unit = pi / 4 if kind == "R" else 0.5
            lower[i], room = unit * round(lower[i] / unit), unit * max(1, round(room / unit))
        upper[i] = lower[i] + room
    lengths, turns = rng.uniform(0.1, 1, joints), rng.uniform(-pi, pi, joints)
    tip = (0.0, 0.1)
    if seed % 3 == 0:
        lengths, turns, tip = rng.choice([0.5, 1.0], joints), rng.choice([pi / 2, -pi / 2], joints), (0.0, 0.0)
    given = lengths.tolist(), lower.tolist(), upper.tolist()
    arm = chain(kinds, *given, turns=turns.tolist(), tip=tip, scale=scale)
    return kinds, arm
