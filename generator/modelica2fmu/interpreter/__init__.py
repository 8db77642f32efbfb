"""Evaluates Modelica expressions and functions on values that may be symbolic."""
