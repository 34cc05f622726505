"""Exams solved end to end; every published value is compared with the computed one."""
