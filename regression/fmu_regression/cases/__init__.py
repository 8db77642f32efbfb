"""Regression cases: reading them and running them."""
