"""What becomes of an earlier package: what is kept, what is replaced, what must be asked about first."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cad2modelica.actuators.file import FILE_NAME, named_joints, read_assignments
from cad2modelica.mechanism.model import Assembly, Assignment
from cad2modelica.options import GenerateOptions
from cad2modelica.processing import Mechanism
from cad2modelica.regenerate.own_files import ORDER, SCENE, OwnFiles, find_own_files
from cad2modelica.regenerate.regeneration import (
    RECORD,
    Plan,
    Record,
    actuator_signature,
    plan_mechatronics,
    read_record,
    require_same_structure,
)
from cad2modelica.structure.entries import Structure, structure_of
from cad2modelica.structure.renames import Renames, marks_in, marks_of, renames

GENERATED = ("package.mo", "Mechanics.mo", "Geometry.mo", RECORD)


@dataclass(frozen=True)
class Revision:
    """A generation against the earlier one.

    Attributes:
        own: the modeller's own files, which are handed on.
        earlier: the earlier generation's record, if there was one.
        structure: names of bodies and joints that others may rely on.
        assignments: components at joints, as the actuators' file says.
        signature: of these assignments, for the record.
        plan: what is done with the mechatronic model.
        changes: how the structure differs, one line each.
    """

    own: OwnFiles
    earlier: Record | None
    structure: Structure
    assignments: tuple[Assignment, ...]
    signature: str
    plan: Plan
    changes: tuple[str, ...]


def revise(mechanism: Mechanism, name: str, assembly_path: Path, output: Path, options: GenerateOptions) -> Revision:
    """Compares a mechanism with the package that an earlier generation wrote.

    Args:
        mechanism: the new one.
        name: the package's name.
        assembly_path: the assembly's file, beside which ``actuators.toml`` is looked for.
        output: folder of the packages.
        options: which consent was given.

    Raises:
        InputError: consent is missing, or the actuators' file is wrong.
    """
    assembly = mechanism.assembly
    earlier = read_record(output / name)
    own = find_own_files(output, name, {*GENERATED, ORDER, *(earlier.files if earlier is not None else ())})
    structure = structure_of(assembly, mechanism.loops, mechanism.view)
    file = _actuator_file(assembly_path, options)
    assigned = named_joints(file) if file is not None else None
    renamed = _renames(earlier, structure, output, assembly)
    changes = require_same_structure(earlier, structure, own, renamed, assigned, options.accept_structure)
    assignments = assembly.drives
    if file is not None:
        assignments = read_assignments(file, assembly, mechanism.loops, renamed.joints)
    signature = actuator_signature(assignments, assembly)
    plan = plan_mechatronics(own, earlier, structure, signature, options.edited)
    return Revision(own, earlier, structure, assignments, signature, plan, changes)


def _renames(earlier: Record | None, structure: Structure, output: Path, assembly: Assembly) -> Renames:
    if earlier is None or earlier.structure == structure:
        return Renames()
    return renames(earlier.structure, structure, marks_in(output / SCENE), marks_of(assembly))


def _actuator_file(assembly_path: Path, options: GenerateOptions) -> Path | None:
    file = options.actuators or assembly_path.parent / FILE_NAME
    return file if options.actuators is not None or file.is_file() else None
