"""Reads an assembly, whichever format its file has.

A format is one line in ``BY_ROOT`` (XML, told by the root element) or ``BY_ENDING`` (all else, told by the file name).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.assembly.reader import read_assembly_xml
from cad2modelica.mechanism.model import Assembly
from cad2modelica.mjcf.reader import read_mjcf
from cad2modelica.sdf.reader import read_sdf
from cad2modelica.simscape.reader import read_simscape
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.xml_document import read_xml
from cad2modelica.step.reader import read_step_assembly
from cad2modelica.urdf.reader import read_urdf

XmlReader = Callable[[etree._Element, Path, Progress, SourceChoices], Assembly]
FileReader = Callable[[Path, Progress, SourceChoices], Assembly]

BY_ROOT: Final[Mapping[str, XmlReader]] = {
    "robot": read_urdf,
    "SimscapeMultibodyImportXML": read_simscape,
    "SimMechanicsImportXML": read_simscape,
    "mujoco": read_mjcf,
    "sdf": read_sdf,
}
"""Readers of XML formats by the root element's name without its namespace; of any other, this project's own."""

BY_ENDING: Final[Mapping[str, FileReader]] = {
    ".step": read_step_assembly,
    ".stp": read_step_assembly,
}
"""Readers of files that are no XML, by ending in small letters."""


def read_assembly(path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES) -> Assembly:
    """Reads an assembly file and the geometry it names.

    Args:
        path: the file.
        progress: is told which part is being read.
        choices: where geometry may lie, and what becomes of bodies without geometry or mass.

    Returns:
        The assembly in SI units.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    by_ending = BY_ENDING.get(path.suffix.lower())
    if by_ending is not None:
        return by_ending(path, progress, choices)
    root = read_xml(path)
    by_root = BY_ROOT.get(etree.QName(root).localname)
    if by_root is not None:
        return by_root(root, path, progress, choices)
    return read_assembly_xml(root, path, progress)
