"""Exams solved end to end, and every published value checked."""
