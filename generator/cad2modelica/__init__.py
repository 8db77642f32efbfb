"""CAD export (assembly XML and VRML) to a Modelica package with a mechanical and a mechatronic model."""

from cad2modelica.assembly_reader import read_assembly
from cad2modelica.generation import GeneratedPackage, GenerateOptions, generate

__all__ = ["GenerateOptions", "GeneratedPackage", "generate", "read_assembly"]
