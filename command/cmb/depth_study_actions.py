"""What the actions of `cmb depth-study` do."""

from __future__ import annotations

import webbrowser
from argparse import Namespace
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import contact_data
from contact_foundation.errors import InputError, Place
from contact_foundation.output import check_file

from cmb.input_file import check_input
from cmb.terminal import progress_bars

if TYPE_CHECKING:
    from depth_study.record.database import StudyDatabase

_DEFAULT_SEED = 1
_CARRY_OVERS = (0.0, 0.05, 0.1, 0.2)
_POWER_OBSERVERS = (10, 20, 30, 44, 60, 80, 120)


def show_design(arguments: Namespace) -> int:
    """Prints a design."""
    from depth_study.design.design_file import load_design
    from depth_study.report.design_report import design_text

    check_input(arguments.design)
    print(design_text(load_design(_design_file(arguments))))
    return 0


def make_sequences(arguments: Namespace) -> int:
    """Makes sequences, prints how balanced they are and writes them."""
    check_input(arguments.design)
    if arguments.output is not None:
        check_file(arguments.output)
    from depth_study.design.design_file import load_design
    from depth_study.design.sequences import balance, make_sequences
    from depth_study.report.design_report import balance_text, write_sequences

    design = load_design(_design_file(arguments))
    with progress_bars() as progress:
        sequences = make_sequences(design, arguments.observers, arguments.seed, progress)
    print(balance_text(balance(design, sequences), arguments.observers))
    if arguments.output is not None:
        write_sequences(design, sequences, arguments.output)
    return 0


def run_study(arguments: Namespace) -> int:
    """Serves the page of a study until it is interrupted."""
    check_input(arguments.design)
    from depth_study.page.server import StudyServer
    from depth_study.page.session import StudySessions
    from depth_study.page.viewing import Viewing
    from scene_viewer.bundle import require_installed

    viewing = Viewing(
        eye_distance=arguments.eye_distance,
        convergence_distance=arguments.convergence_distance,
        screen_width=arguments.screen_width,
        viewing_distance=arguments.viewing_distance,
    )
    require_installed()
    with StudyServer(arguments.port) as server, closing(_opened_study(arguments)) as database:
        print(f"{server.address} shows the study; Ctrl-C ends it. Answers are kept in {arguments.study}.", flush=True)
        if not arguments.no_browser:
            webbrowser.open(server.address)
        with suppress(KeyboardInterrupt):
            server.serve(StudySessions(database, viewing))
        answers = sum(database.observers().values())
    print(f"{answers} answers are kept in {arguments.study}")
    return 0


def _opened_study(arguments: Namespace) -> StudyDatabase:
    """The study's database; a new one if there is none, of the design and seed asked for."""
    from depth_study.record.database import create_database, open_database

    study: Path = arguments.study
    if not study.exists() or (study.is_file() and study.stat().st_size == 0):
        text = _design_file(arguments).read_text(encoding="utf-8")
        return create_database(study, text, _DEFAULT_SEED if arguments.seed is None else arguments.seed)
    database = open_database(study)
    asked = arguments.design.read_text(encoding="utf-8") if arguments.design is not None else database.design_text
    if asked != database.design_text or arguments.seed not in (None, database.seed):
        database.close()
        raise InputError(
            "was begun with another design or seed",
            place=Place(file=study),
            remedy="Leave --design and --seed out to go on with it, or name another file.",
        )
    return database


def evaluate_study(arguments: Namespace) -> int:
    """Evaluates a study's answers, prints the tables and writes the page."""
    check_input(arguments.study, arguments.published)
    if arguments.output is not None:
        check_file(arguments.output)
    from depth_study.design.design_file import load_design
    from depth_study.evaluation.published import load_published
    from depth_study.evaluation.study import evaluate
    from depth_study.record.database import open_database
    from depth_study.report.evaluation_report import evaluation_text, write_evaluation

    database = open_database(arguments.study)
    try:
        answers = database.answers()
    finally:
        database.close()
    published = arguments.published
    thesis = contact_data.depth_study()
    if published is None and answers.design.names == load_design(thesis / "design.toml").names:
        published = thesis / "published.toml"
    evaluation = evaluate(answers, arguments.confidence)
    compared = load_published(published, answers.design) if published is not None else None
    print(evaluation_text(evaluation, compared))
    if arguments.output is not None:
        write_evaluation(evaluation, compared, arguments.output)
    return 0


def simulate_studies(arguments: Namespace) -> int:
    """Simulates studies, prints coverage and power, and writes one study's database."""
    check_input(arguments.design, arguments.published, arguments.population)
    for share in arguments.carry_over or ():
        if not -1 < share < 1:
            raise InputError(f"--carry-over {share:g} is no share", remedy="Give a number between -1 and 1.")
    if arguments.output is not None:
        check_file(arguments.output)
        if arguments.output.exists():
            raise InputError("is there already", place=Place(file=arguments.output), remedy="Name another file.")
    from depth_study.design.design_file import load_design
    from depth_study.design.sequences import make_sequences
    from depth_study.evaluation.published import load_published
    from depth_study.report.simulation_report import coverage_text, power_text
    from depth_study.simulation.coverage import study_coverage
    from depth_study.simulation.observers import load_population
    from depth_study.simulation.power import study_power
    from depth_study.simulation.simulated_study import write_simulated_study

    folder = contact_data.depth_study()
    design_file = _design_file(arguments)
    design = load_design(design_file)
    levels = load_published(arguments.published or folder / "published.toml", design).levels
    population = load_population(arguments.population or folder / "population.toml")
    carry_overs = arguments.carry_over or sorted({population.carry_over, *_CARRY_OVERS})
    options = {"studies": arguments.studies, "seed": arguments.seed, "confidence": arguments.confidence}
    with progress_bars() as progress:
        most = max(arguments.observers, *_POWER_OBSERVERS)
        sequences = make_sequences(design, most, arguments.seed, progress)
        own = sequences[: arguments.observers]
        if arguments.output is not None:
            write_simulated_study(arguments.output, design_file, own, levels, population, arguments.seed)
        coverage = study_coverage(
            design, levels, own, population, carry_overs=carry_overs, progress=progress, **options
        )
        power = study_power(
            design,
            levels,
            sequences,
            population,
            difference=arguments.difference,
            numbers=sorted({arguments.observers, *_POWER_OBSERVERS}),
            progress=progress,
            **options,
        )
    print(
        coverage_text(
            coverage,
            design.names,
            studies=arguments.studies,
            observers=arguments.observers,
            confidence=arguments.confidence,
        )
    )
    print()
    print(power_text(power, arguments.studies))
    return 0


def delete_observer(arguments: Namespace) -> int:
    """Deletes an observer's answers."""
    check_input(arguments.study)
    from depth_study.record.database import open_database

    database = open_database(arguments.study)
    try:
        database.delete_observer(arguments.observer)
    finally:
        database.close()
    print(f"observer {arguments.observer} deleted")
    return 0


def _design_file(arguments: Namespace) -> Path:
    return arguments.design or contact_data.depth_study() / "design.toml"
