"""Derivatives of all unknowns along directions of the states, block by block.

Forward differentiation (Griewank and Walther 2008, "Evaluating Derivatives", chapter 3) of the sorted blocks. A torn
block is differentiated as it is solved: with its torn unknowns held, the directions run through its equations to its
residuals; the factors that its solution left give the derivatives of the torn unknowns (the implicit function
theorem), and these the rest. Nothing is differentiated through an elimination, so for a mechanism the cost is that of
its equations of motion, not of its mass matrix.

Symbols: ``tangent(x)`` is the derivative of ``x``, ``held(x)`` the one with the torn unknowns of its block held,
``probe(x)`` the one by a torn unknown alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

from modelica2fmu.equations.blocks import Assignment, Block, LinearBlock, NonlinearBlock
from modelica2fmu.expand.scalar_model import ExternalCall
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


@dataclass(frozen=True)
class TangentAssignment:
    """``target := value``; ``target`` is a vector of directions."""

    target: str
    value: Node


@dataclass(frozen=True)
class CallTangent:
    """The outputs of a call along directions of its inputs, by difference quotients.

    Attributes:
        call: the call.
        inputs: those that vary, with their tangents.
        outputs: Real outputs and the names of their tangents.
    """

    call: ExternalCall
    inputs: tuple[tuple[Node, Node], ...]
    outputs: tuple[tuple[str, str], ...]


TangentStep = TangentAssignment | CallTangent


@dataclass(frozen=True)
class SolvedTangent:
    """Tangents of a block's torn unknowns: ``jacobian * tangents = -residuals``.

    Attributes:
        block: the block; a linear one has left its factors.
        targets: names of the tangents.
        residuals: tangents of the residuals with the torn unknowns held.
        probe: of a nonlinear block: from ``probe(torn)`` to the symbols of ``columns``.
        columns: of a nonlinear block: derivatives of the residuals in terms of ``probe`` symbols.
    """

    block: LinearBlock | NonlinearBlock
    targets: tuple[str, ...]
    residuals: tuple[float | Node, ...]
    probe: tuple[TangentStep, ...] = ()
    columns: tuple[float | Node, ...] = ()


Tangent = TangentStep | SolvedTangent


def tangent_name(name: str) -> str:
    """Name of the derivative of a symbol along the directions."""
    return f"tangent({name})"


def probe_name(name: str) -> str:
    """Name of the derivative of a symbol by a torn unknown of its block."""
    return f"probe({name})"


def _held_name(name: str) -> str:
    return f"held({name})"


def is_tangent(name: str) -> bool:
    """True for the symbols of derivatives along directions."""
    return name.startswith(("tangent(", "held(", "probe("))


def tangents(blocks: Sequence[Block], states: Sequence[str], rates: Sequence[str]) -> list[Tangent]:
    """What computes ``tangent(rate)`` for all rates from ``tangent(state)``, in order.

    Args:
        blocks: blocks while simulating, in the order of their solution.
        states: names of the states.
        rates: names of what is wanted; one without a tangent in the result does not depend on the states.
    """
    builder = _Builder(states)
    for block in blocks:
        builder.add(block)
    return _needed(builder.steps, [tangent_name(name) for name in rates])


class _Builder:
    def __init__(self, states: Sequence[str]) -> None:
        self._active = set(states)
        self.steps: list[Tangent] = []
        self._differentiate = ex.Differentiation(self._rate)

    def _rate(self, name: str) -> float | Node:
        return ex.symbol(tangent_name(name)) if name in self._active else 0

    def add(self, block: Block) -> None:
        if isinstance(block, Assignment | ExternalCall):
            self._explicit(block)
        elif isinstance(block, NonlinearBlock) and len(block.torn) == 1 and not block.inner:
            self._implicit(block.torn[0], block.residuals[0])
        else:
            self._torn(block)

    def _explicit(self, step: Assignment | ExternalCall) -> None:
        for name, tangent in _differentiated(step, self._differentiate, tangent_name):
            self._active.add(name)
            if tangent is not None:
                self.steps.append(tangent)

    def _implicit(self, name: str, residual: float | Node) -> None:
        """One equation in one unknown."""
        # Not by self._differentiate, which would remember that the unknown does not move.
        right = ex.Differentiation(self._rate)(residual)
        if not isinstance(right, Node):
            return
        slope = ex.Differentiation(lambda other: 1 if other == name else 0)(residual)
        value = ex.node_of(ex.negate(ex.divide(right, slope)))
        self.steps.append(TangentAssignment(tangent_name(name), value))
        self._active.add(name)

    def _torn(self, block: LinearBlock | NonlinearBlock) -> None:
        depends = set(block.torn)  # on the torn unknowns
        for step in block.inner:
            if any(name in depends for name in ex.symbols(*_inputs(step))):
                depends.update(_targets(step))
        held: set[str] = set()

        def held_rate(name: str) -> float | Node:
            return ex.symbol(_held_name(name)) if name in held else self._rate(name)

        differentiate = ex.Differentiation(held_rate)
        for step in block.inner:
            if not any(name in depends for name in _targets(step)):
                self._explicit(step)
                continue
            for name, tangent in _differentiated(step, differentiate, _held_name):
                held.add(name)
                if tangent is not None:
                    self.steps.append(tangent)
        residuals = tuple(differentiate(residual) for residual in block.residuals)
        if all(not isinstance(item, Node) for item in residuals):
            # The torn unknowns do not move, so what follows from them moves as it does with them held.
            for name in held:
                self._active.add(name)
                self.steps.append(TangentAssignment(tangent_name(name), ex.node_of(ex.symbol(_held_name(name)))))
            return
        targets = tuple(tangent_name(name) for name in block.torn)
        if isinstance(block, LinearBlock) and len(block.torn) == 1 and block.system is not None:
            value = ex.node_of(ex.negate(ex.divide(residuals[0], block.system.matrix[0][0])))
            self.steps.append(TangentAssignment(targets[0], value))
        elif isinstance(block, LinearBlock):
            self.steps.append(SolvedTangent(block, targets, residuals))
        else:
            steps, columns = probe(block)
            self.steps.append(SolvedTangent(block, targets, residuals, steps, columns))
        self._active.update(block.torn)
        for step in block.inner:
            if any(name in depends for name in _targets(step)):
                self._explicit(step)


def probe(block: LinearBlock | NonlinearBlock) -> tuple[tuple[TangentStep, ...], tuple[float | Node, ...]]:
    """Derivatives of a block's residuals by its torn unknowns.

    Returns:
        what computes ``probe(x)`` of what follows from the torn unknowns, from ``probe`` of these; and the residuals'
        derivatives in these terms.
    """
    active = set(block.torn)
    differentiate = ex.Differentiation(lambda name: ex.symbol(probe_name(name)) if name in active else 0)
    steps: list[TangentStep] = []
    for step in block.inner:
        for name, tangent in _differentiated(step, differentiate, probe_name):
            active.add(name)
            if tangent is not None:
                steps.append(tangent)
    return tuple(steps), tuple(differentiate(residual) for residual in block.residuals)


def _differentiated(
    step: Assignment | ExternalCall, differentiate: ex.Differentiation, name_of: Callable[[str], str]
) -> list[tuple[str, TangentStep | None]]:
    """The targets of a step that move, the first with what computes their tangents."""
    if isinstance(step, Assignment):
        rate = 0 if step.is_discrete else differentiate(step.value)
        return [(step.target, TangentAssignment(name_of(step.target), rate))] if isinstance(rate, Node) else []
    inputs = tuple(
        (value, rate)
        for argument in step.args
        if argument.type == "Real" and not argument.is_output
        for value in dict.fromkeys(argument.values)
        if isinstance(value, Node) and isinstance(rate := differentiate(value), Node)
    )
    if not inputs:
        return []
    real = [
        value.name
        for argument in step.args
        if argument.is_output and argument.type == "Real"
        for value in argument.values
        if isinstance(value, Node)
    ]
    if step.result is not None and step.result[1] == "Real":
        real.append(step.result[0])
    tangent = CallTangent(step, tuple(dict.fromkeys(inputs)), tuple((name, name_of(name)) for name in real))
    return [(name, tangent if position == 0 else None) for position, name in enumerate(real)]


def _inputs(step: Assignment | ExternalCall) -> Iterable[float | Node]:
    return step.inputs() if isinstance(step, ExternalCall) else (step.value,)


def _targets(step: Assignment | ExternalCall) -> tuple[str, ...]:
    return step.outputs if isinstance(step, ExternalCall) else (step.target,)


def _needed(steps: Sequence[Tangent], wanted: Iterable[str]) -> list[Tangent]:
    """The steps that ``wanted`` needs."""
    needed = set(wanted)
    kept: list[Tangent] = []
    for step in reversed(steps):
        if not any(name in needed for name in tangent_targets(step)):
            continue
        if isinstance(step, SolvedTangent) and step.probe:
            step = replace(step, probe=_needed_probe(step))
        kept.append(step)
        needed.update(name for name in ex.symbols(*tangent_roots(step)) if is_tangent(name))
    return kept[::-1]


def _needed_probe(step: SolvedTangent) -> tuple[TangentStep, ...]:
    kept = _needed(step.probe, ex.symbols(*step.columns))
    return tuple(item for item in kept if not isinstance(item, SolvedTangent))


def tangent_targets(step: Tangent) -> tuple[str, ...]:
    """Symbols that a step computes."""
    if isinstance(step, TangentAssignment):
        return (step.target,)
    if isinstance(step, CallTangent):
        return tuple(target for _, target in step.outputs)
    return step.targets


def tangent_roots(step: Tangent) -> list[float | Node]:
    """Expressions that a step evaluates."""
    if isinstance(step, TangentAssignment):
        return [step.value]
    if isinstance(step, CallTangent):
        return [rate for _, rate in step.inputs]
    return list(step.residuals)
