"""Bounds: what a motion asks of them, the shortest time under them, and time scaling."""
