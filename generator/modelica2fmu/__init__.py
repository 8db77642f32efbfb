"""Translates Modelica models into FMUs."""
