"""Formulas: the robot in SymPy, built from the same file as its numbers."""
