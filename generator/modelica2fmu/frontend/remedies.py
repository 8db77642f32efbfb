"""What to write in place of legal constructs that the front end does not take, by its words about them."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from contact_foundation.errors import InputError

from modelica2fmu.crosscheck.component_sizes import SIZE_OF_COMPONENTS
from modelica2fmu.frontend.source_lines import line_of


class _Known(NamedTuple):
    """A refusal of rumoca 0.10.

    Attributes:
        words: its own.
        message: in place of them, with groups of ``words``.
        remedy: what to write, with groups of ``words``.
        mentions: finds the line where the message has none that can be relied on.
    """

    words: re.Pattern[str]
    message: str
    remedy: str
    mentions: re.Pattern[str] | None = None


_FUNCTION: Final = "put the loop into a function and call that: y = f(x)"
_ELEMENT: Final = (
    "take the whole array, v = {{1, pre(v[2])}} or reinit(v, {{1, v[2]}}); or declare the variable and its when-clause"
    " in a model Part, and Part part[n]"
)
_SHOWN: Final = r"^(?:(?P<shown>.*): )?"  # the statement, where it is told

_KNOWN: Final = tuple(
    _Known(re.compile(_SHOWN + words, re.DOTALL), message, remedy, mentions)
    for words, message, remedy, mentions in (
        (
            r"der\(\.\.\.\) must have exactly one resolved variable-reference operand",
            "der of an expression is not taken, only of a variable",
            "give the expression a variable, Real e = ...; and write der(e)",
            None,
        ),
        (
            r"unsupported model algorithm in canonical DAE: (?:declarative algorithm requires scalar assignments and "
            r"conditionals|statement must be an assignment.*)",
            "a loop with such a body is not taken in an algorithm section of a model",
            _FUNCTION,
            None,
        ),
        (
            r"event-generating expressions are not allowed in while-statement.*",
            "a while-loop whose condition depends on variables is not taken in an algorithm section of a model",
            _FUNCTION,
            re.compile(r"\bwhile\b"),
        ),
        (
            r"unsupported model algorithm in canonical DAE: function-call output `\w+` is not a whole discrete .*",
            "a call with several outputs is not taken in an algorithm section",
            "write it as an equation: (y, z) = f(x)",
            None,
        ),
        (
            r"unsupported model algorithm in canonical DAE: sequential read of `(?P<name>\w+)`.*",
            "{name} is set in several when-statements of an algorithm, one of which reads it",
            "write one when-equation: when ... then {name} = ...; elsewhen ... then {name} = ...; end when;",
            None,
        ),
        (
            r"multi-output event calls require a checked function-action owner",
            "a call with several outputs is not taken in a when-equation",
            "write it in an algorithm section: when ... then (y, z) := f(x); end when;",
            None,
        ),
        (
            r"receiving variable `\w+` is not a coordinate owned by this continuous equation",
            "a record among several outputs of a function is not taken in an equation",
            "write a function for each output: r = f(x)",
            None,
        ),
        (
            r"a receiving tuple slot must receive one whole function result",
            "elements are not taken as targets of several outputs of a function",
            "give the outputs variables, (a, b) = f(x), and set the elements equal to these",
            None,
        ),
        (
            r"(?:variable identity \d+ is already owned by clock identity.*|duplicate condition clock owner key.*)",
            "several sample(...) that set the same variables are not taken",
            "take one sample at the interval that they share and count: k = pre(k) + 1; a = if mod(k, 2) == 1 then ..."
            " else ...",
            None,
        ),
        (
            r"unsupported equation form: for-equation range must be a constant range expression or parameter .*",
            "a loop over values that are no range of whole numbers is not taken",
            "give the values an array, constant E all[2] = {{E.a, E.b}}, and loop over its indices: for i in 1:2 loop"
            " ... all[i] ...",
            re.compile(r"\bfor\b[^;]*?\bin\s+(?!\s*[\w.+\-*/() ]+:)"),
        ),
        (
            r"expandable connector connection between `(?P<first>[^`]+)` and `(?P<second>[^`]+)` requires unsupported "
            r"member augmentation",
            "an expandable connector is connected as {first} and {second}, and does not declare that variable",
            "declare it there, without input or output, as in: expandable connector Bus Real speed; end Bus;",
            None,
        ),
        (
            r".*\ba table read from a file \(tableOnFile\) is unsupported",
            "the front end does not know the file of a table",
            'name it beside tableOnFile=true by a String, as in fileName="drive.txt", or write the rows, as in'
            " table=[0, 1; 10, 2], in place of both",
            re.compile(r"\btableOnFile\s*=\s*true\b"),
        ),
        (
            r"missing source context: .* for component binding type compatibility was not found",
            "a Boolean is given a number",
            "write true or false, or a relation",
            re.compile(r"\bBoolean\b[^;]*=\s*[-+.\d]"),
        ),
        (
            r"record-field `\w+` declaration \d+ requires its typed semantic owner",
            "the front end does not know how many elements an array of components has",
            SIZE_OF_COMPONENTS.replace("{", "{{").replace("}", "}}"),
            re.compile(r"\w\s*\[[^\]]*\bsize\s*\("),
        ),
        (
            r"unevaluable array dimensions for '(?P<name>[\w.]+)': .*FunctionCall \{ comp: (?P<function>[\w.]+).*",
            "the size of {name} depends on the function {function}, which the front end cannot evaluate",
            "give the size as a number, or as a parameter that no function computes",
            None,
        ),
        (
            r"unevaluable array dimensions for '(?P<name>[\w.]+)': .*",
            "the size of {name} cannot be evaluated",
            "give the size as a number, or as a parameter that no function with break, return or the like computes",
            None,
        ),
        (
            r"cannot evaluate structural parameter `connection range`.*",
            "a range in connect is not taken whose ends are no numbers or parameters",
            "write a number in place of end: connect(a.y[2:3], b.u)",
            re.compile(r"\bconnect\b[^;]*\bend\s*\]"),
        ),
        (
            r"`(?P<name>\w+\[[\d, ]+\])` is not a discrete coordinate",
            "a when-clause sets an element of an array, {name}",
            _ELEMENT,
            None,
        ),
        (
            r"reinit\(\) can only be applied to state variables: (?P<name>\w+\[[\d, ]+\]) is not a state.*",
            "reinit takes no element of an array, {name}",
            _ELEMENT,
            None,
        ),
        (
            r"(?P<name>\w+) cannot be evaluated: type mismatch: expected Real or Integer, got Array",
            "{name} has the sum or product of a matrix, which is not taken in parameters and constants",
            "write sum(sum(m[i, :]) for i in 1:size(m, 1))",
            None,
        ),
        (
            r"(?P<name>\w+) cannot be evaluated: type mismatch: expected numeric, got Array \^ Integer",
            "{name} has the power of a matrix, which is not taken in parameters and constants",
            "write m*m, or .^ for powers of the elements",
            None,
        ),
        (
            r"unsupported runtime operator `(?P<name>\w+)`: no checked canonical owner exists .*",
            "the operator {name} is not taken",
            "write a function for it: its result has loops over size(x, 1) and size(x, 2)",
            None,
        ),
        (
            r"delay\(\) (?P<which>.*) argument must have type `Real`, found `Integer`",
            "delay takes no Integer as its {which} argument",
            "write it as a Real: 1.0 in place of 1",
            None,
        ),
    )
)


def with_remedy(error: InputError, file: Path) -> InputError:
    """The same error in the user's words, with what to write, where it is one that is known; else as it is.

    Args:
        error: with the front end's words.
        file: that holds the model.
    """
    if error.remedy is not None:
        return error
    for known in _KNOWN:
        found = known.words.search(error.message)
        if found is None:
            continue
        groups = {name: text or "" for name, text in found.groupdict().items()}
        message = known.message.format(**groups) + (f": {groups['shown']}" if groups["shown"] else "")
        place = error.place
        line = line_of(known.mentions, file) if known.mentions is not None else None
        if place is not None and line is not None:
            place = replace(place, file=file, line=line)
        return InputError(message, place=place, remedy=known.remedy.format(**groups))
    return error
