"""Generates the C of a model: the functions of ``runtime/model/fmurt_model.h`` from the blocks of both systems."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from modelica2fmu.codegen.block_code import BlockCode
from modelica2fmu.codegen.c_functions import Function, FunctionFrame, functions_of
from modelica2fmu.codegen.event_code import (
    assert_statement,
    event_statements,
    fixed_statement,
    indicator_statements,
    lasting_asserts,
    warning_statements,
)
from modelica2fmu.codegen.generated_source import GeneratedSource
from modelica2fmu.codegen.jacobian_code import jacobian_code
from modelica2fmu.codegen.model_file import GUID_PLACE, ModelParts, model_file, model_header
from modelica2fmu.codegen.part_code import PartCode, part_code
from modelica2fmu.codegen.scene_code import SceneCode, scene_code
from modelica2fmu.codegen.slots import Slots, assign_slots
from modelica2fmu.codegen.statements import Statement, WorkSpace
from modelica2fmu.codegen.symbol_places import SymbolPlaces
from modelica2fmu.equations.alias import ReducedModel
from modelica2fmu.equations.blocks import (
    Assignment,
    Block,
    block_roots,
    block_targets,
    blocks_around,
    divided_blocks,
    needed_blocks,
)
from modelica2fmu.equations.parts import find_parts
from modelica2fmu.equations.scenes import Scene, find_scenes
from modelica2fmu.equations.sorting import solve_order
from modelica2fmu.equations.systems import PlaceOf, Systems
from modelica2fmu.equations.tangents import tangents
from modelica2fmu.expand.scalar_model import ExternalCall, Kind, ScalarAssert, derivative_name, start_name, unwrapped
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_LINES_PER_FILE: Final = 5000
_STATES_WITHOUT_JACOBIAN: Final = 500  # KRYLOV_STATES of fmurt_solver.c: the integrator needs none from there on


@dataclass(frozen=True)
class GeneratedModel:
    """The generated C and what the description of the FMU needs of it.

    Attributes:
        sources: C files and their common header.
        guid: hash of the code, in the form of a GUID.
        slots: where variables live.
        states: names of the states, in order.
        operations: number of lines of C that one evaluation of the derivatives executes.
        needs_completed_steps: whether it has to be told of accepted steps: nonlinear systems are followed from one to
            the next, assertions at level warning are checked, and bodies that an importer lets pass through each other
            are told of.
        watches_passages: whether there is an event indicator for bodies that pass through each other.
    """

    sources: tuple[GeneratedSource, ...]
    guid: str
    slots: Slots
    states: tuple[str, ...]
    operations: int
    needs_completed_steps: bool
    watches_passages: bool


def generate(
    reduced: ReducedModel, systems: Systems, includes: Sequence[str], place: PlaceOf, thicknesses: Sequence[str] = ()
) -> GeneratedModel:
    """Generates the C of a model.

    Args:
        reduced: variables and what was removed.
        systems: blocks and states.
        includes: texts of Include annotations, in order.
        place: place of a span.
        thicknesses: parameters that are thicknesses of what may touch.
    """
    return _Generator(reduced, systems, includes, place, thicknesses).run()


class _Generator:
    def __init__(
        self,
        reduced: ReducedModel,
        systems: Systems,
        includes: Sequence[str],
        place: PlaceOf,
        thicknesses: Sequence[str],
    ) -> None:
        self._reduced = reduced
        self._systems = systems
        self._model = systems.model
        self._states = tuple(systems.reduction.states)
        self._includes = includes
        self._place = place
        self._thicknesses = thicknesses
        self._functions: list[Function] = []
        self._is_simulated_at_start = False
        self._simulation, self._initialization = self._needed()
        self._scenes = self._find_scenes()
        self._places = SymbolPlaces(self._assigned_slots(), WorkSpace())
        self._blocks = BlockCode(self._places, self._model.variables, self._simulation, place)

    def run(self) -> GeneratedModel:
        frame = self._places.frame()
        self._add("fmurt_part_parameters", self._parameters(), frame)
        self._add_initialization(frame)
        asserts, warnings = self._watched(is_warning=False), self._watched(is_warning=True)
        simulating = functions_of("fmurt_part_simulate", self._simulate([*asserts, *warnings]), frame)
        self._functions.extend(simulating)
        self._add("fmurt_part_assert", [assert_statement(item, "FMURT_RESULT_DISCARD") for item in asserts], frame)
        self._add("fmurt_part_warn", warning_statements(warnings, self._places), frame)
        events = self._places.frame(", int *states_changed", ("  (void)states_changed;",))
        self._add("fmurt_part_event", event_statements(self._model, self._places), events)
        indicators = self._places.frame(", double *indicator", ("  (void)indicator;",))
        self._add("fmurt_part_indicators", indicator_statements(self._model), indicators)
        jacobian = self._jacobian()
        scenes = scene_code(self._scenes, self._places)
        self._functions.extend(scenes.functions)
        parts = PartCode()
        if not asserts:
            parts = part_code(find_parts(self._simulation, self._states, self._model), self._places)
        self._functions.extend(parts.functions)
        self._functions.extend(self._blocks.functions)
        integrated = [item for item in simulating if not item.is_discrete and not item.on_request]
        operations = sum(item.executed * item.executions for item in integrated)
        return self._assemble(jacobian, parts.tables, scenes, operations)

    def _add(self, prefix: str, statements: Sequence[Statement], frame: FunctionFrame) -> None:
        self._functions.extend(functions_of(prefix, statements, frame))

    # --- what is generated ---

    def _needed(self) -> tuple[list[Block], list[Block]]:
        """The blocks of both systems that anything asks for."""
        systems, model = self._systems, self._model
        wanted = [name for name, variable in model.variables.items() if variable.declaration is not None]
        wanted += [name for name in model.variables if name.startswith("$")]
        wanted += [derivative_name(name) for name in self._states]
        wanted += ex.symbols(*(item.indicator for item in model.relations))
        wanted += ex.symbols(*(root for item in model.reinitializations for root in (item.trigger, item.value)))
        wanted += ex.symbols(*(root for item in model.asserts for root in (item.condition, item.trigger or 0)))
        wanted += ex.symbols(*(item.condition for item in systems.checks))
        wanted += ex.symbols(*(by for _, by in self._reduced.replacements.items()))
        initialization = needed_blocks(systems.initialization, [*wanted, *self._states])
        return needed_blocks(systems.simulation, wanted), initialization

    def _find_scenes(self) -> list[Scene]:
        """The contact scenes, where an integrator moves their bodies."""
        if not self._states:
            return []
        return find_scenes(self._simulation, self._model.variables, self._reduced.replacements)

    def _assigned_slots(self) -> Slots:
        blocks = [*self._simulation, *self._initialization]
        used = [name for block in blocks for name in block_targets(block)]
        used += ex.symbols(*(root for block in blocks for root in block_roots(block)))
        derivatives = dict.fromkeys(derivative_name(name) for name in self._states)
        derivatives.update(dict.fromkeys(name for name in (*used, *self._states) if unwrapped(name)[0] == "der"))
        return assign_slots(self._reduced, list(derivatives))

    # --- simulation ---

    def _simulate(self, watched: Sequence[ScalarAssert]) -> list[Statement]:
        """What an integrator needs at each point, what is done at events, and last what is only looked at."""
        model = self._model
        wanted = [derivative_name(name) for name in self._states]
        wanted += ex.symbols(*(item.indicator for item in model.relations))
        wanted += ex.symbols(*(value for scene in self._scenes for value in scene.motion))
        wanted += ex.symbols(*(root for item in watched for root in (item.condition, item.trigger or 0)))
        wanted += ex.symbols(*(part for item in watched for part in item.message.parts if isinstance(part, Node)))
        needed, others = divided_blocks(self._simulation, wanted)
        statements = [statement for block in needed for statement in self._blocks.statements(block)]
        last = [statement for block in others for statement in self._blocks.statements(block)]
        last += self._negated_statements()
        return [*statements, *(replace(statement, on_request=True) for statement in last)]

    # --- parameters ---

    def _parameters(self) -> list[Statement]:
        model = self._model
        entries: list[Assignment | ExternalCall] = []
        unknowns: list[str] = []
        for call in model.calls:
            if call.outputs and all(model.variables[name].kind is Kind.PARAMETER for name in call.outputs):
                entries.append(call)
                unknowns.extend(call.outputs)
        outputs = set(unknowns)
        for name, variable in model.variables.items():
            if variable.kind is Kind.PARAMETER and isinstance(variable.value, Node) and name not in outputs:
                entries.append(Assignment(name, variable.value))
                unknowns.append(name)
        blocks = solve_order(entries, unknowns, [], self._place)
        statements = [statement for block in blocks for statement in self._blocks.statements(block)]
        removed = {*self._reduced.replacements, *(name for name, _ in self._reduced.invariants)}
        for name, variable in model.variables.items():
            if name in removed or variable.kind in (Kind.PARAMETER, Kind.CONSTANT):
                continue
            if isinstance(variable.start, Node):
                statements.append(self._places.assign(name, variable.start))
        statements.extend(self._negated_statements(of_parameters=True))
        return statements

    def _is_invariant(self, node: float | Node) -> bool:
        """True for what depends on parameters alone."""
        return all(
            (variable := self._model.variables.get(name)) is not None and variable.kind is Kind.PARAMETER
            for name in ex.symbols(node)
        )

    def _watched(self, *, is_warning: bool) -> list[ScalarAssert]:
        """Lasting assertions of a level that may come to fail; those on parameters alone are checked at the start."""
        return [
            item
            for item in lasting_asserts(self._model)
            if item.is_warning == is_warning and not self._is_invariant(item.condition)
        ]

    def _negated_statements(self, of_parameters: bool = False) -> list[Statement]:
        return [
            self._places.assign(name, by)
            for name, by in self._places.slots.negated
            if self._is_invariant(by) == of_parameters
        ]

    # --- initialization ---

    def _add_initialization(self, frame: FunctionFrame) -> None:
        """Adds what is solved at initialization; what is solved while simulating, too, is not written twice."""
        around = blocks_around(self._initialization, self._simulation)
        self._is_simulated_at_start = around is not None
        before, after = around or (self._initialization, [])
        self._add("fmurt_part_initialize", self._initialize(before), frame)
        self._add("fmurt_part_initialized", [*self._solved(after), *self._checked_at_start()], frame)

    def _solved(self, blocks: Sequence[Block]) -> list[Statement]:
        """The statements of blocks, all of which are executed at initialization."""
        return [replace(item, is_discrete=False) for block in blocks for item in self._blocks.statements(block)]

    def _initialize(self, blocks: Sequence[Block]) -> list[Statement]:
        names = ex.symbols(
            *(root for block in blocks for root in block_roots(block)),
            *(item.condition for item in self._systems.checks),
        )
        starts = [name[6:-1] for name in names if name.startswith("start(")]
        statements: list[Statement] = []
        for name in starts:
            place, value = self._places.location(start_name(name)), self._places.location(name)
            statements.append(fixed_statement(f"{place} = {value};"))
        return [*statements, *self._solved(blocks)]

    def _checked_at_start(self) -> list[Statement]:
        asserts = [
            assert_statement(item, "FMURT_RESULT_ERROR")
            for item in lasting_asserts(self._model)
            if self._is_invariant(item.condition)
        ]
        checks = [assert_statement(item, "FMURT_RESULT_ERROR") for item in self._systems.checks]
        return [*self._negated_statements(), *checks, *asserts]

    # --- Jacobian ---

    def _jacobian(self) -> str:
        """Adds the functions of the Jacobian, where it pays; the text of the one that calls them."""
        if not self._states or len(self._states) >= _STATES_WITHOUT_JACOBIAN:
            return ""
        rates = [derivative_name(name) for name in self._states]
        steps = tangents(needed_blocks(self._simulation, rates), self._states, rates)
        code = jacobian_code(steps, self._states, rates, self._places, self._blocks.factors)
        self._functions.extend(code.functions)
        return code.text

    # --- files ---

    def _assemble(self, jacobian: str, parts: str, scenes: SceneCode, operations: int) -> GeneratedModel:
        work, slots = self._places.work, self._places.slots
        main = model_file(
            ModelParts(
                self._reduced,
                slots,
                self._states,
                self._functions,
                jacobian,
                parts,
                scenes.table,
                scenes.count,
                work.reals,
                work.integers,
                self._blocks.followed,
                [slots.of[name].index for name in self._thicknesses if name in slots.of],
                self._is_simulated_at_start,
            )
        )
        sources = [GeneratedSource("model_parts.h", model_header(self._functions)), *self._part_files()]
        digest = hashlib.blake2b(digest_size=16)
        for source in [*sources, GeneratedSource("model.c", main)]:
            digest.update(source.name.encode() + b"\0" + source.text.encode() + b"\0")
        text = digest.hexdigest()
        guid = f"{{{text[:8]}-{text[8:12]}-{text[12:16]}-{text[16:20]}-{text[20:]}}}"
        sources.append(GeneratedSource("model.c", main.replace(GUID_PLACE, guid)))
        told = bool(self._blocks.followed or self._watched(is_warning=True) or scenes.count)
        return GeneratedModel(tuple(sources), guid, slots, self._states, operations, told, scenes.count > 0)

    def _part_files(self) -> list[GeneratedSource]:
        includes = '#include "model_parts.h"\n' + "".join(f"{text}\n" for text in self._includes)
        files: list[tuple[str, list[str], int]] = []
        for function in self._functions:
            if not files or files[-1][2] + function.size > _LINES_PER_FILE:
                files.append((f"model_part{len(files) + 1}.c", [], 0))
            name, texts, size = files[-1]
            texts.append(function.text)
            files[-1] = (name, texts, size + function.size)
        return [GeneratedSource(name, includes + "\n" + "\n".join(texts)) for name, texts, _ in files]
