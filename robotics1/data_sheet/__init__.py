"""The data sheet of an arm: one offline page that answers what is usually asked of it."""
