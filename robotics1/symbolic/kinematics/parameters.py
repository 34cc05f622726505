"""How the numbers of a robot's file depend on its named parameters.

The file is expanded again at other values, and each number is fitted by a polynomial of degree one, else two, which a
further expansion must confirm.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations_with_replacement

import numpy as np
import numpy.typing as npt

from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.robot.checking import children, linked
from robotics1.robot.markup import Element, parse_xml
from robotics1.robot.model import Robot

HIGHEST_DEGREE = 2
CONFIRMS = 1e-9  # difference of a fitted and an expanded number that is rounding

Monomial = tuple[str, ...]  # the names that are multiplied; () is the constant


@dataclass(frozen=True)
class JointNumbers:
    """A joint on the way to a frame, each number as monomial → coefficient.

    Attributes:
        name, kind: of the joint.
        xyz, rpy: its placement in the parent link [m, rad].
        axis: its unit axis.
        leader: the joint whose value it has.
        multiplier, offset: of a mimicking joint.
    """

    name: str
    kind: str
    xyz: tuple[dict[Monomial, float], ...]
    rpy: tuple[dict[Monomial, float], ...]
    axis: Array
    leader: str
    multiplier: float = 1.0
    offset: float = 0.0


@lru_cache(maxsize=16)
def joints_to(robot: Robot, frame: str) -> tuple[JointNumbers, ...]:
    """Return the joints from the root to a link, with their numbers as polynomials of the robot's parameters.

    Raises:
        FormulaError: a number is no polynomial of degree two in the parameters, or an axis depends on them.
    """
    joints = _path(robot, frame)
    base = _numbers(joints)
    names = tuple(robot.parameters)
    coefficients = _fit(robot, frame, names, base) if names else {(): base}
    found = []
    for i, joint in enumerate(joints):
        polynomials = [{m: c[i, n] for m, c in coefficients.items() if c[i, n] != 0} for n in range(9)]
        if any(m for polynomial in polynomials[6:] for m in polynomial):
            raise FormulaError(f"the axis of joint {joint.get('name')!r} depends on a parameter")
        mimic = joint.find("mimic")
        found.append(
            JointNumbers(
                name=joint.get("name", ""),
                kind=joint.get("type", "").replace("continuous", "revolute"),
                xyz=tuple(polynomials[:3]),
                rpy=tuple(polynomials[3:6]),
                axis=base[i, 6:],
                leader=joint.get("name", "") if mimic is None else mimic.get("joint", ""),
                multiplier=1.0 if mimic is None else float(mimic.get("multiplier", 1.0)),
                offset=0.0 if mimic is None else float(mimic.get("offset", 0.0)),
            )
        )
    return tuple(found)


def _path(robot: Robot, frame: str) -> list[Element]:
    """Return the joints from the root to a link."""
    root = parse_xml(robot.urdf, robot.path)
    above = {linked(joint, "child"): joint for joint in children(root, "joint")}
    path: list[Element] = []
    link: str | None = frame
    while link in above:
        path.append(above[link])
        link = linked(above[link], "parent")
    return path[::-1]


def _numbers(joints: list[Element]) -> Array:
    """Return xyz, rpy and axis of each joint, (k, 9)."""
    rows = []
    for joint in joints:
        origin, axis = joint.find("origin"), joint.find("axis")
        texts = ["0 0 0", "0 0 0"] if origin is None else [origin.get("xyz", "0 0 0"), origin.get("rpy", "0 0 0")]
        texts.append("1 0 0" if axis is None else axis.get("xyz", "1 0 0"))
        rows.append([float(value) for text in texts for value in text.split()])
    return np.array(rows).reshape(-1, 9)


def _fit(robot: Robot, frame: str, names: tuple[str, ...], base: Array) -> dict[Monomial, Array]:
    """Return monomial → coefficients (k, 9), of the lowest degree that is confirmed."""
    for degree in range(1, HIGHEST_DEGREE + 1):
        fitted, wrong = _fit_of_degree(degree, robot, frame, names, base)
        if not wrong.any():
            return fitted
    joint, number = divmod(int(np.argmax(wrong)), 9)
    attribute = ("xyz", "rpy", "axis")[number // 3]
    name = _path(robot, frame)[joint].get("name")
    raise FormulaError(f"{attribute} of joint {name!r} is no polynomial of degree {HIGHEST_DEGREE} in the parameters")


def _fit_of_degree(
    degree: int, robot: Robot, frame: str, names: tuple[str, ...], base: Array
) -> tuple[dict[Monomial, Array], npt.NDArray[np.bool_]]:
    """Return monomial → coefficients (k, 9), and which numbers one more point contradicts."""
    monomials = [m for d in range(degree + 1) for m in combinations_with_replacement(names, d)]
    rng = np.random.default_rng(0)
    centre = np.array([robot.parameters[name] for name in names])
    spread = np.where(centre == 0, 1.0, np.abs(centre))
    others = centre + spread * rng.uniform(0.1, 0.9, (len(monomials), len(names)))
    values = [_numbers(_path(robot.with_parameters(dict(zip(names, p, strict=True))), frame)) for p in others]
    if any(value.shape != base.shape for value in values):
        raise FormulaError("the joints themselves depend on a parameter")
    points = [centre, *others]
    matrix = np.array([[np.prod([p[names.index(name)] for name in m]) for m in monomials] for p in points])
    flat = np.array([base, *values]).reshape(len(points), -1)
    solution = np.linalg.lstsq(matrix[:-1], flat[:-1], rcond=None)[0]
    wrong = np.abs(matrix @ solution - flat).max(axis=0) > CONFIRMS
    solution = np.where(np.abs(solution) < CONFIRMS, 0.0, solution).reshape(len(monomials), *base.shape)
    rounded = np.round(solution, 9)
    solution = np.where(np.abs(solution - rounded) < CONFIRMS / 10, rounded, solution)
    return dict(zip(monomials, solution, strict=True)), wrong
