"""Writes what the front end refuses so that it takes it: the same model, in the same lines."""
