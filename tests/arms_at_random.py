"""Arms drawn at random, the same for the same number, and what the package says of them beside plain NumPy.

    python tests/arms_at_random.py --count 300

One to eight joints that turn or slide, some of which mimic another, lengths from 1 mm to 100 m, special and odd angles.
Each quantity is compared with the chain of joints multiplied out here, with differences of it, or with brute force. The
worst error of each quantity is printed; the exit code is 1 if one is too large.
"""

import argparse
import sys
import tempfile
import warnings
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sympy

import robotics1 as r1

SPECIAL = np.pi * np.array([0, 0, 0.5, -0.5, 1, 0.25, -0.25, 1 / 3, -1 / 3])
AXES = np.array([[0, 0, 1], [0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 0, -1], [1, 0, 1], [0.7, 0.6, 0.3]])
MULTIPLIERS = (1, -1, 2, -2, 0.5, -1.5, 1 / 3)
LARGEST = {"fk": 1e-11, "jacobian": 1e-11, "rate": 1e-8, "formulas": 1e-9, "branches": 1e-8, "missed": 1e-5, "ik": 1e-6}


@dataclass(frozen=True)
class Joint:
    """A joint of the plain chain: where it is, about or along what it moves, and whose value it takes."""

    placement: np.ndarray
    axis: np.ndarray
    turns: bool
    leader: int
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Arm:
    """A chain multiplied out with NumPy alone.

    Attributes:
        joints: of the chain.
        columns: the joints that have an entry of q.
        tool: (4, 4) in the last link.
        size: of its lengths [m].
    """

    joints: tuple[Joint, ...]
    columns: tuple[int, ...]
    tool: np.ndarray
    size: float

    def value(self, joint, q):
        return joint.multiplier * q[self.columns.index(joint.leader)] + joint.offset

    def poses(self, q):
        """The frame of each joint, before it moves, and of the tool."""
        T, found = np.eye(4), []
        for joint in self.joints:
            T = T @ joint.placement
            found.append(T)
            x = self.value(joint, q)
            T = T @ (turned(joint.axis, x) if joint.turns else moved(x * joint.axis))
        return [*found, T @ self.tool]

    def jacobian(self, q):
        """J (6, n): each joint's axis, times how fast it follows its leader."""
        *frames, end = self.poses(q)
        J = np.zeros((6, len(self.columns)))
        for joint, T in zip(self.joints, frames, strict=True):
            w = T[:3, :3] @ joint.axis
            column = [*np.cross(w, end[:3, 3] - T[:3, 3]), *w] if joint.turns else [*w, 0, 0, 0]
            J[:, self.columns.index(joint.leader)] += joint.multiplier * np.array(column)
        return J


def turned(axis, angle):
    """The rotation about an axis: R = 1 + sin K + (1 − cos) K²."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    T = np.eye(4)
    T[:3, :3] += np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    return T


def moved(p):
    T = np.eye(4)
    T[:3, 3] = p
    return T


def arm_number(number):
    """The arm of a number, and the text of its URDF."""
    rng = np.random.default_rng([number, 12])
    n = int(rng.integers(1, 9))
    size = 10.0 ** rng.uniform(-3, 2)
    joints, columns, elements = [], [], []
    for i in range(n):
        xyz = size * np.round(rng.uniform(-1, 1, 3) * (rng.random(3) < 0.6), 3)
        rpy = rng.choice(SPECIAL, 3) if rng.random() < 0.6 else np.round(rng.uniform(-2, 2, 3), 3)
        axis = AXES[rng.integers(len(AXES))]
        turns = bool(rng.random() < 0.75)
        alike = [c for c in columns if joints[c].turns == turns]
        follows = bool(alike) and rng.random() < 0.2
        leader = int(rng.choice(alike)) if follows else i
        multiplier = float(rng.choice(MULTIPLIERS)) if follows else 1.0
        offset = float(np.round(rng.uniform(-0.5, 0.5), 2)) * (1 if turns else size) if follows else 0.0
        if not follows:
            columns.append(i)
        placement = moved(xyz) @ turned([0, 0, 1], rpy[2]) @ turned([0, 1, 0], rpy[1]) @ turned([1, 0, 0], rpy[0])
        joints.append(Joint(placement, axis / np.linalg.norm(axis), turns, leader, multiplier, offset))
        elements.append(element(i, xyz, rpy, axis, turns, leader, multiplier, offset, size))
    tool = size * np.round(rng.uniform(-1, 1, 3), 3)
    return Arm(tuple(joints), tuple(columns), moved(tool), size), urdf(elements, n, tool)


def element(i, xyz, rpy, axis, turns, leader, multiplier, offset, size):
    mimic = f'<mimic joint="j{leader}" multiplier="{multiplier!r}" offset="{offset!r}"/>' if leader != i else ""
    limit = "" if turns else f'<limit lower="{-3 * size!r}" upper="{3 * size!r}" velocity="1" effort="1"/>'
    return (
        f'<joint name="j{i}" type="{"continuous" if turns else "prismatic"}"><parent link="l{i}"/>'
        f'<child link="l{i + 1}"/><origin xyz="{text(xyz)}" rpy="{text(rpy)}"/><axis xyz="{text(axis)}"/>{limit}{mimic}'
        "</joint>"
    )


def urdf(elements, n, tool):
    links = "".join(f'<link name="l{i}"/>' for i in range(n + 1))
    end = f'<joint name="t" type="fixed"><origin xyz="{text(tool)}"/><parent link="l{n}"/><child link="tool"/></joint>'
    return f'<robot name="random">{links}<link name="tool"/>{"".join(elements)}{end}</robot>'


def text(values):
    return " ".join(repr(float(value)) for value in values)


# --- checks: each returns how wrong the package is, without units


def configuration(arm, rng):
    turns = np.array([arm.joints[c].turns for c in arm.columns])
    return np.where(turns, rng.uniform(-np.pi, np.pi, len(turns)), arm.size * rng.uniform(-1, 1, len(turns)))


def unitless(arm, J):
    """J with lengths in units of the arm's."""
    columns = np.array([1.0 if arm.joints[c].turns else arm.size for c in arm.columns])
    rows = np.array([1 / arm.size] * 3 + [1.0] * 3)
    return rows[:, None] * J * columns


