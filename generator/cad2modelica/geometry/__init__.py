"""Solids, meshes, hulls and distances: geometry that knows nothing of mechanisms."""
