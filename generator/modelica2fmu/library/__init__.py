"""Finds and reads Modelica sources: models, libraries, annotations, the C that they name."""
