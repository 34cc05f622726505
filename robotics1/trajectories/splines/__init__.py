"""Polynomials through points in time."""
