"""Model error, geometry error and solver error, told apart by trajectories that differ in one thing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from contact_foundation.errors import CmbError

from accuracy_study.answers import ClosedForm, GivenTrajectory, trajectory_error
from accuracy_study.definition import Scene
from accuracy_study.grid import Variant, base_geometry, base_variant
from accuracy_study.run import first_line, measured_error
from accuracy_study.store import Store


@dataclass(frozen=True)
class VariantErrors:
    """The errors of a variant that are left when its solver makes none.

    Attributes:
        floor: doubt about them, and about solver errors: of the tight trajectory itself.
        geometry: the tight trajectory against that with the first value of every knob of geometry; None where one of
            them is missing.
        model: that trajectory against the scene's reference; None likewise.
        failure: why the tight trajectory is missing, or "".
    """

    floor: float | None = None
    geometry: float | None = None
    model: float | None = None
    failure: str = ""


def attribute(
    store: Store,
    scene: Scene,
    keys: Mapping[Variant, str],
    variant: Variant,
    compared: tuple[str, ...],
    reference: ClosedForm | GivenTrajectory | None,
) -> VariantErrors:
    """The errors of a variant.

    Args:
        store: with the tight trajectories.
        scene: of the variant.
        keys: of the tight trajectory of each variant.
        variant: whose errors.
        compared: signals by which trajectories are compared.
        reference: of the scene.
    """
    tight = store.tight(keys[variant])
    if tight is None or tight.trajectory is None:
        return VariantErrors(failure=tight.failure if tight is not None else "it is missing")
    with_base = keys.get(base_geometry(scene, variant))
    plain = store.tight(with_base) if with_base is not None else None
    if plain is None or plain.trajectory is None:
        return VariantErrors(floor=tight.floor)
    failure = ""
    geometry = model = None
    try:
        geometry = trajectory_error(plain.trajectory, tight.trajectory, compared).value
        model = measured_error(store, reference, keys[base_variant(scene)], compared, plain.trajectory).value
    except CmbError as error:
        failure = first_line(error)
    return VariantErrors(tight.floor, geometry, model, failure)
