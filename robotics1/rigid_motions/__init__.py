"""Rigid motions: twists and wrenches in any frame, screws, and the exponential that joins them to poses."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
