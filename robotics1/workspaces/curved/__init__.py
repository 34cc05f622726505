"""Sections whose critical curves are traced: three joints of any kind that move a point in space."""
