"""Motions in time, and meeting a moving target: every motion is a `Curve` of `robotics1.curves`.

`elementary` and `profiles` (of `ramps`, chosen by `transfer`) go from one state to another, `splines` and
`polynomial_splines` through points. `limits` holds bounds against a motion, `bounds_along_path` turns them into bounds
of a law. `least_time_of_joints` (by `law_kinds`) and `least_time_along_path` find fastest motions, `scaling` slows one
down, or finds its least duration. `following` turns a motion of a task into one of joints, `meeting` meets a target.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
