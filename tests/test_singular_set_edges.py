"""Singular sets at the edges: limits, boxes, little time, special lengths, odd files, and what is said of them."""

from math import acos, cos, pi, sin

import numpy as np
import pytest
import sympy
from arms import arm
from dh_arms import POLAR_ARM, ZYZ, dh, shoulder_arm
from singular_arms import CASES, CORE, TURN, XY, XYZ
from singular_checks import case, numbers, rank, read, usual_sigma, written
from sweeps import core_first

from robotics1 import (
    FormulaError,
    FunctionTask,
    InputError,
    OrientationTask,
    PositionTask,
    TaskError,
    find_singularities,
    load_robot,
    robot_from_dh,
)
from robotics1.singularities import find_intersections, parameter_conditions

WIDE = ("3R xy", "spatial 4R xyz", "7R wrist centre", "SCARA twist", "2R, l2 = 0, xy")
q1, q3 = sympy.symbols("q1 q3", real=True)

# --- limits, boxes and time


def places(branches):
    return {written(branch.conditions) for branch in branches}


@pytest.mark.parametrize(("interval", "inside"), [((0.5, pi), "q2 = pi"), ((-0.5, 2), "q2 = 0"), ((0.5, 2), None)])
def test_a_branch_that_a_box_shuts_out_is_outside_and_the_others_are_all(planar_2r, interval, inside):
    found = find_singularities(planar_2r, XY, box={"q2": interval})
    every = {equations for text in ("q2 = 0", "q2 = pi") for equations in read(text, planar_2r)}
    wanted = set() if inside is None else set(read(inside, planar_2r))
    assert (places(found.branches), places(found.outside), found.complete) == (wanted, every - wanted, True)
    assert "Outside the joint limits the arm would be singular at" in found.explain()
    assert ("There is no singular configuration inside the joint limits" in found.explain()) == (inside is None)


@pytest.mark.parametrize("margin", [0.05, 1e-3])
def test_a_curved_branch_that_only_touches_a_corner_of_the_box_is_inside(margin):
    """0.5 cos q2 + 0.35 cos(q2 + q3) = 0 falls in the (q2, q3) plane, and passes the box near its upper corner."""
    q2 = 1.2
    q3 = acos(-0.5 * cos(q2) / 0.35) - q2
    box = {"q2": (q2 - 0.8, q2 + margin), "q3": (q3 - 0.8, q3 + margin)}
    found = find_singularities(arm("anthropomorphic"), XYZ, box=box)
    shoulder = read("a2*cos(q2) + a3*cos(q2 + q3) = 0", found.robot)
    assert places(found.branches) == set(shoulder)
    lower, upper = np.array(list(box.values())).T
    for q in found.branches[0].samples:
        assert ((q[1:] >= lower - 1e-9) & (q[1:] <= upper + 1e-9)).all()


def test_a_slide_without_limits_needs_no_box_in_exact_form_and_one_in_numbers():
    robot = dh(*POLAR_ARM)
    assert find_singularities(robot, XYZ, method="symbolic").complete
    with pytest.raises(InputError, match="q3"):
        find_singularities(robot, XYZ, method="numeric")


def test_a_slide_that_cannot_come_to_zero_leaves_q3_0_outside():
    robot = robot_from_dh(POLAR_ARM, lower=[None, None, 0.2])
    found = find_singularities(robot, XYZ)
    assert places(found.outside) == set(read("q3 = 0", robot))
    assert places(found.branches) == set(read("q2 = 0 | pi", robot))
    assert all(q[2] >= 0.2 for branch in found.branches for q in branch.samples)


@pytest.mark.parametrize(
    "name", core_first(("3R arm xyz", "Stanford", "5R twist", "7R twist"), ("3R arm xyz", "5R twist"))
)
@pytest.mark.parametrize("seconds", [1e-3, 0.1])
def test_too_little_time_gives_a_part_of_the_answer_and_says_so(name, seconds):
    make, task, generic, _ = CASES[name]
    robot = make()
    found = find_singularities(robot, task, time_limit=seconds, samples=5)
    usual = usual_sigma(robot, task)
    assert found.complete or "not complete" in found.note
    assert found.complete or found.note in found.explain()
    exact = [branch.formulas is not None for branch in found.branches]
    assert exact == sorted(exact, reverse=True)  # what was found by numbers stands last
    others = exact.count(False)
    said = "no other" if not others else "all" if others == len(exact) else f"{others}" if others > 1 else "the last"
    assert found.complete or (said in found.note and "σ_min" not in found.note)
    assert found.complete or any(words in found.explain() for words in ("does not prove", "was found"))
    assert found.generic_rank == generic
    for q in (q for branch in found.branches for q in branch.samples[:10]):
        assert rank(robot, task, q, usual) < generic
    assert isinstance(find_intersections(found).branches, tuple)


