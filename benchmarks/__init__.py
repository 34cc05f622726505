"""Benchmarks beside the peers: `python -m benchmarks.inverse_kinematics` and the like, or all with `make bench`."""
