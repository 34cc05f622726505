"""Orientation: rotations as matrices, angles, axes and quaternions, and their rates."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
