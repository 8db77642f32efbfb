"""From an assembly file to a Modelica package on disk."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import InputError, Place
from contact_foundation.output import whole_folder
from contact_foundation.progress import Progress, silent

from cad2modelica.actuators.file import FILE_NAME, Assignment, named_joints, read_assignments
from cad2modelica.actuators.placement import place_actuators
from cad2modelica.collision.collision_shapes import MAXIMUM_PIECES
from cad2modelica.collision.contact_pairs import contact_pairs, within_reach
from cad2modelica.collision.part_geometries import part_geometries
from cad2modelica.collision.start_overlaps import start_overlaps, without_start_overlaps
from cad2modelica.emit.mechanism_building import mechanism_view
from cad2modelica.emit.mechanism_draft import RESERVED
from cad2modelica.emit.package_writer import CLASSES, MECHANICS, MECHATRONICS, package_texts
from cad2modelica.emit.scene_file import scene_text
from cad2modelica.kinematics.assembling import assembled, require_closed
from cad2modelica.kinematics.joint_couplings import with_couplings
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.loops import analyse_loops
from cad2modelica.kinematics.spherical_axes import with_spherical_axes
from cad2modelica.mechanism.assembly_choices import with_grounded, with_pairs, with_stops
from cad2modelica.mechanism.extent_check import require_tractable
from cad2modelica.mechanism.joint_distance import distance_notes
from cad2modelica.mechanism.model import Assembly, Decomposer, DecompositionLimits
from cad2modelica.modelica.names import NamePool
from cad2modelica.reading import read_assembly
from cad2modelica.regenerate.own_files import GRAPH, ORDER, REPORT, SCENE, find_own_files
from cad2modelica.regenerate.regeneration import (
    MECHATRONICS_FILE,
    RECORD,
    Edited,
    Record,
    actuator_signature,
    checksum,
    lost_references,
    plan_mechatronics,
    read_record,
    record_text,
    require_same_structure,
)
from cad2modelica.report.generation_notes import overlap_notes, speed_notes, unit_notes
from cad2modelica.report.generation_report import ReportInput, report_html
from cad2modelica.report.graph_drawing import graph_svg
from cad2modelica.report.mechanism_pictures import mechanism_pictures
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.lost import require_nothing_lost
from cad2modelica.structure.entries import Structure, structure_of
from cad2modelica.structure.renames import Renames, marks_in, marks_of, renames

GENERATED = ("package.mo", "Mechanics.mo", "Geometry.mo", RECORD)


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


@dataclass(frozen=True)
class GeneratedPackage:
    """What was written.

    Attributes:
        root: the package's folder.
        name: the package's name.
        mechanics: qualified name of the mechanical model.
        mechatronics: qualified name of the mechatronic model.
        scene: the scene file.
        report: the HTML page on what was found and decided.
        notes: what the user should know, one line each.
    """

    root: Path
    name: str
    mechanics: str
    mechatronics: str
    scene: Path
    report: Path
    notes: tuple[str, ...]


def generate(
    assembly_path: Path,
    output: Path,
    options: GenerateOptions = GenerateOptions(),
    progress: Progress = silent,
) -> GeneratedPackage:
    """Generates the Modelica package of an assembly.

    Args:
        assembly_path: the assembly's XML file.
        output: folder that will hold the package's folder, ``scene.json``, ``graph.svg`` and ``generation.html``.
            All files of the modeller's own that are there from an earlier generation are kept byte for byte, and the
            mechatronic model unless the assignment of actuators has changed.
        options: choices.
        progress: is told what is being done.

    Returns:
        What was written.

    Raises:
        InputError: the input is wrong, or what is there must not be replaced without consent; nothing is written then.
    """
    _check(options)
    assembly = with_grounded(read_assembly(assembly_path, progress, options.source), options.ground)
    assembly = with_pairs(with_stops(assembly, options.stops), options.exclude, options.include)
    assembly = with_couplings(assembly, options.couple)
    if options.assemble:
        assembly = assembled(assembly, kinematic_tree(assembly))
    require_closed(assembly)
    require_tractable(assembly)
    assembly = with_spherical_axes(assembly)
    name = _package_name(assembly, options)
    progress("build model", 0.0, name)
    tree = kinematic_tree(assembly)
    loops = analyse_loops(assembly, tree)
    given = DecompositionLimits(
        options.collision_error * assembly.length_unit if options.collision_error is not None else None,
        options.max_pieces,
        decomposer=options.decomposer,
    )
    limits = given.or_else(assembly.contacts.decomposition)
    geometries = part_geometries(assembly.parts, limits, progress)
    colliding = [part.name for part in assembly.parts if geometries[part.name].shapes]
    colliding += [plane.name for plane in assembly.planes]
    balls = {part.name: geometries[part.name].ball(part.pose) for part in assembly.parts}
    pairs, dropped = within_reach(assembly, tree, contact_pairs(assembly, tree, colliding), balls)
    progress("start configuration", 0.0, name)
    pairs, start, overlapping = without_start_overlaps(assembly, pairs, start_overlaps(assembly, geometries, pairs))
    view = mechanism_view(assembly, tree, loops, geometries, pairs)
    notes = (
        *assembly.notes,
        *unit_notes(assembly),
        *distance_notes(assembly),
        *speed_notes(assembly, tree),
        *loops.notes,
        *(note for item in geometries.values() for note in item.notes),
        *dropped,
        *overlapping,
    )
    if options.strict:
        require_nothing_lost(notes, assembly.file)
    earlier = read_record(output / name)
    own = find_own_files(output, name, {*GENERATED, ORDER, *(earlier.files if earlier is not None else ())})
    structure = structure_of(assembly, loops, view)
    file = _actuator_file(assembly_path, options)
    assigned = named_joints(file) if file is not None else None
    renamed = _renames(earlier, structure, output, assembly)
    changes = require_same_structure(earlier, structure, own, renamed, assigned, options.accept_structure)
    assignments: tuple[Assignment, ...] = ()
    if file is not None:
        assignments = read_assignments(file, assembly, loops, renamed.joints)
    plan = plan_mechatronics(own, earlier, structure, actuator_signature(assignments, assembly), options.edited)
    taken = {component.name for component in view.components} | {*view.material_names.values(), *RESERVED}
    actuators = place_actuators(assignments, assembly, view.joint_names, taken)
    texts = package_texts(assembly, view, geometries, actuators, name, notes)
    written_anew = {*texts.files, *texts.resources, RECORD, ORDER}
    own.require_free(written_anew | ({str(MECHATRONICS_FILE)} - {str(file) for file in own.files}))
    if plan.write_mechatronics or earlier is None:
        written = checksum(_encoded(texts.mechatronics))
    else:
        written = earlier.mechatronics
    notes += (*changes, *plan.notes, *lost_references(own, plan, texts.mechatronics), *overlap_notes(start))
    drawing = graph_svg(assembly, tree, loops.loops)
    report = report_html(
        ReportInput(
            name,
            assembly,
            tree,
            loops,
            geometries,
            view,
            actuators,
            start,
            notes,
            drawing,
            mechanism_pictures(assembly, geometries),
            structure.signature,
        )
    )
    progress("write package", 0.5, name)
    with whole_folder(output) as staging:
        root = staging / name
        root.mkdir()
        own.copy_to(root)
        if plan.keep_old is not None:
            (root / MECHATRONICS_FILE).rename(root / plan.keep_old)
        for file_name, text in texts.files.items():
            (root / file_name).write_bytes(_encoded(text))
        if plan.write_mechatronics:
            (root / MECHATRONICS_FILE).write_bytes(_encoded(texts.mechatronics))
        for path, content in texts.resources.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_bytes(content)
        record = Record(structure, actuator_signature(assignments, assembly), written, tuple(sorted(texts.resources)))
        (root / RECORD).parent.mkdir(exist_ok=True)
        (root / RECORD).write_bytes(_encoded(record_text(record)))
        (root / ORDER).write_bytes(_encoded("".join(f"{item}\n" for item in own.package_order(CLASSES))))
        (staging / SCENE).write_bytes(_encoded(scene_text(assembly, tree, loops, view, name)))
        (staging / GRAPH).write_bytes(_encoded(drawing))
        (staging / REPORT).write_bytes(_encoded(report))
    progress("write package", 1.0, name)
    return GeneratedPackage(
        root=output / name,
        name=name,
        mechanics=f"{name}.{MECHANICS}",
        mechatronics=f"{name}.{MECHATRONICS}",
        scene=output / SCENE,
        report=output / REPORT,
        notes=notes,
    )


def _encoded(text: str) -> bytes:
    """UTF-8; what names of files hold beside text becomes question marks."""
    return text.encode("utf-8", errors="replace")


def _check(options: GenerateOptions) -> None:
    if options.collision_error is not None and not 0.0 < options.collision_error < float("inf"):
        raise InputError(f"the collision error is {options.collision_error}", remedy="Give a positive length.")
    density = options.source.density
    if density is not None and not 0.0 < density < float("inf"):
        raise InputError(f"the density is {density} kg/m3", remedy="Give a positive one: 2700 is aluminium.")
    for folder in options.source.package_paths:
        if not folder.is_dir():
            raise InputError("is no folder", place=Place(file=folder), remedy="Correct --package-path.")
    if options.max_pieces is not None and not 1 <= options.max_pieces <= MAXIMUM_PIECES:
        raise InputError(
            f"the largest number of pieces is {options.max_pieces}", remedy=f"Give a number from 1 to {MAXIMUM_PIECES}."
        )


def _renames(earlier: Record | None, structure: Structure, output: Path, assembly: Assembly) -> Renames:
    if earlier is None or earlier.structure == structure:
        return Renames()
    return renames(earlier.structure, structure, marks_in(output / SCENE), marks_of(assembly))


def _actuator_file(assembly_path: Path, options: GenerateOptions) -> Path | None:
    file = options.actuators or assembly_path.parent / FILE_NAME
    return file if options.actuators is not None or file.is_file() else None


def _package_name(assembly: Assembly, options: GenerateOptions) -> str:
    """The package's name: the one asked for, which must be possible, or one made of the assembly's.

    Raises:
        InputError: the name that was asked for is none, or is taken.
    """
    name = NamePool(("Modelica", "ContactMultiBody", "Complex", "ModelicaServices")).class_name(
        options.package or assembly.name
    )
    if options.package is not None and name != options.package:
        raise InputError(
            f"{options.package!r} cannot be the package's name: it is no Modelica name, or is taken by the language or "
            "a library",
            remedy=f"Choose another one, such as {name}.",
        )
    return name