# --- lengths


def test_equal_links_make_no_more_of_a_planar_3r_singular():
    assert parameter_conditions(case("3R xy")[3]) == parameter_conditions(case("3R, l2 = l3, xy")[3]) == ()


def test_an_orthogonal_arm_with_a3_below_a2_says_that_more_would_be_singular_where_a2_plus_a3_c3_is_0():
    """det J = a3 c2 s3 (a2 + a3 c3), up to sign: with a3 > a2 the last factor has two zeros, with a3 = a2 one."""
    short, long = case("orthogonal 3R, a2 > a3, xyz")[3], case("orthogonal 3R, a2 < a3, xyz")[3]
    assert [written([equation]) for equation in parameter_conditions(short)] == read("a2 + a3*cos(q3) = 0", short.robot)
    assert "more is singular" in short.explain()
    assert "a2 + a3·cos(q3) = 0" in short.explain()
    assert parameter_conditions(long) == ()
    assert places(short.branches) < places(long.branches)


def test_a_shoulder_further_out_than_the_arm_reaches_is_never_singular_and_that_is_said():
    found = find_singularities(shoulder_arm(1.0), XYZ)
    assert [written([equation]) for equation in parameter_conditions(found)] == read(
        "a1 + a2*cos(q2) + a3*cos(q2 + q3) = 0", found.robot
    )


def test_at_equal_links_the_folded_elbow_has_rank_1():
    found = case("3R arm, a2 = a3, xyz")[3]
    folded = next(branch for branch in found.branches if written(branch.conditions) == read("q3 = pi", found.robot)[0])
    assert (folded.rank, folded.formulas.null.shape, folded.formulas.left_null.shape) == (1, (3, 2), (3, 2))


# --- files

COUPLED = """<robot name="coupled">
  <link name="base"/><link name="1"/><link name="2"/><link name="3"/><link name="tool"/>
  <joint name="a" type="continuous"><parent link="base"/><child link="1"/><axis xyz="0 0 1"/></joint>
  <joint name="b" type="continuous"><parent link="1"/><child link="2"/>
    <origin xyz="0.5 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="c" type="continuous"><parent link="2"/><child link="3"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 0 1"/><mimic joint="b" multiplier="{}"/></joint>
  <joint name="tip" type="fixed"><parent link="3"/><child link="tool"/><origin xyz="0.3 0 0"/></joint>
</robot>"""


@pytest.mark.parametrize("multiplier", [1, 2, -1])
def test_a_coupled_joint_has_the_determinant_of_its_closed_form(tmp_path, multiplier):
    """det J = l1 l2 s2 + (1 + k) l1 l3 s(2 + k2) + k l2 l3 s(k2), with q3 = k q2; l1, l2, l3 = 0.5, 0.4, 0.3."""
    path = tmp_path / "coupled.urdf"
    path.write_text(COUPLED.format(multiplier), encoding="utf-8")
    found = find_singularities(load_robot(path), XY)
    k = multiplier

    def det(x):
        return 0.2 * sin(x) + (1 + k) * 0.15 * sin((1 + k) * x) + k * 0.12 * sin(k * x)

    grid = np.linspace(-pi + 0.005, pi + 0.005, 1000)
    signs = np.sign([det(x) for x in grid])
    assert len(found.branches) == (signs[1:] != signs[:-1]).sum()
    assert [abs(det(branch.q[1])) < 1e-12 for branch in found.branches] == [True] * len(found.branches)
    assert len(places(found.branches)) == len(found.branches)
    assert "Here q1 is a, q2 is b." in found.explain()


