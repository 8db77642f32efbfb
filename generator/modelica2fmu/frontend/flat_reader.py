"""Turns rumoca's flattened form of a model into the typed one of :mod:`modelica2fmu.frontend.ir`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from modelica2fmu.frontend import ir
from modelica2fmu.frontend.flat_expressions import ExpressionReader, name_of, only, plain_parts, span_of, tag_of
from modelica2fmu.library.source_map import SourceMap, Span


def read_flat_model(flat: dict[str, Any], name: str, source_map: SourceMap) -> ir.FlatModel:
    """The typed form of rumoca's flattened model; raises UnsupportedModelError."""
    return _Reader(source_map).model(flat, name)


class _Reader(ExpressionReader):
    """Reads a model, its equations, functions and statements; one method a kind of thing."""

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
        variability = tag_of(item["variability"]).lower()
        causality = tag_of(item["causality"]).lower()
        fixed = item["fixed"]
        start = self.optional(item["start"])
        binding = self.optional(item["binding"])
        return ir.Variable(
            name=name,
            type=type_name,
            shape=tuple(item["dims"]),
            variability="continuous" if variability == "empty" else variability,
            causality=causality if causality in ("input", "output") else "",
            binding=binding,
            start=start,
            fixed=None if fixed is None else tuple(bool(flag) for flag in fixed),
            minimum=self.optional(item["min"]),
            maximum=self.optional(item["max"]),
            nominal=self.optional(item["nominal"]),
            unit=item["unit"] or "",
            display_unit=item["display_unit"] or "",
            quantity=item["quantity"] or "",
            description=item["description"] or "",
            state_select=ir.StateSelect[item["state_select"].upper()],
            evaluate=bool(item["evaluate"]) or (is_final and variability == "parameter"),
            is_protected=bool(item["is_protected"]),
            span=span_of(item["source_span"]),
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
        tag, body = only(item)
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

    def _target(self, item: Any, span: Span | None) -> ir.Reference:
        """The target of a when-equation: a name, subscripts included, or a component reference."""
        if isinstance(item, dict):
            if "parts" in item:
                return self.component(item)
            if "name" in item:
                item = item["name"]
            else:
                read = self.expression(item)
                if isinstance(read, ir.Reference):
                    return read
                raise self.unsupported("this target of an assignment", span)
        return ir.Reference(item, plain_parts(item), (), span)

    def _algorithm(self, item: dict[str, Any]) -> ir.Algorithm:
        outputs = dict.fromkeys(name_of(output) for output in item["outputs"])
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
            span=self.span(item),
        )

    def _function_variable(self, item: dict[str, Any]) -> ir.FunctionVariable:
        return ir.FunctionVariable(
            name=item["name"],
            type=item["type_name"],
            shape=tuple(self.subscript(subscript) for subscript in item["shape_expr"]),
            default=self.optional(item["default"]),
            is_record=item["type_class"] == "Record",
            rank=max(len(item["shape_expr"]), len((item.get("effective_type") or {}).get("dimensions") or ())),
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
        tag, body = (item, {}) if isinstance(item, str) else only(item)
        span = self.span(body) if isinstance(body, dict) else None
        if tag == "Empty":
            return None
        if tag == "Spanned":
            return self._statement(body["statement"])
        if tag == "Assignment":
            return ir.Assignment(self.component(body["comp"]), self.expression(body["value"]), span)
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
            return ir.Reinit(self.component(body["variable"]), self.expression(body["value"]), span)
        if tag == "Assert":
            return self._assert(body, span)
        if tag == "Return":
            return ir.Return(span)
        if tag == "Break":
            return ir.Break(span)
        raise self.unsupported(f"a statement of kind {tag}", span)

    def _call_statement(self, body: dict[str, Any], span: Span | None) -> ir.Statement:
        name = name_of(body["comp"]) if "name" in body["comp"] else ".".join(p["ident"] for p in body["comp"]["parts"])
        args = tuple(self.expression(arg) for arg in body["args"])
        if name == "terminate":
            return ir.Terminate(args[0], span)
        targets: list[ir.Reference | None] = []
        for output in body["outputs"]:
            if output in (None, "Empty") or (isinstance(output, dict) and "Empty" in output):
                targets.append(None)
                continue
            target = self.component(output) if "parts" in output else self.expression(output)
            if not isinstance(target, ir.Reference):
                raise self.unsupported("this target of an assignment", span)
            targets.append(target)
        return ir.CallAssignment(tuple(targets), ir.Call(name, args, span=span), span)

    def _assert(self, body: dict[str, Any], span: Span | None) -> ir.Assert:
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
