"""Loads a model with rumoca and turns its flattened form into the typed one of :mod:`modelica2fmu.ir`."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from cmb_base.errors import BuildError, InputError, Place, UnsupportedModelError

from modelica2fmu import ir
from modelica2fmu.lone_files import LoneFiles, apart
from modelica2fmu.source_map import SourceMap

# Expression trees of a sound model are shallow; deeper ones are an attack or a generator gone wrong.
_DEPTH_LIMIT: Final = 400

# What a folder with the Modelica Standard Library holds.
_STANDARD_PACKAGES: Final = ("Modelica", "ModelicaServices", "Complex")

_BUILTIN_NAMES: Final = {
    "NoEvent": "noEvent", "OuterProduct": "outerProduct", "SemiLinear": "semiLinear",
}  # fmt: skip


def load_flat_model(model: str, file: Path, roots: Sequence[Path], source_map: SourceMap) -> ir.FlatModel:
    """Compiles ``model`` and returns its flattened form.

    Args:
        model: full Modelica name.
        file: the file that holds it; of the files beside it only those of its package structure are loaded.
        roots: library folders (those that contain packages) and single files that it uses.
        source_map: for the places in error messages.

    Raises:
        InputError: the model does not parse or compile.
        UnsupportedModelError: it uses something that has no place in the typed form.
        BuildError: rumoca is not installed.
    """
    try:
        import rumoca
    except ImportError as error:
        raise BuildError(
            "the Modelica front end rumoca is not installed", remedy="install it: pip install rumoca==0.10.2"
        ) from error
    # With a package and the folder around it among the roots, rumoca would see only the package.
    resolved = {root.resolve() for root in roots}
    roots = [root for root in roots if root.resolve().parent not in resolved]
    with apart(file, roots, source_map) as given:
        try:
            with _without_modelicapath():
                session = rumoca.Session([str(root) for root in given.roots])
                flat: dict[str, Any] = _compile(session, model, file, given).to_dict("flat")
        except rumoca.RumocaError as error:
            raise _input_error(rumoca, given.restored(str(error)), model, file) from error
        except BaseException as error:
            # A panic of rumoca derives from BaseException alone.
            if not isinstance(error, OSError | RuntimeError | ValueError) and type(error).__name__ != "PanicException":
                raise
            message = f"{model} cannot be compiled: {given.restored(str(error))}"
            raise InputError(message, place=Place(file=file)) from error
        return read_flat_model(flat, model, source_map)


def _compile(session: Any, model: str, file: Path, given: LoneFiles) -> Any:
    """Loads ``file`` and compiles ``model``.

    rumoca loads only libraries that the loaded text names, not those that they name in turn. A model in a file of its
    own is therefore followed by a class that names them all; places in the text stay as they are. A model of a library
    among the roots needs that class alone.
    """
    roots = given.roots
    is_package = file.name == "package.mo"
    is_library = is_package and file.parent.parent.resolve() in {root.resolve() for root in roots}
    if is_package and not is_library:
        return session.load(str(file), model=model)
    packages = [root.name for root in roots if (root / "package.mo").is_file()]
    packages += [
        name
        for root in roots
        for name in _STANDARD_PACKAGES
        if (root / name / "package.mo").is_file() or (root / f"{name}.mo").is_file()
    ]
    imports = "".join(f"  import {package};\n" for package in dict.fromkeys(packages))
    text = "" if is_library else file.read_text(encoding="utf-8")
    return session.loads(
        f"{text}\nclass 'cmb libraries'\n{imports}end 'cmb libraries';\n",
        model=model,
        filename="libraries.mo" if is_library else str(given.file),
    )


@contextmanager
def _without_modelicapath() -> Iterator[None]:
    """Hides MODELICAPATH from rumoca, which would prefer a library there to the one that was chosen."""
    path = os.environ.pop("MODELICAPATH", None)
    try:
        yield
    finally:
        if path is not None:
            os.environ["MODELICAPATH"] = path


def _input_error(rumoca: Any, message: str, model: str, file: Path) -> InputError:
    """The front end's message with the best place that can be found for it."""
    place = Place(file=file, component=model)
    try:
        diagnostics = rumoca.validate(str(file), model=model)
    except Exception:  # the message at hand must not be lost to a second failure
        diagnostics = []
    text = "\n".join(str(diagnostic.message) for diagnostic in diagnostics) + "\n" + message
    located = re.search(r"\[([^\[\]\s]+\.mo):(\d+):\d+\]", text)
    if located:
        place = Place(file=Path(located[1]), line=int(located[2]), component=model)
    else:
        line = _line_of_quoted_name(message, file)
        if line is not None:
            place = Place(file=file, line=line, component=model)
    first = message.strip().split("\nRelated failures")[0]
    return InputError(first or "the model cannot be compiled", place=place)


