"""The evaluation of a study's answers: levels, effects of factors, carry-over, and checks by other means."""

from __future__ import annotations

from dataclasses import dataclass

from contact_foundation.errors import InputError

from depth_study.design.factors import Contrast
from depth_study.evaluation.carry_over import CarryOver, fit_carry_over
from depth_study.evaluation.effects import Effect, fit_effect, mean_difference, relative_scores
from depth_study.evaluation.levels import Levels, fit_levels
from depth_study.evaluation.mixed_model import MixedModel, fit_mixed_model
from depth_study.evaluation.panel import MIN_ANSWERS, Panel, fit_panel
from depth_study.record.answers import Answers


@dataclass(frozen=True)
class ContrastEffect:
    """A contrast by three ways.

    Attributes:
        contrast: what is asked.
        effect: from relative answers.
        of_levels: the same difference of levels.
        of_clean_levels: of levels without carry-over.
        of_clean_levels_half_width: half the confidence interval of that.
    """

    contrast: Contrast
    effect: Effect
    of_levels: float
    of_clean_levels: float
    of_clean_levels_half_width: float


@dataclass(frozen=True)
class Evaluation:
    """What a study's answers say.

    Attributes:
        answers: what was evaluated.
        confidence: of all intervals.
        panel: scores without scale and bias.
        levels: of the constellations.
        carry_over: how far answers lean towards the constellation before.
        contrasts: the design's.
        factor_effects: of each factor's pairs of levels.
        edge_effect: over all edges one by one.
        mixed_model: a check.
    """

    answers: Answers
    confidence: float
    panel: Panel
    levels: Levels
    carry_over: CarryOver
    contrasts: tuple[ContrastEffect, ...]
    factor_effects: tuple[ContrastEffect, ...]
    edge_effects: tuple[Effect, ...]
    mixed_model: MixedModel

    @property
    def left_out(self) -> tuple[int, ...]:
        """Observers whose answers have no spread."""
        return tuple(
            number for number, used in zip(self.answers.observers, self.panel.used.tolist(), strict=True) if not used
        )


def evaluate(answers: Answers, confidence: float = 0.9) -> Evaluation:
    """Evaluates a study.

    Args:
        answers: of at least two observers whose scale can be told.
        confidence: of all intervals, between 0 and 1.

    Raises:
        InputError: too few answers, or the confidence is no share.
    """
    if not 0 < confidence < 1:
        raise InputError(f"the confidence {confidence:g} is not between 0 and 1", remedy="Give a share such as 0.9.")
    panel = fit_panel(answers.by_constellation)
    if int(panel.used.sum()) < 2:
        raise InputError(
            f"{len(answers.observers)} observers answered, of whom {int(panel.used.sum())} gave at least "
            f"{MIN_ANSWERS} answers that are not all the same",
            remedy="Levels and intervals need two such observers at least.",
        )
    levels = fit_levels(panel, confidence)
    carry_over = fit_carry_over(answers.sequences, panel, levels)
    relative = relative_scores(answers.sequences, answers.relative, panel)
    count = len(answers.observers)

    def contrast_effect(contrast: Contrast) -> ContrastEffect:
        edges = answers.design.directed_edges(contrast)
        effect = fit_effect(relative, edges, count, confidence)
        clean, half = carry_over.difference(edges)
        return ContrastEffect(contrast, effect, float(mean_difference(levels.mean, edges)), float(clean), float(half))

    return Evaluation(
        answers,
        confidence,
        panel,
        levels,
        carry_over,
        tuple(map(contrast_effect, answers.design.contrasts)),
        tuple(map(contrast_effect, answers.design.level_contrasts)),
        tuple(fit_effect(relative, ((e.first, e.second),), count, confidence) for e in answers.design.edges),
        fit_mixed_model(answers, confidence),
    )
