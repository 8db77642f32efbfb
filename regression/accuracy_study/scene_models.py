"""The FMUs of a scene: the model as it is and every variant of it, built once."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from contact_foundation.errors import CmbError
from fmu_regression.fmi.binding import Mode
from fmu_regression.fmi.description import StartValue, check_signals, check_start_values, read_description
from fmu_regression.results.result import read_csv
from fmu_regression.simulate.simulation import DEFAULT_ROWS, default_signals, simulate
from scene_effects.choices import Change, Friction, Restitution
from scene_effects.manager import Manager, Parameters, find_manager, read_parameters
from scene_effects.variants import memoryless, modification, without_restitution, write_variant

from accuracy_study.answers import ClosedForm, GivenTrajectory
from accuracy_study.definition import Scene, Study
from accuracy_study.grid import Variant
from accuracy_study.knobs import AS_MODELLED, PARAMETER, SOLVERS, KnobValue, tessellation
from accuracy_study.tessellation import decomposed, tessellated

Builder = Callable[[str, Sequence[Path], Path], None]
"""Builds the FMU of a model: (model, sources beside the contact library, FMU to write)."""


@dataclass(frozen=True)
class VariantModel:
    """A variant that was built.

    Attributes:
        fmu: the file.
        digest: of its content.
        start_values: of every run of the variant.
        modification: the Modelica that makes the variant of the model, or "".
    """

    fmu: Path
    digest: str
    start_values: Mapping[str, StartValue]
    modification: str


@dataclass(frozen=True)
class _Applied:
    """What the settings of a variant become."""

    change: Change
    modifications: tuple[str, ...]
    start_values: Mapping[str, StartValue]


class SceneModels:
    """The FMUs of one scene.

    Args:
        study, scene: what they are for.
        build: builds FMUs.
        folder: where they go.

    Raises:
        CmbError: the model cannot be built or started.
    """

    def __init__(self, study: Study, scene: Scene, build: Builder, folder: Path) -> None:
        self.scene = scene
        self._study, self._build, self._folder = study, build, folder
        self._stem = "".join(c if c.isalnum() else "_" for c in scene.name)
        self._built: dict[str, tuple[Path, str]] = {}
        fmu, _ = self._fmu("")
        self._description = read_description(fmu)
        self._manager, self._parameters = self._find_manager(fmu)

    @property
    def start(self) -> float:
        """Start time, s."""
        return self._description.start

    @property
    def stop(self) -> float:
        """Stop time, s."""
        own = self._description.stop if self._description.stop is not None else self.start + 1.0
        return self.scene.stop if self.scene.stop is not None else own

    @property
    def interval(self) -> float:
        """Output interval, s."""
        own = self._description.interval or (self.stop - self.start) / DEFAULT_ROWS
        return self.scene.interval if self.scene.interval is not None else own

    @property
    def modes(self) -> tuple[Mode, ...]:
        """The modes that the FMU offers, model exchange first."""
        return tuple(mode for mode in SOLVERS if mode in self._description.identifiers)

    @property
    def compared(self) -> tuple[str, ...]:
        """The signals by which trajectories are compared."""
        if self.scene.signals:
            return self.scene.signals
        if self._manager is None:
            return tuple(default_signals(self._description))
        moving = (
            [k for k, mass in enumerate(self._parameters.masses) if mass != float("inf")] if self._parameters else []
        )
        return tuple(name for k in moving or range(len(self._manager.bodies)) for name in self._manager.position(k))

    @property
    def energy(self) -> str:
        """The variable that holds the total energy, or ""."""
        if self.scene.energy:
            return self.scene.energy
        return "energy" if "energy" in self._description.variables else ""

    @property
    def distances(self) -> tuple[str, ...]:
        """The signed distance of every pair, m."""
        if self._manager is None:
            return ()
        return tuple(f"{self._manager.name}.distance[{k + 1}]" for k in range(len(self._manager.pairs)))

    @property
    def recorded(self) -> tuple[str, ...]:
        """Every signal that a run needs."""
        answers = self.scene.reference.signals if isinstance(self.scene.reference, ClosedForm) else ()
        energy = (self.energy,) if self.energy else ()
        return tuple(dict.fromkeys([*self.compared, *answers, *energy, *self.distances]))

    def problems(self) -> list[CmbError]:
        """What the study asks of the scene that it does not have."""
        found: list[CmbError] = []
        scene = self.scene
        answers = scene.reference.signals if isinstance(scene.reference, ClosedForm) else ()
        for key, names in (("signals", scene.signals), ("reference", answers), ("energy", (scene.energy,))):
            given = [name for name in names if name]
            found += self._checked(key, partial(check_signals, self._description, given))
        found += self._checked("parameters", partial(check_start_values, self._description, scene.parameters))
        if isinstance(scene.reference, GivenTrajectory):
            trajectory = read_csv(scene.reference.path)
            lacking = [name for name in self.compared if name not in trajectory]
            if lacking:
                found.append(self._study.problem(scene, "reference.trajectory", f"it has no signal {lacking[0]}"))
        if not self.stop > self.start:
            found.append(self._study.problem(scene, "stop", f"{self.stop:g} is not after the start {self.start:g}"))
        for name, values in scene.knobs.items():
            for value in values:
                if what := self._knob_problem(name, value):
                    found.append(self._study.problem(scene, f"knobs.{name}", f"{value!r}: {what}"))
        return found

    def variant(self, variant: Variant) -> VariantModel:
        """Builds a variant, unless its Modelica was built before.

        Raises:
            CmbError: it cannot be built.
        """
        applied = self._applied(variant)
        texts = list(applied.modifications)
        if applied.change != Change():
            assert self._manager is not None
            assert self._parameters is not None
            texts.append(modification(applied.change, self._manager, self._parameters))
        text = ", ".join(texts)
        fmu, digest = self._fmu(text)
        return VariantModel(fmu, digest, {**self.scene.parameters, **applied.start_values}, text)

    def _fmu(self, text: str) -> tuple[Path, str]:
        if text not in self._built:
            self._folder.mkdir(parents=True, exist_ok=True)
            mark = hashlib.sha256(text.encode()).hexdigest()[:12] if text else "as_modelled"
            fmu = self._folder / f"{self._stem}_{mark}.fmu"
            sources = self.scene.sources
            model = self.scene.model
            if text:
                source = self._folder / f"Variant_{mark}_of_{self._stem}.mo"
                write_variant(source, model, text)
                sources, model = (source, *sources), source.stem
            self._build(model, sources, fmu)
            self._built[text] = fmu, hashlib.sha256(fmu.read_bytes()).hexdigest()
        return self._built[text]

    def _find_manager(self, fmu: Path) -> tuple[Manager | None, Parameters | None]:
        """The manager and its numbers, from a run of one interval; None where the scene has no manager."""
        try:
            manager = find_manager(self._description, self.scene.manager)
        except CmbError:
            if self.scene.manager is not None:
                raise
            return None, None
        result = simulate(
            fmu,
            signals=manager.parameter_signals(),
            mode=self.modes[0],
            stop=self.start + self.interval,
            interval=self.interval,
            parameters=self.scene.parameters,
        )
        return manager, read_parameters(manager, result)

    def _checked(self, key: str, check: Callable[[], object]) -> list[CmbError]:
        try:
            check()
        except CmbError as error:
            what = f"{error.message}; {error.remedy}" if error.remedy else error.message
            return [self._study.problem(self.scene, key, what)]
        return []

    def _knob_problem(self, name: str, value: KnobValue) -> str:
        """Why the scene does not have a knob or a value of it, or ""."""
        if value == AS_MODELLED or name in ("tolerance", "max_step"):
            return ""
        if name == "solver":
            return "" if value in self.modes else "the FMU does not offer it"
        if name.startswith(PARAMETER):
            variable = name.removeprefix(PARAMETER)
            try:
                check_start_values(self._description, {variable: value})
            except CmbError as error:
                return f"{error.message}; {error.remedy}" if error.remedy else error.message
            return ""
        if name == "geometry" and value in self.scene.geometries:
            return ""
        if self._manager is None:
            return "the scene has no ContactMultiBody.ContactManager, which alone has this knob"
        if name == "restitution" and not self._manager.regards_restitution and "law" not in self.scene.knobs:
            return "the scene's law of the normal force has no restitution"
        return self._geometry_problem(str(value)) if name == "geometry" else ""

    def _geometry_problem(self, value: str) -> str:
        """Why the scene's shapes cannot become others, or ""."""
        try:
            same = self._geometry(value) == self._descriptors()
        except CmbError as error:
            return error.message
        if same and tessellation(value)[0] == "pieces":
            return "the scene has no closed mesh that could be decomposed"
        return "the scene has no box and no round shape that could be tessellated" if same else ""

    def _applied(self, variant: Variant) -> _Applied:
        change = Change()
        start_values: dict[str, StartValue] = {}
        modifications: list[str] = []
        for name, value in variant.settings:
            if value == AS_MODELLED:
                continue
            if name == "geometry" and value in self.scene.geometries:
                modifications.append(self.scene.geometries[str(value)])
                continue
            if name.startswith(PARAMETER):
                start_values[name.removeprefix(PARAMETER)] = value
                continue
            variables = self._numbers_of(name)
            if variables and all(self._is_settable(variable) for variable in variables):
                start_values.update({variable: float(value) for variable in variables})
            else:
                change = change.with_(self._change(name, value))
        return _Applied(change, tuple(modifications), start_values)

    def _numbers_of(self, name: str) -> list[str]:
        """The variables of the manager that a knob sets, if it is one that sets numbers."""
        assert self._manager is not None
        if name == "stiffness":
            return [f"{self._manager.name}.stiffness[{k + 1}]" for k in range(len(self._manager.pairs))]
        return [f"{self._manager.name}.exponent"] if name == "exponent" else []

    def _is_settable(self, name: str) -> bool:
        variable = self._description.variables.get(name)
        return variable is not None and variable.settable

    def _change(self, name: str, value: KnobValue) -> Change:
        assert self._manager is not None
        assert self._parameters is not None
        if name == "stiffness":
            return Change(values={"stiffness": (float(value),) * len(self._manager.pairs)})
        if name == "exponent":
            return Change(exponent=float(value))
        if name == "law":
            return Change(law=str(value))
        if name == "friction":
            return Change(friction=Friction(value))
        if name == "points":
            return Change(point_capacity=int(value))
        if name == "backend":
            return Change(backend=str(value))
        if name == "geometry":
            return Change(geometry=self._geometry(str(value)))
        assert name == "restitution", name
        if value == "Memoryless":
            return memoryless(self._manager, self._parameters)
        if value == "None":
            return without_restitution(self._manager, self._parameters)
        return Change(restitution=Restitution.BY_EVENT)

    def _descriptors(self) -> tuple[str, ...]:
        assert self._manager is not None
        names = (f"{self._manager.name}.geometry[{k + 1}]" for k in range(len(self._manager.bodies)))
        return tuple(self._description.variables[name].start or "" for name in names)

    def _geometry(self, value: str) -> tuple[str, ...]:
        kind, fineness = tessellation(value)
        if kind == "pieces":
            return tuple(decomposed(descriptor, fineness) for descriptor in self._descriptors())
        return tuple(tessellated(descriptor, kind, int(fineness)) for descriptor in self._descriptors())
