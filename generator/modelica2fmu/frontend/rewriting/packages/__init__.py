"""Packages that extend others with modifiers, written out with what they inherit."""
