"""Motions made of others: a path with a timing law, one after the other, side by side, in another time."""
