"""Simulating FMUs: model exchange with CVODE, and co-simulation."""
