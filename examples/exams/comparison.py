"""Whether a printed value and a computed one agree, and nothing looser."""

from dataclasses import dataclass, field
from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal
from typing import Any

import numpy as np
import numpy.typing as npt

from .symbolic_equality import are_equal, formula_of

DECIMALS = 4  # to which a number printed without decimals is held


@dataclass(frozen=True)
class Check:
    """A published value beside the computed one.

    Attributes:
        exercise: such as "2a".
        name: what it is; unique in an exam.
        printed: as published; a formula in SymPy's spelling.
        computed: the computed number; of a formula, its text.
        agreement: "rounded", "truncated", "formula", "word", "erratum" (a known print error), or None.
    """

    exercise: str
    name: str
    printed: str
    computed: float | str
    agreement: str | None

    @property
    def holds(self) -> bool:
        """Whether the published value is reproduced."""
        return self.agreement is not None


@dataclass
class Comparison:
    """The checks of an exam, one after the other.

    Attributes:
        errata: names of the values whose printed sign is known to be wrong.
    """

    errata: frozenset[str] = frozenset()
    checks: list[Check] = field(default_factory=list)

    def numbers(self, exercise: str, name: str, printed: str, computed: npt.ArrayLike) -> None:
        """Compare one printed number, or a row of them separated by blanks, with the computed ones."""
        texts, values = printed.split(), np.atleast_1d(np.asarray(computed, dtype=float))
        if len(texts) != len(values):
            raise ValueError(f"{name}: {len(texts)} numbers are printed and {len(values)} computed")
        for i, (text, value) in enumerate(zip(texts, values, strict=True), start=1):
            full = name if len(texts) == 1 else f"{name}[{i}]"
            found = agreement(text, float(value))
            if full in self.errata and found is None and agreement(_opposite(text), float(value)):
                found = "erratum"
            self._add(Check(exercise, full, text, float(value), found))

    def formula(self, exercise: str, name: str, printed: str, computed: Any) -> None:
        """Compare a printed formula, in SymPy's spelling, with the computed one, by symbolic equality."""
        agree = are_equal(formula_of(printed), computed)
        self.compared(exercise, name, printed, " ".join(str(computed).split()), agree)

    def compared(
        self, exercise: str, name: str, printed: str, computed: str, agree: bool, *, kind: str = "formula"
    ) -> None:
        """Add a formula, or words, that were compared already."""
        self._add(Check(exercise, name, printed, computed, kind if agree else None))

    def failures(self) -> list[Check]:
        """Return the checks that do not hold."""
        return [check for check in self.checks if not check.holds]

    def _add(self, check: Check) -> None:
        if any(check.name == other.name for other in self.checks):
            raise ValueError(f"two checks have the name {check.name!r}")
        self.checks.append(check)


def agreement(printed: str, computed: float) -> str | None:
    """Return "rounded" or "truncated" when the computed number, so cut to the printed digits, is the printed one.

    A number printed without decimals stands for an exact one, and is held to four decimals.
    """
    number = Decimal(printed)
    decimals = -int(number.as_tuple().exponent) or DECIMALS
    unit = Decimal(1).scaleb(-decimals)
    exact = Decimal(computed)
    if exact.quantize(unit, ROUND_HALF_UP) == number:
        return "rounded"
    if "." in printed and exact.quantize(unit, ROUND_DOWN) == number:
        return "truncated"
    return None


def _opposite(printed: str) -> str:
    return printed[1:] if printed.startswith("-") else f"-{printed}"
