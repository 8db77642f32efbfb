"""The report's section on contacts whose manager tells forces of bodies instead of pairs."""

from __future__ import annotations

from fmu_regression.report.page import Cell, Column, Row, Section, Table, Tile
from fmu_regression.report.plots import Plot, Series, plots_over_time
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.body_loads import BodyLoad, body_loads
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import touch_names

_PLOTTED = 24  # bodies, those of the largest forces: eight in a plot
_COUNTS = {"contactCount": ("Pairs that touch", "number"), "largestDepth": ("Largest penetration depth", "depth in m")}


def body_contact_section(scene: Scene, result: SimulationResult) -> Section | None:
    """Forces on bodies, number and depth of contacts; None if the scene's manager shows pairs, or there is none."""
    if not scene.colliders:
        return None
    loads = body_loads(scene, result)
    lead = f"{scene.manager} shows the sum of all contact forces on each body, not the forces of single pairs."
    if not loads:
        return Section("contacts", "Contacts", lead=f"No two bodies touch. {lead}")
    strongest = sorted(loads, key=lambda load: -load.peak_force)[:_PLOTTED]
    series = [Series(scene.label(load.body), result.time, load.strength) for load in strongest]
    plots: list[Plot] = plots_over_time("contact-force", "Contact force on bodies", "force in N", series)
    for name in touch_names(scene):
        quantity = name.rpartition(".")[2]
        if name in result and quantity in _COUNTS:
            title, label = _COUNTS[quantity]
            curve = Series(title.lower(), result.time, result[name])
            plots += plots_over_time(f"contact-{quantity}", title, label, [curve])
    left_out = len(loads) - len(strongest)
    notes = (f"{left_out} bodies of smaller forces are left out of the plots",) if left_out else ()
    return Section("contacts", "Contacts", lead=lead, plots=tuple(plots), tables=(_table(scene, loads),), notes=notes)


def body_contact_tiles(scene: Scene, result: SimulationResult) -> list[Tile]:
    """The summary's tiles; none if the scene's manager shows pairs."""
    if not scene.colliders:
        return []
    loads = body_loads(scene, result)
    watched = f"of {len(scene.colliders)} that may"
    if not loads:
        return [Tile("Bodies touched", "none", "", watched)]
    peak = max(loads, key=lambda load: load.peak_force)
    where = f"{scene.label(peak.body)}, {peak.peak_time:.5g} s"
    return [
        Tile("Bodies touched", str(len(loads)), "", watched),
        Tile("Peak force", f"{peak.peak_force:.5g}", "N", where),
    ]


def _table(scene: Scene, loads: tuple[BodyLoad, ...]) -> Table:
    columns = (
        Column("Body", "text"),
        Column("In contact, s"),
        Column("Mean force meanwhile, N"),
        Column("Peak force, N"),
        Column("at, s"),
    )
    rows = tuple(
        Row(
            (
                Cell(scene.label(load.body), "text"),
                Cell(f"{load.touching:.4g}"),
                Cell(f"{load.mean_force:.4g}"),
                Cell(f"{load.peak_force:.5g}"),
                Cell(f"{load.peak_time:.5g}"),
            ),
            time=f"{load.peak_time:.9g}",
        )
        for load in loads
    )
    return Table(columns, rows)
