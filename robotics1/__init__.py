"""Kinematics of robot arms, answered as a good textbook would: the number, the formula, the verdict, the picture.

At the top are the names that most questions need. The others are in namespaces: `curves`, `trajectories`,
`orientation`, `singularities`, `ik`, `dh`, `plots` and `control`. `__init__.pyi` lists them; each is imported when it
is first used, so that `import robotics1` is quick.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

# The namespaces read their lists of names here, in one thread: see `syntax`.
from robotics1 import curves, dh, ik, orientation, plots, singularities, trajectories  # noqa: E402, F401
