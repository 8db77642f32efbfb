"""The page on which observers see constellations and answer, and the server behind it."""
