"""Denavit–Hartenberg tables: to a robot, to a URDF file, and back from a robot."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
