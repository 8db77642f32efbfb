"""Holds the flattened model against the sources that it was made from."""
