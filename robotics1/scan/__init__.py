"""Singularity measures over many configurations: sampling, chunks, reductions, and the worst refined."""
