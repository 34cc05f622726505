"""xacro → URDF: a file's expressions, the files it reads, and the expansion that joins them."""
