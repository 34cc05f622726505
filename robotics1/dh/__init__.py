"""Denavit–Hartenberg tables: to a robot, to a URDF file, and back from a robot."""
