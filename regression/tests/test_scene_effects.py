"""The study of effects, on managers and results made without any FMU."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError
from fmu_regression.fmi.description import ModelDescription, Variable
from fmu_regression.results.result import FloatArray, SimulationResult, SolverCounters
from lxml import html
from scene_effects.advice import Advice, AdviceItem, advice_text
from scene_effects.choices import Change, Friction, Restitution
from scene_effects.difference import Difference, motion_difference
from scene_effects.findings import Finding, Verdict, find
from scene_effects.manager import PAIR_PARAMETERS, ContactBody, Manager, Parameters, find_manager
from scene_effects.measurement import BuildFigures, Measurement
from scene_effects.observation import PairObservation, exact_distances, observe
from scene_effects.study import EffectStudy
from scene_effects.table import effects_text, write_effects
from scene_effects.variants import Variant, fullest, modification, variants_of, write_variant

BODIES = (
    ContactBody("ball", ("sphere",), "ball.m"),
    ContactBody("box", ("box",), "box.m"),
    ContactBody("floor", ("halfspace",), None),
)
MANAGER = Manager(
    name="contacts",
    bodies=BODIES,
    pairs=((1, 2), (1, 3), (2, 3)),
    friction=Friction.ANCHORED,
    restitution=Restitution.BY_EVENT,
    regards_restitution=True,
    turning=False,
    point_capacity=4,
)
DEFAULTS = {"contactRadius": 0.01, "damping": 1e3, "effectiveMass": 0.0, "steadyRate": 0.5}


def parameters(**pair: tuple[float, ...]) -> Parameters:
    values = {name: (DEFAULTS.get(name, 0.0),) * 3 for name in PAIR_PARAMETERS}
    values |= {"stiffness": (1e6, 2e6, 3e6), "restitution": (0.3, 0.4, 0.5)}
    values |= {"muStatic": (0.3,) * 3, "muDynamic": (0.3,) * 3, "frictionStiffness": (8e5,) * 3}
    return Parameters(
        pair={**values, **pair},
        rest_speed=0.01,
        regularisation_speed=1e-3,
        turning_regularisation_speed=0.01,
        masses=(1.0, 3.0, math.inf),
    )


APART = PairObservation(0.2, 0.3, 0.0, 0.0, 0, 0.0, 0.0, 0.0, 0.0, 0, 0.0)
HITS = PairObservation(-1e-3, 0.5, 0.4, 1.5, 2, 0.2, 0.1, 0.5, 2e-5, 4, 0.0)


def finding(effect: str, manager: Manager, numbers: Parameters, *pairs: PairObservation) -> Finding:
    return next(f for f in find(manager, numbers, pairs, 1e-3) if f.effect == effect)


# --- modifications ------------------------------------------------------------------------------------------------


def test_modification_of_a_manager_inside_a_component() -> None:
    change = Change(friction=Friction.NONE, turning=False)
    text = modification(change, replace(MANAGER, name="cell.contacts"), parameters())
    assert text == "cell(contacts(friction=ContactMultiBody.Types.Friction.None, useTurningFriction=false))"


def test_pairs_left_out_shorten_the_arrays_of_pairs() -> None:
    text = modification(Change(kept_pairs=(0, 2)), MANAGER, parameters())
    assert "pairs={{1,2},{2,3}}" in text
    assert "stiffness={1000000.0,3000000.0}" in text
    assert "restitution={0.3,0.5}" in text
    assert "contactRadius" not in text  # has the library's default


def test_a_change_of_values_counts_for_the_pairs_that_are_left() -> None:
    change = Change(values={"steadyRate": (1.0, 2.0, 3.0)}).with_(Change(kept_pairs=(2,)))
    assert "steadyRate={3.0}" in modification(change, MANAGER, parameters())


def test_no_change_no_modification(tmp_path: Path) -> None:
    assert modification(Change(), MANAGER, parameters()) == ""
    write_variant(tmp_path / "V.mo", "A.B", "")
    assert "extends A.B;" in (tmp_path / "V.mo").read_text()


# --- variants -----------------------------------------------------------------------------------------------------


def test_variants_differ_from_the_fullest_by_one_effect() -> None:
    variants = {v.name: v.change for v in variants_of(MANAGER, parameters(), [1, 2])}
    full = fullest(MANAGER, parameters())
    assert variants["friction none"] == replace(full, friction=Friction.NONE)
    assert variants["2 of 3 pairs"] == replace(full, kept_pairs=(1, 2))
    least = variants["all of these off"]
    assert least is not None
    assert (least.friction, least.restitution, least.point_capacity) == (Friction.NONE, Restitution.NONE, 1)
    assert "spin and rolling off" not in variants


def test_effective_masses_come_from_the_bodies() -> None:
    variants = {v.name: v.change for v in variants_of(MANAGER, parameters(), [0, 1, 2], ["restitution"])}
    change = variants["restitution memoryless"]
    assert change is not None
    assert change.values["effectiveMass"] == pytest.approx((0.75, 1.0, 3.0))


def test_no_variants_of_restitution_where_the_law_disregards_it() -> None:
    manager = replace(MANAGER, regards_restitution=False, restitution=Restitution.NONE)
    assert all("restitution" not in variant.name for variant in variants_of(manager, parameters(), [0]))


# --- the manager of an FMU ----------------------------------------------------------------------------------------


def description(manager: str = "contacts", managers: int = 1) -> ModelDescription:
    """Two balls of the same descriptor, told apart by the frame they share with the manager."""
    variables: dict[str, Variable] = {}

    def add(name: str, start: str | None = None, reference: int = 0) -> None:
        variables[name] = Variable(name, reference, "Real", "Real", "local", "constant", "", False, start)

    for number in range(managers):
        name = manager + (str(number) if managers > 1 else "")
        choices = {"n": "2", "m": "1", "pair[1,1]": "2", "pair[1,2]": "1", "friction": "2", "pointCapacity": "1"}
        choices |= {"normalLaw": "1", "useRestitution": "true", "restitutionMethod": "2", "useTurningFriction": "true"}
        choices |= {"catchImpacts": "false", "geometry[1]": "cmb/1 sphere radius=1"}
        choices["geometry[2]"] = choices["geometry[1]"]
        for parameter, start in choices.items():
            add(f"{name}.{parameter}", start)
        for body in (1, 2):
            for k in (1, 2, 3):
                add(f"{name}.frame[{body}].r_0[{k}]", reference=10 * body + k)
    for component, body in (("second", 2), ("first", 1)):
        add(f"{component}.geometry", "cmb/1 sphere radius=1")
        add(f"{component}.m")
        for k in (1, 2, 3):
            add(f"{component}.frame_a.r_0[{k}]", reference=10 * body + k)
    return ModelDescription("2.0", "M", "", {}, variables, (), 0, 0, False, True, 0.0, 1.0, 1e-6, 0.1, "")


def test_manager_is_found_with_its_bodies() -> None:
    manager = find_manager(description())
    assert [body.name for body in manager.bodies] == ["first", "second"]
    assert manager.bodies[0].mass_variable == "first.m"
    assert manager.pairs == ((2, 1),)
    assert manager.pair_label(0) == "second – first"
    assert (manager.friction, manager.restitution) == (Friction.REGULARISED, Restitution.MEMORYLESS)
    assert manager.turning


def test_wrong_managers() -> None:
    with pytest.raises(InputError, match="several managers: contacts0, contacts1"):
        find_manager(description(managers=2))
    assert find_manager(description(managers=2), "contacts1").name == "contacts1"
    with pytest.raises(InputError, match="other is no ContactManager"):
        find_manager(description(), "other")
    empty = replace(description(), variables={})
    with pytest.raises(InputError, match=r"no ContactMultiBody\.ContactManager"):
        find_manager(empty)


# --- differences --------------------------------------------------------------------------------------------------


def motion(shift: float, angle: float, time: FloatArray) -> SimulationResult:
    signals = {name: np.zeros(time.size) for name in MANAGER.motion_signals()}
    signals[MANAGER.position(1)[0]] = 3 * shift * time
    signals[MANAGER.position(1)[2]] = 4 * shift * time
    c, s = np.cos(angle * time), np.sin(angle * time)
    ones = np.ones(time.size)
    turned = (c, s, 0 * ones, -s, c, 0 * ones, 0 * ones, 0 * ones, ones)
    for body in range(3):
        for name, values in zip(MANAGER.rotation(body), turned, strict=True):
            signals[name] = np.array(values)
    return SimulationResult(time=time, signals=signals)


def test_difference_of_motions() -> None:
    # The second result has rows of events between the output times, which are not compared.
    a = motion(0.0, 0.0, np.linspace(0, 1, 11))
    b = motion(0.01, 0.2, np.sort(np.append(np.linspace(0, 1, 11), [0.55, 0.55])))
    difference = motion_difference(MANAGER, b, a)
    assert difference.position == pytest.approx(0.05)
    assert (difference.body, difference.time) == (1, 1.0)
    assert difference.angle == pytest.approx(0.2)
    assert motion_difference(MANAGER, a, a).position == 0


# --- observations -------------------------------------------------------------------------------------------------


def test_distances_are_observed_exactly() -> None:
    assert exact_distances(MANAGER, description()) == {}
    length = Variable("contacts.exactWithin", 99, "Real", "Real", "parameter", "fixed", "m", True, "0.1")
    with_length = replace(description(), variables={**description().variables, length.name: length})
    ((name, value),) = exact_distances(MANAGER, with_length).items()
    assert name == "contacts.exactWithin"
    assert value > 1e12
    fixed = {**with_length.variables, length.name: replace(length, settable=False)}
    assert exact_distances(MANAGER, replace(with_length, variables=fixed)) == {}


def contact(**changed: FloatArray) -> SimulationResult:
    """One pair: apart until 1 s, arrives at 0.5 m/s, then sticks under 60 % of its friction for 1 s on two points."""
    time = np.linspace(0, 2, 201)
    load = np.where(time >= 1, 100.0, 0.0)
    signals = {f"contacts.w_0[{b},{k}]": np.zeros(201) for b in (1, 2, 3) for k in (1, 2, 3)}
    for i in (1, 2, 3):
        for k in (1, 2, 3):
            signals[f"contacts.force[{i},{k}]"] = {1: 0.6 * 0.3 * load, 2: 0 * load, 3: load}[k]
            for slot in (1, 2, 3, 4):
                signals[f"contacts.normal[{i},{slot},{k}]"] = np.full(201, float(k == 3))
                signals[f"contacts.pointVelocity[{i},{slot},{k}]"] = np.zeros(201)
        signals[f"contacts.distance[{i}]"] = np.where(time >= 1, -1e-4, 0.5 * (1 - time))
        signals[f"contacts.normalForce[{i}]"] = load
        signals[f"contacts.approachSpeed[{i}]"] = np.where(time >= 1, 0.0, 0.5)
        for slot, share in enumerate((0.5, 0.5, 0.0, 0.0)):
            signals[f"contacts.pointNormalForce[{i},{slot + 1}]"] = share * load
    return SimulationResult(time=time, signals={**signals, **changed})


def test_observation_of_a_contact_that_sticks() -> None:
    pair = observe(MANAGER, parameters(), contact())[0]
    assert pair.touches
    assert pair.contact_time == pytest.approx(1.0)
    assert pair.sticking_time == pytest.approx(1.0)
    assert (pair.impacts, pair.fastest_impact) == (1, 0.5)
    assert pair.tangential_share == pytest.approx(0.18)
    assert pair.largest_share == pytest.approx(0.6)
    # v = v_r q/sqrt(1 - q^2) = 0.75 mm/s for 1 s.
    assert pair.creep == pytest.approx(0.75e-3, rel=0.02)
    assert pair.most_points == 2


def test_sliding_does_not_stick() -> None:
    slides = {f"contacts.pointVelocity[1,{slot},1]": np.full(201, 0.5) for slot in (1, 2, 3, 4)}
    pair = observe(MANAGER, parameters(), contact(**slides))[0]
    assert (pair.sticking_time, pair.creep) == (0, 0)


def test_contact_between_two_output_times_shows_by_its_events() -> None:
    none = np.zeros(201)
    flag = none.copy()
    flag[100] = 1
    changed = {"contacts.normalForce[1]": none, "contacts.distance[1]": none, "contacts.touches[1]": flag}
    assert observe(MANAGER, parameters(), contact(**changed))[0].impacts == 1


# --- findings -----------------------------------------------------------------------------------------------------


def test_friction_by_what_it_does() -> None:
    holding = replace(HITS, creep=5e-3)
    assert finding("friction", MANAGER, parameters(), holding, APART, APART).verdict is Verdict.FITS
    weak = finding("friction", replace(MANAGER, friction=Friction.REGULARISED), parameters(), holding, APART, APART)
    assert (weak.verdict, weak.change) == (Verdict.MISSING, Change(friction=Friction.ANCHORED))
    assert "5 mm" in weak.reason
    # Creep is proportional to the speed: 1 mm/s lets it creep by 5 mm, 0.2 mm/s by 1 mm.
    assert weak.reason.endswith("It would stay below 1 mm with regularisationSpeed=2e-4.")
    slower = finding(
        "friction",
        replace(MANAGER, friction=Friction.REGULARISED),
        parameters(),
        replace(HITS, creep=1.61e-3),
        APART,
        APART,
    )
    assert slower.reason.endswith("regularisationSpeed=6e-4.")
    strong = finding("friction", MANAGER, parameters(), HITS, APART, APART)
    assert (strong.verdict, strong.change) == (Verdict.UNNEEDED, Change(friction=Friction.REGULARISED))
    straight = finding("friction", MANAGER, parameters(), replace(HITS, tangential_share=1e-6), APART, APART)
    assert straight.change == Change(friction=Friction.NONE)


def test_friction_of_pairs_that_never_touch_does_not_matter() -> None:
    smooth = parameters(muStatic=(0.0, 0.5, 0.5), muDynamic=(0.0, 0.5, 0.5))
    assert finding("friction", MANAGER, smooth, HITS, APART, APART).change == Change(friction=Friction.NONE)
    assert finding("friction", MANAGER, smooth, HITS, HITS, APART).change != Change(friction=Friction.NONE)


@pytest.mark.parametrize(
    ("speed", "impacts", "restitution", "needed"),
    [(1.5, 2, 0.3, True), (0.009, 2, 0.3, False), (0.0, 0, 0.3, False), (1.5, 2, 0.0, False)],
)
def test_restitution_by_speeds_and_materials(speed: float, impacts: int, restitution: float, needed: bool) -> None:
    numbers = parameters(restitution=(restitution, 0.9, 0.9))
    pair = replace(HITS, fastest_impact=speed, impacts=impacts)
    on = finding("restitution", MANAGER, numbers, pair, APART, APART)
    off = finding("restitution", replace(MANAGER, restitution=Restitution.NONE), numbers, pair, APART, APART)
    assert on.verdict is (Verdict.FITS if needed else Verdict.UNNEEDED)
    assert off.verdict is (Verdict.MISSING if needed else Verdict.FITS)


def test_without_restitution_contacts_are_damped_as_those_that_start_at_rest() -> None:
    found = finding("restitution", MANAGER, parameters(), replace(HITS, impacts=0), APART, APART)
    assert found.change is not None
    assert found.change.values["steadyRate"] == (2000.0,) * 3


def test_turning() -> None:
    rolls = replace(HITS, turning_at_end=5.0)
    assert finding("turning", MANAGER, parameters(), APART, rolls, APART).verdict is Verdict.MISSING
    assert finding("turning", MANAGER, parameters(), APART, APART, rolls).verdict is Verdict.FITS  # a box
    useless = finding("turning", replace(MANAGER, turning=True), parameters(), APART, rolls, APART)
    assert (useless.verdict, useless.change) == (Verdict.UNNEEDED, Change(turning=False))
    numbers = parameters(rollingLever=(0.0, 0.002, 0.0))
    assert finding("turning", replace(MANAGER, turning=True), numbers, APART, rolls, APART).verdict is Verdict.FITS
    assert finding("turning", MANAGER, numbers, APART, rolls, APART).change == Change(turning=True)


def test_points() -> None:
    one = replace(HITS, most_points=1)
    assert finding("points", MANAGER, parameters(), one, APART, APART).change == Change(point_capacity=1)
    assert finding("points", MANAGER, parameters(), one, HITS, APART).verdict is Verdict.FITS
    few = finding("points", replace(MANAGER, point_capacity=1), parameters(), one, HITS, APART)
    assert (few.verdict, few.change) == (Verdict.MISSING, Change(point_capacity=4))


def test_pairs_that_stay_apart() -> None:
    near, held = replace(APART, smallest_distance=5e-3), replace(APART, distance_range=0.0)
    found = finding("pairs", MANAGER, parameters(), HITS, held, near)
    assert found.change == Change(kept_pairs=(0, 2))
    assert "ball – floor (held at 200 mm)" in found.reason
    idle = finding("pairs", MANAGER, parameters(), HITS, APART, APART)
    assert "without any contact: floor" in idle.reason
    assert finding("pairs", MANAGER, parameters(), HITS, HITS, HITS).verdict is Verdict.FITS


def test_nothing_touches() -> None:
    found = find(MANAGER, parameters(), (APART, APART, replace(APART, smallest_distance=0.1)), 1e-3)
    assert len(found) == 1
    assert found[0].verdict is Verdict.UNNEEDED
    assert "box – floor, 100 mm" in found[0].reason


# --- texts --------------------------------------------------------------------------------------------------------


def measurement(name: str, states: int, position: float | None, error: str = "", angle: float = 0.0) -> Measurement:
    difference = None if position is None else Difference(position, 0, 0.5, angle)
    return Measurement(
        Variant(name, Change()),
        f"contacts({name})",
        BuildFigures(200 + states, states, 1, (6, 6), 300),
        None if error else SolverCounters(steps=100, evaluations=10 * states, state_events=3, time_events=1),
        None if error else 0.125,
        difference,
        error,
    )


def advice(position: float, angle: float = 0.0) -> Advice:
    item = AdviceItem(
        Finding("friction", Verdict.UNNEEDED, "It hardly holds.", Change(friction=Friction.REGULARISED)),
        measurement("less", 13, position, angle=angle),
    )
    return Advice("A.B", MANAGER, 2.0, 1e-3, measurement("as modelled", 16, None), (item,), None)


def test_advice_is_given_only_if_it_was_confirmed() -> None:
    good = advice_text(advice(0.5e-3))
    assert "Friction: can be less. It hardly holds." in good
    assert "states 16 → 13" in good
    assert "evaluations 160 → 130" in good
    assert "0.5 mm (ball at 0.5 s)" in good
    assert "Write: contacts(less)" in good
    assert "lines" not in good  # did not change
    bad = advice_text(advice(2e-3))
    assert "Friction: keep it." in bad
    assert "2 mm" in bad
    assert "Write:" not in bad
    assert "Friction: keep it." in advice_text(advice(0.0, angle=0.1))  # spins in its place


def test_table(tmp_path: Path) -> None:
    measured = (
        measurement("everything on", 16, None),
        measurement("friction <none>", 13, 2e-3),
        measurement("points", 14, None, error="gave up"),
    )
    study = EffectStudy("A.B", MANAGER, (HITS, APART, APART), 2.0, measured)
    text = effects_text(study)
    lines = text.splitlines()
    row = next(line for line in lines if line.startswith("friction <none>")).split()
    assert row[2:] == ["213", "13", "1", "6+6", "300", "130", "100", "4", "0.12", "2", "0"]
    assert "points: failed: gave up" in lines
    write_effects(study, tmp_path / "effects.html")
    page = (tmp_path / "effects.html").read_text()
    assert "http://" not in page.replace("http://www.w3.org", "")
    tree = html.fromstring(page)
    cells = [cell.text_content().strip() for cell in tree.iter("td")]
    assert "friction <none>" in cells
    assert "points: failed: gave up" in [item.text_content().strip() for item in tree.iter("li")]
    assert "ball – box" in cells
