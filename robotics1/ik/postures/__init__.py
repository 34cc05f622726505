"""What the solutions of inverse kinematics mean: their names, and which of them a motion without singularity joins."""