def test_1_5708_in_a_file_is_half_pi_and_that_is_said(tmp_path):
    """An arm that lifts, whose q3 = ±π/2 is the stretched and the folded elbow."""
    links = "".join(f'<link name="{name}"/>' for name in ("base", "1", "2", "3", "tool"))
    places_of_joints = (
        ("base", "1", ""),
        ("1", "2", 'rpy="1.5708 0 0"'),
        ("2", "3", 'xyz="0.4 0 0" rpy="0 0 -1.5708"'),
    )
    joints = "".join(
        f'<joint name="{child}" type="continuous"><parent link="{parent}"/><child link="{child}"/><origin {origin}/>'
        f'<axis xyz="0 0 1"/></joint>'
        for parent, child, origin in places_of_joints
    )
    tip = '<joint name="tip" type="fixed"><parent link="3"/><child link="tool"/><origin xyz="0.3 0 0"/></joint>'
    path = tmp_path / "rounded.urdf"
    path.write_text(f'<robot name="rounded">{links}{joints}{tip}</robot>', encoding="utf-8")
    found = find_singularities(load_robot(path), XYZ)
    elbow, shoulder = "q3 = -pi/2 | pi/2", "4*cos(q2) + 3*sin(q2 + q3) = 0"
    assert places(found.branches) == {equations for text in (elbow, shoulder) for equations in read(text, found.robot)}
    assert found.complete
    assert "1.5708" in found.note or "multiple" in found.note


# --- tasks


def test_a_function_that_cannot_be_read_is_a_formula_error_or_is_searched_by_numbers(planar_2r):
    task = FunctionTask(lambda p, R, q: [float(p[0]), p[1]], 2)
    with pytest.raises(FormulaError, match="cannot be read"):
        find_singularities(planar_2r, task, method="symbolic")
    found = find_singularities(planar_2r, task, samples=20)
    assert (found.method, found.complete) == ("numeric", False)
    assert "cannot be read" in found.note
    assert sorted(branch.values["q2"] for branch in found.branches) == pytest.approx([0, pi], abs=1e-6)


def test_where_the_distance_from_the_base_has_no_slope_every_joint_velocity_is_in_the_null_space(planar_2r):
    found = find_singularities(planar_2r, FunctionTask(lambda p, R, q: [np.hypot(p[0], p[1])], 1))
    assert [(branch.rank, branch.null.shape, branch.left_null.shape) for branch in found.branches] == [
        (0, (2, 2), (1, 1))
    ] * 2


def test_euler_angles_that_do_not_exist_where_the_wrist_is_singular_are_said_to_have_no_jacobian():
    """The ZYZ angles of the ZYZ wrist are q1, q2, q3 themselves: J is the identity, up to sin q2 = 0."""
    found = find_singularities(dh(*ZYZ, d6=0.1), OrientationTask(angles="ZYZ"))
    assert (found.generic_rank, found.branches, found.complete) == (3, (), True)
    assert "q2 = 0" in found.note
    assert "q2 = π" in found.note
    assert places(find_singularities(dh(*ZYZ, d6=0.1), TURN).branches) == set(read("q2 = 0 | pi", dh(*ZYZ, d6=0.1)))


# --- sentences


def test_explain_says_where_what_is_lost_what_is_held_and_what_does_not_move_the_tool():
    text = case("3R arm xyz")[3].explain()
    for words in (
        "q1 never matters.",
        "1–2. q3 = 0 or π, whatever q1 and q2: the rank is 2 instead of 3.",
        "a task velocity (x, y, z) with a part along (cos(q1)·cos(q2), sin(q1)·cos(q2), sin(q2)) cannot be realised",
        "a force along (cos(q1)·cos(q2), sin(q1)·cos(q2), sin(q2)) needs no joint torque",
        "joint velocities along (0, a3, −a2 − a3) do not move the task",
        "3. a2·cos(q2) + a3·cos(q2 + q3) = 0, whatever q1: the rank is 2 instead of 3.",
        "a force along (sin(q1), −cos(q1), 0) needs no joint torque",
        "joint velocities along (1, 0, 0) do not move the task",
        "These are all singular configurations.",
    ):
        assert words in text


