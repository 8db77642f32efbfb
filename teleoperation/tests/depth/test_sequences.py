"""Sequences are quasi-Hamiltonian, balanced and reproducible; Hamiltonian paths are decided."""

from __future__ import annotations

import os
import subprocess
import sys
from itertools import pairwise, permutations
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError
from depth_study.design.hamiltonian import hamiltonian_starts
from depth_study.design.sequences import balance, make_sequences
from small_designs import STAR, design_of, thesis

PLUS = """
[factors]
a = ["off", "x", "y"]
b = ["off", "x", "y"]
[[only]]
when = { a = "x" }
allow = { b = ["off"] }
[[only]]
when = { a = "y" }
allow = { b = ["off"] }
"""


def starts_by_trying(design):
    near = [set(others) for others in design.neighbours]
    paths = [p for p in permutations(range(len(near))) if all(b in near[a] for a, b in pairwise(p))]
    return tuple(any(path[0] == start for path in paths) for start in range(len(near)))


@pytest.mark.parametrize(
    "text",
    [
        STAR,
        PLUS,
        '[factors]\na = ["1", "2", "3"]\nb = ["1", "2"]\n',
        '[factors]\na = ["1", "2"]\nb = ["1", "2"]\nc = ["1", "2"]\n'
        '[[only]]\nwhen = { a = "1" }\nallow = { b = "1" }\n',
        '[factors]\na = ["1", "2"]\nb = ["1", "2"]\nc = ["1", "2"]\n'
        '[[only]]\nwhen = { a = "1", b = "1" }\nallow = { c = "1" }\n',
    ],
)
def test_where_hamiltonian_paths_start_is_what_trying_all_orders_finds(text):
    design = design_of(text)
    assert hamiltonian_starts(design) == starts_by_trying(design)


def test_in_the_thesis_hamiltonian_paths_start_everywhere():
    assert hamiltonian_starts(thesis()) == (True,) * 20


def test_what_is_too_large_is_not_decided():
    design = design_of('[factors]\na = ["1", "2", "3", "4", "5"]\nb = ["1", "2", "3", "4", "5"]\n')
    assert hamiltonian_starts(design) is None


def test_sequences_visit_everything_once_over_edges_alone():
    design = thesis()
    sequences = make_sequences(design, 44, seed=3)
    assert all(sorted(row) == list(range(20)) for row in sequences.tolist())
    joined = {(edge.first, edge.second) for edge in design.edges}
    steps = [tuple(sorted(step)) for row in sequences.tolist() for step in pairwise(row)]
    assert set(steps) <= joined
    assert len(steps) == 44 * 19


def test_edges_positions_and_starts_are_balanced():
    design = thesis()
    sequences = make_sequences(design, 44, seed=3)
    found = balance(design, sequences)
    assert found.edge_uses.sum() == 44 * 19
    assert np.abs(found.edge_uses - found.even_uses).max() <= 2.5
    # By chance alone positions would have a standard deviation of sqrt(2.2) = 1.48.
    assert found.position_uses.std() < 0.9
    assert set(found.position_uses[0]) == {2, 3}


def test_the_even_use_is_the_most_even_that_leaves_each_constellation_equally_often():
    found = balance(thesis(), make_sequences(thesis(), 20, seed=1))
    visits = np.zeros(20)
    for edge, uses in zip(thesis().edges, found.even_uses, strict=True):
        visits[[edge.first, edge.second]] += uses
    np.testing.assert_allclose(visits, 2 * 20 * 19 / 20)


def test_the_same_seed_gives_the_same_sequences_however_many_follow():
    design = thesis()
    few, many = make_sequences(design, 5, seed=8), make_sequences(design, 25, seed=8)
    np.testing.assert_array_equal(few, many[:5])
    assert not np.array_equal(few, make_sequences(design, 5, seed=9))


def test_where_no_hamiltonian_path_exists_one_step_is_no_edge():
    design = design_of(
        '[factors]\na = ["1", "2"]\nb = ["1", "2", "3"]\n[[only]]\nwhen = { a = "1" }\nallow = { b = "1" }\n'
    )
    starts = hamiltonian_starts(design)
    assert not all(starts)
    sequences = make_sequences(design, 12, seed=1)
    near = [set(others) for others in design.neighbours]
    for row in sequences.tolist():
        assert sorted(row) == list(range(len(near)))
        jumps = sum(b not in near[a] for a, b in pairwise(row))
        assert jumps == (0 if starts[row[0]] else 1)


def test_designs_that_need_more_jumps_are_refused():
    text = '[factors]\na = ["off", "on"]\nb = ["off", "on"]\nc = ["off", "on"]\nd = ["off", "on"]\ne = ["off", "on"]\n'
    names = "abcde"
    for k, name in enumerate(names[:-1]):
        others = ", ".join(f'{other} = "off"' for other in names[k + 1 :])
        text += f'[[only]]\nwhen = {{ {name} = "on" }}\nallow = {{ {others} }}\n'
    with pytest.raises(InputError, match="at most one step that is no edge"):
        make_sequences(design_of(text), 3, seed=1)


# OpenBLAS's kernels, and what a processor must have to run them.
KERNELS = {
    "Nehalem": {"sse4_2"},
    "Haswell": {"avx2", "fma"},
    "Zen": {"avx2", "fma"},
    "SkylakeX": {"avx512f", "avx512dq", "avx512bw", "avx512vl"},
}


def runnable_kernels() -> list[str]:
    """Those that this processor can run; others end a process by an illegal instruction."""
    information = Path("/proc/cpuinfo")
    flags = set(information.read_text(encoding="utf-8").split()) if information.exists() else set()
    return [kernels for kernels, wanted in KERNELS.items() if wanted <= flags]


@pytest.mark.full
@pytest.mark.skipif(len(runnable_kernels()) < 2, reason="this processor runs just one of the kernels")
def test_sequences_do_not_depend_on_the_processor():
    """Linear algebra rounds by the kernels chosen for a processor; equally good paths must not be told apart so."""
    program = (
        "from small_designs import thesis; from depth_study.design.sequences import make_sequences;"
        "print(make_sequences(thesis(), 12, seed=1).tolist())"
    )
    told = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "OPENBLAS_CORETYPE": kernels},
            cwd=Path(__file__).parent,
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for kernels in runnable_kernels()
    }
    assert len(told) == 1
