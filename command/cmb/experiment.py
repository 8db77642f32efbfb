"""``experiment.toml`` beside an assembly: which model is simulated, and what the report shows beside the usual.

```toml
model = "AntonWalk.Walk"   # instead of the generated mechatronic model, which it extends or uses
sources = ["AntonWalk"]    # Modelica files and packages it needs, beside this file
```

and the tables ``[[plot]]`` and ``[[number]]`` of ``fmu_regression.report.figures``. The file and the model belong to
the modeller; no generation touches them.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import InputError, Place
from contact_foundation.toml_text import read_toml
from fmu_regression.report.figures import NO_FIGURES, Figures, read_figures

FILE_NAME = "experiment.toml"
_KEYS = {"model", "sources", "plot", "number"}


@dataclass(frozen=True)
class Experiment:
    """What an experiment file says.

    Attributes:
        file: the file; None if there is none.
        model: class to simulate; None: the generated mechatronic model.
        sources: Modelica files and folders of packages.
        figures: for the report.
    """

    file: Path | None = None
    model: str | None = None
    sources: tuple[Path, ...] = ()
    figures: Figures = NO_FIGURES


def find_experiment(folder: Path) -> Experiment:
    """Reads the experiment file of a folder; without one, the experiment changes nothing.

    Raises:
        InputError: the file is wrong.
    """
    file = folder / FILE_NAME
    return read_experiment(file) if file.is_file() else Experiment()


def read_experiment(file: Path) -> Experiment:
    """Reads an experiment file.

    Raises:
        InputError: the file does not exist or is wrong.
    """
    place = Place(file=file)
    content = read_toml(file, "an experiment file")
    unknown = sorted(set(content) - _KEYS)
    if unknown:
        raise InputError(
            f"{', '.join(unknown)} has no meaning", place=place, remedy=f"Known are {', '.join(sorted(_KEYS))}."
        )
    model, sources = content.get("model"), content.get("sources", [])
    if model is not None and not isinstance(model, str):
        raise InputError("model is not a name", place=place, remedy="Name a Modelica class.")
    if not isinstance(sources, list) or not all(isinstance(source, str) for source in sources):
        raise InputError("sources is not a list of paths", place=place, remedy="List files and folders of Modelica.")
    return Experiment(file, model, tuple(_source(file, source) for source in sources), read_figures(content, file))


def _source(file: Path, name: str) -> Path:
    folder = file.parent.resolve()
    path = (folder / name).resolve()
    if not path.is_relative_to(folder):
        raise InputError(
            f"source {name!r} lies outside the folder", place=Place(file=file), remedy="Keep it beside the file."
        )
    if not path.exists():
        raise InputError(f"source {name!r} does not exist", place=Place(file=file), remedy="Correct the path.")
    return path
