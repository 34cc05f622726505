"""Paths: curves p(s), rotations R(s) and poses T(s) with their derivatives with respect to s, and no time in them."""
