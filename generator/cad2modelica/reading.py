"""Reads an assembly, whichever format its file has."""

from __future__ import annotations

from pathlib import Path

from contact_foundation.progress import Progress, silent

from cad2modelica.assembly.reader import read_assembly_xml
from cad2modelica.mechanism.model import Assembly
from cad2modelica.source.xml_document import read_xml
from cad2modelica.urdf.reader import read_urdf


def read_assembly(path: Path, progress: Progress = silent) -> Assembly:
    """Reads an assembly file and the geometry it names: this project's XML format, or URDF.

    Args:
        path: the file.
        progress: is told which part is being read.

    Returns:
        The assembly in SI units.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    root = read_xml(path)
    return read_urdf(root, path, progress) if root.tag == "robot" else read_assembly_xml(root, path, progress)
