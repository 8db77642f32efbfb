"""Which packages are not just what they inherit."""

from __future__ import annotations

from modelica2fmu.crosscheck.class_syntax import ClassDefinition


def changes_what_it_inherits(definition: ClassDefinition) -> bool:
    """= true, if a class modifies or redeclares what it extends."""
    if not definition.bases:
        return False
    return (
        any(base.arguments for base in definition.bases)
        or any(each.redeclares for each in definition.components.values())
        or any(each.redeclares for each in definition.classes.values())
    )
