"""How the page's pictures are taken and looked at: lengths in metres."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact_foundation.errors import InputError


@dataclass(frozen=True)
class Viewing:
    """Lengths of a stereoscopic picture in m.

    Attributes:
        eye_distance: between the two cameras.
        convergence_distance: from the cameras to the plane that is seen at the screen.
        screen_width: of the picture on the screen.
        viewing_distance: from the eyes to the screen.
        aspect: the picture's width by its height.
    """

    eye_distance: float = 0.065
    convergence_distance: float = 2.0
    screen_width: float = 0.52
    viewing_distance: float = 0.6
    aspect: float = 16 / 9

    def __post_init__(self) -> None:
        for name in ("convergence_distance", "screen_width", "viewing_distance", "aspect"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} is {value}", remedy="Give a positive length.")
        if not (math.isfinite(self.eye_distance) and self.eye_distance >= 0):
            raise InputError(f"eye_distance is {self.eye_distance}", remedy="Give a length; 0 for one eye.")
