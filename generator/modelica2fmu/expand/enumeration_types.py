"""Enumeration types of a flat model: which there are, and their literals."""

from __future__ import annotations

from modelica2fmu.expand.scalar_values import BASE_TYPES
from modelica2fmu.frontend import ir


class EnumerationTypes:
    """The enumeration types whose literals a model mentions.

    Args:
        model: the flat model.
    """

    def __init__(self, model: ir.FlatModel) -> None:
        self._model = model
        self._names = {literal.rsplit(".", 1)[0] for literal in model.enumeration_literals}

    def is_known(self, name: str) -> bool:
        """True for the name of an enumeration type, full or as in its scope."""
        return bool(self._candidates(name))

    def _candidates(self, name: str) -> list[str]:
        return [full for full in self._names if full == name or full.endswith("." + name)]

    def full_name(self, name: str) -> str:
        """The full name of an enumeration type that is known by ``name`` in its scope."""
        candidates = self._candidates(name)
        # Of a type whose literals nobody mentions, only the ordinal is known.
        return max(candidates, key=lambda full: (len(full), full)) if candidates else "Integer"

    def of_variable(self, name: str) -> str | None:
        """See :class:`interpreter_host.Host`."""
        variable = self._model.variables.get(name)
        if variable is None or variable.type in BASE_TYPES:
            return None
        return self.full_name(variable.type)

    def literals(self, types: set[str]) -> dict[str, tuple[str, ...]]:
        """Literals in their order, by type, of those of ``types`` that are enumerations."""
        result: dict[str, tuple[str, ...]] = {}
        for name in sorted(types - BASE_TYPES):
            literals = {
                ordinal: literal.rsplit(".", 1)[-1]
                for literal, ordinal in self._model.enumeration_literals.items()
                if literal.rsplit(".", 1)[0] == name and not literal.endswith("'")
            }
            result[name] = tuple(literals[ordinal] for ordinal in sorted(literals))
        return result
