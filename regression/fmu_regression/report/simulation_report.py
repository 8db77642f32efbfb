"""The report of a simulation: summary, animation, impacts, forces, joints, energy, on one HTML page."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place
from contact_foundation.output import whole_file

from fmu_regression.report.animation import make_animation
from fmu_regression.report.body_contacts import body_contact_section, body_contact_tiles
from fmu_regression.report.contacts import contact_section, impact_section
from fmu_regression.report.figures import NO_FIGURES, Figures, rows_within
from fmu_regression.report.page import Section, Tile, render_page
from fmu_regression.report.plots import TIME_LABEL, Plot, Series, plots_over_time
from fmu_regression.results.result import SimulationResult
from fmu_regression.results.undefined import undefined_remarks
from fmu_regression.scene.energy import EnergyBalance, energy_balance
from fmu_regression.scene.fmu_scene import load_scene_of
from fmu_regression.scene.impacts import Impact, find_impacts
from fmu_regression.scene.joint_power import JointPower, joint_power
from fmu_regression.scene.possible_motion import jump_notes, require_possible_motion
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import require_signals

_MAX_PLOTS = 40


def write_report(
    result: SimulationResult, scene_file: Path | None, target: Path, figures: Figures = NO_FIGURES
) -> tuple[str, ...]:
    """Writes the report of a result as one self-contained HTML file.

    Args:
        result: the simulation; signals as ``signals_for`` chooses them give the fullest report.
        scene_file: ``scene.json``, or the FMU of a model with a contact manager; without it the report has plots of all
            signals only.
        target: the HTML file; it appears whole or not at all.
        figures: plots and numbers of the modeller's choice.

    Returns:
        Notes on motions that the result's own speeds do not explain; the report has them too.

    Raises:
        InputError: the scene file is wrong, the result lacks what the report would otherwise deny, or has numbers that
            cannot be poses or forces.
    """
    scene = load_scene_of(scene_file) if scene_file is not None else None
    if scene is not None:
        place = Place(component=f"the result {result.model}".rstrip())
        require_signals(scene, result.signals, place, f"Record them: cmb simulate FMU --scene {scene_file}.")
        require_possible_motion(scene, result, place)
    text = report_html(result, scene, figures)
    with whole_file(target) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")
    return jump_notes(scene, result) if scene is not None else ()


def report_html(result: SimulationResult, scene: Scene | None, figures: Figures = NO_FIGURES) -> str:
    """The report's HTML; the same input gives the same text."""
    chosen = _chosen_section(figures.within(result), result)
    if scene is None:
        sections = [_overview(result, None, (), None), *([chosen] if chosen else []), _all_signals(result)]
        title = result.model or "Simulation"
    else:
        impacts = find_impacts(scene, result)
        has_mass = any(body.mass > 0 and not body.fixed for body in scene.bodies)
        energy = energy_balance(scene, result) if has_mass else None
        candidates = [
            _overview(result, scene, impacts, energy),
            _animation(scene, result),
            chosen,
            impact_section(scene, impacts),
            contact_section(scene, result),
            body_contact_section(scene, result),
            _joint_section(scene, result),
            _energy_section(energy, joint_power(scene, result)),
        ]
        sections = [section for section in candidates if section is not None]
        title = scene.name
    duration = f"{result.time[-1] - result.time[0]:g} s simulated"
    return render_page(title, f"{duration}, {result.time.size} rows", sections)


def _overview(
    result: SimulationResult, scene: Scene | None, impacts: tuple[Impact, ...], energy: EnergyBalance | None
) -> Section:
    tiles = [Tile("Time", f"{result.time[-1]:g}", "s", f"{result.time.size} rows")]
    if scene is not None:
        tiles.append(_mechanism_tile(scene))
        if scene.pairs:
            tiles += _contact_tiles(scene, impacts)
        tiles += body_contact_tiles(scene, result)
    if energy is not None:
        tiles.append(Tile("Energy change", f"{energy.change:+.3g}", "J", f"from {energy.total[0]:.5g} J at the start"))
        tiles.append(Tile("Largest energy rise", f"{energy.largest_rise:.2g}", "J", "above an earlier total"))
    if result.tolerance is not None:
        kind = {"me": "model exchange, CVODE", "cs": "co-simulation"}.get(result.mode, result.mode)
        tiles.append(Tile("Tolerance", f"{result.tolerance:g}", "", kind))
    if result.counters is not None:
        counters = result.counters
        rejected = counters.error_test_failures + counters.convergence_failures
        tiles.append(Tile("Solver steps", f"{counters.steps}", "", f"{rejected} rejected"))
        events = counters.state_events + counters.time_events
        tiles.append(Tile("Evaluations", f"{counters.evaluations}", "", f"{events} events"))
    jumps = jump_notes(scene, result) if scene is not None else ()
    return Section(
        "summary", "Summary", tiles=tuple(tiles), notes=(*jumps, *undefined_remarks(result), *result.log[:20])
    )


def _mechanism_tile(scene: Scene) -> Tile:
    moving = [body for body in scene.bodies if not body.fixed]
    mass = sum(body.mass for body in moving)
    return Tile("Moving bodies", str(len(moving)), "", f"{mass:.4g} kg")


