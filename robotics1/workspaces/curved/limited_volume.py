"""The volume that a section sweeps: of a full turn and where there is one solution by moments, else by unions."""

from collections.abc import Sequence
from math import tau

from robotics1.workspaces.curved.curved_section import CurvedSection
from robotics1.workspaces.curved.strip_regions import StripRegion
from robotics1.workspaces.curved.swept_volume import SweptStrips


def volume_with_limits(section: CurvedSection, regions: Sequence[StripRegion]) -> tuple[float | None, float]:
    """Return the volume [m³], None of a task in a plane, and how wrong it may be; 0 if it is as exact as the curves."""
    base, size = section.place.base, section.arm.size
    if base is None:
        return None, 0.0
    reached = [region for region in regions if region.count]
    if base.circular:
        return tau * sum(region.moment for region in reached) * size**3, 0.0
    about = section.place.about_axis
    span = (base.upper - base.lower) / (1.0 if about else size)
    alone = sum(span * (r.moment if about else r.area) for r in reached if r.count == 1)
    several = [strip for region in reached if region.count > 1 for strip in region.strips]
    alike = [[strip for strip in several if strip.count == count] for count in sorted({s.count for s in several})]
    swept = [SweptStrips(section, strips, span).volume() for strips in alike]
    volume, error = (sum(column) for column in zip((alone, 0.0), *swept, strict=True))
    return volume * size**3, error * size**3
