"""What follows from a Jacobian: its subspaces, the forces it balances, and where it loses rank, or nearly so."""
