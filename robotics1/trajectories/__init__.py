"""Motions in time, and meeting a moving target.

`protocols` says what a timing law and a trajectory are; `peaks` finds the largest values of one. Made of polynomials
are `polynomials`, the profiles in `laws` (with the sines), and `splines`; `composition` makes motions of others: a
path with a law, one after the other, side by side, slower. `limits` holds bounds against them: minimum time, time
scaling, violations. `following` turns a motion of a task into one of the joints.
"""
