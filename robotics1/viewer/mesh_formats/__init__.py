"""From the bytes of a mesh file to triangles: the formats, their colours, and the files that they name."""
