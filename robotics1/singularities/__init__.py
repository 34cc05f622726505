"""What follows from a Jacobian: its subspaces, the forces it balances, and where it loses rank, or nearly so."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
