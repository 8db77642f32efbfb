"""Random Modelica expressions from templates."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def random_expression(
    draw: np.random.Generator, templates: Sequence[str], leaves: Sequence[str], depth: int, leaf_share: float
) -> str:
    """An expression of at most so many templates in each other.

    Args:
        draw: where chance comes from.
        templates: with the operands ``{a}``, ``{b}`` and ``{c}``.
        leaves: what stands at the ends.
        depth: of templates, at most.
        leaf_share: probability that a leaf stands in place of a template.
    """
    if depth == 0 or draw.random() < leaf_share:
        return str(draw.choice(leaves))
    template = str(draw.choice(templates))
    operands = {name: random_expression(draw, templates, leaves, depth - 1, leaf_share) for name in "abc"}
    return template.format(**operands)
