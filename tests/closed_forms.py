"""Textbook and exam formulas, written by hand: what the package has to agree with. Imports nothing of ours.

Angles [rad], lengths [m]; c23 is cos(q2 + q3), and so on.
"""

from itertools import pairwise
from math import acos, atan2, cos, hypot, pi, sin

import numpy as np

# --- PRR, exam of 13 January 2025, exercise 1


def prr_pose(q, l2, l3):
    """r = (x, y, φ); φ is not wrapped."""
    q1, q2, q3 = q
    return np.array([q1 + l2 * cos(q2) + l3 * cos(q2 + q3), l2 * sin(q2) + l3 * sin(q2 + q3), q2 + q3])


def prr_pose_jacobian(q, l2, l3):
    _, q2, q3 = q
    s2, c2, s23, c23 = sin(q2), cos(q2), sin(q2 + q3), cos(q2 + q3)
    return np.array([[1, -l2 * s2 - l3 * s23, -l3 * s23], [0, l2 * c2 + l3 * c23, l3 * c23], [0, 1, 1]])


def prr_pose_determinant(q, l2, l3):
    return l2 * cos(q[1])


def prr_null(sign, l2):
    """N(J_r) at q2 = sign π/2."""
    return np.array([l2, sign, -sign])


def prr_left_null(sign, q3, l3):
    """N(J_rᵀ) at q2 = sign π/2."""
    return np.array([0, sign, l3 * sin(q3)])


def prr_position_minors(q, l2, l3):
    """det of J_p without its column 1, 2, 3."""
    _, q2, q3 = q
    return np.array([l2 * l3 * sin(q3), l3 * cos(q2 + q3), l2 * cos(q2) + l3 * cos(q2 + q3)])


PRR_POSITION_SINGULAR = ((-pi / 2, 0.0), (-pi / 2, pi), (pi / 2, 0.0), (pi / 2, pi))  # (q2, q3)


def prr_Js_transposed(l2, l3):
    """J_pᵀ at q2 = π/2, q3 = π."""
    return np.array([[1, 0], [l3 - l2, 0], [l3, 0]])


def prr_balancing_torque(fx, l2, l3):
    """τ = −J_sᵀ f, the same for every f_y; for f_x = 3 it is (−3, 3 (l2 − l3), −3 l3)."""
    return fx * np.array([-1, l2 - l3, -l3])


# --- cylindrical, exercise 2


def cylindrical_position(q):
    return np.array([q[2] * cos(q[1]), q[2] * sin(q[1]), q[0]])


def cylindrical_jacobian(q):
    return np.array([[0, -q[2] * sin(q[1]), cos(q[1])], [0, q[2] * cos(q[1]), sin(q[1])], [1, 0, 0]])


def cylindrical_determinant(q):
    return -q[2]


def cylindrical_solutions(p):
    """The two (q1, q2, q3) with q3 ≠ 0: arm forwards and backwards."""
    rho, phi = hypot(p[0], p[1]), atan2(p[1], p[0])
    return np.array([[p[2], phi, rho], [p[2], phi - pi if phi > 0 else phi + pi, -rho]])


# --- planar 2R and 3R, and the same links turning about other axes


def planar_position(q, lengths):
    angles = np.cumsum(q)
    return np.array([np.dot(lengths, np.cos(angles)), np.dot(lengths, np.sin(angles))])


def planar_jacobian(q, lengths):
    """Column i: (−Σ_{k≥i} l_k sin, Σ_{k≥i} l_k cos) of q1 + ... + q_k."""
    angles = np.cumsum(q)
    tails = [np.asarray(lengths) * (np.arange(len(q)) >= i) for i in range(len(q))]
    return np.array([[-tail @ np.sin(angles) for tail in tails], [tail @ np.cos(angles) for tail in tails]])


def two_link_determinant(q, l1, l2):
    return l1 * l2 * sin(q[1])


def three_link_pose_determinant(q, l1, l2):
    return l1 * l2 * sin(q[1])


