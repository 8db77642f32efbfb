"""Passes over the directions: what is left out of one is zero there, whatever the equations are."""

from __future__ import annotations

import random

import pytest
from modelica2fmu.equations.direction_passes import DirectionPasses, direction_passes
from modelica2fmu.equations.lanes import LANES
from modelica2fmu.equations.tangents import TangentAssignment, tangent_name
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


def assignment(target: str, sources: list[str]) -> TangentAssignment:
    """The tangent of a target as the sum of those of sources."""
    total: float | Node = 0
    for source in sources:
        total = ex.add(total, ex.symbol(tangent_name(source)))
    return TangentAssignment(tangent_name(target), ex.node_of(total))


def random_steps(seed: int) -> tuple[list[TangentAssignment], list[str], list[str]]:
    """Steps, states and what is wanted: bodies of several states, contacts of two of them, forces of some contacts."""
    source = random.Random(seed)
    bodies = [[f"x{body}_{k}" for k in range(source.randint(1, 7))] for body in range(source.randint(1, 6))]
    pool = [[*states] for states in bodies]
    steps = []
    for number in range(source.randint(1, 60)):
        chosen = source.sample(pool, min(len(pool), source.choice((1, 1, 1, 2))))
        names = [source.choice(names) for names in chosen]
        steps.append(assignment(f"y{number}", sorted(set(names))))
        source.choice(chosen).append(f"y{number}")
    states = [name for names in bodies for name in names]
    return steps, states, [step.target for step in source.sample(steps, min(5, len(steps)))]


def result_of(
    schedule: DirectionPasses, sources: dict[str, list[str]], states: list[str], wanted: list[str]
) -> dict[tuple[int, str], float]:
    """The derivatives that executing the schedule gives, by column and name; values are kept from pass to pass."""
    memory = {name: [9.0] * LANES for name in [*sources, *map(tangent_name, states)]}
    found = {}
    before = None
    for number, columns in enumerate(schedule.columns):
        for state, name in enumerate(map(tangent_name, states)):
            memory[name] = [float(lane < len(columns) and columns[lane] == state) for lane in range(LANES)]
        for cluster in schedule.clusters:
            if cluster.passes >> number & 1:
                for step in cluster.steps:
                    assert isinstance(step, TangentAssignment)
                    terms = [memory[name] for name in sources[step.target]]
                    memory[step.target] = [sum(lane) for lane in zip(*terms, strict=True)]
            elif before is None or cluster.passes >> before & 1:
                memory.update({name: [0.0] * LANES for name in cluster.handed_on})
        before = number
        for lane, column in enumerate(columns):
            found.update({(column, name): memory[name][lane] for name in wanted})
    return found


@pytest.mark.parametrize("seed", range(60))
def test_a_schedule_gives_the_derivatives(seed: int) -> None:
    steps, states, wanted = random_steps(seed)
    schedule = direction_passes(steps, states, wanted)
    assert sorted(column for group in schedule.columns for column in group) == list(range(len(states)))
    assert all(len(group) <= LANES for group in schedule.columns)
    assert sorted(
        step.target for cluster in schedule.clusters for step in cluster.steps if isinstance(step, TangentAssignment)
    ) == sorted(step.target for step in steps)
    sources = {step.target: list(ex.symbols(step.value)) for step in steps}
    expected: dict[tuple[int, str], float] = {}
    for column, state in enumerate(states):
        value = {tangent_name(name): float(name == state) for name in states}
        for step in steps:
            value[step.target] = sum(value[name] for name in sources[step.target])
        expected.update({(column, name): value[name] for name in wanted})
    assert result_of(schedule, sources, states, wanted) == expected


def test_bodies_apart_are_not_followed_together() -> None:
    states = [f"x{body}_{k}" for body in range(5) for k in range(8)]
    steps = [assignment(f"y{body}_{k}", [f"x{body}_{k % 8}", f"x{body}_0"]) for body in range(5) for k in range(20)]
    schedule = direction_passes(steps, states, [step.target for step in steps])
    executed = sum(len(cluster.steps) * cluster.passes.bit_count() for cluster in schedule.clusters)
    assert executed < 1.5 * len(steps) * len(schedule.columns) / 5
    assert len(schedule.clusters) <= len(schedule.columns)
