"""Mesh files to triangles: STL, OBJ, COLLADA and VRML97."""
