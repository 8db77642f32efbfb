"""Reads the declarations of a Modelica file; expressions, equations and statements are passed over."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_sections import SectionReader
from modelica2fmu.crosscheck.class_syntax import (
    Base,
    ClassDefinition,
    ComponentDeclaration,
    Constraint,
    Extent,
    Import,
    Modifier,
)
from modelica2fmu.crosscheck.class_tokens import UnreadableError

_CLASS_KINDS: Final = frozenset(
    {"class", "model", "record", "block", "connector", "type", "package", "function", "operator"}
)
_CLASS_PREFIXES: Final = frozenset({"encapsulated", "partial", "pure", "impure", "expandable"})
_COMPONENT_PREFIXES: Final = frozenset({"flow", "stream", "discrete", "parameter", "constant", "input", "output"})
_ELEMENT_PREFIXES: Final = frozenset({"redeclare", "final", "inner", "outer", "replaceable"})
_DEEPEST: Final = 200


def parse(text: bytes, file: Path) -> dict[str, ClassDefinition]:
    """The classes of a file by their names; places are in bytes.

    Raises:
        UnreadableError: the text is not understood, or nested too deeply.
    """
    parser = _Parser(text.decode("latin-1"), file)
    try:
        return parser.file_classes()
    except (IndexError, RecursionError) as error:
        raise UnreadableError(f"{file} ends too early") from error


class _Parser(SectionReader):
    """Recursive descent; one method a production of the language's grammar (Modelica 3.6, appendix A)."""

    def __init__(self, text: str, file: Path) -> None:
        super().__init__(text, file)
        self._depth = 0
        self._in_modification = 0

    def file_classes(self) -> dict[str, ClassDefinition]:
        """stored-definition."""
        classes: dict[str, ClassDefinition] = {}
        if self.accept("within"):
            while not self.accept(";"):
                self.at += 1
        while self.at < len(self.tokens):
            self.accept("final")
            definition = self._class()
            classes[definition.name] = definition
            self.expect(";")
        return classes

    # --- classes ---

    def _is_class(self) -> bool:
        return self.text() in _CLASS_PREFIXES or self.text() in _CLASS_KINDS

    def _class(self) -> ClassDefinition:
        """class-definition, and the short ones of modifications."""
        self._depth += 1
        if self._depth > _DEEPEST:
            raise UnreadableError(f"{self.file}: classes or modifiers are nested too deeply")
        first = self.at
        prefixes = set()
        while self.text() in _CLASS_PREFIXES:
            prefixes.add(self.text())
            self.at += 1
        kind = self.text()
        if kind not in _CLASS_KINDS:
            raise UnreadableError(f"{self.file}: a class expected, {kind!r} found")
        while self.text() in _CLASS_KINDS:
            self.at += 1
        definition = ClassDefinition("", kind, self.extent(first))
        definition.is_encapsulated = "encapsulated" in prefixes
        definition.is_partial = "partial" in prefixes
        definition.extends_inherited = self.accept("extends")
        definition.name = self.identifier()
        if definition.extends_inherited:
            definition.bases.append(Base((definition.name,), self._modifiers(), self.extent(first)))
        if self.accept("="):
            self._short(definition)
        else:
            self._composition(definition)
        definition.extent = self.extent(first)
        self._depth -= 1
        return definition

    def _short(self, definition: ClassDefinition) -> None:
        definition.is_short = True
        if self.text() in ("enumeration", "der") and self.text(1) == "(":
            definition.is_enumeration = self.text() == "enumeration"
            self.at += 1
            self.skip_brackets()
        else:
            while self.text() in _COMPONENT_PREFIXES:
                self.at += 1
            first = self.at
            name = self.name()
            self.skip_subscripts()
            definition.bases.append(Base(name, self._modifiers(), self.extent(first)))
        self.skip_comment()

    def _composition(self, definition: ClassDefinition) -> None:
        while self.tokens[self.at].kind == "string" or self.text() == "+":
            self.at += 1
        while True:
            text = self.text()
            if text == "end" and self.text(1) == definition.name:
                self.at += 2
                return
            if text in ("public", "protected"):
                self.at += 1
            elif text in ("equation", "algorithm") or (text == "initial" and self.text(1) in ("equation", "algorithm")):
                self.section(definition)
            elif text == "external":
                definition.c_name = self.external() or definition.name
            elif text == "annotation":
                self.skip_comment()
                self.expect(";")
            else:
                first = self.at
                self._element(definition)
                definition.elements.append(self.extent(first))
                self.expect(";")

    # --- elements ---

    def _element(self, definition: ClassDefinition) -> None:
        """element, the semicolon excluded."""
        if self.accept("import"):
            definition.imports.extend(self._import())
        elif self.text() == "extends":
            first = self.at
            self.at += 1
            name = self.name()
            definition.bases.append(Base(name, self._modifiers(), self.extent(first)))
            self.skip_comment()
        else:
            for element in self._declarations():
                if isinstance(element, ClassDefinition):
                    definition.classes[element.name] = element
                else:
                    definition.components[element.name] = element

    def _import(self) -> list[Import]:
        if self.text(1) == "=":
            name = self.identifier()
            self.expect("=")
            imports = [Import(name, self.name())]
        else:
            path = self.name()
            if self.accept(".*"):
                imports = [Import(None, path)]
            elif self.text() == "." and self.text(1) == "{":
                self.at += 2
                imports = []
                while not self.accept("}"):
                    name = self.identifier()
                    imports.append(Import(name, (*path, name)))
                    self.accept(",")
            else:
                imports = [Import(path[-1], path)]
        self.skip_comment()
        return imports

    def _declarations(self) -> list[ClassDefinition | ComponentDeclaration]:
        """A class or components with their prefixes and constraining clause."""
        prefixes = set()
        while self.text() in _ELEMENT_PREFIXES:
            prefixes.add(self.text())
            self.at += 1
        elements: list[ClassDefinition | ComponentDeclaration]
        if self._is_class() and not (self.text() == "operator" and self.text(1) == "."):
            elements = [self._class()]
        else:
            elements = list(self._components(prefixes))
        constraint = None
        first = self.at
        if self.accept("constrainedby"):
            name = self.name()
            constraint = Constraint(name, self._modifiers(), self.extent(first))
        self.skip_comment()
        result: list[ClassDefinition | ComponentDeclaration] = []
        for element in elements:
            if isinstance(element, ClassDefinition):
                element.redeclares = "redeclare" in prefixes or element.extends_inherited
                element.constraint = constraint
                element.is_outer = "outer" in prefixes
                element.is_replaceable = "replaceable" in prefixes
                result.append(element)
            else:
                result.append(
                    replace(
                        element,
                        redeclares="redeclare" in prefixes,
                        constraint=constraint,
                    )
                )
        return result

    def _components(self, around: set[str]) -> Iterator[ComponentDeclaration]:
        """component-clause, behind the prefixes of an element."""
        prefixes = set()
        while self.text() in _COMPONENT_PREFIXES:
            prefixes.add(self.text())
            self.at += 1
        type_name = self.name()
        start = self.at
        self.skip_subscripts()
        sizes = self.extent(start) if self.at > start else None
        may_all_be_absent = "constant" in prefixes or sizes is not None
        while True:
            first = self.at
            name = self.identifier()
            may_be_absent = may_all_be_absent or self.text() == "["
            self.skip_subscripts()
            arguments = self._modifiers()
            value = self._value()
            extent = self.extent(first)
            if self.accept("if"):
                may_be_absent = True
                self.expression()
            self.skip_comment()
            yield ComponentDeclaration(
                name,
                type_name,
                extent,
                arguments,
                value,
                is_inner="inner" in around,
                is_outer="outer" in around,
                is_input="input" in prefixes,
                is_parameter=not prefixes.isdisjoint(("parameter", "constant")),
                sizes_of_type=sizes,
                may_be_absent=may_be_absent,
            )
            # In a modification a comma ends the argument.
            if self.text() != "," or self._in_modification:
                return
            self.at += 1

    # --- modifications ---

    def _value(self) -> Extent | None:
        return self.expression() if self.accept("=") or self.accept(":=") else None

    def _modifiers(self) -> tuple[Modifier, ...]:
        """class-modification, if there is one."""
        if not self.accept("("):
            return ()
        self._in_modification += 1
        self._depth += 1
        if self._depth > _DEEPEST:
            raise UnreadableError(f"{self.file}: classes or modifiers are nested too deeply")
        result: list[Modifier] = []
        while not self.accept(")"):
            result.append(self._argument())
            if self.text() != ")":
                self.expect(",")
        self._in_modification -= 1
        self._depth -= 1
        return tuple(result)

    def _argument(self) -> Modifier:
        first = self.at
        if self.accept("break"):
            name = self.name()
            if self.text() == "(":
                self.skip_brackets()
                name = ("connect",)
            return Modifier(name, self.extent(first), removes=True)
        redeclares = self.accept("redeclare")
        while self.text() in ("each", "final"):
            self.at += 1
        if redeclares or self.text() == "replaceable":
            (element,) = self._declarations()
            return Modifier((element.name,), self.extent(first), redeclared=element)
        path = self.name()
        self.skip_subscripts()
        arguments = self._modifiers()
        value = self._value()
        extent = self.extent(first)
        self.skip_comment()
        return Modifier(path, extent, arguments, value)
