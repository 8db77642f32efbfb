"""The flattened model as the front end hands it over: Modelica's own expressions, arrays not yet expanded."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from contact_foundation.errors import InputError

from modelica2fmu.library.source_map import Span

# --- expressions ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Literal:
    """A Real, Integer, Boolean or String literal."""

    value: float | int | bool | str
    span: Span | None = None


@dataclass(frozen=True)
class Reference:
    """A component reference: its parts with the subscripts that stand inside, and the trailing subscripts.

    Attributes:
        name: parts joined by dots, constant inner subscripts included (``frame[1].R.T``).
        parts: identifier and inner subscripts of each part.
        subscripts: trailing subscripts.
    """

    name: str
    parts: tuple[tuple[str, tuple[Subscript, ...]], ...]
    subscripts: tuple[Subscript, ...] = ()
    span: Span | None = None


@dataclass(frozen=True)
class Colon:
    """The subscript ``:``."""


@dataclass(frozen=True)
class Indexed:
    """``base[subscripts]``."""

    base: Expression
    subscripts: tuple[Subscript, ...]
    span: Span | None = None


@dataclass(frozen=True)
class FieldAccess:
    """``base.name`` of a record value."""

    base: Expression
    name: str
    span: Span | None = None


@dataclass(frozen=True)
class Unary:
    """``minus``, ``plus`` or ``not``."""

    op: str
    operand: Expression
    span: Span | None = None


@dataclass(frozen=True)
class Binary:
    """An arithmetic, relational or logical operation, by the front end's name (``Add``, ``MulElem``, ``Lt``)."""

    op: str
    left: Expression
    right: Expression
    span: Span | None = None


@dataclass(frozen=True)
class Builtin:
    """A call of an operator or function built into the language, by its name in Modelica."""

    name: str
    args: tuple[Expression, ...]
    span: Span | None = None


@dataclass(frozen=True)
class Call:
    """A call of a function or record constructor; arguments in the order of the inputs."""

    name: str
    args: tuple[Expression, ...]
    is_constructor: bool = False
    span: Span | None = None


@dataclass(frozen=True)
class If:
    """An if-expression."""

    branches: tuple[tuple[Expression, Expression], ...]
    otherwise: Expression
    span: Span | None = None


class Concatenation(Enum):
    """How an array is put together: ``{a, b}``, ``[a, b]`` or ``[a; b]``."""

    ARRAY = "array"
    HORIZONTAL = "horizontal"
    VERTICAL = "vertical"


@dataclass(frozen=True)
class ArrayConstructor:
    """``{a, b}``, ``[a, b]`` or ``[a; b]``."""

    elements: tuple[Expression, ...]
    kind: Concatenation = Concatenation.ARRAY
    span: Span | None = None


@dataclass(frozen=True)
class TupleExpression:
    """``(a, b)`` on the left of a call with several outputs; ``None`` where an output is left out."""

    elements: tuple[Expression | None, ...]
    span: Span | None = None


@dataclass(frozen=True)
class Range:
    """``start:step:stop``."""

    start: Expression
    step: Expression | None
    stop: Expression
    span: Span | None = None


@dataclass(frozen=True)
class Comprehension:
    """``{expression for i in range, ...}``."""

    expression: Expression
    indices: tuple[tuple[str, Expression], ...]
    span: Span | None = None


@dataclass(frozen=True)
class StringConversion:
    """``String(value, ...)``."""

    value: Expression
    significant_digits: Expression | None = None
    minimum_length: Expression | None = None
    left_justified: Expression | None = None
    span: Span | None = None


Expression = (
    Literal
    | Reference
    | Indexed
    | FieldAccess
    | Unary
    | Binary
    | Builtin
    | Call
    | If
    | ArrayConstructor
    | TupleExpression
    | Range
    | Comprehension
    | StringConversion
)
Subscript = Colon | Expression


# --- statements ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Assignment:
    """``target := value``."""

    target: Reference
    value: Expression
    span: Span | None = None


@dataclass(frozen=True)
class CallAssignment:
    """``(targets) := function(args)``; ``None`` where an output is left out."""

    targets: tuple[Reference | None, ...]
    call: Call
    span: Span | None = None


@dataclass(frozen=True)
class For:
    """A for-statement; several indices are nested, the first outermost."""

    indices: tuple[tuple[str, Expression], ...]
    body: tuple[Statement, ...]
    span: Span | None = None


@dataclass(frozen=True)
class While:
    """A while-statement."""

    condition: Expression
    body: tuple[Statement, ...]
    span: Span | None = None


@dataclass(frozen=True)
class IfStatement:
    """An if-statement."""

    branches: tuple[tuple[Expression, tuple[Statement, ...]], ...]
    otherwise: tuple[Statement, ...]
    span: Span | None = None


@dataclass(frozen=True)
class WhenStatement:
    """A when-statement of a model's algorithm, with its elsewhen branches."""

    branches: tuple[tuple[Expression, tuple[Statement, ...]], ...]
    span: Span | None = None


@dataclass(frozen=True)
class Assert:
    """``assert(condition, message, level)``."""

    condition: Expression
    message: Expression
    is_warning: bool = False
    span: Span | None = None


