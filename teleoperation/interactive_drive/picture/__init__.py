"""Rows of values as poses and forces for the page."""
