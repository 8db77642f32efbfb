"""Fetching and installing releases of the Modelica Standard Library, from a server of the test's own."""

from __future__ import annotations

import http.server
import io
import os
import threading
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from contact_foundation.errors import BuildError, CmbError, InputError
from modelica2fmu.library.library_release import install_release
from modelica2fmu.library.releases import ADDRESS, RELEASES, content_digest, release_of
from modelica2fmu.library.standard_library import StandardLibrary, find_standard_library

FILES = {
    "Modelica/package.mo": 'package Modelica\n annotation(version="4.1.0", revisionId="abc 2025");\nend Modelica;\n',
    "Modelica/Mechanics/package.order": "MultiBody\n",
    "Modelica/Resources/C-Sources/table.c": "int table;\n",
    "Modelica/Resources/Images/logo.svg": "<svg/>",
    "ModelicaServices/package.mo": "package ModelicaServices end ModelicaServices;\n",
    "Complex.mo": "operator record Complex end Complex;\n",
    "LICENSE": "BSD",
    "ModelicaTest/package.mo": "package ModelicaTest end ModelicaTest;\n",
}
TOP = "ModelicaStandardLibrary-4.1.0/"


def archive(files: dict[str, str] = FILES, top: str = TOP) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as target:
        for name, text in files.items():
            target.writestr(top + name, text)
    return content.getvalue()


def write(folder: Path, files: dict[str, str] = FILES) -> StandardLibrary:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return StandardLibrary(folder, "4.1.0", "--msl")


@pytest.fixture
def releases(tmp_path: Path) -> dict[str, str]:
    return {"4.1.0": content_digest(write(tmp_path / "original"))}


class Server:
    """A web server on this machine that answers with what the test wants."""

    def __init__(self) -> None:
        outer = self
        self.status, self.body, self.length = 200, archive(), None

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                self.send_response(outer.status)
                self.send_header("Content-Length", str(outer.length or len(outer.body)))
                self.end_headers()
                self.wfile.write(outer.body)

            def log_message(self, *arguments: object) -> None:
                pass

        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self._server.server_port}/v4.1.0.zip"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    for name in ("http_proxy", "HTTP_PROXY", "all_proxy", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
    started = Server()
    yield started
    started.close()


@pytest.fixture
def cache(tmp_path: Path) -> Path:
    return tmp_path / "home" / ".cache" / "contactmultibody" / "msl"


def test_an_installed_release_is_found(server: Server, releases: dict[str, str], cache: Path, tmp_path: Path) -> None:
    phases: list[str] = []
    library = install_release(
        "4.1.0", server.address, folder=cache, releases=releases,
        progress=lambda phase, _, __="": phases.append(phase),
    )  # fmt: skip
    assert library.folder == cache / "4.1.0"
    names = {path.relative_to(library.folder).as_posix() for path in library.folder.rglob("*") if path.is_file()}
    assert names == {*FILES, ".written-by-cmb"} - {"ModelicaTest/package.mo"}
    assert dict.fromkeys(phases) == {"fetch": None, "unpack": None}
    found = find_standard_library(None, {"HOME": str(tmp_path / "home")})
    assert (found.version, found.origin) == ("4.1.0", "cache")
    assert content_digest(found) == releases["4.1.0"]
    again = install_release("4.1.0", server.address, folder=cache, releases=releases)
    assert again == library


@pytest.mark.parametrize("top", [TOP, ""])
def test_archives_with_versions_in_folder_names_are_the_same_release(
    top: str, server: Server, releases: dict[str, str], cache: Path
) -> None:
    renamed = {
        name.replace("Modelica/", "Modelica 4.1.0/", 1).replace("ModelicaServices/", "ModelicaServices 4.1.0/"): text
        for name, text in FILES.items()
    }
    server.body = archive(renamed, top)
    library = install_release("4.1.0", server.address, folder=cache, releases=releases)
    assert (library.folder / "Modelica" / "package.mo").is_file()


def test_the_digest_is_of_the_code(tmp_path: Path, releases: dict[str, str]) -> None:
    def digest(name: str, **changed: str) -> str:
        files = {**FILES, **{key.replace("__", "/").replace("_mo", ".mo"): text for key, text in changed.items()}}
        return content_digest(write(tmp_path / name, files))

    same = releases["4.1.0"]
    package = FILES["Modelica/package.mo"]
    assert digest("stamp", Modelica__package_mo=package.replace("abc 2025", "def 2026")) == same
    assert digest("ends", Modelica__package_mo=package.replace("\n", "\r\n")) == same
    assert digest("text", Modelica__package_mo=package.replace("4.1.0", "4.1.1")) != same
    assert digest("more", Modelica__Blocks_mo="package Blocks end Blocks;") != same