@dataclass(frozen=True)
class Terminate:
    """``terminate(message)``."""

    message: Expression
    span: Span | None = None


@dataclass(frozen=True)
class Reinit:
    """``reinit(state, value)``."""

    state: Reference
    value: Expression
    span: Span | None = None


@dataclass(frozen=True)
class Break:
    """``break``."""

    span: Span | None = None


@dataclass(frozen=True)
class Return:
    """``return``."""

    span: Span | None = None


Statement = (
    Assignment
    | CallAssignment
    | For
    | While
    | IfStatement
    | WhenStatement
    | Assert
    | Terminate
    | Reinit
    | Break
    | Return
)


# --- functions -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FunctionVariable:
    """An input, output or protected variable of a function.

    Attributes:
        type: ``Real``, ``Integer``, ``Boolean``, ``String`` or a record's or enumeration's name.
        shape: declared dimensions; ``Colon`` where the argument decides.
        default: binding or default argument.
        rank: number of its dimensions, those of its type included.
    """

    name: str
    type: str
    shape: tuple[Subscript, ...] = ()
    default: Expression | None = None
    is_record: bool = False
    rank: int = 0


@dataclass(frozen=True)
class External:
    """The external declaration of a function.

    Attributes:
        language: ``C`` or another.
        name: of the C function.
        result: output that gets the C function's return value, if any.
        args: arguments in the order of the call: references to inputs and outputs, ``size`` calls, literals.
        annotations: Include, IncludeDirectory, Library, LibraryDirectory, each with its texts.
    """

    language: str
    name: str
    result: str | None
    args: tuple[Expression, ...]
    annotations: tuple[tuple[str, tuple[str, ...]], ...] = ()


@dataclass(frozen=True)
class Function:
    """A function, or a record constructor.

    Attributes:
        is_unproven: = true, if the front end has checked no sizes in it.
    """

    name: str
    inputs: tuple[FunctionVariable, ...]
    outputs: tuple[FunctionVariable, ...]
    locals: tuple[FunctionVariable, ...]
    body: tuple[Statement, ...]
    external: External | None = None
    is_constructor: bool = False
    span: Span | None = None
    is_unproven: bool = False


# --- model ---------------------------------------------------------------------------------------------------


class StateSelect(Enum):
    """Modelica's StateSelect, in rising order of preference."""

    NEVER = 1
    AVOID = 2
    DEFAULT = 3
    PREFER = 4
    ALWAYS = 5


@dataclass(frozen=True)
class Variable:
    """A component of predefined type, scalar or array.

    Attributes:
        type: ``Real``, ``Integer``, ``Boolean``, ``String`` or the name of an enumeration type.
        variability: ``constant``, ``parameter``, ``discrete`` or ``continuous`` (as declared).
        causality: ``input``, ``output`` or empty.
        fixed: one flag, or one an element; ``None`` if not given.
        evaluate: = true, if the parameter is final or has annotation Evaluate=true.
        orientation: name of the Orientation record whose field this is, if any.
    """

    name: str
    type: str
    shape: tuple[int, ...]
    variability: str = "continuous"
    causality: str = ""
    binding: Expression | None = None
    start: Expression | None = None
    fixed: tuple[bool, ...] | None = None
    minimum: Expression | None = None
    maximum: Expression | None = None
    nominal: Expression | None = None
    unit: str = ""
    display_unit: str = ""
    quantity: str = ""
    description: str = ""
    state_select: StateSelect = StateSelect.DEFAULT
    evaluate: bool = False
    is_top_level: bool = False
    is_protected: bool = False
    orientation: str | None = None
    span: Span | None = None


@dataclass(frozen=True)
class Equation:
    """``residual = 0``, or ``left = right`` where the residual is a difference."""

    residual: Expression
    span: Span | None = None


@dataclass(frozen=True)
class WhenBranch:
    """``when condition`` or ``elsewhen condition`` with its equations as statements."""

    condition: Expression
    body: tuple[Statement, ...]


@dataclass(frozen=True)
class When:
    """A when-equation with its elsewhen branches."""

    branches: tuple[WhenBranch, ...]
    span: Span | None = None


@dataclass(frozen=True)
class Algorithm:
    """An algorithm section."""

    statements: tuple[Statement, ...]
    outputs: tuple[str, ...]
    span: Span | None = None


@dataclass(frozen=True)
class RecordType:
    """A record's name and the names of its fields, in order."""

    name: str
    fields: tuple[str, ...]


@dataclass(frozen=True)
class FlatModel:
    """A flattened model."""

    name: str
    description: str
    variables: dict[str, Variable]
    records: dict[str, RecordType]  # by the name of the component
    equations: tuple[Equation, ...]
    initial_equations: tuple[Equation, ...]
    asserts: tuple[Assert, ...]
    initial_asserts: tuple[Assert, ...]
    whens: tuple[When, ...]
    algorithms: tuple[Algorithm, ...]
    initial_algorithms: tuple[Algorithm, ...]
    functions: dict[str, Function]
    enumeration_literals: dict[str, int]
    record_types: dict[str, RecordType] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()  # assumptions the user should know of
    refusal: InputError | None = None  # of a model that is not balanced, where nothing that comes after says why
