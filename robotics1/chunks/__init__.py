"""Work that is cut into chunks: done on one core or on many, written down, and gone on with later."""
