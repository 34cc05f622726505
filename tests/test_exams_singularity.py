"""Questions of examinations of 2009 to 2013 on singularities, ranges and null spaces, answered with the public API."""

from itertools import product
from math import pi

import numpy as np
import pytest
import sympy
from dh_arms import NAMED_CABLE, POLAR_ARM, SPATIAL_4R, TWISTED, dh, offset_arm, planar_rpr
from formula_values import real, same
from scipy.optimize import minimize
from singular_checks import numbers, read, spans_range, written
from sympy import Matrix, cos, sin

from robotics1 import (
    OrientationTask,
    PoseTask,
    PositionTask,
    find_singularities,
    formulas,
    ik_solutions,
    joint_velocity,
    line_path,
    load_robot,
    robot_from_dh,
    subspaces,
)
from robotics1.redundancy import ManipulabilityObjective
from robotics1.singularities import find_intersections

H = pi / 2
XY, XYZ, TURN = PositionTask("xy"), PositionTask("xyz"), OrientationTask()
q1, q2, q3, q4 = real("q1:5")
L, L1, L2, L3, l1, l2, l3, d3, a3, alpha = real("L L1 L2 L3 l1 l2 l3 d3 a3 alpha")

PRP = [("P", 0, H, 0, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)]
PRP_BASE = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
PRP_TOOL = [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]]
MOBILE = """<robot name="mobile">
  <link name="ground"/><link name="wheels"/><link name="cart"/><link name="base"/>
  <link name="1"/><link name="2"/><link name="3"/><link name="tool"/>
  <joint name="th" type="continuous"><parent link="ground"/><child link="wheels"/><axis xyz="0 0 1"/></joint>
  <joint name="way" type="prismatic"><parent link="wheels"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-5" upper="5" velocity="1" effort="1"/></joint>
  <joint name="back" type="continuous"><parent link="cart"/><child link="base"/><axis xyz="0 0 -1"/>
    <mimic joint="th"/></joint>
  <joint name="q1" type="continuous"><parent link="base"/><child link="1"/><axis xyz="0 0 1"/></joint>
  <joint name="q2" type="continuous"><parent link="1"/><child link="2"/><axis xyz="0 -1 0"/></joint>
  <joint name="q3" type="continuous"><parent link="2"/><child link="3"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/></joint>
  <joint name="tip" type="fixed"><parent link="3"/><child link="tool"/><origin xyz="0.4 0 0"/></joint>
</robot>"""


def planar(*lengths):
    names = [f"l{i}" for i in range(1, len(lengths) + 1)]
    return robot_from_dh([("R", name, 0, 0, 0) for name in names], parameters=dict(zip(names, lengths, strict=True)))


def prp():
    return robot_from_dh(PRP, base_placement=np.array(PRP_BASE, float), tool_placement=np.array(PRP_TOOL, float))


def ranks(found):
    return {written(branch.conditions): branch.rank for branch in found.branches}


def wanted(robot, **texts):
    """rank_1="q2 = 0 | pi" → the equations with their rank."""
    return {equations: int(key[-1]) for key, text in texts.items() for equations in read(text, robot)}


def at(found, text):
    """The branch of these equations."""
    (equations,) = read(text, found.robot)
    return next(branch for branch in found.branches if written(branch.conditions) == equations)


def span(*columns):
    return Matrix([list(column) for column in columns]).T


def same_span(a, b):
    """Whether two bases in symbols span the same space, wherever the symbols are."""
    return a.rank(simplify=True) == b.rank(simplify=True) == a.row_join(b).rank(simplify=True)


def test_2013_01_09_2b_planar_4r_is_singular_where_all_links_are_in_line():
    found = find_singularities(planar(1, 1, 1, 1), XY)
    assert ranks(found) == wanted(found.robot, rank_1="q2 = 0 | pi; q3 = 0 | pi; q4 = 0 | pi")
    assert (found.complete, found.free_joints) == (True, ("q1",))


