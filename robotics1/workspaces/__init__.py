"""What an arm reaches: the exact boundary with its regions, and maps of many poses."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
