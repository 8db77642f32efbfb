"""Simulated time paced by a monotonic clock."""
