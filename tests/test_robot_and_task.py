"""What stands in the place of a robot or of a task, and is none, is refused in every call."""

import pytest
from arms import arm

import robotics1 as r1

XY = r1.PositionTask("xy")
CALLS = {
    "solve_ik": lambda robot, task: r1.solve_ik(robot, task, [1, 1]),
    "IKSolver": r1.IKSolver,
    "ik_solutions": lambda robot, task: r1.ik_solutions(robot, task, [1, 1]),
    "iterate_ik": lambda robot, task: r1.iterate_ik(robot, task, [1, 1], [0, 0]),
    "find_singularities": r1.find_singularities,
    "scan_singularities": lambda robot, task: r1.scan_singularities(robot, task, samples=10),
    "joint_velocity": lambda robot, task: r1.joint_velocity(robot, task, [1, 1], [0, 0]),
    "joint_acceleration": lambda robot, task: r1.joint_acceleration(robot, task, [1, 1], [0, 0], [0, 0]),
    "rendezvous": lambda robot, task: r1.rendezvous(robot, task, r1.LinearMotion([1, 1], [0, 0]), [0, 0], 1.0),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
@pytest.mark.parametrize(
    ("robot", "task", "said"),
    [
        (None, XY, r"must be a Robot, not a NoneType.*load_robot\(\)"),
        ("robot", "place:xy", r"there is no task 'place:xy'; there is position"),
        ("robot", None, "must be a task such as"),
        ("robot", r1.PoseTask, r"must be made first: write PoseTask\(...\) with brackets"),
        (XY, "robot", "the robot comes first, then the task"),
        ("robot", "robot", "the robot comes first, then the task"),
    ],
)
def test_a_class_or_swapped_arguments_are_refused_with_what_would_be_right(call, robot, task, said):
    given = [arm("planar_2r") if value == "robot" else value for value in (robot, task)]
    with pytest.raises(r1.InputError, match=said):
        call(*given)


def test_a_robot_without_joints_is_not_solved_for(tmp_path):
    path = tmp_path / "post.urdf"
    path.write_text('<robot name="post"><link name="tool"/></robot>', encoding="utf-8")
    with pytest.raises(r1.TaskError, match="nothing moves this task"):
        r1.solve_ik(r1.load_robot(path), r1.PositionTask(), [0, 0, 0])