def two_link_solutions(p, l1, l2):
    """q2 = ±acos((p² − l1² − l2²) / 2 l1 l2), q1 = atan2(y, x) − atan2(l2 s2, l1 + l2 c2): right arm, left arm."""
    c2 = (p[0] ** 2 + p[1] ** 2 - l1**2 - l2**2) / (2 * l1 * l2)
    elbows = (acos(c2), -acos(c2))
    return np.array([[atan2(p[1], p[0]) - atan2(l2 * sin(q2), l1 + l2 * c2), q2] for q2 in elbows])


# --- anthropomorphic 3R: joint 1 upwards, joints 2 and 3 lift


def anthropomorphic_position(q, d1, a2, a3):
    q1, q2, q3 = q
    out = a2 * cos(q2) + a3 * cos(q2 + q3)
    return np.array([out * cos(q1), out * sin(q1), d1 + a2 * sin(q2) + a3 * sin(q2 + q3)])


def anthropomorphic_determinant(q, a2, a3):
    return -a2 * a3 * sin(q[2]) * shoulder(q, a2, a3)


def shoulder(q, a2, a3):
    """a2 c2 + a3 c23: the distance of the tool from the axis of joint 1."""
    return a2 * cos(q[1]) + a3 * cos(q[1] + q[2])


# --- cubics, exercise 3


def cubic_coefficients(q0, q1, T, v0, v1):
    """Ascending in τ = t/T, from the four boundary conditions."""
    return np.array([q0, T * v0, 3 * (q1 - q0) - T * (2 * v0 + v1), -2 * (q1 - q0) + T * (v0 + v1)])


# --- a chain of axes: the spatial test arm of robots/spatial.urdf

