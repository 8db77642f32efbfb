"""What no figure tells: which model of contact each program has, and what it therefore cannot show."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

_RESTITUTION: Final = (
    "Restitution: here it is a coefficient, delivered by the damping that the speed of each impact asks for. MuJoCo's "
    "spring and damper is given the damping ratio that delivers 0.7 at any speed. Drake's Hunt-Crossley law has a "
    "dissipation in s/m, set so that the first impact is exact; later ones, which are slower, rebound higher. Bullet "
    "takes a coefficient, but uses up a part of the rebound for what is left of the gap at the beginning of the step."
)
_FRICTION: Final = (
    "Friction: MuJoCo's and Drake's are regularised, so that a body that should stand creeps; Bullet and anchored "
    "friction here hold. Drake has one contact point for a box on a half space; the box is given points at its "
    "corners, or hydroelastic contact, whose modulus gives its lower face the stiffness."
)

NOTES: Final[Mapping[str, tuple[str, ...]]] = {
    "ball, first apex": (_RESTITUTION,),
    "ball, three impacts": (_RESTITUTION,),
    "block that stops": (_FRICTION,),
    "creep on an incline": (_FRICTION,),
    "stack of five boxes": (
        "Each program has its own stiffness, and rigid boxes are the reference: what is compressed counts as error.",
    ),
    "Newton's cradle": (
        "The balls stand 1 mm apart, so that impacts follow each other and rigid impacts have one outcome.",
    ),
}
"""By the scene's name."""
