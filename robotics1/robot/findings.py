"""What a check of a robot file finds, and the small readings that all checks share."""

import math
from dataclasses import dataclass, field, replace

from robotics1.robot.markup import Element

LARGEST = 1e18  # of lengths, angles and factors: sums and products of a few of them stay finite


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong.

    Attributes:
        severe: whether the file cannot be read as a robot; otherwise it is a warning.
        message: what is wrong, and what would be right.
        line: where.
        element: whose name is meant, such as the joint's.
    """

    severe: bool
    message: str
    line: int | None = None
    element: str | None = None

    def __str__(self) -> str:
        return self.message if self.line is None else f"line {self.line}: {self.message}"


@dataclass
class Findings:
    """What has been found so far."""

    found: list[Finding] = field(default_factory=list)

    def error(self, owner: Element, message: str, at: Element | None = None) -> None:
        """Add what makes the file unusable: of a named element, at a part of it."""
        self._add(True, owner, message, at)

    def warn(self, owner: Element, message: str, at: Element | None = None) -> None:
        """Add what is odd but harmless: of a named element, at a part of it."""
        self._add(False, owner, message, at)

    def _add(self, severe: bool, owner: Element, message: str, at: Element | None) -> None:
        line = (owner if at is None else at).line
        self.found.append(Finding(severe, f"{owner.label} {message}", line, owner.get("name")))

    def numbers(
        self, owner: Element, element: Element, attribute: str, count: int = 1, largest: float = LARGEST
    ) -> list[float] | None:
        """Return the numbers of an attribute, or None when it is absent or wrong, which is then said."""
        text = element.get(attribute)
        if text is None:
            return None
        try:
            values = [float(part) for part in text.split()]
        except ValueError:
            values = []
        if "_" in text or not text.isascii():  # Python reads 1_0 as 10, and digits of every script; urdfdom does not
            values = []
        where = "" if element is owner else f" of its <{element.tag}>"
        if len(values) != count:
            wanted = "a number" if count == 1 else f"{count} numbers"
            self.error(owner, f"needs {wanted} in {attribute}{where}, not {text!r}", element)
            return None
        if not all(math.isfinite(value) for value in values):
            self.error(owner, f"has {text!r} in {attribute}{where}; numbers must be finite", element)
            return None
        if max(map(abs, values)) > largest:
            self.error(owner, f"has {text!r} in {attribute}{where}; at most {largest:g} can be computed with", element)
            return None
        return values

    def without_lines(self) -> "Findings":
        """Return the same without lines: those of an expanded xacro are not those of its file."""
        return Findings([replace(finding, line=None) for finding in self.found])

    @property
    def errors(self) -> tuple[Finding, ...]:
        """What makes the file unusable."""
        return tuple(finding for finding in self.found if finding.severe)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """What is odd but harmless."""
        return tuple(finding for finding in self.found if not finding.severe)
