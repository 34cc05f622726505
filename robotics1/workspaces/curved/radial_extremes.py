"""The smallest and the largest distance from the first joint's axis, and all configurations that attain them."""

from collections.abc import Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.axes import distinct
from robotics1.workspaces.curved.curved_section import CurvedSection
from robotics1.workspaces.curved.image_curves import ImageCurve
from robotics1.workspaces.curved.singular_curves import onto_singular

SAME = 1e-9  # of distances that are alike, when the arm is one long
SAME_CONFIGURATION = 1e-5  # rad or m


def extreme_radius(section: CurvedSection, images: Sequence[ImageCurve], *, largest: bool) -> tuple[float, Array]:
    """Return the distance [m] and the configurations (k, nq).

    The smallest and the largest distance are attained on critical curves; but for the centre, where it is inside.
    """
    centre = np.zeros(2)
    if not largest and not section.arm.mapped.about_axis and section.counts(centre[None])[0]:
        found = section.solutions(centre)
        return 0.0, np.array([section.arm.configuration(q, _base(section)) for q in found])
    values: list[float] = []
    places: list[Array] = []
    for image in images:
        t = _stationary(image)
        q = image.q(t)
        if image.curve.limit is None:
            q = onto_singular(image.mapped, q)
        z = image.mapped.image(q)
        values += list(z[:, 0] if image.mapped.about_axis else np.linalg.norm(z, axis=1))
        places += list(q)
    best = max(values) if largest else min(values)
    best = 0.0 if best < SAME else best
    near = np.array([q for value, q in zip(values, places, strict=True) if abs(value - best) < SAME])
    kept = near[distinct(near, section.arm.domain.circular, SAME_CONFIGURATION)]
    return best * section.arm.size, np.array([section.arm.configuration(q, _base(section)) for q in kept])


def _base(section: CurvedSection) -> float | None:
    base = section.place.base
    return None if base is None else float(np.clip(0.0, base.lower, base.upper))


def _stationary(image: ImageCurve) -> Array:
    """Return t of the ends of a curve and of where the distance does not change; the middle, if it never does."""
    knots = image.knots
    t = np.concatenate([knots, (knots[1:] + knots[:-1]) / 2])
    t.sort()

    def rate(s: Array) -> Array:
        v = image.velocity(s)
        return v[:, 0] if image.mapped.about_axis else (v * image.at(s)).sum(axis=1)

    z = image.at(t)
    radius = z[:, 0] if image.mapped.about_axis else np.linalg.norm(z, axis=1)
    if np.ptp(radius) < SAME:
        return t[len(t) // 2 : len(t) // 2 + 1]
    rates = rate(t)
    changed = np.flatnonzero((rates[1:] > 0) != (rates[:-1] > 0))
    return np.concatenate([t[[0, -1]], image.roots(rate, t[changed], t[changed + 1])])
