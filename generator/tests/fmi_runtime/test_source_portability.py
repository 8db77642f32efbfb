"""An FMU's sources and the engine's use the languages' and POSIX' headers alone, as a compiler on macOS has them."""

from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from contact_data import checkout
from modelica2fmu.packaging.dependencies import find_fmi_headers, find_sundials

ROOT = checkout()
C_HEADERS = {"float", "limits", "math", "setjmp", "stdarg", "stddef", "stdint", "stdio", "stdlib", "string"}
POSIX_HEADERS = {"pthread"}
SUNDIALS = re.compile(r"(cvode|nvector|sundials|sunlinsol|sunmatrix)/")
FOREIGN = re.compile(r"(fcl|coal|ccd)/")
"""Back ends, each a module that is built where its library is found."""


def included(folder: Path) -> dict[str, set[str]]:
    """Headers in angle brackets, with the files that include them."""
    found: dict[str, set[str]] = {}
    for path in folder.rglob("*"):
        if path.suffix in {".c", ".h", ".cpp", ".hpp"}:
            for header in re.findall(r"^ *# *include <([^>]+)>", path.read_text("utf-8"), re.MULTILINE):
                found.setdefault(header, set()).add(path.name)
    return found


def test_the_runtime_includes_c_and_posix_alone() -> None:
    headers = included(ROOT / "generator" / "modelica2fmu" / "runtime")
    others = {header for header in headers if not SUNDIALS.match(header)}
    assert others <= {f"{name}.h" for name in C_HEADERS | POSIX_HEADERS}
    assert len(others) > 5


def test_the_engine_includes_c_and_cpp_alone() -> None:
    """Only the loader of modules asks the system, and only for headers that are there."""
    engine = ROOT / "external-c" / "src"
    headers = included(engine)
    system = {header for header in headers if header.endswith(".h") and not FOREIGN.match(header)}
    system -= {f"{name}.h" for name in C_HEADERS}
    assert system <= {"dlfcn.h", "unistd.h"}
    assert {file for header in system for file in headers[header]} == {"module_file.cpp"}
    assert "#if __has_include(<dlfcn.h>)" in (engine / "backend" / "module_file.cpp").read_text("utf-8")


@pytest.fixture
def sources(ball: Path, tmp_path: Path) -> Path:
    """The unpacked sources of an FMU."""
    with zipfile.ZipFile(ball) as archive:
        archive.extractall(tmp_path)
    return tmp_path / "sources"


def test_the_sources_compile_with_what_posix_promises(sources: Path) -> None:
    """Nothing of the GNU C library, and no code that is for Linux."""
    strict = ["-std=c11", "-D_XOPEN_SOURCE=700", "-pedantic-errors", "-Werror=implicit-function-declaration"]
    elsewhere = ["-U__linux__", "-U__linux", "-U__gnu_linux__", "-U_GNU_SOURCE", "-U_DEFAULT_SOURCE"]
    include = [f"-I{sources}", f"-I{find_fmi_headers()}", f"-I{find_sundials().include}"]
    files = sorted(sources.glob("*.c"))
    assert files
    for file in files:
        command = ["gcc", *strict, *elsewhere, *include, "-fsyntax-only", file]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


def test_gnu_functions_would_be_found(tmp_path: Path) -> None:
    source = tmp_path / "gnu.c"
    source.write_text('#include <stdlib.h>\nchar *home(void) { return secure_getenv("HOME"); }\n')
    command = [
        "gcc",
        "-std=c11",
        "-D_XOPEN_SOURCE=700",
        "-Werror=implicit-function-declaration",
        "-fsyntax-only",
        source,
    ]
    assert subprocess.run(command, capture_output=True, check=False).returncode != 0


@pytest.mark.skipif(shutil.which("cmake") is None, reason="CMake is not installed")
@pytest.mark.parametrize("system", ["Darwin", "Linux"])
def test_the_cmake_project_links_as_the_system_does(sources: Path, tmp_path: Path, system: str) -> None:
    """What CMake would have macOS link, which it can say without its compiler."""
    build = tmp_path / "build"
    options = [f"-DCMAKE_SYSTEM_NAME={system}", "-DCMAKE_C_COMPILER_WORKS=1", "-DCMAKE_CXX_COMPILER_WORKS=1"]
    options += [f"-DCMAKE_LIBRARY_PATH={find_sundials().include.parent / 'lib'}", "-DCMAKE_OSX_SYSROOT=/"]
    subprocess.run(
        ["cmake", "-G", "Unix Makefiles", "-S", sources, "-B", build, *options], check=True, capture_output=True
    )
    (link,) = build.glob("CMakeFiles/*.dir/link.txt")
    command = link.read_text("utf-8")
    assert ("-Wl,--" in command) == (system == "Linux")
    assert (".dylib" in command) == (system == "Darwin")
    assert ("-Wl,-dead_strip" in command) == (system == "Darwin")
