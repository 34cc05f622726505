"""The exact extremes of motions, of their coordinates and of norms."""
