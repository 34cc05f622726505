"""Two joints that move a point in a plane, or in the half plane (ρ, h) that the first joint turns about its axis.

With b(q) = (1, cos q, sin q) of a revolute and (1, q, 0) of a prismatic joint, the point is p = Σ W_ij b_i(x) b_j(y):
a product of exponentials, multiplied out. So its derivatives are those of b.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.axes import Axis
from robotics1.workspaces.placed_section import in_section

ON_AXIS = 1e-9  # ρ of a point on the axis, when the arm is one long


@dataclass(frozen=True, eq=False)
class PlaneMap:
    """The map (x, y) → section, of an arm of unit size.

    Attributes:
        W: (3, 3, 3) coefficients of the point; the third coordinate is along the first joint.
        revolute: whether the two joints turn.
        about_axis: whether the section is (ρ, h), with ρ² = p₁² + p₂² and h = p₃; else it is (p₁, p₂).
    """

    W: Array
    revolute: tuple[bool, bool]
    about_axis: bool

    def point(self, q: Array, order: tuple[int, int] = (0, 0)) -> Array:
        """Return the point, or its derivative of an order in x and y, at q (k, 2): (k, 3)."""
        return self._product(*(_basis(q[:, i], self.revolute[i], order[i]) for i in range(2)))

    def _product(self, b: Array, c: Array) -> Array:
        """Return Σ W_ij b_i c_j, (k, 3), of values (k, 3) of both bases."""
        return np.asarray((b[:, :, None] * c[:, None, :]).reshape(-1, 9) @ self.W.reshape(3, 9).T)

    def image(self, q: Array) -> Array:
        """Return the section's coordinates at q (k, 2): (k, 2)."""
        return in_section(self.point(q), self.about_axis)

    def velocity(self, q: Array, qdot: Array) -> Array:
        """Return the velocity of the section's coordinates: (k, 2)."""
        p = self.point(q)
        v = self.point(q, (1, 0)) * qdot[:, :1] + self.point(q, (0, 1)) * qdot[:, 1:]
        if not self.about_axis:
            return v[:, :2]
        rho = np.hypot(p[:, 0], p[:, 1])
        radial = (p[:, 0] * v[:, 0] + p[:, 1] * v[:, 1]) / np.where(rho > ON_AXIS, rho, 1.0)
        return np.column_stack([np.where(rho > ON_AXIS, radial, 0.0), v[:, 2]])

    def image_and_jacobian(self, q: Array) -> tuple[Array, Array]:
        """Return the section's coordinates (k, 2) and their derivatives by x and y (k, 2, 2)."""
        b, c = ([_basis(q[:, i], self.revolute[i], order) for order in (0, 1)] for i in range(2))
        p, px, py = (self._product(b[i], c[j]) for i, j in ((0, 0), (1, 0), (0, 1)))
        columns = np.stack([px, py], axis=2)
        if not self.about_axis:
            return p[:, :2], columns[:, :2]
        z = in_section(p, True)
        rho = np.where(z[:, :1] > ON_AXIS, z[:, :1], np.inf)
        radial = (p[:, :1] * columns[:, 0] + p[:, 1:2] * columns[:, 1]) / rho
        return z, np.stack([radial, columns[:, 2]], axis=1)

    def determinant(self, q: Array) -> Array:
        """Return det ∂(p₁, p₂)/∂(x, y), or ½ det ∂(ρ², h)/∂(x, y), which is smooth on the axis too: (k,)."""
        _, a, b = self._derivatives(q)
        return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]

    def gradient(self, q: Array) -> Array:
        """Return the gradient of the determinant: (k, 2)."""
        p, (px, py) = self.point(q), (self.point(q, (1, 0)), self.point(q, (0, 1)))
        second = {order: self.point(q, order) for order in ((2, 0), (1, 1), (0, 2))}
        a, b = self._rows(p, px), self._rows(p, py)
        columns = []
        for along, first, to_a, to_b in ((px, (2, 0), px, py), (py, (1, 1), px, py)):
            last = (first[0] - 1, first[1] + 1)
            da = self._rows(p, second[first], (along, to_a))
            db = self._rows(p, second[last], (along, to_b))
            columns.append(da[:, 0] * b[:, 1] + a[:, 0] * db[:, 1] - da[:, 1] * b[:, 0] - a[:, 1] * db[:, 0])
        return np.column_stack(columns)

    def _derivatives(self, q: Array) -> tuple[Array, Array, Array]:
        p = self.point(q)
        return p, self._rows(p, self.point(q, (1, 0))), self._rows(p, self.point(q, (0, 1)))

    def _rows(self, p: Array, v: Array, product: tuple[Array, Array] | None = None) -> Array:
        """Return (p·v in the plane, v₃), with the product of two derivatives added to p·v; or (v₁, v₂)."""
        if not self.about_axis:
            return v[:, :2]
        radial = (p[:, :2] * v[:, :2]).sum(axis=1)
        if product is not None:
            radial = radial + (product[0][:, :2] * product[1][:, :2]).sum(axis=1)
        return np.column_stack([radial, v[:, 2]])


def _basis(q: Array, revolute: bool, order: int) -> Array:
    if revolute:
        turned = q + order * np.pi / 2
        return np.column_stack([np.full(len(q), float(order == 0)), np.cos(turned), np.sin(turned)])
    values = ((1.0, q), (0.0, 1.0), (0.0, 0.0))[order]
    return np.column_stack([np.broadcast_to(v, len(q)) for v in (*values, 0.0)])


def plane_map(joints: Sequence[Axis], tip: Array, frame: Array, origin: Array, size: float, about: bool) -> PlaneMap:
    """Return the map of two joints that move a tip (3,), in a frame (3, 3) of rows and lengths of a size."""
    v = np.zeros((3, 3))
    v[:, 0] = (tip - origin) / size  # columns: 1, and the two functions of y
    tensor = np.zeros((3, 3, 3))
    for i, w in enumerate(_moved(joints[1], v[:, 0], origin, size).T):
        tensor[:, :, i] = _moved(joints[0], w, origin, size, point=i == 0)
    return PlaneMap(np.einsum("da,aij->dij", frame, tensor), (joints[0].revolute, joints[1].revolute), about)


def _moved(joint: Axis, v: Array, origin: Array, size: float, *, point: bool = True) -> Array:
    """Return the columns (3, 3) of 1, cos q, sin q (or of 1, q) of a moved point, or of a moved direction."""
    a = joint.direction
    if not joint.revolute:
        return np.column_stack([v, a if point else np.zeros(3), np.zeros(3)])
    centre = (joint.point - origin) / size if point else np.zeros(3)
    arm = v - centre
    along = a * (a @ arm)
    return np.column_stack([centre + along, arm - along, np.cross(a, arm)])