def test_2012_09_10_6_angular_velocities_of_a_3r_arm_have_rank_2_everywhere():
    """The printed second coefficient, q̇1 + q̇2, is an erratum: it is q̇2 + q̇3."""
    robot = robot_from_dh([("R", 0.2, H, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    found, J = find_singularities(robot, TURN), formulas(robot, TURN).jacobian
    assert (found.generic_rank, found.branches, found.complete) == (2, (), True)
    assert same_span(J, span((0, 0, 1), (sin(q1), -cos(q1), 0)))
    assert same_span(span(*J.nullspace()), span((0, 1, -1)))
    r1, r2, r3 = real("r1:4")
    assert same(J * Matrix([r1, r2, r3]), r1 * Matrix([0, 0, 1]) + (r2 + r3) * Matrix([sin(q1), -cos(q1), 0]))


def test_2012_06_11_2b_planar_rpr_is_singular_at_q2_0_and_c3_0():
    found = find_singularities(planar_rpr(), XY)
    assert ranks(found) == wanted(found.robot, rank_1="q2 = 0; q3 = -pi/2 | pi/2")
    assert found.complete


def test_2012_06_11_2c_four_subspaces_of_the_planar_rpr_at_q2_0_q3_half_pi():
    branch = at(find_singularities(planar_rpr(), XY), "q2 = 0; q3 = pi/2")
    J = formulas(planar_rpr(), XY).jacobian.subs({q2: 0, q3: sympy.pi / 2})
    assert same_span(branch.formulas.range, span((cos(q1), sin(q1))))
    assert same_span(branch.formulas.left_null, span((sin(q1), -cos(q1))))
    assert same_span(branch.formulas.null, span((1, 0, -1), (1, L, 0)))
    assert same_span(J.T, span((L, -1, L)))


def test_2012_02_09_1b_wrist_with_twists_alpha_and_minus_alpha_is_singular_at_s2_0():
    robot = dh(*TWISTED, alpha=1.0)
    found = find_singularities(robot, TURN)
    assert same(formulas(robot, TURN).determinant, -sin(q2) * sin(alpha) ** 2)
    assert ranks(found) == wanted(robot, rank_2="q2 = 0 | pi")
    assert same_span(at(found, "q2 = 0").formulas.left_null, span((cos(q1), sin(q1), 0)))


def test_2012_02_09_2b_polar_arm_has_rank_1_at_q3_0_and_2_at_s2_0():
    found = find_singularities(dh(*POLAR_ARM), XYZ)
    assert same(formulas(found.robot, XYZ).determinant, sin(q2) * q3**2)
    assert ranks(found) == wanted(found.robot, rank_1="q3 = 0", rank_2="q2 = 0 | pi")
    both = {written(piece.conditions): piece.rank for piece in find_intersections(found).branches}
    assert both == wanted(found.robot, rank_1="q2 = 0 | pi; q3 = 0")


HALF_POLAR = robot_from_dh(POLAR_ARM, lower=[None, None, 0], upper=[None, None, 5])


def test_2012_02_09_3a_a_segment_through_the_axis_of_joint_1_needs_q1_along_it():
    path = line_path([1, 1, 1], [-1, -1, 3])
    assert (path.length, *path(1.732051)) == pytest.approx((3.464102, 0, 0, 2), abs=1e-6)
    lost = at(find_singularities(HALF_POLAR, XYZ), "q2 = pi").formulas.left_null
    assert sympy.solve((lost.T * Matrix([-1, -1, 1]))[0], q1) == [sympy.pi / 4]  # and π more
    v = path.derivative(1.732051)
    along, across = (joint_velocity(HALF_POLAR, XYZ, v, [angle, pi, 1]) for angle in (pi / 4, 0.1))
    assert (along.feasible, across.feasible) == (True, False)
    assert along.qdot == pytest.approx([0, 0.816497, 0.57735], abs=1e-6)


def test_2012_02_09_3a_the_segment_begins_and_ends_with_q1_along_it():
    start, end = (ik_solutions(HALF_POLAR, XYZ, p).q for p in ([1, 1, 1], [-1, -1, 3]))
    assert any(np.allclose(q, [0.785398, 1.570796, 1.414214], atol=1e-6) for q in start)
    assert any(np.allclose(q, [0.785398, 3.757072 - 2 * pi, 2.44949], atol=1e-6) for q in end)


def test_2012_01_11_1c_planar_3r_is_singular_at_s2_0_and_s3_0():
    found = find_singularities(planar(1, 0.5, 0.25), XY)
    assert ranks(found) == wanted(found.robot, rank_1="q2 = 0 | pi; q3 = 0 | pi")
    assert found.complete


def test_2012_01_11_1d_manipulability_of_a_planar_3r_is_the_sum_of_squared_minors_and_knows_no_q1():
    robot = planar(1, 0.5, 0.25)
    squares = sum(minor**2 for minor in formulas(robot, XY).minors.values())
    parts = (l1 * (l2 * sin(q2) + l3 * sin(q2 + q3)), l3 * (l1 * sin(q2 + q3) + l2 * sin(q3)), l2 * l3 * sin(q3))
    assert same(squares, sum(part**2 for part in parts))
    assert q1 not in squares.free_symbols
    assert numbers(robot, [sympy.sqrt(squares)])([0.3, 1.48, 0.24]) == pytest.approx(0.795515, abs=1e-6)


def test_2012_01_11_bonus_manipulability_of_a_planar_3r_is_largest_near_1_48_0_24():
    """The printed maximum is at a point of a grid of 0.02 rad; the gradient leads to the optimum beside it."""
    measure = ManipulabilityObjective(planar(1, 0.5, 0.25), XY)
    best = minimize(lambda q: -measure.value(q), [0, 1, 0], jac=lambda q: -measure.gradient(q), tol=1e-10)
    assert best.x[1:] == pytest.approx([1.470218, 0.24735], abs=1e-5)
    assert -best.fun == pytest.approx(0.795537, abs=1e-6)
    assert measure.value(-best.x) == pytest.approx(-best.fun)
    grid = [(measure.value([0, a, b]), a, b) for a, b in product(np.arange(1.4, 1.6, 0.02), np.arange(0.2, 0.3, 0.02))]
    assert max(grid) == pytest.approx((0.7955, 1.48, 0.24), abs=1e-4)


def test_2011_07_04_5_cable_arm_has_rank_2_with_q2_q3_q4_at_0_inside_its_limits():
    """The matrix printed for frame 2 is the one in base axes; in frame 2 the second row is zero."""
    limits = np.radians([[-150, 150], [-113, 113], [-157, 157], [-50, 180]])
    lower, upper = limits.T
    robot = robot_from_dh(NAMED_CABLE, parameters={"a3": 0.045, "d3": 0.55}, lower=lower, upper=upper)
    in_base = formulas(robot, PositionTask(frame="link4"), point=(0, 0, "L")).jacobian.subs({q2: 0, q3: 0, q4: 0})
    in_two = formulas(robot, PositionTask(frame="link4", reference="link2"), point=(0, 0, "L"))
    J = in_two.jacobian.subs({q2: 0, q3: 0, q4: 0})
    assert same(J, Matrix([[0, L + d3, 0, L], [0, 0, 0, 0], [0, 0, 0, a3]]))
    assert same(in_base, sympy.rot_axis3(-q1) * J)
    assert J.rank() == 2
    assert robot.within_limits([0.3, 0, 0, 0])


def test_2011_07_04_5_cable_arm_is_singular_at_q2_0_q4_0_whatever_the_others():
    tool = np.eye(4)
    tool[2, 3] = 0.35
    found = find_singularities(
        robot_from_dh(NAMED_CABLE, parameters={"a3": 0.045, "d3": 0.55}, tool_placement=tool), XYZ
    )
    assert at(found, "q2 = 0; q4 = 0").free_joints == ("q1", "q3")
    assert any(branch.contains(np.array([0.3, 0, 0, 0])) for branch in found.branches)
    assert found.complete


def test_2011_02_03_2_arm_with_a_shoulder_offset_is_singular_at_the_elbow_and_under_the_shoulder():
    found = find_singularities(offset_arm(), XYZ)
    shoulder = L1 + L2 * cos(q2) + L3 * cos(q2 + q3)
    assert same(formulas(found.robot, PositionTask(reference="tool")).determinant, -L2 * L3 * shoulder * sin(q3))
    assert ranks(found) == wanted(found.robot, rank_2="q3 = 0 | pi", also_2="L1 + L2*cos(q2) + L3*cos(q2 + q3) = 0")


def test_2011_02_03_3_no_rotation_of_the_offset_arm_is_about_the_horizontal_axis_in_its_plane():
    found, J = find_singularities(offset_arm(), TURN), formulas(offset_arm(), TURN).jacobian
    assert (found.generic_rank, found.branches) == (2, ())
    assert same_span(span(*J.T.nullspace()), span((cos(q1), sin(q1), 0)))
    assert "the rank of its Jacobian is 2 everywhere" in found.explain()


def test_2010_06_15_1a_the_height_of_an_rp_arm_is_singular_at_s1_0_and_q2_0():
    robot = robot_from_dh([("R", 0, H, 0, H), ("P", 0, 0, 0, 0)])
    found = find_singularities(robot, PositionTask("y"))
    assert ranks(found) == wanted(robot, rank_0="q1 = 0 | pi; q2 = 0")


def test_2010_02_11_d_folded_2r_reaches_a_tangent_along_y_with_least_joint_speed():
    answer = joint_velocity(planar(0.6, 0.5), XY, [0, 1], [0, -pi])
    assert answer.feasible
    assert answer.rank == 1
    assert answer.qdot == pytest.approx(np.array([0.1, -0.5]) / 0.26, abs=1e-12)


def test_2009_12_17_2_and_5_spatial_4r_realises_the_twist_and_its_linear_part_has_rank_3():
    robot, q = dh(*SPATIAL_4R, L=1.0), [0, 3 * pi / 4, pi, pi]
    whole, linear = (subspaces(task.jacobian(robot, q)) for task in (PoseTask(), XYZ))
    assert (whole.rank, linear.rank) == (4, 3)
    assert whole.contains([0, 0, -1, 0, -0.707107, 0])  # to its six digits
    assert linear.singular_values == pytest.approx([1.618034, 1, 0.618034], abs=1e-6)
    assert not any(branch.contains(np.array(q)) for branch in find_singularities(robot, XYZ).branches)


def test_2009_09_10_b_an_arm_on_a_synchro_drive_loses_rank_only_with_the_wheels_in_or_across_its_plane(
    tmp_path,
):
    """At rest, way = 0, the wheels' angle th moves nothing: q1, ..., q5 are th, way, and the joints of the arm.

    The shoulder singularity, 2 q4 + q5 = π with equal links, is made up for unless the wheels roll in the arm's plane;
    the stretched one unless they roll across it; an upright or hanging, stretched or folded arm never is.
    """
    path = tmp_path / "mobile.urdf"
    path.write_text(MOBILE, encoding="utf-8")
    found = find_singularities(load_robot(path), XYZ, box={"way": (0, 0)})
    double = "q4 = -pi/2 | pi/2; q5 = 0 | pi"
    folded, in_plane = "q2 = 0; q5 = pi", "q3 - q1 = 0 | pi; q2 = 0; 2*q4 + q5 = pi"
    across = "q3 - q1 = -pi/2 | pi/2; q2 = 0; q5 = 0"
    assert ranks(found) == wanted(found.robot, a_2=double, b_2=folded, c_2=in_plane, d_2=across)
    assert found.complete


@pytest.mark.parametrize(
    ("q", "least"),
    [
        ([0.3, 0, 1.0, 0.7, pi - 1.4], 0.241983),
        ([1.0, 0, 1.0, 0.7, pi - 1.4], 0),
        ([0.3, 0, 1.0, 0.7, 0], 0.340084),
        ([1.0 + H, 0, 1.0, 0.7, 0], 0),
    ],
)
def test_2009_09_10_b_smallest_singular_value_of_the_arm_on_a_synchro_drive(tmp_path, q, least):
    path = tmp_path / "mobile.urdf"
    path.write_text(MOBILE, encoding="utf-8")
    values = subspaces(XYZ.jacobian(load_robot(path), q)).singular_values
    assert values[-1] == pytest.approx(least, abs=1e-6)


def test_2009_06_10_b1_planar_prp_is_singular_at_s2_0_and_q3_0():
    found = find_singularities(prp(), XY)
    assert ranks(found) == wanted(found.robot, rank_1="q2 = 0 | pi; q3 = 0")
    assert same(formulas(prp(), XY).jacobian, Matrix([[0, q3 * cos(q2), sin(q2)], [1, q3 * sin(q2), -cos(q2)]]))


@pytest.mark.parametrize(("text", "sign"), [("q2 = 0; q3 = 0", -1), ("q2 = pi; q3 = 0", 1)])
def test_2009_06_10_b2_four_subspaces_of_the_planar_prp_where_it_is_singular(text, sign):
    branch = at(find_singularities(prp(), XY), text)
    assert same_span(branch.formulas.range, span((0, 1)))
    assert same_span(branch.formulas.left_null, span((1, 0)))
    assert same_span(branch.formulas.null, span((0, 1, 0), (1, 0, -sign)))
    assert spans_range(np.array([[1.0], [0], [sign]]), branch.jacobian(branch.q).T)


def test_2011_06_17_c_tip_velocities_of_a_stretched_2r_with_bounded_joint_speeds_are_a_segment():
    """The vertices of the box of joint speeds, mapped by J; the area |det J| 4 q̇1 q̇2 is zero."""
    J = XY.jacobian(planar(3, 2), [pi / 6, 0])
    vertices = np.array(list(product((-1, 1), (-1.5, 1.5)))) @ J.T
    printed = np.array([[-4, 6.9282], [1, -1.7321], [4, -6.9282], [-1, 1.7321]])
    assert sorted(map(tuple, vertices.round(4).tolist())) == sorted(map(tuple, printed.tolist()))
    assert J == pytest.approx(np.array([[-2.5, -1], [4.3301, 1.7321]]), abs=1e-4)
    assert np.linalg.norm(vertices, axis=1).max() == pytest.approx(8)
    assert np.linalg.det(J) == pytest.approx(0, abs=1e-12)
    assert at(find_singularities(planar(3, 2), XY), "q2 = 0").rank == 1
