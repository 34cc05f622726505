"""A point that is fixed to a link, as one more frame of the robot."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy

from robotics1.errors import InputError
from robotics1.orientation.expressions import expressions
from robotics1.robot.assembly import free_link_name, with_tip
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot
from robotics1.robot.parameters import (
    HIGHEST_DEGREE,
    Monomial,
    Parameters,
    Placement,
    Placements,
    placement_of,
    with_values,
)

UNVALUED = 1.0  # the length that a name without a value stands for [m]


def with_point(
    robot: Robot, frame: str | None, point: Any, parameters: Mapping[str, float] | None = None
) -> tuple[Robot, str]:
    """Return the robot with a frame at a point of a link, and the name of that frame.

    The frame has the axes of the link. Names of coordinates that are no parameters of the robot become some.

    Args:
        robot: the robot.
        frame: the link, or None for the tool.
        point: (3,) coordinates in the link's axes [m]: numbers, names, or polynomials of names.
        parameters: further names and values that the robot shall have as parameters.

    Raises:
        InputError: the point is no such thing.
        UnknownNameError: there is no such frame.
    """
    link = robot.link_of(frame)
    coordinates = _coordinates(point)
    names = sorted({symbol.name for x in coordinates for symbol in x.free_symbols})
    home = {**dict.fromkeys(names, UNVALUED), **(parameters or {}), **robot.parameters}
    name = free_link_name(robot, "point")
    return RobotWithPoint(robot, link, name, tuple(coordinates), Parameters(home)).with_parameters({}), name


@dataclass(frozen=True)
class RobotWithPoint:
    """What a robot with a point on a link is made from.

    Attributes:
        robot: the robot without the point.
        link, name: the link, and the frame at the point.
        coordinates: (x, y, z) of the point in the link's axes [m], of real symbols.
        parameters: the values of the robot's parameters and of the symbols.
    """

    robot: Robot
    link: str
    name: str
    coordinates: tuple[sympy.Expr, ...]
    parameters: Mapping[str, float]

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot with the point, at these values; the others stay."""
        at = with_values(f"robot {self.robot.name!r}", self.parameters, values)
        own = {key: value for key, value in values.items() if key in self.robot.parameters}
        robot = self.robot.with_parameters(own) if own else self.robot
        numbers = {sympy.Symbol(key, real=True): value for key, value in at.items()}
        x, y, z = (float(coordinate.xreplace(numbers)) for coordinate in self.coordinates)
        found = with_tip(robot, Joint(f"{self.name}_joint", "fixed", self.link, self.name, (x, y, z)))
        return replace(found, parameters=at, source=replace(self, robot=robot, parameters=at))

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the joints as polynomials in these parameters; the point's are its coordinates."""
        names = [sympy.Symbol(key, real=True) for key in self.parameters]
        polynomials = [sympy.Poly(x, *names) for x in self.coordinates]
        joint = f"{self.name}_joint"
        point: Placement | str = f"xyz of joint {joint!r} is no polynomial of degree {HIGHEST_DEGREE} in the parameters"
        if all(x.total_degree() <= HIGHEST_DEGREE for x in polynomials):
            xyz = [{_monomial(names, powers): float(c) for powers, c in x.terms()} for x in polynomials]
            point = placement_of([*xyz, {}, {}, {}])
        return {**self.robot.placements, joint: point}


def _monomial(names: Sequence[sympy.Symbol], powers: Sequence[int]) -> Monomial:
    return tuple(name.name for name, power in zip(names, powers, strict=True) for _ in range(power))


def _coordinates(point: Any) -> list[sympy.Expr]:
    """Return the coordinates as expressions of real symbols."""
    entries = [sympy.sympify(x) for x in expressions("point", point, (3,), "[m]")]
    symbols = {symbol for x in entries for symbol in x.free_symbols}
    for symbol in symbols:
        if re.fullmatch(r"q(dot)?\d+", symbol.name):
            raise InputError(
                f"point cannot depend on {symbol.name}: q1, q2, ... are the joints, and the point is fixed"
            )
    if not all(x.is_polynomial(*symbols) for x in entries):
        raise InputError(
            f"the coordinates of point must be numbers, names, or polynomials of names; they are {entries}"
        )
    real = {symbol: sympy.Symbol(symbol.name, real=True) for symbol in symbols}
    return [x.xreplace(real) for x in entries]
