"""C statements of events: assertions, terminations, reinitializations, time events, and the event indicators."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from modelica2fmu.codegen.c_expressions import bare, c_text
from modelica2fmu.codegen.statements import Lines, Statement, Write
from modelica2fmu.codegen.symbol_places import SymbolPlaces, set_work
from modelica2fmu.expand.scalar_model import INITIAL, TIME, ScalarAssert, ScalarModel
from modelica2fmu.interpreter.arrays import Text
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


def event_statements(model: ScalarModel, places: SymbolPlaces) -> list[Statement]:
    """What an event iteration does after the equations."""
    running = ex.Substitution({INITIAL: 0})
    statements: list[Statement] = []
    for assertion in model.asserts:
        if assertion.trigger is not None:
            statements.append(assert_statement(assertion, "FMURT_RESULT_ERROR"))
    for termination in model.terminations:
        statements.append(_termination(running(termination.trigger), termination.message))
    # All values are computed before the first state changes.
    offset = places.work.real(2 * len(model.reinitializations))
    for position, item in enumerate(model.reinitializations):
        statements.append(set_work(offset + 2 * position, running(item.trigger)))
        statements.append(set_work(offset + 2 * position + 1, running(item.value)))
    for position, item in enumerate(model.reinitializations):
        flag, value = f"w[{offset + 2 * position}]", f"w[{offset + 2 * position + 1}]"
        state = places.location(item.state)
        statements.append(fixed_statement(f"if ({flag} != 0.0) {{ {state} = {value}; *states_changed = 1; }}"))
    statements.append(fixed_statement("v->next_time_event = HUGE_VAL;"))
    for threshold in model.time_thresholds:
        statements.append(_next_time(threshold))
    for sample in model.samples:
        since = ex.divide(ex.subtract(ex.symbol(TIME), sample.start), sample.interval)
        count = ex.binary("max", ex.add(ex.unary("floor", ex.add(since, 5e-10)), 1), 0)
        statements.append(_next_time(ex.add(sample.start, ex.multiply(count, sample.interval))))
    return [replace(item, is_discrete=True) for item in statements]


def lasting_asserts(model: ScalarModel) -> list[ScalarAssert]:
    """Assertions, of either level, that hold all the time."""
    return [item for item in model.asserts if item.trigger is None]


def warning_statements(warnings: Iterable[ScalarAssert], places: SymbolPlaces) -> list[Statement]:
    """The checks of lasting warnings; each is reported once a run."""
    return [_warning(item, places.work.real(1)) for item in warnings]


def assert_statement(item: ScalarAssert, severity: str) -> Statement:
    """The check of an assertion; one at level error returns ``severity``."""
    running = ex.Substitution({INITIAL: 0})
    condition: float | Node = ex.logical_not(running(item.condition))
    if item.trigger is not None:
        condition = ex.logical_and(running(item.trigger), condition)

    def lines(write: Write) -> list[str]:
        report = "fmurt_report_warning" if item.is_warning else "fmurt_report_error"
        end = [] if item.is_warning else [f"  return {severity};"]
        return [f"if ({write(condition)}) {{", *_message(item.message, write, report), *end, "}"]

    return Statement((condition, *_nodes(item.message)), lines)


def indicator_statements(model: ScalarModel) -> list[Statement]:
    """The event indicators."""
    return [
        Statement((item.indicator,), _indicator(item.number - 1, item.indicator))
        for item in model.relations
    ]  # fmt: skip


def fixed_statement(line: str) -> Statement:
    """A line without expressions."""
    return Statement((), lambda _: [line])


def _indicator(position: int, value: float | Node) -> Lines:
    return lambda write: [f"indicator[{position}] = {bare(write(value))};"]


def _warning(item: ScalarAssert, said: int) -> Statement:
    failed = ex.logical_not(ex.Substitution({INITIAL: 0})(item.condition))
    timed = Text((*item.message.parts, " (first at ", ex.symbol(TIME), " s)"))

    def lines(write: Write) -> list[str]:
        return [
            f"if (w[{said}] == 0.0 && {write(failed)}) {{", *_message(timed, write, "fmurt_report_warning"),
            f"  w[{said}] = 1.0;", "}",
        ]  # fmt: skip

    return Statement((failed, *_nodes(timed)), lines)


def _termination(trigger: float | Node, message: Text) -> Statement:
    def lines(write: Write) -> list[str]:
        return [
            f"if ({write(trigger)}) {{", *_message(message, write, "fmurt_report_warning"),
            "  v->terminate = 1;", "}",
        ]  # fmt: skip

    return Statement((trigger, *_nodes(message)), lines)


def _next_time(value: float | Node) -> Statement:
    return Statement((value,), lambda write: [f"fmurt_next_time(v, {bare(write(value))});"])


def _nodes(message: Text) -> tuple[Node, ...]:
    return tuple(part for part in message.parts if isinstance(part, Node))


def _message(message: Text, write: Write, report: str) -> list[str]:
    parts = "".join("%.6g" if isinstance(part, Node) else part.replace("%", "%%") for part in message.parts)
    values = "".join(f", (double)({write(part)})" for part in message.parts if isinstance(part, Node))
    return [
        "  char message[512];",
        f"  snprintf(message, sizeof message, {c_text(parts)}{values});",
        f"  {report}(v, message);",
    ]