def _contact_tiles(scene: Scene, impacts: tuple[Impact, ...]) -> list[Tile]:
    watched = f"{len(scene.pairs)} pair{'s' if len(scene.pairs) != 1 else ''} watched"
    if not impacts:
        return [Tile("Contacts", "none", "", watched)]
    first = next((impact for impact in impacts if impact.meets), impacts[0])
    tiles = [
        Tile("Contacts", str(len(impacts)), "", watched),
        Tile("First impact", f"{first.start:.5g}", "s", scene.pair_label(first.pair)),
    ]
    strong = [impact for impact in impacts if impact.peak_force is not None]
    if strong:
        peak = max(strong, key=lambda impact: impact.peak_force or 0.0)
        tiles.append(
            Tile("Peak force", f"{peak.peak_force:.5g}", "N", f"{scene.pair_label(peak.pair)}, {peak.peak_time:.5g} s")
        )
    return tiles


def _animation(scene: Scene, result: SimulationResult) -> Section | None:
    animation = make_animation(scene, result)
    return None if animation is None else Section("animation", "Animation", animation=animation)


def _chosen_section(figures: Figures, result: SimulationResult) -> Section | None:
    tiles = tuple(Tile(number.title, f"{number.value(result):.5g}", number.unit) for number in figures.numbers)
    plots: list[Plot] = []
    for k, chosen in enumerate(figures.plots):
        rows = rows_within(result, chosen.window)
        series = [Series(label, result.time[rows], result[name][rows]) for label, name in chosen.signals]
        plots += plots_over_time(f"chosen-{k + 1}", chosen.title, chosen.label, series)
    return Section("chosen", "Chosen figures", tiles=tiles, plots=tuple(plots)) if tiles or plots else None


def _joint_section(scene: Scene, result: SimulationResult) -> Section | None:
    plots: list[Plot] = []
    for kind, title in (("variable", "Joint coordinates"), ("rate", "Joint rates")):
        by_unit: dict[str, list[Series]] = defaultdict(list)
        for joint in scene.joints:
            name = joint.variable if kind == "variable" else joint.rate
            if name in result:
                by_unit[joint.unit].append(Series(joint.name, result.time, result[name]))
        for unit, series in by_unit.items():
            what = {"rad": "angle", "m": "length"}.get(unit, "coordinate")
            label = f"{what} in {unit or '1'}" if kind == "variable" else f"rate in {unit or '1'}/s"
            plots += plots_over_time(f"joint-{kind}-{unit or 'none'}", title, label, series)
    return Section("joints", "Joints", plots=tuple(plots[:_MAX_PLOTS])) if plots else None


def _energy_section(energy: EnergyBalance | None, power: JointPower | None) -> Section | None:
    if energy is None:
        return None
    series = [
        Series("kinetic", energy.time, energy.kinetic),
        Series("potential", energy.time, energy.potential),
    ]
    if energy.elastic is not None:
        series.append(Series("elastic, in the contacts", energy.time, energy.elastic))
    series.append(Series("total", energy.time, energy.total))
    gained = energy.total - energy.total[0]
    against = [Series("total less total at the start", energy.time, gained, color=3)]
    plots = [Plot("energy-kinds", "Energy", TIME_LABEL, "energy in J", tuple(series))]
    lead = (
        "Computed from masses, inertias and the recorded motion of all moving bodies. Falls are losses in "
        "impacts, friction and damping; rises come from drives, or from the integration."
    )
    if power is not None:
        work = power.work
        against.append(Series("work of drives, stops, springs and friction at the joints", energy.time, work, color=1))
        against.append(Series("difference: contacts, and the integration", energy.time, gained - work, color=2))
        sides = (
            Series("in, at joints that push", power.time, power.supplied),
            Series("out, at joints that brake", power.time, power.taken),
        )
        plots.append(Plot("joint-power", "Power through the joints", TIME_LABEL, "power in W", sides))
        lead += (
            f" Through the axes of the joints {np.trapezoid(power.supplied, power.time):.4g} J came in and "
            f"{np.trapezoid(power.taken, power.time):.4g} J went out, by the trapezoidal rule over the rows."
        )
    plots.insert(1, Plot("energy-total", "Total energy against its start", TIME_LABEL, "energy in J", tuple(against)))
    return Section(
        "energy",
        "Energy",
        lead=lead,
        plots=tuple(plots),
        notes=energy.notes,
    )


def _all_signals(result: SimulationResult) -> Section:
    groups: dict[str, list[Series]] = defaultdict(list)
    for name, values in result.signals.items():
        groups[name.split("[", 1)[0]].append(Series(name, result.time, values))
    plots: list[Plot] = []
    for k, (name, series) in enumerate(groups.items()):
        plots += plots_over_time(f"signal-{k}", name, result.axis_label(series[0].name), series)
    notes = (f"{len(plots) - _MAX_PLOTS} further plots are left out",) if len(plots) > _MAX_PLOTS else ()
    return Section("signals", "Signals", plots=tuple(plots[:_MAX_PLOTS]), notes=notes)
