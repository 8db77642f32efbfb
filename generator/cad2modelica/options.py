"""Choices of a generation."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place

from cad2modelica.collision.collision_shapes import MAXIMUM_PIECES
from cad2modelica.collision.manager_choice import ManagerChoice
from cad2modelica.mechanism.model import Decomposer
from cad2modelica.regenerate.regeneration import Edited
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices


@dataclass(frozen=True)
class GenerateOptions:
    """Choices of a generation.

    Attributes:
        package: name of the package; made of the assembly's name if None.
        actuators: TOML file that assigns actuators to joints; ``actuators.toml`` beside the assembly, if there is
            one, if None.
        accept_structure: whether a package of another structure may be replaced.
        assemble: whether parts are moved so that all joints close at the start.
        edited: what happens to an edited mechatronic model when the assignment of actuators has changed.
        collision_error: concavity that a piece of a concave body may keep, in the assembly's unit of length (m for
            URDF); counts before the assembly's own ``collisionError``, but not before a part's.
        max_pieces: largest number of pieces of a concave body; counts likewise.
        decomposer: what splits concave bodies; counts likewise.
        ground: names of parts that are held in the world where they stand.
        stops: whether joints have stops at their limits; None: as the format has it (XML: yes, URDF: no).
        couple: whether joints that are to follow others (mimic of URDF) do.
        strict: whether something of the source that the model does not have is an error, instead of a note.
        source: where a robot description's meshes may lie, and what becomes of links without mesh or mass.
        exclude: pairs of parts (URDF: links) that do not touch each other.
        include: pairs that touch each other although they would be left out.
        up: the source's axis that points up ("x", "-x", "y", ...), against gravity; None: as the source has it.
        contacts: whether parts touch each other at all, beside the pairs of ``include``.
        clearances: whether the distances of parts that are apart are exact, instead of lower bounds, which cost less.
        manager: whether contacts are shown for each pair, or for each body by a CompiledContactManager.
    """

    package: str | None = None
    actuators: Path | None = None
    collision_error: float | None = None
    max_pieces: int | None = None
    decomposer: Decomposer | None = None
    accept_structure: bool = False
    edited: Edited = Edited.ASK
    assemble: bool = False
    ground: tuple[str, ...] = ()
    stops: bool | None = None
    couple: bool = True
    strict: bool = False
    source: SourceChoices = DEFAULT_CHOICES
    exclude: tuple[tuple[str, str], ...] = ()
    include: tuple[tuple[str, str], ...] = ()
    up: str | None = None
    contacts: bool = True
    clearances: bool = False
    manager: ManagerChoice = ManagerChoice.AUTOMATIC


DEFAULT_OPTIONS: Final = GenerateOptions()


def check_options(options: GenerateOptions) -> None:
    """Raises InputError if a number is none that can be, or a folder is not there."""
    if options.collision_error is not None and not 0.0 < options.collision_error < float("inf"):
        raise InputError(f"the collision error is {options.collision_error}", remedy="Give a positive length.")
    density = options.source.density
    if density is not None and not 0.0 < density < float("inf"):
        raise InputError(f"the density is {density} kg/m3", remedy="Give a positive one: 2700 is aluminium.")
    tessellation = options.source.tessellation
    if tessellation is not None and not 1e-7 < tessellation < float("inf"):
        raise InputError(f"the tessellation is {tessellation:g} m", remedy="Give a positive distance: 0.1 (mm).")
    for folder in options.source.package_paths:
        if not folder.is_dir():
            raise InputError("is no folder", place=Place(file=folder), remedy="Correct --package-path.")
    if options.max_pieces is not None and not 1 <= options.max_pieces <= MAXIMUM_PIECES:
        raise InputError(
            f"the largest number of pieces is {options.max_pieces}", remedy=f"Give a number from 1 to {MAXIMUM_PIECES}."
        )
