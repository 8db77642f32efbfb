"""Collision shapes of the parts, and the pairs of bodies that may touch."""
