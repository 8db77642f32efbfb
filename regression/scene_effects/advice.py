"""Advice on a scene: what was found, and what following it changes, measured."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact_foundation.errors import InputError
from contact_foundation.progress import Progress, silent

from scene_effects.choices import Change
from scene_effects.findings import Finding, Verdict, find
from scene_effects.manager import Manager
from scene_effects.measurement import Bench, Measurement
from scene_effects.study import measure_fullest
from scene_effects.variants import Variant

_ALLOWED_ANGLE = 0.01
"""A difference of orientations in rad that does not matter."""
_TITLES = {
    "friction": "Friction",
    "restitution": "Restitution",
    "turning": "Spin and rolling friction",
    "points": "Points a pair",
    "pairs": "Pairs",
    "contact": "Contact",
}


@dataclass(frozen=True)
class AdviceItem:
    """A finding and what following it does.

    Attributes:
        finding: about one effect.
        measured: the model with the finding's change, differences from the model as it is; None without a change.
    """

    finding: Finding
    measured: Measurement | None = None

    def is_confirmed(self, allowed: float) -> bool:
        """Whether an effect that is not needed can go: the bodies move as before, positions within ``allowed`` in m."""
        return (
            self.finding.verdict is Verdict.UNNEEDED
            and self.measured is not None
            and self.measured.difference is not None
            and self.measured.difference.position <= allowed
            and self.measured.difference.angle <= _ALLOWED_ANGLE
        )


@dataclass(frozen=True)
class Advice:
    """Advice on a scene.

    Attributes:
        model: qualified name.
        manager: as the model has it.
        duration: s simulated.
        allowed: m, the difference of positions that does not matter.
        as_modelled: the model as it is.
        items: one for each effect.
        together: the model without all that can go, where that is more than one effect.
    """

    model: str
    manager: Manager
    duration: float
    allowed: float
    as_modelled: Measurement
    items: tuple[AdviceItem, ...]
    together: Measurement | None


def advise(bench: Bench, allowed: float, progress: Progress = silent) -> Advice:
    """Finds out which effects a scene needs, and measures what leaving out or adding others changes.

    Args:
        bench: builds and runs.
        allowed: m, a difference of positions that does not matter.
        progress: receives the phase "variants".

    Raises:
        InputError: ``allowed`` is not positive.
        SimulationError: the variant with every effect on cannot be built or simulated.
    """
    if not allowed > 0:
        raise InputError(f"the difference {allowed:g} must be positive")
    full, observations = measure_fullest(bench)
    findings = find(bench.manager, bench.parameters, observations, allowed)
    items = []
    for k, finding in enumerate(findings):
        progress("variants", k / len(findings), finding.effect)
        measured = None
        if finding.change is not None:
            measured = bench.measure(Variant(finding.effect, finding.change)).against(bench.manager, bench.as_modelled)
        items.append(AdviceItem(finding, measured))
    confirmed = [item for item in items if item.is_confirmed(allowed)]
    together = None
    if len(confirmed) > 1:
        change = Change()
        for item in confirmed:
            assert item.finding.change is not None
            change = change.with_(item.finding.change)
        together = bench.measure(Variant("together", change)).against(bench.manager, bench.as_modelled)
    progress("variants", 1.0)
    assert full.result is not None
    duration = float(full.result.time[-1] - full.result.time[0])
    return Advice(bench.model, bench.manager, duration, allowed, bench.as_modelled, tuple(items), together)


def advice_text(advice: Advice) -> str:
    """The advice as readable sentences; no trailing newline."""
    lines = [f"{advice.model}, manager {advice.manager.name}, judged by {advice.duration:g} s of simulation:"]
    for item in advice.items:
        lines += ["", *_item(advice, item)]
    if advice.together is not None:
        lines += ["", "All that can go, together: " + _effect(advice, advice.together)]
        lines += _write(advice.together)
    return "\n".join(lines)


def _item(advice: Advice, item: AdviceItem) -> list[str]:
    finding, measured = item.finding, item.measured
    title = _TITLES[finding.effect]
    if finding.verdict is Verdict.FITS:
        return [f"{title}: fits. {finding.reason}"]
    if finding.verdict is Verdict.MISSING:
        lines = [f"{title}: missing. {finding.reason}"]
        if measured is not None:
            lines.append("  " + _effect(advice, measured))
            lines += _write(measured)
        return lines
    assert measured is not None
    if item.is_confirmed(advice.allowed):
        return [f"{title}: can be less. {finding.reason}", "  " + _effect(advice, measured), *_write(measured)]
    return [
        f"{title}: keep it. It looks as if less would do ({finding.reason.rstrip('.')}), but that was tried:",
        "  " + _effect(advice, measured),
    ]


def _write(measured: Measurement) -> list[str]:
    return [] if measured.error else [f"  Write: {measured.modification}"]


def _effect(advice: Advice, measured: Measurement) -> str:
    """What a change changes: figures from the model as it is to the changed one, and the motion."""
    if measured.error:
        return f"The changed model fails: {measured.error}"
    before, after = _figures(advice.as_modelled), _figures(measured)
    changed = [
        f"{name} {before[name]} → {value}" for name, value in after.items() if name in before and value != before[name]
    ]
    text = ", ".join(changed) or "no figure of the model changes"
    difference = measured.difference
    if difference is None:
        return f"{text[0].upper()}{text[1:]}."
    if difference.position == 0 and difference.angle == 0:
        return f"{text[0].upper()}{text[1:]}; the bodies move as before."
    body = advice.manager.bodies[difference.body].name
    return (
        f"{text[0].upper()}{text[1:]}; the bodies' positions differ by at most {1000 * difference.position:.3g} mm "
        f"({body} at {difference.time:.4g} s), their orientations by {math.degrees(difference.angle):.3g} degrees."
    )


def _figures(measured: Measurement) -> dict[str, str]:
    """Figures that are the same on every machine; wall times of short simulations say less."""
    figures: dict[str, str] = {}
    if measured.build is not None:
        build = measured.build
        figures |= {"equations": str(build.equations), "states": str(build.states)}
        figures |= {"event indicators": str(build.event_indicators), "lines": str(build.lines)}
    if measured.counters is not None:
        counters = measured.counters
        figures |= {"evaluations": str(counters.evaluations), "steps": str(counters.steps)}
        figures["events"] = str(counters.state_events + counters.time_events)
    return figures
