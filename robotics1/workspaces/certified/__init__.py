"""The extremes of a distance over all configurations of an arm, between two bounds."""
