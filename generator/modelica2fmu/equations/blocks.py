"""What a sorted system is made of: equations before, and explicit steps and solved blocks after sorting."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass, replace

from modelica2fmu.expand.scalar_model import ExternalCall
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


@dataclass(frozen=True)
class Residual:
    """``residual = 0``; ``number`` is that of a continuous equation."""

    residual: float | Node
    span: Span | None = None
    number: int | None = None


@dataclass(frozen=True)
class Assignment:
    """``target := value``; explicit, because it is one (discrete variables) or because it was solved."""

    target: str
    value: float | Node
    is_discrete: bool = False
    span: Span | None = None


Entry = Residual | Assignment | ExternalCall
Step = Assignment | ExternalCall


@dataclass(frozen=True)
class LinearSystem:
    """``matrix * torn = right`` in expressions: the matrix row by row, and the right-hand side."""

    matrix: tuple[tuple[float | Node, ...], ...]
    right: tuple[float | Node, ...]


@dataclass(frozen=True)
class LinearBlock:
    """Find ``torn`` so that after ``inner`` all ``residuals`` vanish, all of them linear in ``torn``.

    Attributes:
        torn: unknowns of the linear system.
        inner: what follows from the torn unknowns, in order.
        residuals: the equations of the linear system.
        size: number of unknowns before tearing.
        system: the residuals with ``inner`` inserted; without it they are evaluated as they are: for the right-hand
            side with ``torn = 0``, and their derivatives by the torn unknowns for the matrix.
    """

    torn: tuple[str, ...]
    inner: tuple[Assignment, ...]
    residuals: tuple[float | Node, ...]
    size: int
    system: LinearSystem | None


@dataclass(frozen=True)
class NonlinearBlock:
    """Find ``torn`` so that after ``inner`` all ``residuals`` vanish; ``spans`` says where these stand in the model."""

    torn: tuple[str, ...]
    residuals: tuple[float | Node, ...]
    inner: tuple[Step, ...]
    size: int
    spans: tuple[Span | None, ...] = ()


Block = Assignment | ExternalCall | LinearBlock | NonlinearBlock


def entry_roots(entry: Entry) -> list[float | Node]:
    """All expressions of an entry."""
    if isinstance(entry, Residual):
        return [entry.residual]
    if isinstance(entry, Assignment):
        return [entry.value]
    return list(entry.inputs())


def entry_targets(entry: Entry) -> tuple[str, ...]:
    """The symbols that an entry determines by itself."""
    if isinstance(entry, Assignment):
        return (entry.target,)
    if isinstance(entry, ExternalCall):
        return entry.outputs
    return ()


def block_roots(block: Block) -> list[float | Node]:
    """All expressions that a block evaluates."""
    if isinstance(block, Assignment | ExternalCall):
        return entry_roots(block)
    inner = [root for step in block.inner for root in entry_roots(step)]
    if isinstance(block, NonlinearBlock) or block.system is None:
        return [*block.residuals, *inner]
    return [*(item for row in block.system.matrix for item in row), *block.system.right, *inner]


def block_targets(block: Block) -> list[str]:
    """All symbols that a block determines."""
    if isinstance(block, LinearBlock | NonlinearBlock):
        return [*block.torn, *(name for step in block.inner for name in entry_targets(step))]
    return list(entry_targets(block))


def needed_blocks(blocks: Sequence[Block], wanted: Iterable[str]) -> list[Block]:
    """The blocks that ``wanted`` needs, in the same order."""
    needed = set(wanted)
    kept = []
    for block in reversed(blocks):
        if any(name in needed for name in block_targets(block)):
            kept.append(block)
            needed.update(ex.symbols(*block_roots(block)))
    return kept[::-1]


def divided_blocks(blocks: Sequence[Block], wanted: Iterable[str]) -> tuple[list[Block], list[Assignment]]:
    """The blocks that ``wanted`` needs or that may fail or have memory, and the assignments that come after them.

    Discrete assignments, calls and what is solved are among the first; a linear system leaves to the second the
    unknowns that follow from its solution and that nothing else needs.
    """
    needed = set(wanted)
    first: list[Block] = []
    last: list[Assignment] = []
    for block in reversed(blocks):
        kept: Block = block
        if isinstance(block, LinearBlock) and block.system is not None:
            inner = _divided_steps(block.inner, needed, last)
            kept = replace(block, inner=tuple(inner))
        elif isinstance(block, Assignment) and not block.is_discrete and block.target not in needed:
            last.append(block)
            continue
        first.append(kept)
        needed.update(ex.symbols(*block_roots(kept)))
    return first[::-1], last[::-1]


def _divided_steps(steps: Sequence[Assignment], needed: set[str], last: list[Assignment]) -> list[Assignment]:
    """Those of a system's explicit steps that are needed, as their symbols are then; the others go to ``last``."""
    first = []
    for step in reversed(steps):
        if step.target in needed:
            first.append(step)
            needed.update(ex.symbols(*entry_roots(step)))
        else:
            last.append(step)
    return first[::-1]


def blocks_around(blocks: Sequence[Block], others: Sequence[Block]) -> tuple[list[Block], list[Block]] | None:
    """What of ``blocks`` comes before and after ``others``, whose continuous ones are all among ``blocks``.

    ``None`` if they are not, or if some of them need what needs others of them.
    """
    common = {_identity(block): block for block in others if not (isinstance(block, Assignment) and block.is_discrete)}
    own = [block for block in blocks if _identity(block) not in common]
    if not common or len(blocks) - len(own) < len(common):
        return None
    later = {name for block in common.values() for name in block_targets(block)}
    before: list[Block] = []
    after: list[Block] = []
    waiting: set[str] = set()
    for block in own:
        if later.isdisjoint(names := ex.symbols(*block_roots(block))) and waiting.isdisjoint(names):
            before.append(block)
        else:
            after.append(block)
            waiting.update(block_targets(block))
    used = ex.symbols(*(root for block in common.values() for root in block_roots(block)))
    if not waiting.isdisjoint(used) or any(name.startswith("start(") for name in used):
        return None
    return before, after


def _identity(block: Block) -> Hashable:
    """The same for blocks that do the same: equal expressions are one node."""
    return type(block), tuple(block_targets(block)), tuple(block_roots(block))
