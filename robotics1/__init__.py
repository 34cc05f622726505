"""Kinematics of robot arms, answered as a good textbook would: the number, the formula, the verdict, the picture.

At the top are the names that most questions need. The others are in namespaces: `curves`, `trajectories`,
`orientation`, `rigid_motions`, `singularities`, `ik`, `workspaces`, `dh`, `textbook_robots`, `plots`, `tasks`,
`redundancy` and `control`.
`__init__.pyi` lists them; each is imported when it is first used, so that `import robotics1` is quick. A name of a
namespace is found at the top too: `robotics1.solve_trig` is `robotics1.ik.solve_trig`.
"""

from typing import Any

import lazy_loader

_at_the_top, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

# The namespaces read their lists of names here, in one thread: see `syntax`.
from robotics1 import (  # noqa: E402
    control,
    curves,
    dh,
    ik,
    orientation,
    plots,
    redundancy,
    rigid_motions,
    singularities,
    tasks,
    textbook_robots,
    trajectories,
    workspaces,
)

SPACES = (
    tasks, curves, trajectories, orientation, rigid_motions, singularities, ik, workspaces, dh, textbook_robots, plots,
    redundancy, control,
)  # fmt: skip


def __getattr__(name: str) -> Any:
    try:
        return _at_the_top(name)
    except AttributeError:
        for space in SPACES:
            if name in space.__all__:
                return getattr(space, name)
        raise
