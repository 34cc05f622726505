"""Sections of planar chains, by arcs and segments: exact."""
