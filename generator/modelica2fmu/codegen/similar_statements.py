"""Statements that differ by their places and numbers alone become loops, so that code does not grow with their number.

The contacts of many pairs of bodies, for example, are the same equations with other variables. Nodes that several
statements use are statements of their own, for else no two would be the same. Those that only certain branches of
conditional expressions need are computed where these are taken: most contacts are open most of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from operator import itemgetter
from typing import Final

from modelica2fmu.codegen.c_expressions import number
from modelica2fmu.codegen.demanded_nodes import Literal, demands
from modelica2fmu.codegen.expression_forms import ExpressionForms, Form, Leaf, Operation, split_place
from modelica2fmu.codegen.loop_code import Guards, TrueList, loop_lines
from modelica2fmu.codegen.shared_nodes import SharedNode, shared_nodes
from modelica2fmu.codegen.statement_schedule import Schedule
from modelica2fmu.codegen.statements import Group, Put, Statement, Stored, WorkSpace, Write
from modelica2fmu.equations.lanes import LANES, lanes_at
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_LEAST: Final = 8  # statements of a loop
_SMALL: Final = 5000  # operations that a compiler takes as they are
_SAVED: Final = 0.25  # of the operations, from which on loops pay


@dataclass
class Arrangement:
    """Statements in an order in which many are loops.

    Attributes:
        statements: in order.
        kept: nodes that loops store in the work array, and their offsets.
        handed_on: those of them that statements of other groups read.
        passing: nodes that have no value where nothing that an integrator asks for needs them, so that statements which
            are executed on request compute them anew.
    """

    statements: list[Statement]
    kept: dict[Node, int] = field(default_factory=dict)
    handed_on: set[Node] = field(default_factory=set)
    passing: set[Node] = field(default_factory=set)


def arranged(
    statements: Sequence[Statement],
    location: Callable[[str], str],
    work: WorkSpace,
    lane_nodes: Collection[Node],
) -> Arrangement:
    """The statements with loops where these pay; else as they are.

    Args:
        statements: in order; each symbol is assigned at most once and not read before.
        location: C lvalue of a symbol.
        work: where loops keep nodes that other statements use.
        lane_nodes: nodes that are vectors.
    """
    if sum(statement.put is not None for statement in statements) < _LEAST:
        return Arrangement(list(statements))
    return _Arranger(statements, location, work, lane_nodes).run()


@dataclass(frozen=True)
class _Kind:
    """What the statements of a stretch have in common, as for statements."""

    group: Group | None
    on_request: bool


@dataclass(frozen=True)
class _Unit:
    """A statement, or a shared node that is computed.

    Attributes:
        statement: None for a node.
        shared: None for a statement.
        segment: in which the unit is executed.
        form: of its expression; None where it cannot be in a loop.
        leaves: what it reads, in the order of the form if it has one.
        guard: where it needs to be computed; None for everywhere.
        fills: = true, if it is zero elsewhere, and not just not needed.
    """

    statement: Statement | None
    shared: SharedNode | None
    segment: int
    form: Form | None
    leaves: tuple[Node, ...]
    guard: Literal | None = None
    fills: bool = False

    @property
    def reads(self) -> tuple[Node, ...]:
        """What is read before the unit is executed."""
        return self.leaves if self.guard is None else (*self.leaves, self.guard.condition)

    @property
    def is_discrete(self) -> bool:
        """= true, if it is executed at events only."""
        if self.shared is not None:
            return self.shared.is_discrete
        return self.statement is not None and self.statement.is_discrete

    @property
    def put(self) -> Put | None:
        """What a statement does."""
        return self.statement.put if self.statement is not None else None


class _Arranger:
    def __init__(
        self,
        statements: Sequence[Statement],
        location: Callable[[str], str],
        work: WorkSpace,
        lane_nodes: Collection[Node],
    ) -> None:
        self._statements = statements
        self._location = location
        self._work = work
        self._lane_nodes = lane_nodes
        self._segments, self._kinds = _segments(statements)
        shared = shared_nodes(statements)
        self._place = {item.node: len(statements) + k for k, item in enumerate(shared)}
        self._demands = demands(root for item in statements if not item.on_request for root in item.roots)
        self._forms = ExpressionForms(self._place, lane_nodes, location)
        self._lasting = {node: place for node, place in self._place.items() if not self._passes(node)}
        self._forms_on_request = ExpressionForms(self._lasting, lane_nodes, location)
        self._units = [
            *(self._unit_of_statement(position) for position in range(len(statements))),
            *(self._unit_of_node(item) for item in shared),
        ]
        self._families = self._found_families()
        self._needed = self._needed_by_loops()
        self._conditions = {
            unit.guard.condition for k in self._families if (unit := self._units[k]).guard and unit.guard.holds
        }
        self._lists: dict[Node, tuple[TrueList, int]] = {}
        self._result = Arrangement([], passing={node for node in self._demands if self._passes(node)})

    def _passes(self, node: Node) -> bool:
        """Whether a node has no value where nothing that is always executed needs it."""
        return bool(self._demands.get(node))

    def _unit_of_statement(self, position: int) -> _Unit:
        statement, segment = self._statements[position], self._segments[position]
        shared = self._lasting if statement.on_request else self._place
        put = statement.put
        if put is None or put.stored is Stored.OTHERWISE or len(statement.roots) != 1:
            return _Unit(statement, None, segment, None, self._read(statement.roots, shared))
        root = ex.node_of(statement.roots[0])
        if root in shared:  # a copy
            return _Unit(statement, None, segment, *self._form(root))
        if not statement.on_request and put.stored is Stored.NUMBER and self._is_branch_or_zero(root):
            form, leaves = self._form(root.args[1])
            return _Unit(statement, None, segment, form, leaves, Literal(root.args[0], True), fills=True)
        form, leaves = (self._forms_on_request if statement.on_request else self._forms).form(root)
        return _Unit(statement, None, segment, form, leaves)

    def _form(self, node: Node) -> tuple[Form, tuple[Node, ...]]:
        if node in self._place:
            return (Leaf("shared lanes" if node in self._lane_nodes else "shared"),), (node,)
        return self._forms.form(node)

    def _is_branch_or_zero(self, node: Node) -> bool:
        """Whether a node is zero where a condition that is always known does not hold."""
        if node.op != "select" or node.args[2].op != "constant" or node.args[2].value != 0:
            return False
        condition, branch, _ = node.args
        return (
            condition in self._place
            and not self._passes(condition)
            and (node in self._lane_nodes) == (branch in self._lane_nodes)
        )

    def _unit_of_node(self, item: SharedNode) -> _Unit:
        segment = self._segments[item.first]
        on_request = self._kinds[segment].on_request
        form, leaves = (self._forms_on_request if on_request else self._forms).form(item.node)
        return _Unit(None, item, segment, form, leaves, None if on_request else self._guard(item.node))

    def _guard(self, node: Node) -> Literal | None:
        """A condition that is always known, without which nothing needs a node."""
        known = (
            literal
            for literal in self._demands.get(node, ())
            if literal.condition in self._place and not self._passes(literal.condition)
        )
        return min(known, key=lambda literal: self._place[literal.condition], default=None)

    def _read(self, roots: Sequence[float | Node], shared: Collection[Node]) -> tuple[Node, ...]:
        """Symbols and shared nodes that expressions read."""
        found: dict[Node, None] = {}
        seen: set[Node] = set()
        stack = [root for root in roots if isinstance(root, Node)]
        while stack:
            node = stack.pop()
            if node in seen:
                continue
            seen.add(node)
            if node in shared or node.op == "symbol":
                found[node] = None
            else:
                stack.extend(node.args)
        return tuple(found)

    # --- families ---

    def _found_families(self) -> dict[int, int]:
        """Family of each unit that has enough others like it; none where that saves little."""
        members: dict[Hashable, list[int]] = {}
        for position, unit in enumerate(self._units):
            if unit.form is not None:
                members.setdefault(self._likeness(unit), []).append(position)
        large = [units for units in members.values() if len(units) >= _LEAST]
        total = sum(self._size(unit) for unit in self._units)
        saved = sum((len(units) - 1) * self._size(self._units[units[0]]) for units in large)
        if total < _SMALL or saved < _SAVED * total:
            return {}
        return {unit: family for family, units in enumerate(large) for unit in units}

    @staticmethod
    def _size(unit: _Unit) -> int:
        return 1 + sum(isinstance(step, Operation) for step in unit.form or ())

    @staticmethod
    def _likeness(unit: _Unit) -> Hashable:
        """What the units of a loop have in common."""
        put = unit.put
        parts = None if put is None else split_place(put.place)
        array = None if put is None else (put.place if parts is None else parts[0], put.stored)
        guard = None if unit.guard is None else unit.guard.holds
        return unit.segment, unit.is_discrete, array, unit.form, guard, unit.fills

    def _needed_by_loops(self) -> set[Node]:
        """Shared nodes that loops read and none computes."""
        return {
            leaf
            for position in self._families
            for leaf in self._units[position].reads
            if leaf in self._place and self._place[leaf] not in self._families
        }

    # --- order ---

    def run(self) -> Arrangement:
        if not self._families:
            return Arrangement(list(self._statements))
        of_segment: dict[int, list[int]] = {}
        for position, unit in enumerate(self._units):
            of_segment.setdefault(unit.segment, []).append(position)
        is_discrete = [unit.is_discrete for unit in self._units]
        for segment in sorted(of_segment):
            units = of_segment[segment]
            for together in Schedule(self._needs(units), self._families, is_discrete, _LEAST).run():
                self._emit(together, self._kinds[segment])
        return self._result

    def _needs(self, units: Sequence[int]) -> dict[int, list[int]]:
        """For each unit of a segment, those of it that compute what it reads."""
        assigned = {
            put.symbol: position
            for position in units
            if (put := self._units[position].put) is not None and put.symbol is not None
        }
        present = set(units)
        return {position: list(self._needs_of(position, assigned, present)) for position in units}

    def _needs_of(self, position: int, assigned: Mapping[str, int], present: Collection[int]) -> Iterator[int]:
        for leaf in dict.fromkeys(self._units[position].reads):
            needed = assigned.get(leaf.name) if leaf.op == "symbol" else self._place.get(leaf)
            if needed is not None and needed in present and needed != position:
                yield needed

    # --- statements ---

    def _emit(self, together: Sequence[int], kind: _Kind) -> None:
        statements = self._result.statements
        if len(together) > 1:
            units = sorted((self._units[position] for position in together), key=self._index)
            statements.extend(self._loop(part, kind) for part in self._by_list(units))
            return
        unit = self._units[together[0]]
        if unit.statement is not None:
            statements.append(unit.statement)
        elif unit.shared is not None and (unit.shared.node in self._needed or together[0] in self._families):
            statements.append(
                Statement((unit.shared.node,), lambda _: [], group=kind.group, on_request=kind.on_request)
            )

    def _index(self, unit: _Unit) -> int:
        """Where a unit's place, or what it reads first, stands in its array."""
        places = [unit.put.place] if unit.put is not None else []
        places += [self._location(leaf.name) for leaf in unit.leaves if leaf.op == "symbol"]
        return next((found[1] for place in places if (found := split_place(place)) is not None), 0)

    def _by_list(self, units: Sequence[_Unit]) -> Iterator[Sequence[_Unit]]:
        """The units by the lists in which their conditions are, each part in the order of its list."""
        parts: dict[TrueList | None, list[tuple[int, _Unit]]] = {}
        for unit in units:
            listed, position = self._listed(unit) or (None, 0)
            parts.setdefault(listed, []).append((position, unit))
        for part in parts.values():
            yield [unit for _, unit in sorted(part, key=itemgetter(0))]

    def _listed(self, unit: _Unit) -> tuple[TrueList, int] | None:
        """The list in which a unit's condition is, and its position there."""
        if unit.guard is None or not unit.guard.holds:
            return None
        return self._lists.get(unit.guard.condition)

    def _listing(self, units: Sequence[_Unit]) -> TrueList | None:
        """Where conditions that a loop computes are listed, if others go by them."""
        nodes = [unit.shared.node for unit in units if unit.shared is not None]
        if units[0].guard is not None or self._conditions.isdisjoint(nodes):
            return None
        made = TrueList(self._work.integer(1 + len(units)), len(units))
        self._lists.update({node: (made, position) for position, node in enumerate(nodes)})
        return made

    def _guards(self, units: Sequence[_Unit], write: Write) -> Guards | None:
        first = units[0]
        if first.guard is None:
            return None
        conditions = [write(unit.guard.condition) for unit in units if unit.guard is not None]
        is_lane = first.put is not None and first.put.place.startswith("LANES")
        otherwise = ("(fmurt_lanes){0}" if is_lane else "0.0") if first.fills else ""
        entries = [entry for unit in units if (entry := self._listed(unit)) is not None]
        listed = entries[0][0] if entries else None
        return Guards(conditions, first.guard.holds, otherwise, listed, [position for _, position in entries])

    def _loop(self, units: Sequence[_Unit], kind: _Kind) -> Statement:
        targets, put = self._targets(units), units[0].put
        listing = self._listing(units)
        stored = Stored.NUMBER if put is None else put.stored
        read = tuple(dict.fromkeys(leaf for unit in units for leaf in unit.reads if leaf in self._place))
        form = units[0].form
        assert form is not None

        def lines(write: Write) -> list[str]:
            leaves = [[self._leaf(leaf, write) for leaf in unit.leaves] for unit in units]
            return loop_lines(form, leaves, targets, stored, self._guards(units, write), listing)

        executed = len(units) * (1 + sum(isinstance(step, Operation) and step.is_shared for step in form))
        keeps = tuple(unit.shared.node for unit in units if unit.shared is not None)
        return Statement(
            read,
            lines,
            units[0].is_discrete,
            kind.group,
            executed=executed,
            keeps=keeps,
            on_request=kind.on_request,
        )

    def _leaf(self, leaf: Node, write: Write) -> str:
        if leaf.op == "constant":
            return number(leaf.value)
        return self._location(leaf.name) if leaf.op == "symbol" else write(leaf)

    def _targets(self, units: Sequence[_Unit]) -> list[str]:
        result = []
        for unit in units:
            if unit.shared is None:
                assert unit.put is not None
                result.append(unit.put.place)
                continue
            node = unit.shared.node
            is_lane = node in self._lane_nodes
            offset = self._work.real(LANES if is_lane else 1)
            self._result.kept[node] = offset
            if unit.shared.crosses_groups:
                self._result.handed_on.add(node)
            result.append(lanes_at(offset) if is_lane else f"w[{offset}]")
        return result


def _segments(statements: Sequence[Statement]) -> tuple[list[int], list[_Kind]]:
    """For each statement the number of the stretch in which it may move, and the kinds of these stretches.

    A statement that does more than to store a value is a stretch of its own.
    """
    segments: list[int] = []
    kinds: list[_Kind] = []
    before: Statement | None = None
    for statement in statements:
        kind = _Kind(statement.group, statement.on_request)
        if before is None or statement.put is None or before.put is None or kind != kinds[-1]:
            kinds.append(kind)
        segments.append(len(kinds) - 1)
        before = statement
    return segments, kinds
