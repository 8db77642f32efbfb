"""The files of a generation: texts of the package, scene, graph and report, written whole or not at all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.output import whole_folder

from cad2modelica.actuators.placement import Actuator, place_actuators
from cad2modelica.emit.mechanism_draft import RESERVED
from cad2modelica.emit.package_writer import CLASSES, PackageTexts, package_texts
from cad2modelica.emit.scene_file import scene_text
from cad2modelica.processing import Mechanism
from cad2modelica.regenerate.own_files import GRAPH, ORDER, REPORT, SCENE
from cad2modelica.regenerate.regeneration import (
    MECHATRONICS_FILE,
    RECORD,
    Record,
    checksum,
    lost_references,
    record_text,
)
from cad2modelica.report.generation_notes import overlap_notes
from cad2modelica.report.generation_report import ReportInput, report_html
from cad2modelica.report.graph_drawing import graph_svg
from cad2modelica.report.mechanism_pictures import mechanism_pictures
from cad2modelica.revision import Revision


@dataclass(frozen=True)
class PackageFiles:
    """Everything that is going to be written.

    Attributes:
        texts: the package.
        scene: what a report on a simulation needs.
        graph: the mechanism's graph as SVG.
        report: the HTML page on what was found and decided.
        notes: all notes of the generation, one line each.
    """

    texts: PackageTexts
    scene: str
    graph: str
    report: str
    notes: tuple[str, ...]


def compose(mechanism: Mechanism, revision: Revision, name: str) -> PackageFiles:
    """All files of a generation as texts.

    Raises:
        InputError: a file of the modeller's own has the name of one that would be written.
    """
    actuators = _actuators(mechanism, revision)
    assembly, view = mechanism.assembly, mechanism.view
    texts = package_texts(assembly, view, mechanism.geometries, actuators, name, mechanism.notes)
    written = {*texts.files, *texts.resources, RECORD, ORDER}
    revision.own.require_free(written | ({str(MECHATRONICS_FILE)} - {str(file) for file in revision.own.files}))
    notes = (
        *mechanism.notes,
        *revision.changes,
        *revision.plan.notes,
        *lost_references(revision.own, revision.plan, texts.mechatronics),
        *overlap_notes(mechanism.start),
    )
    graph = graph_svg(assembly, mechanism.tree, mechanism.loops.loops)
    report = report_html(_report_input(mechanism, revision, actuators, name, graph, notes))
    scene = scene_text(assembly, mechanism.tree, mechanism.loops, view, name)
    return PackageFiles(texts, scene, graph, report, notes)


def write(files: PackageFiles, revision: Revision, output: Path, name: str) -> None:
    """Writes the package with the modeller's own files, scene, graph and report; all of it or nothing."""
    texts, plan = files.texts, revision.plan
    with whole_folder(output) as staging:
        root = staging / name
        root.mkdir()
        revision.own.copy_to(root)
        if plan.keep_old is not None:
            (root / MECHATRONICS_FILE).rename(root / plan.keep_old)
        for file_name, text in texts.files.items():
            (root / file_name).write_bytes(_encoded(text))
        if plan.write_mechatronics:
            (root / MECHATRONICS_FILE).write_bytes(_encoded(texts.mechatronics))
        for path, content in texts.resources.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_bytes(content)
        (root / RECORD).parent.mkdir(exist_ok=True)
        (root / RECORD).write_bytes(_encoded(record_text(_record(texts, revision))))
        (root / ORDER).write_bytes(_encoded("".join(f"{item}\n" for item in revision.own.package_order(CLASSES))))
        (staging / SCENE).write_bytes(_encoded(files.scene))
        (staging / GRAPH).write_bytes(_encoded(files.graph))
        (staging / REPORT).write_bytes(_encoded(files.report))


def _actuators(mechanism: Mechanism, revision: Revision) -> tuple[Actuator, ...]:
    view = mechanism.view
    taken = {component.name for component in view.components} | {*view.material_names.values(), *RESERVED}
    return place_actuators(revision.assignments, mechanism.assembly, view.joint_names, taken)


def _report_input(
    mechanism: Mechanism,
    revision: Revision,
    actuators: Sequence[Actuator],
    name: str,
    graph: str,
    notes: Sequence[str],
) -> ReportInput:
    return ReportInput(
        name=name,
        assembly=mechanism.assembly,
        tree=mechanism.tree,
        loops=mechanism.loops,
        geometries=mechanism.geometries,
        view=mechanism.view,
        actuators=actuators,
        start=mechanism.start,
        notes=notes,
        drawing=graph,
        pictures=mechanism_pictures(mechanism.assembly, mechanism.geometries),
        structure=revision.structure.signature,
    )


def _record(texts: PackageTexts, revision: Revision) -> Record:
    if revision.plan.write_mechatronics or revision.earlier is None:
        mechatronics = checksum(_encoded(texts.mechatronics))
    else:
        mechatronics = revision.earlier.mechatronics
    return Record(revision.structure, revision.signature, mechatronics, tuple(sorted(texts.resources)))


def _encoded(text: str) -> bytes:
    """UTF-8; what names of files hold beside text becomes question marks."""
    return text.encode("utf-8", errors="replace")
