"""CAD export (assembly XML and VRML) to a Modelica package with a mechanical and a mechatronic model."""

from cad2modelica.collision.manager_choice import ManagerChoice
from cad2modelica.generation import GeneratedPackage, generate
from cad2modelica.mechanism.model import Decomposer
from cad2modelica.options import GenerateOptions
from cad2modelica.reading import read_assembly
from cad2modelica.regenerate.regeneration import Edited
from cad2modelica.source.choices import SourceChoices

__all__ = [
    "Decomposer",
    "Edited",
    "GenerateOptions",
    "GeneratedPackage",
    "ManagerChoice",
    "SourceChoices",
    "generate",
    "read_assembly",
]
