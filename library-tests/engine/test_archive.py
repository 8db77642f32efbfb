"""The archive that Modelica tools and FMUs link: it needs the C library alone, and shows the C interface alone."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from contact_data import checkout, contact_engine

SHARED = contact_engine()
ARCHIVE = SHARED.with_name("libContactMultiBody.a")
HEADERS = checkout() / "external-c" / "include"
SUPPLIED = {"ModelicaFormatError", "_GLOBAL_OFFSET_TABLE_", "__dso_handle"}
"""By the Modelica tool, by the linker, by the compiler's start-up code."""

pytestmark = pytest.mark.skipif(not ARCHIVE.is_file(), reason="the contact engine is not installed (scripts/setup)")

USER = r"""
#include <setjmp.h>
#include <stdio.h>
#include "contact_multibody_modelica.h"
static jmp_buf caller;
void ModelicaFormatError(const char *format, ...) { (void)format; longjmp(caller, 1); }
#ifdef __cplusplus
extern "C"
#endif
int use(void) {
  const char *wrong[] = {"cmb/1 sphere radius=-1"}, *right[] = {"cmb/1 sphere radius=1"};
  if (setjmp(caller) == 0) { cmb_modelica_intern(wrong, 1, NULL, 0, 0); return 1; }
  return cmb_modelica_intern(right, 1, NULL, 0, 0) > 0 ? 0 : 2;
}
"""


def run(*command: object) -> str:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True).stdout


def symbols(*options: str) -> list[tuple[str, str]]:
    """Letters and names of the archive's symbols."""
    return [
        (fields[-2], fields[-1])
        for line in run("nm", *options, ARCHIVE).splitlines()
        if len(fields := line.split()) >= 2 and not line.endswith(":")
    ]


def c_library() -> set[str]:
    """What the C library and its mathematics offer."""
    offered = set()
    for name in ("libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"):
        path = run("gcc", f"-print-file-name={name}").strip()
        for line in run("nm", "-D", "--defined-only", path).splitlines():
            offered.add(line.split()[-1].split("@")[0])
    return offered


def test_it_needs_the_c_library_alone() -> None:
    needed = {name for letter, name in symbols("-u") if letter == "U"}
    assert "malloc" in needed
    assert needed - SUPPLIED <= c_library()


def test_it_shows_the_c_interface_alone() -> None:
    declared = {
        name
        for path in HEADERS.glob("*.h")
        for name in re.findall(r"(cmb_[a-z0-9_]+)\(", re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL))
    }
    assert set(symbols("-g", "--defined-only")) == {("T", name) for name in declared}


@pytest.fixture(scope="module")
def user(tmp_path_factory: pytest.TempPathFactory) -> Path:
    source = tmp_path_factory.mktemp("user") / "user.c"
    source.write_text(USER, encoding="utf-8")
    return source


