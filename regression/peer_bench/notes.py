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
        "Where the time goes here (1e6 N/m, tolerance 1e-4): 808 of 890 steps and nine tenths of the time lie in the "
        "first 0.1 s, while the boxes strike each other: error control follows each stroke with small steps, with a "
        "Jacobian of 95 states every ten steps. From 0.5 s on one step fills an output interval and costs 0.1 ms; a "
        "program of fixed steps goes on paying for all of them: the longer boxes stand, the cheaper they are here.",
    ),
    "Newton's cradle": (
        "The balls stand 1 mm apart, so that impacts follow each other and rigid impacts have one outcome.",
    ),
    "row of dominoes": (
        "Programs agree on the course but not on digits: each has its own contact law, so that each is measured "
        "against itself. The error is that of solver and step alone.",
    ),
    "hexapod": (
        "The same bodies, servos and gait; feet are points of 2e4 N/m here and in Drake, of MuJoCo's default "
        "compliance and of about the same one, and rigid in Bullet. Friction has a slip speed of 1e-2 m/s here and in "
        "Drake. Joint damping is treated implicitly by MuJoCo's and Drake's discrete solvers and by the solver here, "
        "explicitly by Bullet, which needs small steps for it.",
    ),
    "hundred spheres": (
        "Spheres run into each other, which no program reproduces sphere by sphere: the mean over all is compared.",
        "Where the time goes here (tolerance 1e-3): 3287 explicit steps of 4 evaluations, each of 37 µs, 1300 states. "
        "One step serves all spheres, so that every impact of any of them shortens the step of all; peers take a few "
        "hundred steps whatever collides, and resolve impacts within a step.",
    ),
}
"""By the scene's name."""
