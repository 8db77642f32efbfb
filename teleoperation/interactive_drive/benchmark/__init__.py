"""Deadlines, latency and jitter, measured without a browser."""
