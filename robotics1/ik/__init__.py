"""Inverse kinematics: taught iterations with their table, and every solution."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
