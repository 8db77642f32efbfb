"""From an assembly file to a Modelica package on disk."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import InputError
from contact_foundation.progress import Progress, silent

from cad2modelica.emit.package_writer import MECHANICS, MECHATRONICS
from cad2modelica.mechanism.model import Assembly
from cad2modelica.modelica.names import NamePool
from cad2modelica.options import DEFAULT_OPTIONS, GenerateOptions, check_options
from cad2modelica.package_output import compose, write
from cad2modelica.processing import prepare, process
from cad2modelica.reading import read_assembly
from cad2modelica.regenerate.own_files import REPORT, SCENE
from cad2modelica.revision import revise
from cad2modelica.source.lost import require_nothing_lost


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
    options: GenerateOptions = DEFAULT_OPTIONS,
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
    check_options(options)
    assembly = prepare(read_assembly(assembly_path, progress, options.source), options)
    name = _package_name(assembly, options)
    progress("build model", 0.0, name)
    mechanism = process(assembly, options, progress)
    if options.strict:
        require_nothing_lost(mechanism.notes, assembly.file)
    revision = revise(mechanism, name, assembly_path, output, options)
    files = compose(mechanism, revision, name)
    progress("write package", 0.5, name)
    write(files, revision, output, name)
    progress("write package", 1.0, name)
    return GeneratedPackage(
        root=output / name,
        name=name,
        mechanics=f"{name}.{MECHANICS}",
        mechatronics=f"{name}.{MECHATRONICS}",
        scene=output / SCENE,
        report=output / REPORT,
        notes=files.notes,
    )


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
