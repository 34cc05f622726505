"""Kinematic control: feedback laws of first and second order, their errors, gains and simulation."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
