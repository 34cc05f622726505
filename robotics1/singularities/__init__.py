"""What a Jacobian says: its subspaces, the forces it balances, where it loses rank, and how near to that it is."""
