"""Robots as exam questions give them: a planar arm by its joints and lengths, an arm by its direct kinematics."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
