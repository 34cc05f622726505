"""From polynomials to the formulas that a person writes, and to text."""
