"""Simulation results: sampled signals with both sides of every event."""
