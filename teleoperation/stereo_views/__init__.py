"""Geometry and colour of pictures for one eye and for two: cameras, disparity, anaglyphs."""
