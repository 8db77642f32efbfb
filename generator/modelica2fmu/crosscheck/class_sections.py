"""Passes over sections of equations and statements, and keeps places in them."""

from __future__ import annotations

from typing import Final

from modelica2fmu.crosscheck.class_syntax import ClassDefinition
from modelica2fmu.crosscheck.class_tokens import OPENING, TokenReader

_SECTIONS: Final = frozenset({"public", "protected", "equation", "algorithm", "external"})
_OTHER_STATEMENTS: Final = frozenset({"connect", "assert", "terminate", "reinit", "Connections"})
_BLOCKS: Final = frozenset({"if", "for", "when", "while"})


class SectionReader(TokenReader):
    """Reads the sections of a class."""

    def section(self, definition: ClassDefinition) -> None:
        """An equation or algorithm section, of which places are kept."""
        first = self.at
        self.at += 2 if self.text() == "initial" else 1
        depth = 0
        block, opening = "", first
        while depth or not self._ends_section():
            text = self.text()
            if text == "end" and self.text(1) in _BLOCKS:
                self.at += 2
                depth -= 1
                self.expect(";")
                if not depth:
                    (definition.equations if block == "when" else definition.blocks).append(self.extent(opening))
            elif text == "else":
                self.at += 1
            elif text in _BLOCKS or text in ("elseif", "elsewhen"):
                if text in _BLOCKS:
                    depth += 1
                    block, opening = (text, self.at) if depth == 1 else (block, opening)
                self._skip_to("loop" if text in ("for", "while") else "then")
            else:
                start = self.at
                is_equation = self._skip_to(";")
                if is_equation and not depth and text not in _OTHER_STATEMENTS:
                    definition.equations.append(self.extent(start))
        definition.behaviour.append(self.extent(first))

    def _ends_section(self) -> bool:
        text = self.text()
        return (
            (text == "end" and self.text(1) not in _BLOCKS)
            or text in _SECTIONS
            or (text == "initial" and self.text(1) in ("equation", "algorithm"))
            or (text == "annotation" and self.text(1) == "(")
        )

    def _skip_to(self, text: str) -> bool:
        """Behind the next such token outside of brackets; = true, if there is an equals sign before it."""
        equals = False
        depth = 0  # of if-expressions, whose "then" ends no condition
        self.at += 1
        while depth or self.text() != text:
            if self.text() in OPENING and self.tokens[self.at].kind == "sign":
                self.skip_brackets()
                continue
            equals |= self.text() in ("=", ":=")
            depth += text == "then" and self.text() == "if"
            depth -= text == "then" and depth > 0 and self.text() == "else"
            self.at += 1
        self.at += 1
        return equals

    def external(self) -> str | None:
        """The C function that an external one calls, ``None`` if it is not written."""
        name = None
        while not self.accept(";"):
            if self.text() == "annotation":
                self.skip_comment()
                continue
            if self.text(1) == "(" and name is None:
                name = self.text()
            if self.text() in OPENING:
                self.skip_brackets()
            else:
                self.at += 1
        return name
