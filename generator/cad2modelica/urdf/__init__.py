"""Robot descriptions (URDF) to the mechanism."""
