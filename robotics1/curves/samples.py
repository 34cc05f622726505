"""A motion at equal steps of time: as arrays, as a table in CSV or pandas, and as ROS's message JointTrajectory."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError, MissingExtraError
from robotics1.files import check_suffix, write_file
from robotics1.inputs import Array, real_number, text
from robotics1.results import Frozen

MOST = 10_000_000  # samples
NANO = 1_000_000_000  # nanoseconds in a second


@dataclass(frozen=True, eq=False)
class MotionSamples(Frozen):
    """A motion at k instants: a fixed number a second, and the end.

    Attributes:
        t: (k,) instants [s].
        q: (k, n) values.
        velocity: (k, n) their first derivatives [per s].
        acceleration: (k, n) their second derivatives [per s²].
        names: of the n coordinates.
    """

    t: Array
    q: Array
    velocity: Array
    acceleration: Array
    names: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.t)

    def columns(self) -> dict[str, Array]:
        """Return heading → column (k,): t, then the values, velocities and accelerations, as q1, q1_dot, q1_ddot."""
        named = {"t": self.t}
        for ending, array in (("", self.q), ("_dot", self.velocity), ("_ddot", self.acceleration)):
            named |= {f"{name}{ending}": array[:, i] for i, name in enumerate(self.names)}
        return named

    def csv(self, file: str | Path | None = None) -> str:
        """Return the columns as CSV, numbers with all their digits, and write them if a file is given.

        Raises:
            InputError: the file cannot be written there.
        """
        stream = io.StringIO()
        columns = self.columns()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([repr(float(value)) for value in row] for row in zip(*columns.values(), strict=True))
        if file is not None:
            check_suffix("a motion", file, (".csv", ".txt"))
            write_file(file, stream.getvalue())
        return stream.getvalue()

    def to_pandas(self) -> Any:
        """Return a `pandas.DataFrame` of the columns, with t for its index.

        Raises:
            MissingExtraError: pandas is not installed.
        """
        try:
            import pandas
        except ImportError as error:
            raise MissingExtraError("pandas", "pandas") from error
        return pandas.DataFrame(self.columns()).set_index("t")

    def joint_trajectory(self, frame_id: str = "") -> dict[str, Any]:
        """Return a dictionary of the form of ROS's `trajectory_msgs/JointTrajectory`, which JSON and YAML can hold.

        Args:
            frame_id: of the header.
        """
        points = [
            {
                "positions": q.tolist(),
                "velocities": v.tolist(),
                "accelerations": a.tolist(),
                "effort": [],
                "time_from_start": dict(zip(("sec", "nanosec"), divmod(round(t * NANO), NANO), strict=True)),
            }
            for t, q, v, a in zip(self.t.tolist(), self.q, self.velocity, self.acceleration, strict=True)
        ]
        header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": text("frame_id", frame_id)}
        return {"header": header, "joint_names": list(self.names), "points": points}


def motion_samples(curve: Any, rate: float, names: Sequence[str] | None = None) -> MotionSamples:
    """Return a curve of numbers at t = 0, 1/rate, 2/rate, ..., and at its end.

    Args:
        curve: a motion in time, with values of numbers.
        rate: samples a second [Hz].
        names: of its coordinates, such as `robot.joint_names`; by default q1, q2, ...

    Raises:
        InputError: the rate is not positive or gives too many samples, the names are too few or many, or the curve is
            of orientations or poses.
    """
    rate = real_number("rate", rate, positive=True)
    if not curve.of_points:
        raise InputError("a motion of orientations or poses has no columns; call it at the instants that you want")
    if curve.end * rate > MOST:
        raise InputError(f"rate={rate:g} gives {curve.end * rate:.3g} samples; at most {MOST:g} are made")
    whole = np.arange(int(np.ceil(curve.end * rate * (1 - 1e-12)))) / rate
    t = np.append(whole, curve.end)
    q, velocity, acceleration = (np.reshape(curve.derivative(t, order), (len(t), -1)) for order in range(3))
    n = q.shape[1]
    if names is None:
        names = [f"q{i + 1}" for i in range(n)]
    if isinstance(names, str) or len(names) != n:
        raise InputError(f"names must have one name for each of {n} coordinates; it is {names!r}")
    return MotionSamples(t, q, velocity, acceleration, tuple(text("a name", name) for name in names))
