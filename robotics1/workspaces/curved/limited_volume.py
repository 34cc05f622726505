"""The volume that a section sweeps: exact for a full turn, and where there is one solution; else by samples."""

from collections.abc import Sequence
from math import ceil, sqrt, tau

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.curved_section import CurvedSection
from robotics1.workspaces.curved.strip_regions import StripRegion

SAMPLES = (150, 600)  # points of the section, twice


def volume_with_limits(section: CurvedSection, regions: Sequence[StripRegion]) -> tuple[float | None, float]:
    """Return the volume [m³], None of a task in a plane, and by how much two samplings differ; 0 if it is exact."""
    base = section.place.base
    if base is None:
        return None, 0.0
    reached = [region for region in regions if region.count]
    if base.circular:
        return tau * sum(region.moment for region in reached) * section.arm.size**3, 0.0
    about = section.arm.mapped.about_axis
    span = (base.upper - base.lower) / (1.0 if about else section.arm.size)
    alone = sum(span * (r.moment if about else r.area) for r in reached if r.count == 1)
    several = [region for region in reached if region.count > 1]
    area = sum(region.area for region in several)
    if not several:
        return alone * section.arm.size**3, 0.0
    found = [alone + sum(_swept(section, r, ceil(count * r.area / area)) for r in several) for count in SAMPLES]
    return found[1] * section.arm.size**3, abs(found[1] - found[0]) * section.arm.size**3


def _swept(section: CurvedSection, region: StripRegion, count: int) -> float:
    """Return the mean of what the base sweeps at points of a region, times the region's own measure."""
    points, weights = _samples(section, region, count)
    shares = section.reached_shares(points, region.count)
    about = section.arm.mapped.about_axis
    measure = weights * points[:, 0] if about else weights
    whole = region.moment if about else region.area
    return float((measure * shares).sum() / measure.sum() * whole)


def _samples(section: CurvedSection, region: StripRegion, count: int) -> tuple[Array, Array]:
    """Return points (k, 2) in the middle of cells of the region's strips, and the areas of the cells."""
    pieces, heights = section.strips.pieces, section.strips.heights
    points, weights = [], []
    rows = max(1.0, sqrt(count))
    extent = sum(float(heights[s.level + 1] - heights[s.level]) for s in region.strips)
    for strip in region.strips:
        if strip.left is None or strip.right is None:
            continue
        low, high = heights[strip.level : strip.level + 2]
        n = max(1, round(rows * 2 * (high - low) / extent))
        up = low + (np.arange(n) + 0.5) / n * (high - low)
        left, right = (pieces[i].place(pieces[i].parameter(up)) for i in (strip.left, strip.right))
        width = np.linalg.norm(right - left, axis=1)
        m = max(1, ceil(count * float(width.mean() * (high - low)) / (region.area * n)))
        share = (np.arange(m) + 0.5) / m
        points.append((left[:, None] + share[None, :, None] * (right - left)[:, None]).reshape(-1, 2))
        weights.append(np.repeat(width * (high - low) / (n * m), m))
    return np.vstack(points), np.concatenate(weights)
