"""C text of numbers, texts and operations."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Final

_CALLS: Final = {
    "abs": "fabs", "sqrt": "sqrt", "sin": "sin", "cos": "cos", "tan": "tan", "asin": "asin", "acos": "acos",
    "atan": "atan", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "exp": "exp", "log": "log", "log10": "log10",
    "floor": "floor", "ceil": "ceil", "sign": "fmurt_sign", "pow": "pow", "atan2": "atan2", "min": "fmurt_min",
    "max": "fmurt_max", "mod": "fmurt_mod", "rem": "fmurt_rem", "quotient": "fmurt_quotient",
}  # fmt: skip
_INFIX: Final = {
    "add": "+", "sub": "-", "mul": "*", "div": "/", "lt": "<", "le": "<=", "eq": "==", "ne": "!=", "and": "&&",
    "or": "||",
}  # fmt: skip

_ARITHMETIC: Final = frozenset({"add", "sub", "mul", "div", "neg"})
# Places of Integers (symbol_places), of which C's quotient would be a whole number.
_WHOLE: Final = re.compile(r"(?:i|v->pre_integer)\[")


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


def operation(op: str, args: Sequence[str]) -> str:
    """C text of an operation on numbers; ``select`` and infix operators in parentheses."""
    if op in _ARITHMETIC:
        args = [_real(arg) for arg in args]
    elif op == "select":
        args = [args[0], *(_real(arg) for arg in args[1:])]
    infix = _INFIX.get(op)
    if infix is not None:
        return f"({args[0]} {infix} {args[1]})"
    if op == "neg":
        return f"(-{args[0]})"
    if op == "not":
        return f"(!{args[0]})"
    if op == "select":
        return f"({args[0]} ? {args[1]} : {args[2]})"
    return f"{_CALLS[op]}({', '.join(args)})"


def _real(text: str) -> str:
    """The text of an operand as a double."""
    return f"(double){text}" if _WHOLE.match(text) else text
