"""`cmb effects`: what each effect of a scene costs."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_foundation.output import check_file
from scene_effects.choices import EFFECTS

from cmb.effect_bench import add_scene_arguments, effect_bench
from cmb.input_file import check_input
from cmb.terminal import progress_bars

NAME = "effects"
SUMMARY = "show what each effect of contact costs: a scene with each switched on and off"
DESCRIPTION = (
    "Builds and runs a scene with friction anchored, regularised and off, restitution by events, memoryless and off, "
    "spin and rolling friction, points a pair and pairs, and prints equations, states, event indicators, evaluations "
    "and the difference from the variant with everything on."
)
EXAMPLES = """examples:
  cmb effects
  cmb effects ContactMultiBody.Examples.BallOnFloor \\
    --effect restitution --stop 1
  cmb effects Drop --source Drop.mo --output effects.html
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    add_scene_arguments(parser)
    parser.add_argument(
        "--effect", action="append", choices=EFFECTS, help="effect to vary, repeatable (all if left out)"
    )
    parser.add_argument("--output", type=Path, metavar="HTML", help="also write a page")


def run(arguments: Namespace) -> int:
    """Makes the study and prints its table."""
    if arguments.output is not None:
        check_file(arguments.output)
    check_input(*arguments.source)
    from scene_effects.study import study_effects
    from scene_effects.table import effects_text, write_effects

    with progress_bars() as progress, effect_bench(arguments, progress) as bench:
        study = study_effects(bench, arguments.effect or EFFECTS, progress)
    print(effects_text(study))
    if arguments.output is not None:
        write_effects(study, arguments.output)
    return 0
