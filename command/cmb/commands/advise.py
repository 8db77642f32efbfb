"""`cmb advise`: which effects a scene needs."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from cmb.effect_bench import add_scene_arguments, effect_bench
from cmb.input_file import check_input
from cmb.terminal import progress_bars

NAME = "advise"
SUMMARY = "say which effects of contact a scene needs, which it could drop and what is missing"
DESCRIPTION = (
    "Simulates a scene with every effect on, judges by what the bodies did and by their materials which effects it "
    "needs, and measures what leaving out the others or adding what is missing changes. The advice holds for the "
    "motion that was simulated."
)
EXAMPLES = """examples:
  cmb advise ContactMultiBody.Examples.BoxOnIncline
  cmb advise ContactMultiBody.Examples.NewtonCradle --stop 1
  cmb advise Hammer.Mechatronics \\
    --source out/hammer/model/Hammer --stop 0.6 --difference 1e-4
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    add_scene_arguments(parser)
    parser.add_argument(
        "--difference",
        type=float,
        default=1e-3,
        metavar="M",
        help="difference of positions in m that does not matter (0.001)",
    )


def run(arguments: Namespace) -> int:
    """Prints the advice."""
    check_input(*arguments.source)
    from scene_effects.advice import advice_text, advise

    with progress_bars() as progress, effect_bench(arguments, progress) as bench:
        advice = advise(bench, arguments.difference, progress)
    print(advice_text(advice))
    return 0