def test_angles_that_are_subtracted_stand_on_the_other_side_and_where_j_is_zero_that_is_said():
    """r = cos(q3 − q1): J = sin(q3 − q1) (1, 0, −1) vanishes at q3 = q1 and q3 = q1 + π."""
    found = find_singularities(arm("planar_3r"), FunctionTask(lambda p, R, q: [np.cos(q[2] - q[0])], 1))
    assert [(written(branch.conditions), branch.rank) for branch in found.branches] == [
        (written([sympy.Eq(q3 - q1, angle)]), 0) for angle in (0, sympy.pi)
    ]
    for branch, place in zip(found.branches, ("q3 = q1", "q3 = q1 + π"), strict=True):
        assert branch.explain().splitlines() == [
            f"{place}, whatever q2: the rank is 0 instead of 1.",
            "   There J = 0:",
            "   - no task velocity (r1) but zero can be realised;",
            "   - no force needs joint torques;",
            "   - no joint velocity moves the task.",
        ]


def test_a_2r_is_never_singular_in_the_plane_and_loses_c1_s1_l2_s2_everywhere():
    """J = (−y, −l2 s12; x, l2 c12; 1, 1): u = (c1, s1, l2 s2) is orthogonal to both columns."""
    found = case("2R pose")[3]
    q1, q2, l2 = sympy.symbols("q1 q2 l2", real=True)
    wanted = sympy.Matrix([sympy.cos(q1), sympy.sin(q1), l2 * sympy.sin(q2)])
    assert found.generic_bases.left_null == wanted
    assert found.generic_bases.null.shape == (2, 0)
    assert found.explain().splitlines() == [
        "There is no singular configuration.",
        "Almost everywhere",
        "   - a task velocity (x, y, φ) with a part along (cos(q1), sin(q1), l2·sin(q2)) cannot be realised;",
        "   - a force along (cos(q1), sin(q1), l2·sin(q2)) needs no joint torque.",
    ]


@pytest.mark.parametrize("name", core_first(WIDE, ("3R xy", "SCARA twist")))
def test_the_bases_almost_everywhere_are_those_of_j(name):
    robot, task, generic, found, *_ = case(name)
    null, lost = (numbers(robot, getattr(found.generic_bases, basis)) for basis in ("null", "left_null"))
    for seed in range(5):
        q = np.random.default_rng(seed).uniform(-2, 2, robot.nq)
        J = task.jacobian(robot, q)
        N, L = null(q).reshape(robot.nv, robot.nv - generic), lost(q).reshape(task.rows, task.rows - generic)
        assert np.abs(J @ N).max(initial=0) <= 1e-12
        assert np.abs(J.T @ L).max(initial=0) <= 1e-12
        assert np.linalg.matrix_rank(N) == robot.nv - generic
        assert np.linalg.matrix_rank(L) == task.rows - generic


def test_a_branch_of_one_equation_may_be_two_loops():
    """a2 cos q2 = −a3 cos(q2 + q3) with a2 < a3: |cos(q2 + q3)| ≤ a2/a3 < 1, so that sin(q2 + q3) keeps its sign."""
    found = find_singularities(arm("anthropomorphic", a2=0.35, a3=0.5), XYZ)
    (shoulder,) = (branch for branch in found.branches if not branch.values)
    sines = np.sin(shoulder.samples[:, 1] + shoulder.samples[:, 2])
    assert np.abs(sines).min() >= np.sqrt(1 - 0.7**2) - 1e-9
    assert {-1, 1} == set(np.sign(sines))


@pytest.mark.parametrize("name", core_first(CASES, CORE, 10))
def test_explain_tells_of_every_branch_its_place_and_rank(name):
    found = case(name)[3]
    text = found.explain()
    for branch in found.branches:
        place, rank = branch.explain().splitlines()[0].split(": the rank is ")
        assert f"the rank is {rank}" in text
        for part in place.split(", whatever")[0].split(", "):  # values of one joint stand together, as q2 = 0 or π
            name, _, value = part.partition(" = ")
            assert part in text or (f"{name} = " in text and f" or {value}" in text)
        said = [line for line in branch.explain().splitlines()[1:] if not line.startswith("   There")]
        assert all(line in text for line in said)
    assert "nan" not in text
    assert ("There is no singular configuration" in text) == (not found.branches)


def test_a_task_whose_jacobian_is_rounding_alone_is_moved_by_no_joint():
    robot = robot_from_dh([("R", 0, pi / 2, 0.5, 0), ("P", 0, pi / 2, 0, pi / 2)])
    for method in ("auto", "symbolic"):
        with pytest.raises(TaskError, match="no joint moves the task"):
            find_singularities(robot, PositionTask("z"), method=method)
