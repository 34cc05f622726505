"""Curves of one variable: paths, orientations, poses, laws and motions."""
