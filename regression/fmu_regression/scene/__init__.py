"""What a scene file says of a mechanism, and motion, energy, impacts and loads by it."""
