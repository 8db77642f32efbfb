"""Modelica text, names, and a model as components and connections on a diagram."""
