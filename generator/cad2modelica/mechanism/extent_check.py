"""Whether a mechanism is of a size that contacts can be computed in."""

from __future__ import annotations

import numpy as np
from contact_foundation.errors import Place

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import Assembly
from cad2modelica.source.problems import Problems

FARTHEST = 1e9  # m; the contact engine takes lengths up to it


def require_tractable(assembly: Assembly) -> None:
    """Refuses parts, planes and joints that lie farther away than the contact engine reaches.

    Raises:
        InputError: something does; a ``ProblemList`` if several do.
    """
    problems = Problems(str(assembly.file))

    def check(what: str, points: Array, place: Place) -> None:
        farthest = float(np.abs(points).max(initial=0.0))
        if not farthest <= FARTHEST:
            problems.add(
                f"{what} is {farthest:.4g} m away from the world's origin, farther than {FARTHEST:g} m",
                place,
                "Correct the position, or the unit of length.",
            )

    for part in assembly.parts:
        check(f"part {part.name!r}", part.pose.position, part.place)
        for mesh in (*part.meshes, *(part.collision_meshes or ())):
            check(f"geometry of part {part.name!r}", mesh.vertices, part.place)
    for plane in assembly.planes:
        check(f"plane {plane.name!r}", plane.position, plane.place)
    for joint in assembly.joints:
        check(f"joint {joint.name!r}", joint.origin, joint.place)
    problems.raise_if_any()