def check_numbers(arm, robot, rng):
    q, qdot = configuration(arm, rng), configuration(arm, rng)
    T, ours = arm.poses(q)[-1], r1.forward_kinematics(robot, q).homogeneous
    wrong = {"fk": max(np.abs(ours - T)[:3, :3].max(), np.abs(ours - T)[:3, 3].max() / arm.size)}
    wrong["jacobian"] = np.abs(unitless(arm, r1.frame_jacobian(robot, q) - arm.jacobian(q))).max()
    h = 1e-3
    near, far = (arm.jacobian(q + k * h * qdot) - arm.jacobian(q - k * h * qdot) for k in (1, 2))
    rate = (8 * near - far) / (12 * h)
    error = unitless(arm, r1.frame_jacobian_rate(robot, q, qdot) - rate)
    wrong["rate"] = np.abs(error).max() / max(1.0, np.abs(unitless(arm, rate)).max())
    return wrong


def check_formulas(arm, robot, rng):
    found = r1.formulas(robot, r1.PositionTask())
    f = sympy.lambdify(found.q, found.value.row_join(found.jacobian), "numpy")
    q = configuration(arm, rng)
    ours = np.asarray(f(*q), dtype=float)
    theirs = np.column_stack([arm.poses(q)[-1][:3, 3], arm.jacobian(q)[:3]])
    return {"formulas": np.abs(ours - theirs).max() / max(arm.size, np.abs(theirs).max())}


def task_of(arm, rng):
    return r1.PositionTask(("z", "xy", "xyz")[int(rng.integers(3))] if len(arm.columns) > 1 else "x")


def check_singular_set(arm, robot, task, rng, seconds=1.5):
    """Samples of branches are singular; and, if the answer is said to be complete, so is no other configuration."""
    try:
        found = r1.find_singularities(robot, task, time_limit=seconds, samples=10)
    except r1.TaskError:
        return {}  # no joint moves the task
    rows = [{"x": 0, "y": 1, "z": 2}[name] for name in task.row_names]

    def sigmas(q):
        return np.linalg.svd(unitless(arm, arm.jacobian(q))[rows], compute_uv=False)

    usual = max(sigmas(configuration(arm, rng))[0] for _ in range(16))
    k = found.generic_rank - 1
    wrong = {"branches": max((sigmas(q)[k] / usual for b in found.branches for q in b.samples[:10]), default=0.0)}
    if found.complete:
        singular = [refined(arm, rows, configuration(arm, rng), k, usual) for _ in range(6)]
        missed = [q for q in singular if q is not None and not on_some(found, robot, q)]
        wrong["missed"] = float(len(missed))
    return wrong