def needed_libraries(binary: Path) -> set[str]:
    return set(re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-d", binary)))


def test_a_c_compiler_links_it_and_errors_are_thrown_and_caught_inside(user: Path, tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int use(void); int main(void) { return use(); }", encoding="utf-8")
    program = tmp_path / "program"
    run("gcc", "-o", program, tmp_path / "main.c", user, f"-I{HEADERS}", ARCHIVE, "-lm")
    run(program)
    assert needed_libraries(program) <= {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}


def test_two_of_them_and_a_cpp_program_live_in_one_process(user: Path, tmp_path: Path) -> None:
    """Two shared libraries hold an archive each, the program the C++ runtime; each throws and catches, both unload."""
    for name in ("one", "two"):
        run("gcc", "-shared", "-fPIC", "-o", tmp_path / f"lib{name}.so", user, f"-I{HEADERS}", ARCHIVE, "-lm")
    program = tmp_path / "program"
    (tmp_path / "main.cpp").write_text(
        """
        #include <dlfcn.h>
        #include <iostream>
        #include <stdexcept>
        int main(int, char **names) {
          for (int round = 0; round < 3; ++round) {
            void *library[2];
            for (int i = 0; i < 2; ++i) {
              library[i] = dlopen(names[1 + i], RTLD_NOW | RTLD_GLOBAL);
              if (library[i] == nullptr) return std::cerr << dlerror() << std::endl, 3;
              if (dlsym(library[i], "cmb_intern") != nullptr) return 6;
              const auto use = reinterpret_cast<int (*)()>(dlsym(library[i], "use"));
              if (const int result = use()) return result;
              try { throw std::runtime_error("ours"); } catch (const std::exception &) {}
            }
            for (void *each : library) dlclose(each);
            if (dlopen(names[1], RTLD_NOW | RTLD_NOLOAD) != nullptr) return 5;
          }
        }
        """,
        encoding="utf-8",
    )
    run("g++", "-o", program, tmp_path / "main.cpp")
    run(program, tmp_path / "libone.so", tmp_path / "libtwo.so")


FCL = r"""
#include <stdio.h>
#include "contact_multibody.h"
void ModelicaFormatError(const char *format, ...) { (void)format; }
int main(void) {
  const char *geometry[] = {"cmb/1 box size=1,1,1", "cmb/1 sphere radius=1"};
  const int pairs[] = {1, 2};
  const cmb_scene_source source = {geometry, 2, pairs, 1, CMB_BACKEND_FCL, NULL};
  cmb_scene scene;
  const cmb_status status = cmb_intern(&source, &scene);
  puts(status == CMB_OK ? "found" : cmb_last_error());
  return 0;
}
"""


def test_a_library_is_found_beside_the_binary_or_by_the_environment_and_missed_clearly(tmp_path: Path) -> None:
    module = ARCHIVE.with_name("libContactMultiBodyFcl.so")
    if not module.is_file():
        pytest.skip("the engine was built without FCL")
    (tmp_path / "main.c").write_text(FCL, encoding="utf-8")
    program = tmp_path / "program"
    run("gcc", "-o", program, tmp_path / "main.c", f"-I{HEADERS}", ARCHIVE, "-lm")
    message = run(program)
    assert "the module libContactMultiBodyFcl.so is not in " + str(tmp_path) in message
    assert "choose another back end than FCL" in message
    assert run("env", f"CMB_MODULE_PATH=/nowhere:{module.parent}", program) == "found\n"
    copy = tmp_path / module.name
    copy.write_bytes(b"damaged")
    assert "cannot be loaded" in run(program)
    shutil.copyfile(module, copy)
    for library in module.parent.glob("*.so.*"):
        shutil.copyfile(library, tmp_path / library.name)
    assert run(program) == "found\n"


WINDOWS = ARCHIVE.parents[1] / "win64" / ARCHIVE.name
MINGW = "x86_64-w64-mingw32-"


@pytest.mark.skipif(
    not WINDOWS.is_file() or shutil.which(f"{MINGW}gcc-posix") is None,
    reason="no engine for Windows (scripts/setup cross)",
)
def test_the_archive_for_windows_holds_what_the_engine_needs_alone(tmp_path: Path) -> None:
    """A program needs the system's libraries alone; of the C++ runtime no member is there that nothing asks for."""
    source = tmp_path / "user.c"
    source.write_text(USER + "int main(void) { return use(); }\n")
    program = tmp_path / "user.exe"
    run(f"{MINGW}gcc-posix", f"-I{HEADERS}", source, WINDOWS, "-o", program)
    needed = {
        line.split()[-1].lower() for line in run(f"{MINGW}objdump", "-p", program).splitlines() if "DLL Name" in line
    }
    assert needed == {"kernel32.dll", "msvcrt.dll"}
    members = set(run(f"{MINGW}ar", "t", WINDOWS).split())
    assert "fstream-inst.o" in members  # files of geometry are read by it
    assert not {"regex.o", "chrono.o", "memory_resource.o", "ios_init.o"} & members
    assert WINDOWS.stat().st_size < 7.5e6
