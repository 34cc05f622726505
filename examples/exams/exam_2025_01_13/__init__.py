"""Robotics 1, exam of 13 January 2025: its answers, its formulas, and what its solution published."""
