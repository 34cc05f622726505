"""Kinematics of robot arms, answered as a good textbook would: the number, the formula, the verdict, the picture.

The public names are listed in `__init__.pyi`; each is imported when it is first used, so that `import robotics1`
is quick.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
