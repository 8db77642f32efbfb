"""What makes the FMU's folder ``sources`` compile on its own: headers of others, and a CMake project."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from string import Template
from typing import Final

from modelica2fmu.description.model_description import ModelDescription
from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS

EXTERNAL_HEADERS: Final = "external"
"""Folder in ``sources`` for headers that are not the FMU's own."""

# The folder of SUNDIALS' headers may be that of the whole system.
_SUNDIALS: Final = {"cvode", "nvector", "sundials", "sunlinsol", "sunmatrix", "sunnonlinsol"}

_CMAKE: Final = Template("""\
# Builds the binary of this FMU again, for example:
#   cmake -S sources -B build -DCMAKE_LIBRARY_PATH="/folder/of/the/libraries"
#   cmake --build build
# Needs the static library of CVODE (SUNDIALS 6) and the external libraries of the model.
cmake_minimum_required(VERSION 3.20)
project($identifier C CXX)

set(CMAKE_FIND_LIBRARY_SUFFIXES .a .so .dylib)
set(libraries)
foreach(name IN ITEMS $libraries)
  find_library(library_$${name} $${name})
  if(library_$${name})
    list(APPEND libraries $${library_$${name}})
  else()
    list(APPEND libraries -l$${name}) # the compiler's own
  endif()
endforeach()

file(GLOB sources CONFIGURE_DEPENDS "$${CMAKE_CURRENT_SOURCE_DIR}/*.c")
add_library($identifier MODULE $${sources})
target_include_directories($identifier PRIVATE $${CMAKE_CURRENT_SOURCE_DIR} $${CMAKE_CURRENT_SOURCE_DIR}/$external)
target_compile_options($identifier PRIVATE $options)
if(APPLE) # not tried: no compiler for it was at hand
  target_link_options($identifier PRIVATE -Wl,-dead_strip)
  target_link_libraries($identifier PRIVATE $${libraries} m)
  set_target_properties($identifier PROPERTIES PREFIX "" SUFFIX .dylib LINKER_LANGUAGE CXX
    BUILD_RPATH "@loader_path")
else()
  target_link_options($identifier PRIVATE -Wl,--exclude-libs,ALL -Wl,--gc-sections)
  target_link_libraries($identifier PRIVATE -Wl,--start-group $${libraries} -Wl,--end-group m pthread)
  set_target_properties($identifier PROPERTIES PREFIX "" SUFFIX .so LINKER_LANGUAGE CXX
    BUILD_RPATH "$$ORIGIN")
endif()
""")


def cmake_project(description: ModelDescription) -> str:
    """Text of ``sources/CMakeLists.txt``."""
    return _CMAKE.substitute(
        identifier=description.identifier,
        libraries=" ".join(("sundials_cvode", *description.external.libraries)),
        external=EXTERNAL_HEADERS,
        options=" ".join(COMPILE_OPTIONS),
    )


def copy_headers(dependencies: Iterable[Path], folders: Sequence[Path], sundials: Path, target: Path) -> None:
    """Copies the headers that the sources were compiled with and that neither they nor the system bring along.

    Args:
        dependencies: files that the compiler wrote about what each source includes.
        folders: headers below one of them are copied, under their names relative to it; the first one counts.
        sundials: folder of SUNDIALS' headers, of which only these are copied.
        target: folder to write to.
    """
    names = {name for path in dependencies for name in _included(path)}  # most sources include the same
    included = {Path(name).resolve() for name in names}
    roots = [*(folder.resolve() for folder in folders), sundials.resolve()]
    for header in sorted(included):
        root = next((root for root in roots if header.is_relative_to(root)), None)
        if root is None:
            continue
        relative = header.relative_to(root)
        if root == roots[-1] and relative.parts[0] not in _SUNDIALS:
            continue
        copy = target / relative
        if not copy.exists():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(header, copy)


def _included(dependencies: Path) -> Iterator[str]:
    """File names in a rule for make: ``object: source header ...`` with escaped blanks and line ends."""
    _, _, names = dependencies.read_text(encoding="utf-8", errors="surrogateescape").partition(": ")
    for name in re.findall(r"(?:\\[^\n]|[^\\\s])+", names):
        yield re.sub(r"\\(.)", r"\1", name).replace("$$", "$")
