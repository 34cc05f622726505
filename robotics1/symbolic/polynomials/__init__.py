"""Trigonometric polynomials: arithmetic, factors, numbers, determinants."""