def with_entry(name: str, mode: int = 0o100644) -> bytes:
    content = io.BytesIO(archive())
    with zipfile.ZipFile(content, "a") as target:
        entry = zipfile.ZipInfo(name)
        entry.external_attr = mode << 16
        target.writestr(entry, "../../outside")
    return content.getvalue()


@pytest.mark.parametrize(
    ("status", "body", "length", "error", "text"),
    [
        (404, b"", None, BuildError, "cannot be fetched: Not Found"),
        (200, archive()[:300], 5000, BuildError, "ended after 300 of 5000 bytes|IncompleteRead"),
        (200, b"<html>", None, InputError, "no archive that can be read"),
        (200, archive()[:-40], None, InputError, "no archive that can be read"),
        (200, archive({"README": "text"}), None, InputError, "no Modelica Standard Library in this archive"),
        (200, archive({**FILES, "Complex.mo": "changed"}), None, InputError, "another digest"),
        (200, archive({**FILES, "Modelica/More.mo": "more"}), None, InputError, "another digest"),
        (200, with_entry(TOP + "Modelica/../../../../outside.mo"), None, InputError, "leaves the archive's folder"),
        (200, with_entry(TOP + "Modelica/link.mo", 0o120777), None, InputError, "leaves the archive's folder"),
    ],
    ids=["missing", "cut-short", "no-zip", "damaged", "other", "changed", "added", "path", "link"],
)
def test_what_is_no_release_is_refused_and_leaves_nothing(
    status: int, body: bytes, length: int | None, error: type[CmbError], text: str,
    server: Server, releases: dict[str, str], cache: Path, tmp_path: Path,
) -> None:  # fmt: skip
    install_release("4.1.0", server.address, folder=cache, releases=releases)
    before = sorted(path for path in tmp_path.rglob("*"))
    server.status, server.body, server.length = status, body, length
    with pytest.raises(error, match=text):
        install_release("4.1.0", server.address, folder=cache, releases=releases)
    assert sorted(path for path in tmp_path.rglob("*")) == before  # the earlier one is still there, nothing else
    assert content_digest(StandardLibrary(cache / "4.1.0", "", "")) == releases["4.1.0"]


def test_offline_the_remedy_is_named(releases: dict[str, str], cache: Path, server: Server) -> None:
    server.close()
    with pytest.raises(BuildError, match=r"cannot be fetched: .*refused") as caught:
        install_release("4.1.0", server.address, folder=cache, releases=releases)
    assert "cmb msl install 4.1.0 --from FILE" in str(caught.value)
    assert not cache.exists()


def test_a_file_is_installed_without_a_network(releases: dict[str, str], cache: Path, tmp_path: Path) -> None:
    path = tmp_path / "fetched.zip"
    path.write_bytes(archive())
    assert install_release("4.1.0", path, folder=cache, releases=releases).folder.is_dir()
    with pytest.raises(InputError, match="no such file"):
        install_release("4.1.0", tmp_path / "gone.zip", folder=cache, releases=releases)
    with pytest.raises(InputError, match=r"release 9\.9\.9 .* is not known"):
        install_release("9.9.9", path, folder=cache, releases=releases)


def test_what_somebody_else_put_there_stays(releases: dict[str, str], cache: Path, tmp_path: Path) -> None:
    (cache / "4.1.0").mkdir(parents=True)
    (cache / "4.1.0" / "mine.txt").write_text("mine")
    path = tmp_path / "fetched.zip"
    path.write_bytes(archive())
    with pytest.raises(InputError, match="not written by cmb"):
        install_release("4.1.0", path, folder=cache, releases=releases)
    assert (cache / "4.1.0" / "mine.txt").read_text() == "mine"


def test_the_known_releases_are_those_that_are_found() -> None:
    """Wherever an unchanged release is found, its digest is the known one."""
    found = find_standard_library(None, os.environ)
    if found.version not in RELEASES or found.origin == "core subset":
        pytest.skip("no release of the Modelica Standard Library is on MODELICAPATH")
    assert release_of(content_digest(found)) == found.version


def test_the_official_address_is_that_of_the_version() -> None:
    assert ADDRESS.format(version="4.1.0").endswith("/v4.1.0.zip")
    assert ADDRESS.startswith("https://")
    assert all(len(digest) == 64 for digest in RELEASES.values())
