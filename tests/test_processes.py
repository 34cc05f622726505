"""Worker processes of every kind, started before and after kernels, threads and formulas were used in the parent."""

import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
from arms import arm
from observation import observed
from public_objects import PLANE, TARGET, squared_distance

import robotics1 as r1

LONGEST = 240  # seconds: what takes longer hangs
KINDS = ("fork", "forkserver", "spawn")
Q = [0.4, 0.9]


def planar():
    return r1.robot_from_dh([("R", 1.2, 0, 0, 0), ("R", 0.8, 0, 0, 0)])


def everything(robot):
    """What a worker answers for a planar arm: kernels of IK and scans, formulas, singularities, loading."""
    solver = r1.IKSolver(robot, PLANE)
    batch = solver.solve_batch([TARGET, [0.3, 0.9], [0.9, 0.2], [1.0, -1.0]])
    scan = r1.scan_singularities(robot, PLANE, samples=300)
    return observed(
        [
            batch.q,
            batch.error_norm,
            scan.worst,
            r1.formulas(robot, PLANE).determinant,
            r1.robot_from_dh([("R", 2.0, 0, 0, 0)]).reach,
            r1.load_robot(arm("six_r").path).lower,
        ]
    )


def answers_of_a_child(kind, robot):
    """What a process of this kind answers; RuntimeError if it does not end."""
    context = get_context(kind)
    receiver, sender = context.Pipe(duplex=False)
    child = context.Process(target=send_everything, args=(sender, robot), daemon=True)
    child.start()
    sender.close()
    try:
        if not receiver.poll(LONGEST):
            raise RuntimeError(f"a {kind} child hangs")
        return receiver.recv()
    finally:
        child.kill()
        child.join()


def send_everything(sender, robot):
    try:
        sender.send(everything(robot))
    except BaseException as error:
        sender.send(repr(error))
        raise


PROGRAM = f"""
import sys
from concurrent.futures import ThreadPoolExecutor
sys.path.insert(0, {str(Path(__file__).parent)!r})
from test_processes import KINDS, answers_of_a_child, everything, planar

def children(robot, kinds):
    return {{kind: answers_of_a_child(kind, robot) for kind in kinds}}

if __name__ == "__main__":
    robot = planar()
    early = children(robot, KINDS)
    wanted = everything(robot)
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(everything, [robot] * 2)) == [wanted] * 2
        late = children(robot, sys.argv[1:])  # the threads of the pool wait for more
    for answers in (early, late):
        for kind, answer in answers.items():
            assert answer == wanted, (kind, answer, wanted)
"""


def run_program(folder, text, *arguments):
    """Run a program in a new interpreter, which has compiled and called nothing."""
    path = folder / "program.py"
    path.write_text(text, encoding="utf-8")
    command = [sys.executable, str(path), *map(str, arguments)]
    run = subprocess.run(command, check=False, timeout=4 * LONGEST, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_children_before_and_after_the_kernels_and_the_threads_of_their_parent(tmp_path):
    """Of each kind before the first compiled call of the parent; and a forked one after it and its threads."""
    run_program(tmp_path, PROGRAM, "fork")


@pytest.mark.sweep
def test_children_of_every_kind_after_the_kernels_and_the_threads_of_their_parent(tmp_path):
    run_program(tmp_path, PROGRAM, *KINDS)


WHILE = f"""
import sys, threading, time
sys.path.insert(0, {str(Path(__file__).parent)!r})
from test_processes import answers_of_a_child, everything, planar

over = False

def busy(robot):
    while not over:
        everything(robot)

if __name__ == "__main__":
    robot = planar()
    wanted = everything(robot)
    threads = [threading.Thread(target=busy, args=(robot,), daemon=True) for _ in range(2)]
    for thread in threads:
        thread.start()
    for _ in range(int(sys.argv[1])):
        assert answers_of_a_child("fork", robot) == wanted
        time.sleep(0.003)
    over = True
"""


def test_a_forked_child_does_not_wait_for_the_threads_of_its_parent(tmp_path):
    """Threads find formulas, scans and solutions while the process is forked."""
    run_program(tmp_path, WHILE, 3)


@pytest.mark.sweep
def test_many_forked_children_do_not_wait_for_the_threads_of_their_parent(tmp_path):
    run_program(tmp_path, WHILE, 60)


@pytest.fixture(scope="module")
def pool():
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        yield pool


def test_public_functions_go_to_workers_by_their_names(pool):
    """A robot, a task, solvers, formulas and paths go there, and their answers come back."""
    robot, q = arm("planar_2r"), np.array(Q)
    motion = r1.cubic([0, 0], Q, 2.0)
    solver = r1.IKSolver(robot, PLANE, seed=2)
    path = r1.curves.formula_path(["cos(s)", "sin(s)"], "s", 2.0)
    calls = [
        (r1.forward_kinematics, robot, q),
        (r1.frame_jacobian, robot, q),
        (r1.frame_jacobian_rate, robot, q, q),
        (r1.solve_ik, robot, PLANE, TARGET),
        (r1.ik_solutions, robot, PLANE, TARGET),
        (r1.iterate_ik, robot, PLANE, TARGET, q),
        (r1.joint_velocity, robot, PLANE, [1, 0], q),
        (r1.find_singularities, robot, PLANE),
        (r1.scan_singularities, robot, r1.PlanarPoseTask()),
        (r1.dh.urdf_to_dh, robot),
        (r1.subspaces, r1.frame_jacobian(robot, q)),
        (r1.trajectories.limit_violations, robot, motion, r1.MotionLimits(0.1)),
        (r1.simulate_tracking, motion, [0.1, 0], 2.0),
        (r1.minimum_time, [0, 0], Q, r1.MotionLimits(1.0, 2.0)),
        (r1.curves.by_arc_length, path),
        (r1.curves.frenet_frame, path, 0.3),
        (r1.robot_from_dh, [("R", 1, 0, 0, 0)]),
        (r1.load_robot, "prr"),
        (r1.check_robot, "prr"),
        (r1.FunctionTask(squared_distance, 1).jacobian, robot, q),
        (r1.PoseTask("XYZ").value, robot, q),
        (solver, TARGET),
        (solver.solve_batch, [TARGET, [0.5, 0.5]]),
        (robot.with_parameters, {"l1": 2.0}),
        (motion, 0.5),
    ]
    options = {r1.scan_singularities: {"samples": 300}}
    waiting = [pool.submit(f, *arguments, **options.get(f, {})) for f, *arguments in calls]
    for (f, *arguments), future in zip(calls, waiting, strict=True):
        assert observed(future.result(LONGEST)) == observed(f(*arguments, **options.get(f, {}))), f


def test_the_robots_of_a_map_come_back_in_order(pool):
    robots = [r1.robot_from_dh([("R", "a", 0, 0, 0)], parameters={"a": a}) for a in (1.0, 2.0, 3.0)]
    poses = list(pool.map(r1.forward_kinematics, robots, [[0.0]] * 3, timeout=LONGEST))
    assert [T.translation[0] for T in poses] == pytest.approx([1, 2, 3], abs=1e-15)


def test_a_scan_in_worker_processes_is_the_scan_in_one(pool):
    """Also of the user's own function, which stays in this process."""
    for robot, task, samples in (
        (arm("six_r"), r1.PoseTask(), 3000),
        (arm("planar_2r"), r1.FunctionTask(squared_distance, 1), 100),
    ):
        here, there = (r1.scan_singularities(robot, task, samples=samples, executor=e) for e in (None, pool))
        assert observed([there.worst, there.worst_values]) == observed([here.worst, here.worst_values])
