"""The mechanism as the generator knows it, in SI units, and doubts about it."""
