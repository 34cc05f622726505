"""What stands in a data sheet, in order, and how long each section may take."""

from collections.abc import Callable
from importlib import import_module
from typing import NamedTuple

from robotics1.data_sheet.asked import Answer, Asked


class Section(NamedTuple):
    """A section of the sheet.

    Attributes:
        name: of its function, and in addresses.
        title: above it.
        module: where its function is.
        seconds: that it may take.
        late: whether it is written after the others, since it may take all of its time.
    """

    name: str
    title: str
    module: str
    seconds: float
    late: bool = False

    @property
    def write(self) -> Callable[[Asked], Answer]:
        """The function that writes it, which has the section's name."""
        function: Callable[[Asked], Answer] = getattr(import_module(f"robotics1.data_sheet.{self.module}"), self.name)
        return function


SECTIONS = (
    Section("scene", "The arm", "scene", 20.0),
    Section("joints", "Joints and limits", "geometry", 5.0),
    Section("dh_tables", "Denavit–Hartenberg tables", "geometry", 5.0),
    Section("direct_kinematics", "Direct kinematics", "kinematics", 10.0, late=True),
    Section("jacobian", "Jacobian", "kinematics", 10.0, late=True),
    Section("determinant", "Determinant", "kinematics", 10.0, late=True),
    Section("singular_set", "Singular set", "kinematics", 15.0, late=True),
    Section("inverse_kinematics", "Inverse kinematics", "inverse", 10.0),
    Section("inverse_formulas", "Inverse kinematics in closed form", "inverse", 10.0, late=True),
    Section("workspace", "Workspace", "reached", 10.0),
    Section("ellipsoids", "Velocity and force", "measures", 8.0),
    Section("scan", "Scan of σ_min: how near to singular", "measures", 25.0),
    Section("origin", "File, warnings, versions", "geometry", 5.0),
)

WRITTEN = sorted(SECTIONS, key=lambda section: section.late)  # in this order
