"""Orientation: rotations as matrices, angles, axes and quaternions, and their rates."""
