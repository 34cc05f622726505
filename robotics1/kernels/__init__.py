"""Compiled loops over the constants of a chain: for many configurations, or many steps, in a fraction of a second."""
