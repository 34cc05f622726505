"""Sections by cells: arms whose boundary is not known."""