def refined(arm, rows, q, k, usual):
    """The configuration of least σ_k near q, by Newton's method on the block of J that vanishes; or None."""
    units = np.array([1.0 if arm.joints[c].turns else arm.size for c in arm.columns])

    def J(x):
        return unitless(arm, arm.jacobian(x))[rows]

    for _ in range(60):
        U, sigma, Vt = np.linalg.svd(J(q))
        block = U[:, k:].T @ J(q) @ Vt[k:].T
        if sigma[k] <= 1e-14 * usual:
            break
        moves = [(J(q + e) - J(q - e)) / 2e-6 for e in 1e-6 * np.diag(units)]
        A = np.array([(U[:, k:].T @ dJ @ Vt[k:].T).ravel() for dJ in moves]).T
        step = np.linalg.lstsq(A, -block.ravel(), rcond=1e-7)[0]
        q = q + units * step * min(1.0, 0.5 / max(np.abs(step).max(), 1e-300))
    turns = np.array([arm.joints[c].turns for c in arm.columns])
    inside = (np.abs(q) <= np.where(turns, np.inf, 3 * arm.size)).all()
    return q if inside and np.linalg.svd(J(q), compute_uv=False)[k] <= 1e-12 * usual else None


def on_some(found, robot, q):
    """Whether a configuration is beside a branch: on it once its joints are moved there, by at most 1e-5."""
    around = [q, *(np.where(np.abs(q - grid) < 1e-5, grid, q) for grid in (np.pi / 4 * np.round(4 * q / np.pi),))]
    return any(branch.contains(x) for branch in found.branches for x in around)


def check_ik(arm, robot, task, rng):
    """Every solution that Newton's method finds from many starts is among the answers, if these are all."""
    q0 = configuration(arm, rng)
    rows = [{"x": 0, "y": 1, "z": 2}[name] for name in task.row_names]
    if np.linalg.cond(unitless(arm, arm.jacobian(q0))[rows]) > 1e3:
        return {}
    target = arm.poses(q0)[-1][rows, 3]
    found = r1.ik_solutions(robot, task, target)
    wrong = [np.abs(arm.poses(q)[-1][rows, 3] - target).max() / arm.size for q in found.q]
    missed = 0
    for _ in range(20):
        q = configuration(arm, rng)
        for _ in range(30):
            step = np.linalg.lstsq(arm.jacobian(q)[rows], target - arm.poses(q)[-1][rows, 3], rcond=1e-9)[0]
            q = q + step
        reached = np.abs(arm.poses(q)[-1][rows, 3] - target).max() < 1e-10 * arm.size
        inside = (np.abs(q) <= np.where(robot.revolute, np.inf, 3 * arm.size)).all()
        if reached and inside and np.linalg.cond(unitless(arm, arm.jacobian(q))[rows]) < 1e3:
            apart = (q - found.q) / np.where(robot.revolute, 1.0, arm.size)
            apart = np.where(robot.revolute, np.angle(np.exp(1j * apart)), apart)
            missed += not len(apart) or np.abs(apart).max(axis=1).min() > 1e-4
    return {"ik": max([float(missed), *wrong])}


def errors_of(number, folder, *, seconds=1.5, sets=1, longest=6):
    """quantity → how wrong it is, for the arm of a number; its singular set in some seconds, of one arm in `sets`; and
    formulas of arms of up to `longest` joints.
    """
    arm, source = arm_number(number)
    path = Path(folder) / f"arm{number}.urdf"
    path.write_text(source, encoding="utf-8")
    with warnings.catch_warnings(action="ignore", category=r1.RobotWarning):  # axes of any length
        robot = r1.load_robot(path)
    rng = np.random.default_rng([number, 13])
    found = check_numbers(arm, robot, rng)
    if len(arm.joints) <= longest:
        found |= check_formulas(arm, robot, rng)
    task = task_of(arm, rng)
    if len(arm.columns) <= 4 and number % sets == 0:
        found |= check_singular_set(arm, robot, task, rng, seconds)
    plain = all(joint.multiplier.is_integer() or not joint.turns for joint in arm.joints)
    if number % 3 == 0 and task.rows == len(arm.columns) and plain:
        found |= check_ik(arm, robot, task, rng)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    worst = defaultdict(lambda: (0.0, None, 0))
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(options.first, options.first + options.count):
            try:
                found = errors_of(number, folder)
            except Exception as error:
                print(f"arm {number}: {type(error).__name__}: {error}")
                failed += 1
                continue
            for name, error in found.items():
                largest, place, count = worst[name]
                worst[name] = (max(largest, error), number if error > largest else place, count + 1)
                if not error <= LARGEST[name]:
                    print(f"arm {number}: {name} is wrong by {error:.1e}")
                    failed += 1
    for name, (error, number, count) in worst.items():
        print(f"{name:10} {count:5} arms, worst {error:.1e} (arm {number})")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
