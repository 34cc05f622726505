"""Motions in time, and meeting a moving target: every motion is a `Curve` of `robotics1.curves`.

`polynomials`, `sines` and `profiles` (of `ramps`, chosen by `transfer`) go from one state to another, `splines` and
`polynomial_splines` through points. `limits` holds bounds against a motion; `coordination` finds least times of joints
(one `law_kinds` each, by `shortest`), `fastest_along_path` along a path, `scaling` by slowing down. `following` turns a
motion of a task into one of the joints; `meeting` meets a target.
"""