SPATIAL_CHAIN = (  # type, origin xyz, origin rpy, axis
    ("R", (0.0, 0.0, 0.3), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    ("P", (0.1, 0.0, 0.2), (0.3, 0.0, 0.0), (0.6, 0.0, 0.8)),
    ("R", (0.3, 0.1, 0.0), (0.0, 0.4, 0.0), (0.0, 0.6, 0.8)),
    ("R", (0.2, 0.0, 0.1), (0.0, 0.0, 0.5), (0.8, -0.6, 0.0)),
    ("R", (0.25, 0.05, 0.0), (0.2, -0.3, 0.1), (0.48, 0.6, 0.64)),
)
SPATIAL_TOOL = ((0.1, -0.05, 0.15), (0.4, 0.2, -0.7))


def rotation(axis, angle):
    """Rodrigues: R = 1 + sin θ [a]× + (1 − cos θ) [a]×²."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + sin(angle) * cross + (1 - cos(angle)) * cross @ cross


def placement(xyz, rpy):
    """The homogeneous matrix of a URDF origin: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    T = np.eye(4)
    T[:3, :3] = rotation((0, 0, 1), rpy[2]) @ rotation((0, 1, 0), rpy[1]) @ rotation((1, 0, 0), rpy[0])
    T[:3, 3] = xyz
    return T


def spatial_pose_and_jacobian(q):
    """T (4, 4), and J (6, 5) with the columns (a × (p − o), a) of a revolute and (a, 0) of a prismatic joint."""
    T, axes = np.eye(4), []
    for (kind, xyz, rpy, axis), value in zip(SPATIAL_CHAIN, q, strict=True):
        T = T @ placement(xyz, rpy)
        axes.append((kind, T[:3, :3] @ axis, T[:3, 3].copy()))
        move = np.eye(4)
        if kind == "R":
            move[:3, :3] = rotation(axis, value)
        else:
            move[:3, 3] = np.multiply(axis, value)
        T = T @ move
    T = T @ placement(*SPATIAL_TOOL)
    p = T[:3, 3]
    columns = [np.r_[np.cross(a, p - o), a] if kind == "R" else np.r_[a, 0, 0, 0] for kind, a, o in axes]
    return T, np.array(columns).T


# --- workspaces


def annulus_area(inner, outer, angle=2 * pi):
    """The area between two circles, or between two rays of an angle."""
    return angle / 2 * (outer**2 - inner**2)


def two_link_area_of_elbow(l1, l2, turn, elbow):
    """The area that a 2R sweeps with one elbow, |q2| from elbow[0] to elbow[1] ≤ π, and a range of q1 up to a turn:
    ∫ |det J| dq1 dq2."""
    return turn * l1 * l2 * (cos(elbow[0]) - cos(elbow[1]))


def two_link_distance(l1, l2, q2):
    """The law of cosines: how far the tip of a 2R is from its base."""
    return hypot(l1 + l2 * cos(q2), l2 * sin(q2))


def two_link_area_both_elbows(l1, l2, first, second):
    """The area of a 2R with |q1| ≤ first ≤ π and |q2| ≤ second < π, by integration over the distance r of the tip.

    At r the tip is on an arc |φ − β| ≤ first, and on its mirror image, |φ + β| ≤ first, with β the angle from the
    first link to the tip; where they overlap, in front or behind the base, they are shorter than 4 first.
    """
    r, weight = gauss_between(two_link_distance(l1, l2, second), l1 + l2, two_link_bends(l1, l2, first))
    beta = np.arccos(np.clip((l1**2 + r**2 - l2**2) / (2 * l1 * r), -1, 1))
    longer = np.minimum(np.minimum(beta, pi - beta), first)
    return float(weight @ (r * np.minimum(2 * first + 2 * longer, 2 * pi)))


def two_link_bends(l1, l2, first):
    """The distances where the arcs of both elbows begin to overlap, before or behind the base: β = first, π − first."""
    found = []
    for beta in (first, pi - first):
        under = l2**2 - (l1 * sin(beta)) ** 2
        if under >= 0:
            found += [l1 * cos(beta) + s * under**0.5 for s in (1, -1)]
    return found


def gauss_between(a, b, bends, pieces=40, order=12):
    """Nodes and weights of Gauss–Legendre from a to b, finer towards both ends of each smooth piece (square roots)."""
    x, w = np.polynomial.legendre.leggauss(order)
    ends = sorted({a, b, *(c for c in bends if a < c < b)})
    nodes, weights = [], []
    for c, d in pairwise(ends):
        t = np.linspace(0, pi, pieces + 1)
        for s, e in pairwise(t):
            u = (s + e) / 2 + (e - s) / 2 * x  # r = middle − half cos u has no square roots at the ends
            nodes.append((c + d) / 2 - (d - c) / 2 * np.cos(u))
            weights.append((d - c) / 2 * np.sin(u) * (e - s) / 2 * w)
    return np.concatenate(nodes), np.concatenate(weights)


def planar_3r_inner_radius(l1, l2, l3):
    """The hole of a planar 3R without limits."""
    return max(abs(l1 - l2) - l3, abs(l2 - l3) - l1, abs(l1 - l3) - l2, 0.0)


def spherical_shell_volume(inner, outer):
    return 4 / 3 * pi * (outer**3 - inner**3)


def volume_beside_the_axis(inner, outer, beside, turn):
    """The volume that a plane annulus about a point of the axis sweeps, at a distance from the axis, by a turn S < π.

    At (u, h) in the plane the point is at ρ² = u² + d², at the angle atan2(d, u) from the plane, and at (−u, h) at π
    less that. So the two ranges begin 2 atan(u/d) apart, and V = ∫∫ u (S + min(S, 2 atan(u/d))) du dh over u > 0.
    """
    kink = beside * np.tan(turn / 2)

    def along(u):
        heights = 2 * (np.sqrt(outer**2 - u**2) - np.sqrt(np.maximum(inner**2 - u**2, 0)))
        return u * (turn + np.minimum(turn, 2 * np.arctan(u / beside))) * heights

    ends = sorted({0.0, inner, outer, *([kink] if kink < outer else [])})
    nodes, weights = np.polynomial.legendre.leggauss(60)
    total = 0.0
    for a, b in pairwise(ends):
        angle = pi / 4 * (1 + nodes)  # u = a + (b − a) sin² is smooth where the heights are like roots
        u = a + (b - a) * np.sin(angle) ** 2
        total += float((weights * along(u) * (b - a) * np.sin(2 * angle)).sum() * pi / 4)
    return total
