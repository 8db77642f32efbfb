"""MJCF, the model format of MuJoCo, to the mechanism."""
