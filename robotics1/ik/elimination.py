"""Six joints without special geometry: the ways to eliminate all coordinates but one, and which of them prove most."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from robotics1.ik.general_six import Roots, general_loop
from robotics1.ik.joint_chain import FixedChain
from robotics1.ik.two_slides import roots_of_two_slides
from robotics1.inputs import Array

SAMPLES = 5  # poses at which an elimination is tried
BEST = 3  # of them are kept
Way = Callable[[list[Array]], Roots | None]  # placements of the loop, six (4, 4) → candidates


def elimination(chain: FixedChain) -> tuple[str, Callable[[Array], Roots | None] | None]:
    """Return the name and the solver of six joints; no solver if none proves anything at poses of the arm."""
    slides = chain.prismatic
    if sum(slides) == 2:  # the loop begins at a joint that turns
        begins = [(i, flipped) for i in range(6) if not slides[i] for flipped in (False, True)]
        ways: list[Way] = [partial(roots_of_two_slides, prismatic=slides, begin=i, flipped=f) for i, f in begins]
        roots = _best(chain, ways)
        if roots is not None:
            return "elimination to a polynomial", roots
    ways = [partial(_roots_of_a_pencil, prismatic=slides, begin=i) for i in range(6) if not slides[i - 1]]
    return "elimination to an eigenvalue problem", _best(chain, ways)


def _best(chain: FixedChain, ways: list[Way]) -> Callable[[Array], Roots | None] | None:
    """Return the solver that tries those that prove most; None if none proves anything."""
    x = np.random.default_rng(0).uniform(-1, 1, (SAMPLES, 6)) * np.where(chain.prismatic, chain.length or 1.0, np.pi)
    goals = chain.poses_and_jacobians(x)[0]
    found = [[_roots(chain, way, goal) for goal in goals] for way in ways]
    proofs = [sum(roots is not None and roots.proven for roots in row) for row in found]
    best = [ways[k] for k in sorted(range(len(ways)), key=lambda k: -proofs[k]) if proofs[k] > 0][:BEST]

    def roots(goal: Array) -> Roots | None:
        """Return the roots that are proven to be all, or some."""
        some = None
        for way in best:
            found = _roots(chain, way, goal)
            if found is not None and found.proven:
                return found
            some = found if some is None else some
        return some

    return roots if best else None


def _roots(chain: FixedChain, way: Way, goal: Array) -> Roots | None:
    """Return the roots for a goal, lengths in metres."""
    A, unit = chain.loop(goal)
    found = way(A)
    return None if found is None else replace(found, x=chain.in_metres(found.x, unit))


def _roots_of_a_pencil(A: list[Array], prismatic: tuple[bool, ...], begin: int) -> Roots | None:
    """Return the roots of the loop that begins at a joint behind one that turns."""
    A = A[begin:] + A[:begin]
    found = general_loop(A, prismatic[begin:] + prismatic[:begin]).roots(A)
    return None if found is None else replace(found, x=np.roll(found.x, begin, axis=1))
