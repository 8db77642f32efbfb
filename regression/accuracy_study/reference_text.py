"""What a scene's runs are measured against, in words."""

from __future__ import annotations

from accuracy_study.answers import ClosedForm, GivenTrajectory
from accuracy_study.study import SceneFindings


def reference_text(found: SceneFindings) -> str:
    """The kind of the reference and where it comes from."""
    reference = found.scene.reference
    if isinstance(reference, ClosedForm):
        return f"known answers: {reference.source}"
    if isinstance(reference, GivenTrajectory):
        return f"trajectory {reference.path.name}: {reference.source}"
    return f"the first value of every knob at tolerance {found.tight:g}"
