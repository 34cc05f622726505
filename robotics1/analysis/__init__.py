"""What a Jacobian says: its subspaces, its singularities, the forces it balances."""
