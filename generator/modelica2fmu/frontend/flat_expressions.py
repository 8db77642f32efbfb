"""Reads the expressions of rumoca's flattened form (JSON, version 0.10)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import SourceMap, Span

# Expression trees of a sound model are shallow; deeper ones are an attack or a generator gone wrong.
_DEPTH_LIMIT: Final = 400

_BUILTIN_NAMES: Final = {
    "NoEvent": "noEvent", "OuterProduct": "outerProduct", "SemiLinear": "semiLinear",
}  # fmt: skip


class ExpressionReader:
    """Reads expressions; one method a kind of them."""

    def __init__(self, source_map: SourceMap) -> None:
        self._source_map = source_map
        self._depth = 0
        self._expression_readers: dict[str, Callable[[Any, Span | None], ir.Expression]] = {
            "Literal": self._literal,
            "VarRef": self._reference,
            "Binary": self._binary,
            "Unary": self._unary,
            "BuiltinCall": self._builtin,
            "FunctionCall": self._call,
            "If": self._if,
            "Array": self._array,
            "Tuple": self._tuple,
            "Range": self._range,
            "Index": self._index,
            "FieldAccess": self._field,
            "ArrayComprehension": self._comprehension,
            "StringConversion": self._string_conversion,
        }

    def unsupported(self, construct: str, span: Span | None) -> UnsupportedModelError:
        """The error for a construct that has no place in the typed form."""
        return UnsupportedModelError(
            f"{construct} is not translated",
            place=self._source_map.place(span),
            remedy="see docs/fmu-builder.md for the constructs that are, and rewrite the model with those",
        )

    def optional(self, item: Any) -> ir.Expression | None:
        """The expression, if there is one."""
        return None if item is None else self.expression(item)

    def expression(self, item: Any) -> ir.Expression:
        """An expression of any kind; raises UnsupportedModelError."""
        tag, body = only(item) if isinstance(item, dict) else (str(item), None)
        span = self.span(body) if isinstance(body, dict) else None
        reader = self._expression_readers.get(tag)
        if reader is None:
            raise self.unsupported(f"an expression of kind {tag}", span)
        self._depth += 1
        if self._depth > _DEPTH_LIMIT:
            raise self.unsupported(f"an expression nested deeper than {_DEPTH_LIMIT}", span)
        result = reader(body, span)
        self._depth -= 1
        return result

    def _literal(self, body: Any, span: Span | None) -> ir.Expression:
        _, value = only(body["value"])
        return ir.Literal(value, span)

    def _reference(self, body: Any, span: Span | None) -> ir.Reference:
        subscripts = tuple(self.subscript(subscript) for subscript in body["subscripts"])
        name = body["name"]
        if isinstance(name, str):
            return ir.Reference(name, plain_parts(name), subscripts, span)
        reference = name.get("component_ref")
        parts = plain_parts(name["name"]) if reference is None else self._parts(reference)
        return ir.Reference(name["name"], parts, subscripts, span)

    def _parts(self, item: Any) -> tuple[tuple[str, tuple[ir.Subscript, ...]], ...]:
        return tuple(
            (part["ident"], tuple(self.subscript(subscript) for subscript in part["subs"])) for part in item["parts"]
        )

    def component(self, item: dict[str, Any]) -> ir.Reference:
        """A component reference of a statement; the last part's subscripts become trailing ones."""
        parts = self._parts(item)
        subscripts = parts[-1][1]
        parts = (*parts[:-1], (parts[-1][0], ()))
        return ir.Reference(_joined(parts), parts, subscripts, span_of(item.get("span")))

    def subscript(self, item: Any) -> ir.Subscript:
        """A subscript: a colon, a number or an expression."""
        tag, body = only(item) if isinstance(item, dict) else (str(item), {})
        if tag == "Colon":
            return ir.Colon()
        if tag == "Index":
            value = body["value"] if isinstance(body, dict) else body
            return ir.Literal(int(value))
        if tag == "Expr":
            return self.expression(body.get("expr", body))
        raise self.unsupported(f"a subscript of kind {tag}", None)

    def _binary(self, body: Any, span: Span | None) -> ir.Expression:
        return ir.Binary(tag_of(body["op"]), self.expression(body["lhs"]), self.expression(body["rhs"]), span)

    def _unary(self, body: Any, span: Span | None) -> ir.Expression:
        return ir.Unary(tag_of(body["op"]), self.expression(body["rhs"]), span)

    def _builtin(self, body: Any, span: Span | None) -> ir.Expression:
        name = body["function"]
        name = _BUILTIN_NAMES.get(name, name[0].lower() + name[1:])
        return ir.Builtin(name, tuple(self.expression(arg) for arg in body["args"]), span)

    def _call(self, body: Any, span: Span | None) -> ir.Expression:
        args = tuple(self.expression(arg) for arg in body["args"])
        return ir.Call(name_of(body["name"]), args, bool(body["is_constructor"]), span)

    def _if(self, body: Any, span: Span | None) -> ir.Expression:
        branches = tuple((self.expression(condition), self.expression(value)) for condition, value in body["branches"])
        return ir.If(branches, self.expression(body["else_branch"]), span)

    def _array(self, body: Any, span: Span | None) -> ir.Expression:
        kind = ir.Concatenation[tag_of(body["kind"]).upper()]
        return ir.ArrayConstructor(tuple(self.expression(item) for item in body["elements"]), kind, span)

    def _tuple(self, body: Any, span: Span | None) -> ir.Expression:
        elements = tuple(
            None if item == "Empty" or (isinstance(item, dict) and "Empty" in item) else self.expression(item)
            for item in body["elements"]
        )
        return ir.TupleExpression(elements, span)

    def _range(self, body: Any, span: Span | None) -> ir.Expression:
        return ir.Range(self.expression(body["start"]), self.optional(body["step"]), self.expression(body["end"]), span)

    def _index(self, body: Any, span: Span | None) -> ir.Expression:
        subscripts = tuple(self.subscript(subscript) for subscript in body["subscripts"])
        return ir.Indexed(self.expression(body["base"]), subscripts, span)

    def _field(self, body: Any, span: Span | None) -> ir.Expression:
        base = self.expression(body["base"])
        owner = as_reference(base)
        if owner is None:
            return ir.FieldAccess(base, body["field"], span)
        # o[i].x may be a member of a component, which is no value of its own.
        parts = (*owner.parts[:-1], (owner.parts[-1][0], owner.subscripts), (body["field"], ()))
        return ir.Reference(f"{owner.name}{_shown(owner.subscripts)}.{body['field']}", parts, (), span)

    def _comprehension(self, body: Any, span: Span | None) -> ir.Expression:
        if body.get("filter"):
            raise self.unsupported("an array constructor with a filter", span)
        indices = tuple((index["name"], self.expression(index["range"])) for index in body["indices"])
        return ir.Comprehension(self.expression(body["expr"]), indices, span)

    def _string_conversion(self, body: Any, span: Span | None) -> ir.Expression:
        tag, options = only(body["format"]) if isinstance(body["format"], dict) else (str(body["format"]), {})
        if tag != "Options":
            raise self.unsupported("String() with a C format", span)
        return ir.StringConversion(
            self.expression(body["value"]),
            self.optional(options.get("significant_digits")),
            self.optional(options.get("minimum_length")),
            self.optional(options.get("left_justified")),
            span,
        )

    @staticmethod
    def span(body: dict[str, Any]) -> Span | None:
        """Where a thing with a span stands."""
        return span_of(body.get("span"))


