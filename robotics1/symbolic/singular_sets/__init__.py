"""Where minors vanish together: the pieces, their configurations, and the bases that hold on all of a piece."""
