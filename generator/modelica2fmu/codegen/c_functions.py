"""C functions of bounded length that execute sequences of statements.

Compilers need more than linear time for long functions. A node that several functions use is kept in the work array.

Nodes below which certain symbols stand can be vectors of ``LANES`` numbers, for derivatives in as many directions.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Container, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Final

from modelica2fmu.codegen.function_body import BEFORE, FunctionBody
from modelica2fmu.codegen.similar_statements import Arrangement, arranged
from modelica2fmu.codegen.statements import Group, Put, Statement, Stored, WorkSpace
from modelica2fmu.equations.lanes import LANES
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_STATEMENTS_PER_FUNCTION: Final = 1200
_LINES_PER_STATEMENT: Final = 8  # executed lines of a loop, whose tables take a compiler as long as one statement


@dataclass(frozen=True)
class Function:
    """A C function of the generated code.

    Attributes:
        name: of the function.
        text: the C.
        is_discrete: as for statements.
        size: number of lines.
        executions: how often it is executed in one evaluation.
        kept: offsets of the vectors that it keeps in the work array for later functions.
        executed: number of lines that one execution goes through.
        on_request: as for statements.
    """

    name: str
    text: str
    is_discrete: bool
    size: int
    executions: int = 1
    kept: tuple[int, ...] = ()
    executed: int = 0
    on_request: bool = False


@dataclass
class _Chunk:
    """What becomes a function."""

    is_discrete: bool
    group: Group | None
    calls_model: bool
    is_loop: bool
    on_request: bool = False
    statements: list[Statement] = field(default_factory=list)
    size: int = 0

    def takes(self, statement: Statement, size: int) -> bool:
        """Whether there is room for another statement."""
        return (
            not self.calls_model
            and not statement.calls_model
            and self.is_discrete == statement.is_discrete
            and self.on_request == statement.on_request
            and self.is_loop == (statement.executed > 0)
            and self.group == statement.group
            and self.size + size <= _STATEMENTS_PER_FUNCTION
        )


@dataclass(frozen=True)
class FunctionFrame:
    """What all functions of a model have in common.

    Attributes:
        location: C lvalue of a symbol.
        work: where intermediate results of several functions are kept.
        signature: parameters of each function.
        prologue: first lines of each body.
        is_lane_symbol: true for symbols that are vectors.
    """

    location: Callable[[str], str]
    work: WorkSpace
    signature: str
    prologue: tuple[str, ...]
    is_lane_symbol: Callable[[str], bool]


def single_function(name: str, statements: Sequence[Statement], frame: FunctionFrame) -> Function:
    """One function that executes the statements in order, however many they are."""
    chunk = _Chunk(False, None, False, False, statements=list(statements))
    return _functions([chunk], [name], _lane_nodes(statements, frame.is_lane_symbol), frame, Arrangement([]))[0]


def functions_of(prefix: str, statements: Sequence[Statement], frame: FunctionFrame) -> list[Function]:
    """Functions that execute the statements in order when called one after the other.

    Their names are ``prefix_1``, ``prefix_2``, ...; the functions of groups, which are called from inside, have others.

    Args:
        prefix: of the functions' names.
        statements: in order; each symbol is assigned at most once and not read before.
        frame: what the functions have in common.
    """
    lane_nodes = _lane_nodes(statements, frame.is_lane_symbol)
    arrangement = arranged(statements, frame.location, frame.work, lane_nodes)
    chunks = _chunks(arrangement, lane_nodes)
    counts: dict[str, int] = {}
    names = []
    for chunk in chunks:
        kind = prefix if chunk.group is None else f"{chunk.group.name}_part"
        counts[kind] = counts.get(kind, 0) + 1
        names.append(f"{kind}_{counts[kind]}")
    parts = _functions(chunks, names, lane_nodes, frame, arrangement)
    functions = list(parts)
    for group, members in groupby(zip(chunks, parts, strict=True), key=lambda pair: pair[0].group):
        if group is not None:
            functions.append(_group_function(group, [part for _, part in members], frame.signature))
    return functions


def _group_function(group: Group, parts: Sequence[Function], signature: str) -> Function:
    calls = "".join(f"  if ((result = {part.name}(v)) != FMURT_RESULT_OK) return result;\n" for part in parts)
    text = f"int {group.name}({signature})\n{{\n  int result = FMURT_RESULT_OK;\n{calls}  return result;\n}}\n"
    kept = tuple(offset for part in parts for offset in part.kept)
    return Function(group.name, text, False, len(parts), group.executions, kept, len(parts))


def _functions(
    chunks: Sequence[_Chunk],
    names: Sequence[str],
    lane_nodes: Collection[Node],
    frame: FunctionFrame,
    arrangement: Arrangement,
) -> list[Function]:
    homes = _homes(chunks, frame.work, lane_nodes, arrangement.kept)
    kept: dict[int, list[int]] = {}
    for node, (first, offset) in homes.items():
        if node in lane_nodes:
            kept.setdefault(first, []).append(offset)
    for node, (position, offset) in _homes_of_loops(chunks, arrangement).items():
        homes[node] = (BEFORE, offset)
        if node in lane_nodes and node in arrangement.handed_on:
            kept.setdefault(position, []).append(offset)
    lasting = {node: home for node, home in homes.items() if node not in arrangement.passing}
    result = []
    for position, (chunk, name) in enumerate(zip(chunks, names, strict=True)):
        body = FunctionBody(
            chunk.statements, position, lasting if chunk.on_request else homes, frame.location, lane_nodes
        )
        lines = body.lines()
        text = "\n".join(
            [f"int {name}({frame.signature})", "{", *frame.prologue, *lines, "  return FMURT_RESULT_OK;", "}", ""]
        )
        executions = chunk.group.executions if chunk.group is not None else 1
        stored = tuple(kept.get(position, ()))
        size, executed = len(lines), body.executed
        result.append(
            Function(name, text, chunk.is_discrete, size, executions, stored, executed, on_request=chunk.on_request)
        )
    return result


def _homes_of_loops(chunks: Sequence[_Chunk], arrangement: Arrangement) -> dict[Node, tuple[int, int]]:
    """Nodes that loops store: number of the chunk, offset in the work array."""
    return {
        node: (position, arrangement.kept[node])
        for position, chunk in enumerate(chunks)
        for statement in chunk.statements
        for node in statement.keeps
    }


def _chunks(arrangement: Arrangement, lane_nodes: Collection[Node]) -> list[_Chunk]:
    chunks: list[_Chunk] = []
    seen: set[Node] = set(arrangement.kept)
    for statement in arrangement.statements:
        nodes = ex.topological(statement.roots, seen)
        size = 1 + (len(nodes) + (LANES - 1) * sum(node in lane_nodes for node in nodes)) // 2
        size += statement.executed // _LINES_PER_STATEMENT
        if not chunks or not chunks[-1].takes(statement, size):
            is_loop = statement.executed > 0
            discrete, calls_model = statement.is_discrete, statement.calls_model
            chunks.append(_Chunk(discrete, statement.group, calls_model, is_loop, statement.on_request))
        chunks[-1].statements.append(statement)
        chunks[-1].size += size
    return chunks or [_Chunk(False, None, False, False)]


def numbers_of_lanes(
    statements: Sequence[Statement], is_lane_symbol: Callable[[str], bool], group: Group
) -> list[Statement]:
    """Statements of a group that compute the expressions without vectors which the vectors of others are made of.

    One for each expression, so that they become functions of bounded length; one that does nothing if there are none.
    """
    lane_nodes = _lane_nodes(statements, is_lane_symbol)
    found: dict[Node, None] = {}
    roots = [root for statement in statements for root in statement.roots if isinstance(root, Node)]
    for node in [*(arg for vector in lane_nodes for arg in vector.args), *roots]:
        if node.args and node not in lane_nodes:
            found[node] = None
    put = Put("", None, Stored.OTHERWISE)
    return [Statement((node,), lambda _: [], group=group, put=put) for node in found] or [
        Statement((), lambda _: [], group=group, put=put)
    ]


def _lane_nodes(statements: Sequence[Statement], is_lane_symbol: Callable[[str], bool]) -> dict[Node, None]:
    """All nodes that are vectors, operands before what uses them."""
    found: dict[Node, None] = {}
    for node in ex.topological(root for statement in statements for root in statement.roots):
        if (node.op == "symbol" and is_lane_symbol(node.name)) or any(arg in found for arg in node.args):
            found[node] = None
    return found


def _homes(
    chunks: Sequence[_Chunk], work: WorkSpace, lane_nodes: Collection[Node], given: Container[Node]
) -> dict[Node, tuple[int, int]]:
    """Nodes that continuous chunks share with later ones: number of the first chunk, offset in the work array.

    Nodes that are given have places already.
    """
    first: dict[Node, int] = {}
    shared: dict[Node, None] = {}
    for position, chunk in enumerate(chunks):
        mine: set[Node] = set()
        for statement in chunk.statements:
            stack = [root for root in statement.roots if isinstance(root, Node)]
            while stack:
                node = stack.pop()
                if not node.args or node in mine or node in given:
                    continue
                mine.add(node)
                owner = first.get(node)
                if owner is not None and owner != position:
                    shared[node] = None
                    continue  # it is read from the work array, what is below is not needed here
                if owner is None and not chunk.is_discrete:
                    first[node] = position
                stack.extend(node.args)
    return {node: (first[node], work.real(LANES if node in lane_nodes else 1)) for node in shared}
