"""Declares the scalar variables of a flat model, without their values."""

from __future__ import annotations

from modelica2fmu.expand.enumeration_types import EnumerationTypes
from modelica2fmu.expand.scalar_model import Kind, ScalarVariable
from modelica2fmu.expand.scalar_values import BASE_TYPES, element_names
from modelica2fmu.frontend import ir


class VariableDeclaration:
    """Makes scalar variables of declared ones.

    Args:
        model: the flat model.
        enumerations: its enumeration types.
    """

    def __init__(self, model: ir.FlatModel, enumerations: EnumerationTypes) -> None:
        self._model = model
        self._enumerations = enumerations
        self._assigned_in_when = self._targets_of_whens()

    def scalars(self, variable: ir.Variable) -> list[ScalarVariable]:
        """The elements of a variable, row-major."""
        kind = self._kind(variable)
        names = element_names(variable.name, variable.shape)
        fixed = variable.fixed or (False,)
        result = []
        for position, name in enumerate(names):
            orientation = None
            if variable.orientation is not None and variable.shape == (3, 3):
                orientation = (variable.orientation, position // 3, position % 3)
            result.append(
                ScalarVariable(
                    name=name,
                    type=variable.type if variable.type in BASE_TYPES else self._enumerations.full_name(variable.type),
                    kind=kind,
                    fixed=fixed[position] if len(fixed) == len(names) else fixed[0],
                    state_select=variable.state_select,
                    orientation=orientation,
                    declaration=variable,
                    is_output=variable.causality == "output" and variable.is_top_level,
                    span=variable.span,
                )
            )
        return result

    def _kind(self, variable: ir.Variable) -> Kind:
        if variable.variability == "constant":
            return Kind.CONSTANT
        if variable.variability == "parameter":
            if variable.fixed is not None and not all(variable.fixed):
                return Kind.FREE_PARAMETER
            return Kind.PARAMETER
        if variable.causality == "input" and variable.is_top_level and "." not in variable.name:
            return Kind.INPUT
        is_discrete = (
            variable.type != "Real"
            or variable.variability == "discrete"
            or variable.name in self._assigned_in_when
            or any(name in self._assigned_in_when for name in element_names(variable.name, variable.shape))
        )
        return Kind.DISCRETE if is_discrete else Kind.CONTINUOUS

    def _targets_of_whens(self) -> set[str]:
        """Names (without subscripts) of the variables that when-clauses assign."""
        names: set[str] = set()

        def visit(statements: tuple[ir.Statement, ...], inside: bool) -> None:
            for statement in statements:
                match statement:
                    case ir.Assignment(target=target) if inside:
                        names.add(target.name)
                    case ir.CallAssignment(targets=targets) if inside:
                        names.update(target.name for target in targets if target is not None)
                    case ir.IfStatement(branches=branches, otherwise=otherwise):
                        for _, body in branches:
                            visit(body, inside)
                        visit(otherwise, inside)
                    case ir.For(body=body):
                        visit(body, inside)
                    case ir.WhenStatement(branches=branches):
                        for _, body in branches:
                            visit(body, True)

        for when in self._model.whens:
            for branch in when.branches:
                visit(branch.body, True)
        for algorithm in self._model.algorithms:
            visit(algorithm.statements, False)
        return names
