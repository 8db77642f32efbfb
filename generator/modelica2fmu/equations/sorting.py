"""From equations to a sequence of explicit assignments, calls, and small blocks that are solved numerically.

Equations and unknowns are matched, and strongly connected components of the matched system are torn each on its own.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from fractions import Fraction

from contact_foundation.errors import InputError, Place, UnsupportedModelError

from modelica2fmu.equations.blocks import (
    Assignment,
    Block,
    Entry,
    NonlinearBlock,
    Residual,
    Step,
    entry_roots,
    entry_targets,
)
from modelica2fmu.equations.dependent_equations import DependentEquationsError
from modelica2fmu.equations.linear_blocks import linear_block
from modelica2fmu.equations.matching import Matching, strongly_connected_components
from modelica2fmu.equations.tearing import Tearing
from modelica2fmu.expand.scalar_model import ExternalCall
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.linear_form import LinearForms, solved_for


def solve_order(
    entries: Sequence[Entry],
    unknowns: Collection[str],
    preferred: Collection[str],
    place: Callable[[Span | None], Place],
) -> list[Block]:
    """Blocks in the order in which they can be solved.

    Args:
        entries: equations, assignments and calls.
        unknowns: all symbols that they determine.
        preferred: unknowns to be torn first.
        place: place of a span.

    Raises:
        InputError: equations and unknowns cannot be matched.
        DependentEquationsError: what is matched is singular.
        UnsupportedModelError: an algebraic loop over discrete variables.
    """
    return _Sorter(entries, unknowns, preferred, place).run()


class _Sorter:
    def __init__(
        self,
        entries: Sequence[Entry],
        unknowns: Collection[str],
        preferred: Collection[str],
        place: Callable[[Span | None], Place],
    ) -> None:
        self._entries = entries
        self._unknowns = dict.fromkeys(unknowns)
        self._preferred = set(preferred)
        self._place = place
        self._dependencies: list[list[str]] = []
        for entry in entries:
            names = ex.symbols(*entry_roots(entry))
            self._dependencies.append([name for name in names if name in self._unknowns])

    def run(self) -> list[Block]:
        owner: dict[str, int] = {}
        for number, entry in enumerate(self._entries):
            for name in entry_targets(entry):
                owner[name] = number
        residuals = [number for number, entry in enumerate(self._entries) if isinstance(entry, Residual)]
        matching = Matching(
            {number: [name for name in self._dependencies[number] if name not in owner] for number in residuals}
        )
        unmatched = [number for number in residuals if not matching.augment(number)]
        missing = [name for name in self._unknowns if name not in owner and name not in matching.row_of]
        if unmatched or missing:
            raise InputError(self._singular(unmatched, missing), place=self._first_place(unmatched))
        owner.update(matching.row_of)
        successors = {
            number: [owner[name] for name in dict.fromkeys(self._dependencies[number]) if owner[name] != number]
            for number in range(len(self._entries))
        }
        self._draw_in(successors, owner)
        blocks: list[Block] = []
        for component in strongly_connected_components(successors):
            blocks.extend(self._component(component, matching.column_of))
        return blocks

    def _draw_in(self, successors: dict[int, list[int]], owner: Mapping[str, int]) -> None:
        """Adds the equations of preferred unknowns to the component that determines them.

        The derivative of a joint's speed often stands in one equation only, so that it would be computed after
        the component; as an unknown of the component it is the best one to assume.
        """
        components = strongly_connected_components(successors)
        large: dict[int, int] = {}  # entry -> number of the only large component it follows from, -1 if several
        for number, component in enumerate(components):
            if len(component) > 1:
                large.update(dict.fromkeys(component, number))
                continue
            (entry,) = component
            found = {large[successor] for successor in successors[entry] if successor in large}
            if found and not isinstance(self._entries[entry], Residual):
                # Discrete variables and calls stand between components; what follows them comes after.
                found = {-1}
            if found:
                large[entry] = found.pop() if len(found) == 1 else -1
        for name in self._unknowns:
            entry = owner[name]
            number = large.get(entry, -1)
            if name in self._preferred and number >= 0 and isinstance(self._entries[entry], Residual):
                successors[components[number][0]].append(entry)

    def _singular(self, unmatched: Sequence[int], missing: Sequence[str]) -> str:
        texts = []
        if unmatched:
            shown = [ex.to_text(entry_roots(self._entries[number])[0]) for number in unmatched[:5]]
            texts.append("equations without an unknown: " + "; ".join(shown))
        if missing:
            texts.append("unknowns without an equation: " + ", ".join(missing[:10]))
        return "the equations are structurally singular: " + "; ".join(texts)

    def _first_place(self, numbers: Sequence[int]) -> Place | None:
        for number in numbers:
            return self._place(self._entries[number].span)
        return None

    # --- one component ---

    def _component(self, component: Sequence[int], column_of: Mapping[int, str]) -> list[Block]:
        if len(component) == 1:
            entry = self._entries[component[0]]
            if not isinstance(entry, Residual):
                if any(name in self._dependencies[component[0]] for name in entry_targets(entry)):
                    raise self._discrete_loop(component)
                return [entry]
            name = column_of[component[0]]
            value = solved_for(entry.residual, name)
            if value is not None:
                return [Assignment(name, value, span=entry.span)]
            form = LinearForms([name])(entry.residual)
            if form is not None and name not in form.coefficients:
                raise DependentEquationsError([name], [(entry, Fraction(1))], self._place(entry.span))
            return [NonlinearBlock((name,), (entry.residual,), (), 1, (entry.span,))]
        if any(isinstance(self._entries[number], Assignment) for number in component):
            raise self._discrete_loop(component)
        return [self._tear(component, column_of)]

    def _discrete_loop(self, component: Sequence[int]) -> UnsupportedModelError:
        names = [name for number in component for name in entry_targets(self._entries[number])]
        return UnsupportedModelError(
            "discrete variables depend on each other in a loop: " + ", ".join(names[:8]),
            place=self._first_place(component),
            remedy="break the loop by pre()",
        )

    def _tear(self, component: Sequence[int], column_of: Mapping[int, str]) -> Block:
        calls = [entry for number in component if isinstance(entry := self._entries[number], ExternalCall)]
        numbers = [number for number in component if isinstance(self._entries[number], Residual)]
        names = [column_of[number] for number in numbers] + [name for call in calls for name in call.outputs]
        torn, order, remaining = Tearing(
            {number: self._entries[number] for number in component},
            {number: self._dependencies[number] for number in component},
            names,
            self._preferred,
        ).run()
        rows = [entry for number in remaining if isinstance(entry := self._entries[number], Residual)]
        if not calls:
            solved = [(entry, name) for number, name in order if isinstance(entry := self._entries[number], Residual)]
            linear = linear_block(torn, solved, rows, self._place)
            if linear is not None:
                return linear
        inner: list[Step] = []
        for number, name in order:
            entry = self._entries[number]
            if isinstance(entry, Residual):
                value = solved_for(entry.residual, name)
                assert value is not None
                inner.append(Assignment(name, value, span=entry.span))
            else:
                assert isinstance(entry, ExternalCall)
                inner.append(entry)
        residuals, spans = tuple(row.residual for row in rows), tuple(row.span for row in rows)
        return NonlinearBlock(tuple(torn), residuals, tuple(inner), len(names), spans)
