"""Simscape Multibody import files, as CAD plug-ins export them."""
