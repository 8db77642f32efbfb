"""Sorts scalar equations into steps that compute one unknown or one block after the other."""
