"""Arms drawn at random: R and P, followers, fingers beside the tool, a millimetre to a hundred metres."""

from math import pi
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from robotics1 import load_robot

TURNS = (0.0, pi / 2, -pi / 2, pi, pi / 4)


def _origin(rng, size):
    xyz = size * rng.choice([0.0, 1.0, rng.uniform(-1, 1)], 3)
    rpy = [rng.choice(TURNS) if rng.random() < 0.7 else rng.uniform(-pi, pi) for _ in range(3)]
    return f'<origin xyz="{" ".join(map(repr, xyz.tolist()))}" rpy="{" ".join(f"{float(a)!r}" for a in rpy)}"/>'


def _limits(rng, kind, size):
    low, high = (-size, size) if kind == "prismatic" else (-pi, pi)
    if rng.random() < 0.4:
        low, high = low * rng.uniform(0.1, 0.9), high * rng.uniform(0.1, 0.9)
    return f'<limit lower="{float(low)!r}" upper="{float(high)!r}" velocity="1" effort="1"/>'


def drawn_arm(seed, *, joints=None, followers=True):
    """Return the arm of a seed: 1 to 8 joints, some of which may follow others, and a finger that moves no tool."""
    rng = np.random.default_rng(seed)
    n, size = joints or int(rng.integers(1, 9)), 10.0 ** rng.uniform(-3, 2)
    links, parts = ["base"], []
    for i in range(n):
        kind = "prismatic" if rng.random() < 0.3 else "revolute"
        mimic = ""
        if followers and i and rng.random() < 0.2:
            leader = int(rng.integers(0, i))
            same = parts[leader][1] == kind and not parts[leader][2]
            mimic = f'<mimic joint="j{leader}" multiplier="{rng.choice([-1.0, 1.0, 0.5])}"/>' if same else ""
        inside = (
            _limits(rng, kind, size)
            if not mimic
            else (f'<limit lower="{-1000 * size - 100}" upper="{1000 * size + 100}" velocity="1" effort="1"/>')
        )
        parts.append((f"j{i}", kind, mimic, _origin(rng, size) + inside, links[-1], f"l{i}"))
        links.append(f"l{i}")
    parts.append(("tip", "fixed", "", f'<origin xyz="{size!r} 0 0"/>', links[-1], "tool"))
    parts.append(("finger", "prismatic", "", '<limit lower="0" upper="0.04" velocity="1" effort="1"/>', "tool", "jaw"))
    body = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<axis xyz="0 0 1"/>{inside}{mimic}</joint>'
        for name, kind, mimic, inside, parent, child in parts
    )
    with TemporaryDirectory() as folder:
        path = Path(folder) / "drawn.urdf"
        every = "".join(f'<link name="{link}"/>' for link in [*links, "tool", "jaw"])
        path.write_text(f'<robot name="drawn">{every}{body}</robot>', encoding="utf-8")
        return load_robot(path, tool="tool")
