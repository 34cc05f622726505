"""Tasks: r = f(q), its Jacobian, and the error to a target."""
