"""A task's value, Jacobian, determinant and minors as formulas, compared with Pinocchio."""
