"""What an arm reaches: the exact boundary, its regions, and the number of solutions in each."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