def span_of(item: Any) -> Span | None:
    """Where something stands, if that is known."""
    return Span(item["source"], item["start"], item["end"]) if isinstance(item, dict) else None


def only(item: dict[str, Any]) -> tuple[str, Any]:
    """Tag and body of an externally tagged enumeration."""
    ((tag, body),) = item.items()
    return tag, body


def tag_of(item: Any) -> str:
    """Tag of an externally tagged enumeration."""
    return item if isinstance(item, str) else next(iter(item))


def name_of(item: Any) -> str:
    """A name, given as it is or in a record."""
    return item if isinstance(item, str) else item["name"]


def plain_parts(name: str) -> tuple[tuple[str, tuple[ir.Subscript, ...]], ...]:
    """A name as a single part of a component reference."""
    return ((name, ()),)


def as_reference(expression: ir.Expression) -> ir.Reference | None:
    """``o[i]`` as one reference with trailing subscripts; None for anything else."""
    if isinstance(expression, ir.Indexed) and isinstance(expression.base, ir.Reference):
        base = expression.base
        if not base.subscripts:
            return ir.Reference(base.name, base.parts, expression.subscripts, expression.span)
    is_plain = isinstance(expression, ir.Reference) and not expression.parts[-1][1]
    return expression if is_plain and isinstance(expression, ir.Reference) else None


def _shown(subscripts: Sequence[ir.Subscript]) -> str:
    """Subscripts in a name for messages."""
    texts = [
        str(item.value) if isinstance(item, ir.Literal) else item.name if isinstance(item, ir.Reference) else "..."
        for item in subscripts
    ]
    return f"[{','.join(texts)}]" if texts else ""


def _joined(parts: Sequence[tuple[str, tuple[ir.Subscript, ...]]]) -> str:
    """Dotted name with constant inner subscripts."""
    pieces = []
    for identifier, subscripts in parts:
        if subscripts and all(isinstance(subscript, ir.Literal) for subscript in subscripts):
            numbers = ",".join(str(subscript.value) for subscript in subscripts if isinstance(subscript, ir.Literal))
            pieces.append(f"{identifier}[{numbers}]")
        else:
            pieces.append(identifier)
    return ".".join(pieces)
