"""Depth study: how strongly the cues of a picture let people see depth, from the design to the evaluated answers."""
