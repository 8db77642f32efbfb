"""`cmb msl`: which Modelica Standard Library is used, and installing a release of it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_foundation.errors import InputError
from modelica2fmu.library.releases import LATEST, RELEASES, content_digest, release_of
from modelica2fmu.library.standard_library import CORE_SUBSET, StandardLibrary, find_standard_library

from cmb.terminal import progress_bars

NAME = "msl"
SUMMARY = "say which Modelica Standard Library is used, or install a release of it"
DESCRIPTION = (
    "Looks for the Modelica Standard Library in this order: --msl, MODELICAPATH, OpenModelica's usual folders, the "
    "user's cache, and last the MultiBody core subset that this project brings along. `cmb msl install` fetches an "
    "official release into the user's cache and checks it by its SHA-256 digest."
)
EXAMPLES = f"""examples:
  cmb msl
  MODELICAPATH=/opt/msl cmb msl
  cmb msl install
  cmb msl install {list(RELEASES)[-1]}
  cmb msl install --from ModelicaStandardLibrary.zip
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument(
        "action", nargs="?", choices=("show", "install"), default="show", help="what to do (show if left out)"
    )
    parser.add_argument(
        "version", nargs="?", metavar="VERSION", help=f"release to install: {' or '.join(RELEASES)} (the first)"
    )
    parser.add_argument("--from", dest="origin", metavar="ZIP", help="file or address of the release's archive")
    parser.add_argument("--msl", type=Path, metavar="FOLDER", help="folder that holds the Modelica Standard Library")


def run(arguments: Namespace) -> int:
    """Prints name, version, folder, digest and where it was found; installs first if asked to."""
    if arguments.action == "install":
        if arguments.msl is not None:
            raise InputError("--msl names a library to look at", remedy="leave it out to install one")
        from modelica2fmu.library.library_release import install_release

        with progress_bars() as progress:
            install_release(arguments.version or LATEST, _origin(arguments.origin), progress=progress)
    elif arguments.version is not None or arguments.origin is not None:
        raise InputError("a version and --from are for `cmb msl install`")
    _show(find_standard_library(arguments.msl))
    return 0


def _origin(text: str | None) -> str | Path | None:
    if text is None or text.startswith(("http://", "https://")):
        return text
    return Path(text)


def _show(library: StandardLibrary) -> None:
    digest = content_digest(library)
    release = release_of(digest)
    nature = f"the official release {release}" if release else "not an official release"
    if library.origin == CORE_SUBSET:
        nature = "this project's own subset, with what models with contacts need of it"
    print(f"Modelica {library.version or 'of unknown version'} from {library.folder} ({library.origin})")
    print(f"  sha256 of its code {digest}: {nature}")
