"""Motions made of polynomials: one, one after the other, and as formulas."""
