"""The mechanism as a Modelica package and ``scene.json``."""
