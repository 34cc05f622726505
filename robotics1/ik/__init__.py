"""Inverse kinematics: taught iterations with their table, and every solution."""
