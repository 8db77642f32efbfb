"""Matching and components against networkx as an independent reference."""

from __future__ import annotations

import networkx as nx
from hypothesis import given, settings
from hypothesis import strategies as st
from modelica2fmu.equations.matching import Matching, strongly_connected_components

bipartite = st.lists(st.lists(st.integers(0, 9), max_size=4, unique=True), min_size=1, max_size=10)


@settings(max_examples=200, deadline=None)
@given(bipartite)
def test_matching_is_maximum(rows):
    matching = Matching({number: [f"c{column}" for column in columns] for number, columns in enumerate(rows)})
    found = sum(matching.augment(number) for number in range(len(rows)))
    graph = nx.Graph()
    graph.add_nodes_from(range(len(rows)), bipartite=0)
    graph.add_edges_from((number, f"c{column}") for number, columns in enumerate(rows) for column in columns)
    expected = nx.bipartite.hopcroft_karp_matching(graph, range(len(rows)))
    assert found == len(expected) // 2
    for row, column in matching.column_of.items():
        assert column in matching.incidence[row]
        assert matching.row_of[column] == row


@settings(max_examples=200, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12)), max_size=40))
def test_components_are_those_of_networkx_in_solving_order(edges):
    successors: dict[int, list[int]] = {number: [] for number in range(13)}
    for start, end in edges:
        successors[start].append(end)
    components = strongly_connected_components(successors)
    graph = nx.DiGraph()
    graph.add_nodes_from(successors)
    graph.add_edges_from(edges)
    assert {frozenset(item) for item in components} == {
        frozenset(item) for item in nx.strongly_connected_components(graph)
    }
    position = {node: number for number, component in enumerate(components) for node in component}
    assert all(position[end] <= position[start] for start, end in edges)


def test_failing_search_names_the_overdetermined_part():
    matching = Matching({0: ["a"], 1: ["a", "b"], 2: ["b"], 3: ["a", "b"]})
    assert all(matching.augment(number) for number in (0, 1))
    found, rows, columns = matching.search(2)
    assert not found
    assert sorted(rows) == [0, 1, 2]
    assert sorted(columns) == ["a", "b"]
