"""Expands a flattened model to scalar variables, equations and events."""
