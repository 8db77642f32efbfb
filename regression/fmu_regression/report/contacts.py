"""The report's sections on contacts: impacts, forces, loads."""

from __future__ import annotations

from fmu_regression.report.page import Cell, Column, Row, Section, Table
from fmu_regression.report.plots import PER_PLOT, Plot, Series, plots_over_time
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.impacts import Impact
from fmu_regression.scene.loads import pair_loads
from fmu_regression.scene.scene_file import ContactPair, Scene
from fmu_regression.scene.signals import pair_signal

_MAX_TABLE_ROWS = 20_000  # that browsers still show
_CLOSE_RESTITUTION = 0.02
_LEAST_OVERLAP = 1e-9  # m; less is rounding
_MOST_NOTES = 20
_QUANTITIES = {
    "normalForce": ("Contact force", "normal force in N"),
    "distance": (
        "Distance between the bodies",
        "signed distance in m; where bodies are apart, a lower bound unless exact clearances were asked for",
    ),
    "approachSpeed": ("Approach speed", "approach speed in m/s"),
}


def impact_section(scene: Scene, impacts: tuple[Impact, ...]) -> Section | None:
    """The table of impacts; None if no pair is watched."""
    if not scene.pairs:
        return None
    if not impacts:
        return Section("impacts", "Impacts", lead="No two bodies touch.")
    notes = []
    if len(impacts) > _MAX_TABLE_ROWS:
        notes.append(f"{len(impacts) - _MAX_TABLE_ROWS} further contacts are left out here")
    if any(not impact.located for impact in impacts):
        notes.append(
            "~ the result has no event at the start or end of this contact; time and speeds are interpolated between "
            "samples"
        )
    columns = (
        Column("Start, s", "text"),
        Column("Pair", "text"),
        Column("Duration, ms"),
        Column("Speed before, m/s"),
        Column("Speed after, m/s"),
        Column("Restitution"),
        Column("asked for"),
        Column("Peak force, N"),
        Column("Impulse, N s"),
    )
    rows = tuple(_impact_row(scene, impact) for impact in impacts[:_MAX_TABLE_ROWS])
    return Section(
        "impacts",
        "Impacts",
        lead="Speeds are those along the contact normal when the contact begins and ends.",
        tables=(Table(columns, rows),),
        notes=tuple(notes),
    )


def _impact_row(scene: Scene, impact: Impact) -> Row:
    delivered, asked = impact.restitution, impact.pair.restitution
    close = delivered is not None and asked is not None and abs(delivered - asked) <= _CLOSE_RESTITUTION
    duration = "to the end" if impact.end is None else f"{1000 * (impact.end - impact.start):.4g}"
    return Row(
        cells=(
            Cell(f"{'' if impact.located else '~ '}{impact.start:.6f}", "text"),
            Cell(scene.pair_label(impact.pair), "text"),
            Cell(duration),
            Cell(_optional(impact.speed_before, ".4g")),
            Cell(_optional(impact.speed_after, ".4g")),
            Cell(_optional(delivered, ".4f"), "good" if close else ""),
            Cell(_optional(asked, ".4g")),
            Cell(_optional(impact.peak_force, ".5g")),
            Cell(_optional(impact.impulse, ".4g")),
        ),
        time=f"{impact.start if impact.peak_time is None else impact.peak_time:.9g}",
    )


def _optional(value: float | None, form: str) -> str:
    return "–" if value is None else format(value + 0.0, form)


def contact_section(scene: Scene, result: SimulationResult) -> Section | None:
    """Forces, distances and speeds of the pairs, and what each carries; None if nothing of it is recorded."""
    touching = [pair for pair in scene.pairs if _ever_touches(scene, pair, result)]
    plots: list[Plot] = []
    for quantity, (title, label) in _QUANTITIES.items():
        pairs = scene.pairs if quantity == "distance" and len(scene.pairs) <= PER_PLOT else touching
        series = [
            Series(scene.pair_label(pair), result.time, result[name])
            for pair in pairs
            if (name := pair_signal(scene, pair, quantity)) in result
        ]
        plots += plots_over_time(f"contact-{quantity}", title, label, series)
    if not plots:
        return None
    left_out = len(scene.pairs) - len(touching)
    notes = [f"{left_out} pairs that never touch are left out"] if left_out and len(scene.pairs) > PER_PLOT else []
    notes += start_overlap_notes(scene, result)
    return Section("contacts", "Contacts", plots=tuple(plots), tables=_load_tables(scene, result), notes=tuple(notes))


def start_overlap_notes(scene: Scene, result: SimulationResult) -> list[str]:
    """Pairs that are in each other at the start: what drives them apart is no gain of energy, but was there before."""
    found = []
    for pair in scene.pairs:
        name = pair_signal(scene, pair, "distance")
        depth = -float(result[name][0]) if name in result and result.time.size else 0.0
        if depth > _LEAST_OVERLAP:
            found.append((depth, scene.pair_label(pair)))
    return [
        f"{label} overlap at the start by {1000 * depth:.3g} mm: its elastic energy is there from the start"
        for depth, label in sorted(found, reverse=True)[:_MOST_NOTES]
    ]


def _ever_touches(scene: Scene, pair: ContactPair, result: SimulationResult) -> bool:
    force = pair_signal(scene, pair, "normalForce")
    distance = pair_signal(scene, pair, "distance")
    if force in result:
        return bool((result[force] != 0).any())
    return distance in result and bool((result[distance] < 0).any())


def _load_tables(scene: Scene, result: SimulationResult) -> tuple[Table, ...]:
    columns = (
        Column("Pair", "text"),
        Column("In contact, s"),
        Column("Mean force meanwhile, N"),
        Column("Peak force, N"),
        Column("Largest depth, mm"),
        Column("Slid, mm"),
    )
    rows = tuple(
        Row(
            (
                Cell(scene.pair_label(load.pair), "text"),
                Cell(f"{load.touching:.4g}"),
                Cell(f"{load.mean_force:.4g}"),
                Cell(f"{load.peak_force:.5g}"),
                Cell(_optional(None if load.largest_depth is None else 1000 * load.largest_depth, ".4g")),
                Cell(_optional(None if load.slid is None else 1000 * load.slid, ".4g")),
            )
        )
        for load in pair_loads(scene, result)[:_MAX_TABLE_ROWS]
    )
    return (Table(columns, rows),) if rows else ()
