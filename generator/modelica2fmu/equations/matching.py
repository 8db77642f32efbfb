"""Bipartite matching of equations with unknowns, and the order in which blocks of equations are solved.

Matching: augmenting paths, breadth first (a phase-free variant of Hopcroft and Karp 1973, "An n^5/2 algorithm for
maximum matchings in bipartite graphs"). Order: strongly connected components by Tarjan 1972, "Depth-first search
and linear graph algorithms", which yields the block lower triangular form (Duff and Reid 1978).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence


class Matching:
    """A growing matching between rows (equations) and columns (unknowns).

    Args:
        incidence: the columns of each row; rows may be added later.
    """

    def __init__(self, incidence: Mapping[int, Sequence[str]] | None = None) -> None:
        self.incidence: dict[int, Sequence[str]] = dict(incidence or {})
        self.column_of: dict[int, str] = {}
        self.row_of: dict[str, int] = {}

    def assign(self, row: int, column: str) -> None:
        """Matches a free row with a free column."""
        self.column_of[row] = column
        self.row_of[column] = row

    def augment(self, row: int) -> bool:
        """Matches ``row`` too, changing others where needed; false if that is impossible."""
        found, _, _ = self.search(row)
        return found

    def search(self, row: int) -> tuple[bool, list[int], list[str]]:
        """Like :meth:`augment`, with the rows and columns that the search has reached (all, if it fails)."""
        parent: dict[str, int] = {}
        queue = deque([row])
        rows = [row]
        while queue:
            current = queue.popleft()
            columns = self.incidence[current]
            free = next((column for column in columns if column not in parent and column not in self.row_of), None)
            if free is not None:
                parent[free] = current
                self._flip(free, parent)
                return True, rows, list(parent)
            for column in columns:
                if column in parent:
                    continue
                parent[column] = current
                owner = self.row_of[column]
                rows.append(owner)
                queue.append(owner)
        return False, rows, list(parent)

    def _flip(self, column: str, parent: Mapping[str, int]) -> None:
        while True:
            row = parent[column]
            previous = self.column_of.get(row)
            self.assign(row, column)
            if previous is None:
                return
            column = previous


def strongly_connected_components(successors: Mapping[int, Iterable[int]]) -> list[list[int]]:
    """Components of a directed graph, each after all that it points to; iterative."""
    index: dict[int, int] = {}
    low: dict[int, int] = {}
    on_stack: set[int] = set()
    stack: list[int] = []
    components: list[list[int]] = []
    for root in successors:
        if root in index:
            continue
        work = [(root, iter(successors[root]))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, iterator = work[-1]
            for successor in iterator:
                if successor not in index:
                    index[successor] = low[successor] = len(index)
                    stack.append(successor)
                    on_stack.add(successor)
                    work.append((successor, iter(successors[successor])))
                    break
                if successor in on_stack:
                    low[node] = min(low[node], index[successor])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    component = []
                    while True:
                        member = stack.pop()
                        on_stack.discard(member)
                        component.append(member)
                        if member == node:
                            break
                    components.append(sorted(component))
    return components
