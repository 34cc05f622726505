"""Motions in time: polynomials of the joints, the target's motion, and meeting it."""
