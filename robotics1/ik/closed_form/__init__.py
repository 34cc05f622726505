"""Inverse kinematics in closed form: formulas with the target's and the lengths' names."""
