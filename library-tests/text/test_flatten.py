"""rumoca flattens the whole library, with the project's MultiBody core and with the real Standard Library."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from library_compiler import LIBRARIES, Compiler
from library_files import case_models, class_files, runnable_models

# These use every part and every effect; the real libraries are too slow to flatten all models with.
REPRESENTATIVE = (
    "ContactMultiBody.Examples.HammerOnAnvil",
    "ContactMultiBody.Examples.BallWithoutEvents",
    "ContactMultiBody.Examples.RollingResistance",
    "ContactMultiBodyTest.Scenes.AllParts",
    "ContactMultiBody.Actuators.Examples.CascadeOnArm",
    "ContactMultiBody.Actuators.Examples.SpindleAxis",
)


# Together these use all of the functions.
RICH_IN_FUNCTIONS = (
    "ContactMultiBody.Examples.BoxOnEdge",
    "ContactMultiBody.Examples.SpheresInBox",
    "ContactMultiBodyTest.Scenes.AllShapes",
    "ContactMultiBodyTest.Scenes.ShapesFromFiles",
    "ContactMultiBodyTest.Laws.ScalarLaws",
    "ContactMultiBodyTest.Laws.DampingFactors",
    "ContactMultiBodyTest.Agreement.BothWays",
    "ContactMultiBody.Actuators.Examples.CascadeOnArm",
    "ContactMultiBody.Examples.BlockOnMat",
    "ContactMultiBodyTest.Sliding.TurningFaces",
    "ContactMultiBodyTest.Agreement.ShapesByBothWays",
    "ContactMultiBodyTest.Rest.AllFormulaContacts",
)


# FMUs are built of them, as of the models of regression cases.
BUILT = {f"ContactMultiBodyTest.Agreement.{name}ByBothWays" for name in ("Laws", "Shapes", "Spheres")} | case_models()


LARGE = {"ContactMultiBodyTest.Agreement.BothWays", "ContactMultiBodyTest.Sliding.TurningFaces"}


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.full if name in LARGE else ())
        for name in runnable_models()
        if name not in BUILT
    ],
)
def test_model_flattens(core: Compiler, name: str) -> None:
    flat = core.flatten(name)
    assert flat["equations"]


@pytest.mark.parametrize("version", [library for library in LIBRARIES if library != "core"])
@pytest.mark.parametrize("name", REPRESENTATIVE)
def test_model_flattens_with_the_standard_library(
    compilers: Callable[[str], Compiler], version: str, name: str
) -> None:
    assert compilers(version).flatten(name)["equations"]


@pytest.mark.full
def test_every_function_is_used_by_a_model(core: Compiler) -> None:
    unused = {f.full_name for f in class_files() if f.kind == "function" and "partial" not in f.prefix}
    others = [name for name in runnable_models() if name not in RICH_IN_FUNCTIONS]
    for model in [*RICH_IN_FUNCTIONS, *others]:  # the others only if these leave something over
        # a name the model wrote without its package is kept as it was written
        used = tuple(core.flatten(model)["functions"])
        unused -= {name for name in unused if any(name == key or name.endswith(f".{key}") for key in used)}
        if not unused:
            break
    assert sorted(unused) == []


EFFECTS = (
    # modification of the contacts of BoxOnIncline, has events, has anchors, recovers the speed of impact
    ("", True, False, False),
    ("friction=ContactMultiBody.Types.Friction.None", True, False, False),
    ("friction=ContactMultiBody.Types.Friction.Anchored", True, True, False),
    ("useRestitution=false", False, False, False),
    ("normalLaw=ContactMultiBody.Types.NormalLaw.SpringDamper", False, False, False),
    ("restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless", False, False, True),
)

FRICTION_FUNCTIONS = ("regularisedForces", "anchoredForces", "anchorRates")


@pytest.mark.parametrize(
    ("modification", "events", "anchors", "recovers"),
    [pytest.param(*case, marks=() if case is EFFECTS[0] else pytest.mark.full) for case in EFFECTS],
)
def test_effects_are_structural(core: Compiler, modification: str, events: bool, anchors: bool, recovers: bool) -> None:
    model = core.model("ContactMultiBody.Examples.BoxOnIncline", f"contacts({modification})")
    flat = model.to_dict("flat")
    variables = flat["variables"]

    def elements(name: str) -> int:
        size = 1
        for extent in variables[name]["dims"] if name in variables else [0]:
            size *= extent
        return size

    assert bool(flat["when_chains"]) == events
    assert (elements("contacts.touches") > 0) == events
    assert (elements("contacts.impactSpeed") > 0) == events
    for name in ("strikeSpeed", "struck", "rate"):
        assert (elements(f"contacts.{name}") > 0) == events, name
    assert elements("contacts.anchorStretch") == (6 if anchors else 0)
    assert (elements("contacts.springDeceleration") > 0) == recovers


@pytest.mark.parametrize(
    ("friction", "called"),
    [
        pytest.param("None", set(), marks=pytest.mark.full),
        pytest.param("Regularised", {"regularisedForces"}, marks=pytest.mark.full),
        ("Anchored", None),
    ],
)
def test_equations_call_the_friction_that_was_chosen(core: Compiler, friction: str, called: set[str] | None) -> None:
    law = f"contacts(friction=ContactMultiBody.Types.Friction.{friction})"
    equations = str(core.model("ContactMultiBody.Examples.BoxOnIncline", law).to_dict("flat")["equations"])
    found = {name for name in FRICTION_FUNCTIONS if name in equations}
    assert found == (set(FRICTION_FUNCTIONS) - {"regularisedForces"} if called is None else called)


@pytest.mark.parametrize("version", LIBRARIES)
def test_body_without_geometry_is_the_standard_one(compilers: Callable[[str], Compiler], version: str) -> None:
    flat = compilers(version).flatten("ContactMultiBodyTest.Scenes.BodyWithoutGeometry")

    def members(body: str) -> set[str]:
        return {name.removeprefix(f"{body}.") for name in flat["variables"] if name.startswith(f"{body}.")}

    added = members("mine") - members("standard")
    assert members("standard") - members("mine") == set()
    assert added
    assert all(
        name in {"geometry", "checkInertia"} or name.split(".")[0] in {"material", "inertia", "collider"}
        for name in added
    )

    def equations(body: str) -> int:
        return sum(f"'{body}." in str(equation) for equation in flat["equations"])

    assert equations("mine") == equations("standard") > 0
