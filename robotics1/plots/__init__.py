"""Figures for print: motions and timing laws against time, paths, velocity and force ellipses."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
