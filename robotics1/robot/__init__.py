"""From a file to a `Robot`."""