def _line_of_quoted_name(message: str, file: Path) -> int | None:
    """Line of the first mention of a name that the message quotes, where it gives no place itself."""
    quoted = re.search(r"['`]([A-Za-z_][\w.]*)['`]", message)
    if quoted is None or not file.is_file():
        return None
    pattern = re.compile(rf"(?<![\w.]){re.escape(quoted[1])}(?!\w)")
    for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), start=1):
        if pattern.search(line):
            return number
    return None


def read_flat_model(flat: dict[str, Any], name: str, source_map: SourceMap) -> ir.FlatModel:
    """The typed form of rumoca's flattened model; raises UnsupportedModelError."""
    return _Reader(source_map).model(flat, name)


class _Reader:
    """Reads rumoca's JSON (0.10); one method a kind of thing."""

    def __init__(self, source_map: SourceMap) -> None:
        self._source_map = source_map
        self._depth = 0
        self._expression_readers: dict[str, Callable[[Any, ir.Span | None], ir.Expression]] = {
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

    def unsupported(self, construct: str, span: ir.Span | None) -> UnsupportedModelError:
        return UnsupportedModelError(
            f"{construct} is not translated",
            place=self._source_map.place(span),
            remedy="see docs/fmu-builder.md for the constructs that are, and rewrite the model with those",
        )

    # --- model ---

    def model(self, flat: dict[str, Any], name: str) -> ir.FlatModel:
        record_types = {
            number: ir.RecordType(record["name"], tuple(field["name"] for field in record["fields"]))
            for number, record in flat["record_types"].items()
        }
        records = {}
        orientations = set()
        for component, instance in flat["record_instances"].items():
            record = record_types.get(str(instance["type_def_id"]))
            if record is not None and not instance["dims"]:
                records[component] = record
                if record.name.endswith("MultiBody.Frames.Orientation"):
                    orientations.add(component)
        top_level = set(flat["top_level_input_components"]) | set(flat["top_level_connectors"])
        variables = {}
        for key, variable in flat["variables"].items():
            is_final = bool(flat["variable_final_flags"].get(key))
            read = self._variable(key, variable, flat["variable_type_names"].get(key, "Real"), is_final)
            head = re.split(r"[.\[]", key, maxsplit=1)[0]
            owner = key.rsplit(".", 1)[0]
            variables[key] = replace(
                read,
                is_top_level="." not in key or head in top_level,
                orientation=owner if owner in orientations else None,
            )
        return ir.FlatModel(
            name=name,
            description=flat.get("model_description") or "",
            variables=variables,
            records=records,
            equations=tuple(self._equation(equation) for equation in flat["equations"]),
            initial_equations=tuple(self._equation(equation) for equation in flat["initial_equations"]),
            asserts=tuple(self._assert(item, self.span(item)) for item in flat["assert_equations"]),
            initial_asserts=tuple(self._assert(item, self.span(item)) for item in flat["initial_assert_equations"]),
            whens=tuple(self._when(chain) for chain in flat["when_chains"]),
            algorithms=tuple(self._algorithm(item) for item in flat["algorithms"]),
            initial_algorithms=tuple(self._algorithm(item) for item in flat["initial_algorithms"]),
            functions={key: self._function(key, item) for key, item in flat["functions"].items()},
            enumeration_literals=dict(flat["enum_literal_ordinals"]),
            record_types={record.name: record for record in record_types.values()},
        )

    def _variable(self, name: str, item: dict[str, Any], type_name: str, is_final: bool) -> ir.Variable:
        variability = _tag(item["variability"]).lower()
        causality = _tag(item["causality"]).lower()
        fixed = item["fixed"]
        start = self._optional(item["start"])
        binding = self._optional(item["binding"])
        return ir.Variable(
            name=name,
            type=type_name,
            shape=tuple(item["dims"]),
            variability="continuous" if variability == "empty" else variability,
            causality=causality if causality in ("input", "output") else "",
            binding=binding,
            start=start,
            fixed=None if fixed is None else tuple(bool(flag) for flag in fixed),
            minimum=self._optional(item["min"]),
            maximum=self._optional(item["max"]),
            nominal=self._optional(item["nominal"]),
            unit=item["unit"] or "",
            display_unit=item["display_unit"] or "",
            quantity=item["quantity"] or "",
            description=item["description"] or "",
            state_select=ir.StateSelect[item["state_select"].upper()],
            evaluate=bool(item["evaluate"]) or (is_final and variability == "parameter"),
            is_protected=bool(item["is_protected"]),
            span=_span(item["source_span"]),
        )

    def _equation(self, item: dict[str, Any]) -> ir.Equation:
        return ir.Equation(self.expression(item["residual"]), self.span(item))

    def _when(self, chain: dict[str, Any]) -> ir.When:
        branches = []
        for branch in [chain["first"], *chain["else_when"]]:
            body = tuple(self._when_equation(equation) for equation in branch["equations"])
            branches.append(ir.WhenBranch(self.expression(branch["condition"]), body))
        return ir.When(tuple(branches), self.span(chain))

    def _when_equation(self, item: dict[str, Any]) -> ir.Statement:
        tag, body = _only(item)
        span = self.span(body)
        if tag == "Assign":
            return ir.Assignment(self._target(body["target"], span), self.expression(body["value"]), span)
        if tag == "Reinit":
            return ir.Reinit(self._target(body["state"], span), self.expression(body["value"]), span)
        if tag == "Assert":
            return self._assert(body, span)
        if tag == "Terminate":
            return ir.Terminate(self._message(body["message"]), span)
        if tag == "Conditional":
            branches = tuple(
                (self.expression(condition), tuple(self._when_equation(equation) for equation in equations))
                for condition, equations in body["branches"]
            )
            otherwise = tuple(self._when_equation(equation) for equation in body["else_branch"] or [])
            return ir.IfStatement(branches, otherwise, span)
        if tag == "FunctionCallOutputs":
            call = self.expression(body["function"])
            if isinstance(call, ir.Call):
                targets = tuple(self._target(output, span) for output in body["outputs"])
                return ir.CallAssignment(targets, call, span)
        raise self.unsupported(f"a when-equation of kind {tag}", span)

    def _target(self, item: Any, span: ir.Span | None) -> ir.Reference:
        """The target of a when-equation: a name, subscripts included, or a component reference."""
        if isinstance(item, dict):
            if "parts" in item:
                return self._component(item)
            if "name" in item:
                item = item["name"]
            else:
                read = self.expression(item)
                if isinstance(read, ir.Reference):
                    return read
                raise self.unsupported("this target of an assignment", span)
        return ir.Reference(item, _plain_parts(item), (), span)

    def _algorithm(self, item: dict[str, Any]) -> ir.Algorithm:
        outputs = dict.fromkeys(_name(output) for output in item["outputs"])
        return ir.Algorithm(self._statements(item["statements"]), tuple(outputs), self.span(item))

    # --- functions and statements ---

    def _function(self, name: str, item: dict[str, Any]) -> ir.Function:
        external = item["external"]
        return ir.Function(
            name=name,
            inputs=tuple(self._function_variable(variable) for variable in item["inputs"]),
            outputs=tuple(self._function_variable(variable) for variable in item["outputs"]),
            locals=tuple(self._function_variable(variable) for variable in item["locals"]),
            body=self._statements(item["body"]),
            external=None if external is None else self._external(name, external),
            is_constructor=bool(item["is_constructor"]),
            is_pure=bool(item["pure"]),
            span=self.span(item),
        )

    def _function_variable(self, item: dict[str, Any]) -> ir.FunctionVariable:
        return ir.FunctionVariable(
            name=item["name"],
            type=item["type_name"],
            shape=tuple(self._subscript(subscript) for subscript in item["shape_expr"]),
            default=self._optional(item["default"]),
            is_record=item["type_class"] == "Record",
        )

    def _external(self, name: str, item: dict[str, Any]) -> ir.External:
        annotations: list[tuple[str, tuple[str, ...]]] = []
        for annotation in item.get("annotations") or []:
            value = self.expression(annotation["value"])
            texts = value.elements if isinstance(value, ir.ArrayConstructor) else (value,)
            if all(isinstance(text, ir.Literal) and isinstance(text.value, str) for text in texts):
                strings = tuple(str(text.value) for text in texts if isinstance(text, ir.Literal))
                annotations.append((".".join(annotation["name"]), strings))
        return ir.External(
            language=item["language"] or "C",
            name=item["function_name"] or name.rsplit(".", 1)[-1],
            result=item["output_name"],
            args=tuple(self.expression(arg) for arg in item["args"]),
            annotations=tuple(annotations),
        )

    def _statements(self, items: Sequence[Any]) -> tuple[ir.Statement, ...]:
        return tuple(statement for item in items if (statement := self._statement(item)) is not None)

    def _statement(self, item: Any) -> ir.Statement | None:
        tag, body = (item, {}) if isinstance(item, str) else _only(item)
        span = self.span(body) if isinstance(body, dict) else None
        if tag == "Empty":
            return None
        if tag == "Spanned":
            return self._statement(body["statement"])
        if tag == "Assignment":
            return ir.Assignment(self._component(body["comp"]), self.expression(body["value"]), span)
        if tag == "For":
            indices = tuple((index["ident"], self.expression(index["range"])) for index in body["indices"])
            return ir.For(indices, self._statements(body["equations"]), span)
        if tag == "While":
            block = body.get("block", body)
            return ir.While(self.expression(block["cond"]), self._statements(block["stmts"]), span)
        if tag == "If":
            branches = tuple(
                (self.expression(block["cond"]), self._statements(block["stmts"])) for block in body["cond_blocks"]
            )
            return ir.IfStatement(branches, self._statements(body["else_block"] or []), span)
        if tag == "When":
            blocks = body["blocks"] if isinstance(body, dict) else body
            return ir.WhenStatement(
                tuple((self.expression(block["cond"]), self._statements(block["stmts"])) for block in blocks), span
            )
        if tag == "FunctionCall":
            return self._call_statement(body, span)
        if tag == "Reinit":
            return ir.Reinit(self._component(body["variable"]), self.expression(body["value"]), span)
        if tag == "Assert":
            return self._assert(body, span)
        if tag == "Return":
            return ir.Return(span)
        if tag == "Break":
            return ir.Break(span)
        raise self.unsupported(f"a statement of kind {tag}", span)

    def _call_statement(self, body: dict[str, Any], span: ir.Span | None) -> ir.Statement:
        name = _name(body["comp"]) if "name" in body["comp"] else ".".join(p["ident"] for p in body["comp"]["parts"])
        args = tuple(self.expression(arg) for arg in body["args"])
        if name == "terminate":
            return ir.Terminate(args[0], span)
        targets: list[ir.Reference | None] = []
        for output in body["outputs"]:
            if output in (None, "Empty") or (isinstance(output, dict) and "Empty" in output):
                targets.append(None)
                continue
            target = self._component(output) if "parts" in output else self.expression(output)
            if not isinstance(target, ir.Reference):
                raise self.unsupported("this target of an assignment", span)
            targets.append(target)
        return ir.CallAssignment(tuple(targets), ir.Call(name, args, span=span), span)

    def _assert(self, body: dict[str, Any], span: ir.Span | None) -> ir.Assert:
        level = body.get("level")
        is_warning = False
        if level is not None:
            read = self.expression(level)
            is_warning = (isinstance(read, ir.Literal) and read.value == 1) or (
                isinstance(read, ir.Reference) and read.name.endswith("warning")
            )
        return ir.Assert(self.expression(body["condition"]), self._message(body["message"]), is_warning, span)

    def _message(self, item: Any) -> ir.Expression:
        return ir.Literal(item) if isinstance(item, str) else self.expression(item)

    # --- expressions ---

    def _optional(self, item: Any) -> ir.Expression | None:
        return None if item is None else self.expression(item)

    def expression(self, item: Any) -> ir.Expression:
        tag, body = _only(item) if isinstance(item, dict) else (str(item), None)
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

    def _literal(self, body: Any, span: ir.Span | None) -> ir.Expression:
        _, value = _only(body["value"])
        return ir.Literal(value, span)

    def _reference(self, body: Any, span: ir.Span | None) -> ir.Reference:
        subscripts = tuple(self._subscript(subscript) for subscript in body["subscripts"])
        name = body["name"]
        if isinstance(name, str):
            return ir.Reference(name, _plain_parts(name), subscripts, span)
        reference = name.get("component_ref")
        parts = _plain_parts(name["name"]) if reference is None else self._parts(reference)
        return ir.Reference(name["name"], parts, subscripts, span)

    def _parts(self, item: Any) -> tuple[tuple[str, tuple[ir.Subscript, ...]], ...]:
        return tuple(
            (part["ident"], tuple(self._subscript(subscript) for subscript in part["subs"])) for part in item["parts"]
        )

    def _component(self, item: dict[str, Any]) -> ir.Reference:
        """A component reference of a statement; the last part's subscripts become trailing ones."""
        parts = self._parts(item)
        subscripts = parts[-1][1]
        parts = (*parts[:-1], (parts[-1][0], ()))
        return ir.Reference(_joined(parts), parts, subscripts, _span(item.get("span")))

    def _subscript(self, item: Any) -> ir.Subscript:
        tag, body = _only(item) if isinstance(item, dict) else (str(item), {})
        if tag == "Colon":
            return ir.Colon()
        if tag == "Index":
            value = body["value"] if isinstance(body, dict) else body
            return ir.Literal(int(value))
        if tag == "Expr":
            return self.expression(body.get("expr", body))
        raise self.unsupported(f"a subscript of kind {tag}", None)

    def _binary(self, body: Any, span: ir.Span | None) -> ir.Expression:
        return ir.Binary(_tag(body["op"]), self.expression(body["lhs"]), self.expression(body["rhs"]), span)

    def _unary(self, body: Any, span: ir.Span | None) -> ir.Expression:
        return ir.Unary(_tag(body["op"]), self.expression(body["rhs"]), span)

    def _builtin(self, body: Any, span: ir.Span | None) -> ir.Expression:
        name = body["function"]
        name = _BUILTIN_NAMES.get(name, name[0].lower() + name[1:])
        return ir.Builtin(name, tuple(self.expression(arg) for arg in body["args"]), span)

    def _call(self, body: Any, span: ir.Span | None) -> ir.Expression:
        args = tuple(self.expression(arg) for arg in body["args"])
        return ir.Call(_name(body["name"]), args, bool(body["is_constructor"]), span)

    def _if(self, body: Any, span: ir.Span | None) -> ir.Expression:
        branches = tuple((self.expression(condition), self.expression(value)) for condition, value in body["branches"])
        return ir.If(branches, self.expression(body["else_branch"]), span)

    def _array(self, body: Any, span: ir.Span | None) -> ir.Expression:
        kind = ir.Concatenation[_tag(body["kind"]).upper()]
        return ir.ArrayConstructor(tuple(self.expression(item) for item in body["elements"]), kind, span)

    def _tuple(self, body: Any, span: ir.Span | None) -> ir.Expression:
        elements = tuple(
            None if item == "Empty" or (isinstance(item, dict) and "Empty" in item) else self.expression(item)
            for item in body["elements"]
        )
        return ir.TupleExpression(elements, span)

    def _range(self, body: Any, span: ir.Span | None) -> ir.Expression:
        return ir.Range(
            self.expression(body["start"]), self._optional(body["step"]), self.expression(body["end"]), span
        )

    def _index(self, body: Any, span: ir.Span | None) -> ir.Expression:
        subscripts = tuple(self._subscript(subscript) for subscript in body["subscripts"])
        return ir.Indexed(self.expression(body["base"]), subscripts, span)

    def _field(self, body: Any, span: ir.Span | None) -> ir.Expression:
        return ir.FieldAccess(self.expression(body["base"]), body["field"], span)

    def _comprehension(self, body: Any, span: ir.Span | None) -> ir.Expression:
        if body.get("filter"):
            raise self.unsupported("an array constructor with a filter", span)
        indices = tuple((index["name"], self.expression(index["range"])) for index in body["indices"])
        return ir.Comprehension(self.expression(body["expr"]), indices, span)

    def _string_conversion(self, body: Any, span: ir.Span | None) -> ir.Expression:
        tag, options = _only(body["format"]) if isinstance(body["format"], dict) else (str(body["format"]), {})
        if tag != "Options":
            raise self.unsupported("String() with a C format", span)
        return ir.StringConversion(
            self.expression(body["value"]),
            self._optional(options.get("significant_digits")),
            self._optional(options.get("minimum_length")),
            self._optional(options.get("left_justified")),
            span,
        )

    @staticmethod
    def span(body: dict[str, Any]) -> ir.Span | None:
        return _span(body.get("span"))


def _span(item: Any) -> ir.Span | None:
    return ir.Span(item["source"], item["start"], item["end"]) if isinstance(item, dict) else None


def _only(item: dict[str, Any]) -> tuple[str, Any]:
    """Tag and body of an externally tagged enumeration."""
    ((tag, body),) = item.items()
    return tag, body


def _tag(item: Any) -> str:
    return item if isinstance(item, str) else next(iter(item))


def _name(item: Any) -> str:
    return item if isinstance(item, str) else item["name"]


def _plain_parts(name: str) -> tuple[tuple[str, tuple[ir.Subscript, ...]], ...]:
    return ((name, ()),)


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
