"""The MultiBody core subset against the real Modelica Standard Library, where there is one.

Every test model must show the same public variables with the same types, units, defaults and start values, and move
the same way.
"""

from __future__ import annotations

from typing import Any

import core_models
import numpy as np
import pytest
import rumoca

# Models whose values the subset defines itself.
_OWN = {"OwnFunctions"}
# One of each kind for the comparison of trajectories; building one with the whole library takes seconds.
_MOVING = [
    "FreeChain",
    "UniversalSwing",
    "PlanarTilted",
    "SphericalStatesQuaternions",
    "FreeMotionAngles",
    "FreeBodyQuaternions",
    "Homogeneous",
    "LineForces",
    "WorldForces",
    "MutualForces",
    "Sensors",
    "FrameFunctions",
    "RotationalDrives",
    "RotationalSupports",
    "TranslationalDrives",
    "Controller",
    "Filters",
    "DrivenRobot",
]
_ATTRIBUTES = (
    "variability",
    "causality",
    "flow",
    "dims",
    "quantity",
    "unit",
    "start",
    "fixed",
    "min",
    "max",
    "binding",
)
_POSITIONS = {"span", "source_span", "location", "instance_id", "def_id", "type_id", "token_number", "source"}
# Inside sensors and forces the two libraries have different parts; the sensors' and forces' own variables are compared.
_INNER = (".frame_resolve", ".lineForce.", ".transform", ".zeroPosition", ".resolveVector", ".cut.")


def _plain(value: Any) -> Any:
    """An expression without the places it comes from."""
    if isinstance(value, dict):
        if set(value) == {"Literal"}:
            inner = value["Literal"]["value"]
            number = next(iter(inner.values())) if isinstance(inner, dict) else inner
            return float(number) if isinstance(number, int | float) and not isinstance(number, bool) else number
        return {key: _plain(item) for key, item in value.items() if key not in _POSITIONS}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value


def _kind(value: Any) -> str:
    return next(iter(value)) if isinstance(value, dict) else str(value)


def _is_simple(value: Any) -> bool:
    """Whether an expression is a literal, or an array of literals: its form is then its value."""
    if isinstance(value, list):
        return all(_is_simple(item) for item in value)
    if isinstance(value, dict):
        return set(value) == {"Array"} and _is_simple(value["Array"].get("elements"))
    return True


_NAMES = [name for name in core_models.fixture_names() if name not in _OWN]


@pytest.fixture(scope="module")
def interfaces(msl, tmp_path_factory):
    """Public variables of all test models with both libraries: they are components of one model, to load each once."""
    file = tmp_path_factory.mktemp("all") / "AllFixtures.mo"
    components = "".join(f"  CoreFixtures.{name} the{name};\n" for name in _NAMES)
    file.write_text(
        f"model AllFixtures\n  extends Modelica.Icons.Example;\n{components}end AllFixtures;\n", encoding="utf-8"
    )

    def variables(library: str) -> dict[str, dict[str, Any]]:
        session = rumoca.Session([library, str(core_models.MODELS)])
        flat = session.load(str(file), model="AllFixtures").to_dict("flat")
        return {
            key: value
            for key, value in flat["variables"].items()
            if not value["is_protected"] and not any(part in f"{key}." for part in _INNER)
        }

    return variables(str(core_models.CORE)), variables(str(msl))


@pytest.mark.parametrize("name", _NAMES)
def test_same_public_variables(name, interfaces):
    own, real = (
        {key: value for key, value in library.items() if key.startswith(f"the{name}.")} for library in interfaces
    )
    assert own
    assert not set(own) - set(real), "variables that the Standard Library does not have"
    assert not set(real) - set(own), "variables that the subset lacks"
    for variable, attributes in own.items():
        for attribute in _ATTRIBUTES:
            mine, theirs = attributes[attribute], real[variable][attribute]
            if attribute in ("variability", "causality"):
                mine, theirs = _kind(mine), _kind(theirs)
            mine, theirs = _plain(mine), _plain(theirs)
            # Formulas may be written differently; their values are compared in motion.
            if _is_simple(mine) and _is_simple(theirs):
                assert mine == theirs, f"{variable}: {attribute}"


@pytest.mark.parametrize("name", _MOVING)
def test_same_trajectories(name, msl, simulate):
    own, real = simulate(name, stop=0.5), simulate(name, stop=0.5, library=msl)
    common = [variable for variable in own if variable in real and not variable.startswith("der(")]
    assert len(common) > 10
    for variable in common:
        scale = max(1.0, float(np.max(np.abs(real[variable]))))
        difference = float(np.max(np.abs(own[variable] - real[variable]))) / scale
        # Ten times what the two integrators' tolerance of 1e-10 leaves: the quaternions' equations differ.
        assert difference < 2e-8, f"{variable}: {difference:.1e}"
