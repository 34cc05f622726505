"""Timing laws: velocity profiles and sines."""
