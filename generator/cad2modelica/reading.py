"""Reads an assembly, whichever format its file has."""

from __future__ import annotations

from pathlib import Path

from contact_foundation.progress import Progress, silent

from cad2modelica.assembly.reader import read_assembly_xml
from cad2modelica.mechanism.model import Assembly
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.xml_document import read_xml
from cad2modelica.urdf.reader import read_urdf


def read_assembly(path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES) -> Assembly:
    """Reads an assembly file and the geometry it names: this project's XML format, or URDF.

    Args:
        path: the file.
        progress: is told which part is being read.
        choices: where a robot description's meshes may lie, and what becomes of links without mesh or mass.

    Returns:
        The assembly in SI units.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    root = read_xml(path)
    if root.tag == "robot":
        return read_urdf(root, path, progress, choices)
    return read_assembly_xml(root, path, progress)
