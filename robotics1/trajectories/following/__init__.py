"""Inverse differential kinematics, at one state and along a trajectory."""
