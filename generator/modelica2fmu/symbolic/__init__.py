"""Scalar expressions: operations, derivatives, linear forms."""
