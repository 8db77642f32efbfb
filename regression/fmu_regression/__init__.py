"""Simulating FMUs, comparing their results with references, and reports."""
