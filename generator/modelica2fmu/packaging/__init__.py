"""Packaging: from a described and generated model to an FMU file."""

from modelica2fmu.packaging.layout import FmiVersion
from modelica2fmu.packaging.package import package_fmu
from modelica2fmu.packaging.solver_variables import SolverOptions

__all__ = ["FmiVersion", "SolverOptions", "package_fmu"]
