"""`cmb depth-study`: how strongly the cues of a picture let people see depth."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from cmb import depth_study_actions as actions
from cmb.number_arguments import count, port, seed, share

NAME = "depth-study"
SUMMARY = "measure on people which cues of a picture show depth: design, sequences, answers, evaluation"
DESCRIPTION = (
    "A study of constellations of factors (technique, camera, scene), which observers score from 1 to 9 and compare "
    "with the one before. The design is a TOML file; without one it is the thesis's: 20 constellations, 52 edges."
)
EXAMPLES = """examples:
  cmb depth-study design
  cmb depth-study sequence --observers 44 --output sequences.csv
  cmb depth-study run study.db
  cmb depth-study simulate --output study.db
  cmb depth-study evaluate study.db --output study.html
  cmb depth-study delete study.db --observer 7
"""
_DEFAULT_SEED = 1
_DEFAULT_OBSERVERS = 44


def add_arguments(parser: ArgumentParser) -> None:
    """Adds one subcommand for each action."""
    kinds = parser.add_subparsers(metavar="ACTION", required=True)

    design = kinds.add_parser("design", help="constellations, edges, and whether Hamiltonian paths exist")
    _add_design(design)
    design.set_defaults(action=actions.show_design)

    sequence = kinds.add_parser("sequence", help="balanced sequences of constellations for observers")
    _add_design(sequence)
    _add_observers(sequence)
    _add_seed(sequence)
    sequence.add_argument("--output", type=Path, metavar="CSV", help="write the sequences there")
    sequence.set_defaults(action=actions.make_sequences)

    run_page = kinds.add_parser("run", help="show the study in a browser on this machine and keep every answer")
    run_page.add_argument("study", type=Path, metavar="STUDY", help="database of the study; made if it is not there")
    _add_design(run_page)
    run_page.add_argument("--seed", type=seed, metavar="N", help=f"of the sequences of a new study ({_DEFAULT_SEED})")
    run_page.add_argument(
        "--port", type=port, default=8770, metavar="N", help="of the page (8770; 0: any that is free)"
    )
    run_page.add_argument("--no-browser", action="store_true", help="print the page's address, open no browser")
    for name, default, text in (
        ("eye-distance", 0.065, "between the two cameras"),
        ("convergence-distance", 2.0, "from the cameras to what is seen at the screen"),
        ("screen-width", 0.52, "of the picture on the screen"),
        ("viewing-distance", 0.6, "from the eyes to the screen"),
    ):
        run_page.add_argument(f"--{name}", type=float, default=default, metavar="M", help=f"m, {text} ({default:g})")
    run_page.set_defaults(action=actions.run_study)

    evaluate = kinds.add_parser("evaluate", help="levels, effects of factors and checks from a study's answers")
    evaluate.add_argument("study", type=Path, metavar="STUDY", help="database of the study")
    evaluate.add_argument(
        "--published", type=Path, metavar="TOML", help="levels to compare with (the thesis's, if the design is its)"
    )
    _add_confidence(evaluate)
    evaluate.add_argument("--output", type=Path, metavar="HTML", help="also write a page with plots")
    evaluate.set_defaults(action=actions.evaluate_study)

    simulate = kinds.add_parser("simulate", help="simulated studies: coverage of intervals, observers needed")
    _add_design(simulate)
    _add_observers(simulate)
    _add_seed(simulate)
    simulate.add_argument("--published", type=Path, metavar="TOML", help="true levels (the thesis's if left out)")
    simulate.add_argument("--population", type=Path, metavar="TOML", help="scale, bias, noise of observers drawn")
    simulate.add_argument("--studies", type=count, default=1000, metavar="N", help="studies simulated (1000)")
    simulate.add_argument(
        "--carry-over", type=float, action="append", metavar="SHARE", help="repeatable (0, 0.05, 0.1 and 0.2)"
    )
    simulate.add_argument(
        "--difference", type=float, default=0.5, metavar="D", help="difference that observers shall find (0.5)"
    )
    _add_confidence(simulate)
    simulate.add_argument("--output", type=Path, metavar="STUDY", help="write one such study's database")
    simulate.set_defaults(action=actions.simulate_studies)

    delete = kinds.add_parser("delete", help="delete an observer's answers")
    delete.add_argument("study", type=Path, metavar="STUDY", help="database of the study")
    delete.add_argument("--observer", type=count, required=True, metavar="NUMBER", help="whose answers")
    delete.set_defaults(action=actions.delete_observer)


def run(arguments: Namespace) -> int:
    """Carries the action out."""
    status: int = arguments.action(arguments)
    return status


def _add_design(parser: ArgumentParser) -> None:
    parser.add_argument("--design", type=Path, metavar="TOML", help="design of the study (the thesis's if left out)")


def _add_observers(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--observers", type=count, default=_DEFAULT_OBSERVERS, metavar="N", help=f"({_DEFAULT_OBSERVERS})"
    )


def _add_seed(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--seed", type=seed, default=_DEFAULT_SEED, metavar="N", help=f"of all chance ({_DEFAULT_SEED})"
    )


def _add_confidence(parser: ArgumentParser) -> None:
    parser.add_argument("--confidence", type=share, default=0.9, metavar="SHARE", help="of intervals (0.9)")
