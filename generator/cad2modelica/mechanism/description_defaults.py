"""What descriptions of mechanisms that say nothing of simulation and contact are simulated with."""

from __future__ import annotations

GRAVITY = (0.0, 0.0, -9.81)
"""m/s2, world axes."""
STOP_TIME = 1.0
"""s."""
TOLERANCE = 1e-6
DECOMPOSED_TRIANGLES = 1000
"""Parts of finer geometry collide as hulls of their bodies: several simulators take a collision mesh's convex hull, so
descriptions are written for it, and a robot of thirty finely tessellated links would be decomposed for minutes."""
