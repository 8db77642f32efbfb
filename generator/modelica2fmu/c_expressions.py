"""C text of expressions, statements and the functions they are put into.

A sequence of statements becomes functions of bounded size, because compilers need more than linear time for long
ones. Within a function, a node that is used more than once is a local constant; a node that later functions use too
is kept in the work array.

Nodes below which certain symbols stand can be vectors of ``LANES`` numbers, for derivatives in as many directions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Final

from modelica2fmu import expression as ex
from modelica2fmu.expression import Node

_STATEMENTS_PER_FUNCTION: Final = 1200
_INLINE_LENGTH: Final = 160
LANES: Final = 4  # CMB_LANES of runtime/cmb_model.h

_CALLS: Final = {
    "abs": "fabs", "sqrt": "sqrt", "sin": "sin", "cos": "cos", "tan": "tan", "asin": "asin", "acos": "acos",
    "atan": "atan", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "exp": "exp", "log": "log", "log10": "log10",
    "floor": "floor", "ceil": "ceil", "sign": "cmb_sign", "pow": "pow", "atan2": "atan2", "min": "cmb_min",
    "max": "cmb_max", "mod": "cmb_mod", "rem": "cmb_rem", "quotient": "cmb_quotient",
}  # fmt: skip
_INFIX: Final = {
    "add": "+", "sub": "-", "mul": "*", "div": "/", "lt": "<", "le": "<=", "eq": "==", "ne": "!=", "and": "&&",
    "or": "||",
}  # fmt: skip


def number(value: float) -> str:
    """A C double literal that reads back exactly."""
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "HUGE_VAL" if value > 0 else "-HUGE_VAL"
    text = repr(float(value))
    return f"({text})" if text.startswith("-") else text


def c_text(text: str) -> str:
    """A C string literal, in ASCII with octal escapes of its UTF-8 bytes."""
    characters = []
    for byte in text.encode("utf-8"):
        character = chr(byte)
        characters.append(character if 32 <= byte < 127 and character not in '"\\?' else f"\\{byte:03o}")
    return '"' + "".join(characters) + '"'


Write = Callable[["float | Node"], str]


@dataclass(frozen=True)
class Statement:
    """Some lines of C and the expressions in them.

    Attributes:
        roots: expressions that the lines contain.
        lines: the C, given a function from expression to C.
        is_discrete: = true, if it is executed at events only.
    """

    roots: tuple[float | Node, ...]
    lines: Callable[[Write], Sequence[str]]
    is_discrete: bool = False


@dataclass
class WorkSpace:
    """Allocation of the work arrays."""

    reals: int = 0
    integers: int = 0

    def real(self, count: int) -> int:
        """Offset of ``count`` new doubles."""
        offset = self.reals
        self.reals += count
        return offset

    def integer(self, count: int) -> int:
        """Offset of ``count`` new integers."""
        offset = self.integers
        self.integers += count
        return offset


@dataclass(frozen=True)
class Function:
    """A C function of the generated code; ``is_discrete`` as for statements."""

    name: str
    text: str
    is_discrete: bool
    size: int


@dataclass
class _Chunk:
    is_discrete: bool
    statements: list[Statement] = field(default_factory=list)
    size: int = 0


def functions_of(
    prefix: str,
    statements: Sequence[Statement],
    location: Callable[[str], str],
    work: WorkSpace,
    signature: str,
    prologue: Sequence[str],
    split: bool = True,
    is_lane_symbol: Callable[[str], bool] | None = None,
) -> list[Function]:
    """Functions that execute the statements in order when called one after the other.

    Args:
        prefix: of the functions' names.
        statements: in order; each symbol is assigned at most once and not read before.
        location: C lvalue of a symbol.
        work: where intermediate results of several functions are kept.
        signature: parameters of each function.
        prologue: first lines of each body.
        split: = false for a single function.
        is_lane_symbol: true for symbols that are vectors.
    """
    chunks = _chunks(statements, split)
    lane_nodes = _lane_nodes(statements, is_lane_symbol)
    homes = _homes(chunks, work, lane_nodes)
    result = []
    for position, chunk in enumerate(chunks):
        name = f"{prefix}_{position + 1}" if split else prefix
        body = _Body(chunk, position, homes, location, lane_nodes).lines()
        text = "\n".join([f"int {name}({signature})", "{", *prologue, *body, "  return CMB_RESULT_OK;", "}", ""])
        result.append(Function(name, text, chunk.is_discrete, len(body)))
    return result


def _chunks(statements: Sequence[Statement], split: bool) -> list[_Chunk]:
    chunks: list[_Chunk] = []
    seen: set[Node] = set()
    for statement in statements:
        new = ex.topological(statement.roots, seen)
        size = 1 + len(new) // 2
        if not chunks or (
            split
            and (chunks[-1].is_discrete != statement.is_discrete or chunks[-1].size + size > _STATEMENTS_PER_FUNCTION)
        ):
            chunks.append(_Chunk(statement.is_discrete))
        chunks[-1].statements.append(statement)
        chunks[-1].size += size
    return chunks or [_Chunk(False)]


def _lane_nodes(statements: Sequence[Statement], is_lane_symbol: Callable[[str], bool] | None) -> set[Node]:
    """All nodes that are vectors."""
    found: set[Node] = set()
    if is_lane_symbol is None:
        return found
    for node in ex.topological(root for statement in statements for root in statement.roots):
        if (node.op == "symbol" and is_lane_symbol(node.name)) or any(arg in found for arg in node.args):
            found.add(node)
    return found


def _homes(chunks: Sequence[_Chunk], work: WorkSpace, lane_nodes: Collection[Node]) -> dict[Node, tuple[int, int]]:
    """Nodes that continuous chunks share with later ones: number of the first chunk, offset in the work array."""
    first: dict[Node, int] = {}
    shared: dict[Node, None] = {}
    for position, chunk in enumerate(chunks):
        mine: set[Node] = set()
        for statement in chunk.statements:
            stack = [root for root in statement.roots if isinstance(root, Node)]
            while stack:
                node = stack.pop()
                if not node.args or node in mine:
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


class _Body:
    """Writes the lines of one chunk."""

    def __init__(
        self,
        chunk: _Chunk,
        position: int,
        homes: dict[Node, tuple[int, int]],
        location: Callable[[str], str],
        lane_nodes: Collection[Node],
    ) -> None:
        self._lane_nodes = lane_nodes
        self._chunk = chunk
        self._position = position
        self._homes = homes
        self._location = location
        self._names: dict[Node, str] = {}
        self._lines: list[str] = []
        self._uses: dict[Node, int] = {}
        self._count_uses()

    def _count_uses(self) -> None:
        for statement in self._chunk.statements:
            for root in statement.roots:
                if isinstance(root, Node):
                    self._use(root)

    def _is_elsewhere(self, node: Node) -> bool:
        home = self._homes.get(node)
        return home is not None and home[0] != self._position and home[0] < self._position

    def _use(self, root: Node) -> None:
        stack = [root]
        while stack:
            node = stack.pop()
            count = self._uses.get(node, 0)
            self._uses[node] = count + 1
            if count == 0 and not self._is_elsewhere(node):
                stack.extend(node.args)

    def lines(self) -> list[str]:
        for statement in self._chunk.statements:
            for root in statement.roots:
                if isinstance(root, Node):
                    self._prepare(root)
            self._lines.extend(f"  {line}" for line in statement.lines(self._write))
        return self._lines

    def _write(self, root: float | Node) -> str:
        if not isinstance(root, Node):
            return number(root)
        return self._names[root]

    def _prepare(self, root: Node) -> None:
        """Makes sure that ``root`` has a text, declaring constants for shared nodes."""
        stack = [(root, False)]
        while stack:
            node, ready = stack.pop()
            if node in self._names:
                continue
            if node.op == "symbol":
                self._names[node] = self._location(node.name)
                continue
            if node.op == "constant":
                self._names[node] = number(node.value)
                continue
            if self._is_elsewhere(node):
                self._names[node] = self._home(node)
                continue
            if not ready:
                stack.append((node, True))
                stack.extend((arg, False) for arg in node.args if arg not in self._names)
                continue
            self._name(node)

    def _home(self, node: Node) -> str:
        offset = self._homes[node][1]
        return lanes_at(offset) if node in self._lane_nodes else f"w[{offset}]"

    def _name(self, node: Node) -> None:
        text = self._text(node)
        home = self._homes.get(node)
        if home is None and self._uses[node] == 1 and len(text) <= _INLINE_LENGTH:
            self._names[node] = text
            return
        name = f"n{len(self._names)}"
        type_name = "cmb_lanes" if node in self._lane_nodes else "double"
        self._lines.append(f"  const {type_name} {name} = {bare(text)};")
        self._names[node] = name
        if home is not None:
            self._lines.append(f"  {self._home(node)} = {name};")

    def _text(self, node: Node) -> str:
        args = [self._names[arg] for arg in node.args]
        infix = _INFIX.get(node.op)
        if infix is not None:
            return f"({args[0]} {infix} {args[1]})"
        if node.op == "neg":
            return f"(-{args[0]})"
        if node.op == "not":
            return f"(!{args[0]})"
        if node.op == "select" and node in self._lane_nodes:
            # A branch that is no vector is the number zero: derivatives are linear in the directions.
            first, second = (
                f"(cmb_lanes){text}" if arg in self._lane_nodes else "(cmb_lanes){0}"
                for arg, text in zip(node.args[1:], args[1:], strict=True)
            )
            return f"({args[0]} ? {first} : {second})"
        if node.op == "select":
            return f"({args[0]} ? {args[1]} : {args[2]})"
        return f"{_CALLS[node.op]}({', '.join(args)})"


def lanes_at(offset: int) -> str:
    """C lvalue of the vector at an offset of the work array."""
    return f"LANES(w, {offset})"


def bare(text: str) -> str:
    """The text without its outer parentheses, if they enclose all of it."""
    if not text.startswith("("):
        return text
    depth = 0
    for position, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if depth == 0:
            return text[1:-1] if position == len(text) - 1 else text
    return text


def roots_of(items: Iterable[float | Node]) -> tuple[float | Node, ...]:
    """The items as the roots of a statement."""
    return tuple(items)
