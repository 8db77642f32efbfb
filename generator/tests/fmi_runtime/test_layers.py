"""The runtime's files include one another in one direction."""

from __future__ import annotations

import re

import networkx as nx
from modelica2fmu.packaging.runtime_sources import runtime_files

LAYERS = ("numerics", "model", "instance", "integrator", "fmi")  # from the bottom upwards


def units_and_includes() -> nx.DiGraph[str]:
    """An edge from each unit (a C file with its header) to the units whose headers it includes."""
    graph: nx.DiGraph[str] = nx.DiGraph()
    own = {path.name for path in runtime_files()}
    for path in runtime_files():
        graph.add_node(path.stem)
        for name in re.findall(r'#include "([^"]+)"', path.read_text(encoding="utf-8")):
            if name in own and name.removesuffix(".h") != path.stem:
                graph.add_edge(path.stem, name.removesuffix(".h"))
    return graph


def test_no_unit_includes_itself_through_others():
    assert list(nx.simple_cycles(units_and_includes())) == []


def test_a_layer_includes_itself_and_lower_ones_alone():
    layer = {path.stem: LAYERS.index(path.parent.name) for path in runtime_files()}
    upward = [(unit, other) for unit, other in units_and_includes().edges if layer[unit] < layer[other]]
    assert upward == []
