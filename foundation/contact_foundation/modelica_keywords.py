"""The keywords of Modelica (Modelica Language Specification 3.6, section 2.3.3), which cannot be names."""

from __future__ import annotations

from typing import Final

_TEXT: Final = """
algorithm and annotation block break class connect connector constant constrainedby der discrete each else
elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for
function if import impure in initial inner input loop model not operator or outer output package parameter
partial protected public pure record redeclare replaceable return stream then true type when while within
"""
KEYWORDS: Final = frozenset(_TEXT.split())
