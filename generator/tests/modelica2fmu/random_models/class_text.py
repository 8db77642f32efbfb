"""Modelica text of classes."""

from __future__ import annotations

from class_semantics import ClassDefinition, Declaration, Modifier


def class_text(definition: ClassDefinition, indent: str = "") -> str:
    inside = f"{indent}  "
    lines = [f"{indent}{definition.sort} {definition.name}"]
    lines += [f"{inside}extends {base}{_arguments(modifier)};" for base, modifier in definition.bases]
    for each in definition.declarations:
        if each.definition is not None:
            lines.append(class_text(each.definition, inside).rstrip("\n"))
        else:
            lines.append(f"{inside}{_declaration(each)};")
    return "\n".join([*lines, f"{indent}end {definition.name};\n"])


def _declaration(declared: Declaration) -> str:
    prefix = "redeclare " if declared.is_redeclaration else "replaceable " if declared.is_replaceable else ""
    modified = _arguments(declared.modifier)
    if declared.kind == "class":
        return f"{prefix}{declared.sort} {declared.name} = {declared.type_name}{modified}"
    if declared.kind == "component":
        size = f"[{declared.size}]" if declared.size else ""
        condition = " if false" if declared.is_absent else ""
        clause = ""
        if declared.constraint:
            clause = f" constrainedby {declared.constraint[0]}{_arguments(declared.constraint[1])}"
        scope = f"{declared.scope_prefix} " if declared.scope_prefix else ""
        return f"{scope}{prefix}{declared.type_name} {declared.name}{size}{modified}{condition}{clause}"
    kind = "" if declared.kind == "variable" else f"{declared.kind} "
    return f"{kind}Real {declared.name}{_value(declared.modifier)}"


def _arguments(modifier: Modifier) -> str:
    parts = [_argument(name, child) for name, child in modifier.children]
    return f"({', '.join(parts)})" if parts else ""


def _argument(name: str, child: Modifier) -> str:
    if child.redeclared and name.isupper():
        return f"redeclare model {name} = {child.redeclared}{_arguments(child)}"
    if child.redeclared:
        return f"redeclare {child.redeclared} {name}{_arguments(child)}"
    return f"{'each ' if child.is_each else ''}{name}{_arguments(child)}{_value(child)}"


def _value(modifier: Modifier) -> str:
    if not modifier.values:
        return ""
    texts = [each.text for each in modifier.values]
    return f" = {texts[0]}" if len(texts) == 1 else f" = {{{', '.join(texts)}}}"
