"""Generates C from sorted equations."""
