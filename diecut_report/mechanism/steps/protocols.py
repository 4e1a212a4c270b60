"""What a step may take, and the protocols of what checks, runs and prints it: the declaration check, the engine, the printer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from diecut_report.formulas import Array
from diecut_report.mechanism.names import Bound, ByText, Written, bound
from diecut_report.text.phrases import phrase

# What a name may stand for, and what a step may take.

Kinds = frozenset[str]
NUMBER: Kinds = frozenset({"number"})
ROW: Kinds = frozenset({"number", "row"})
CURVE: Kinds = frozenset({"number", "row", "curve", "abscissa"})
CURVE_INPUT: Kinds = frozenset({"curve input"})
ANY: Kinds = frozenset()  # of what is not asked for
PLAIN: Kinds = ROW | {"text", "curve input", "phase", "mechanism", "prepared", "crossings", "varying"}
A_CURVE = frozenset({"curve"}), phrase("a curve over an abscissa")
A_VALUE = phrase("a number, a text, or what is taken by reference")
AN_ABSCISSA = frozenset({"abscissa"}), phrase("the id of an Abscissa")
A_ROW = frozenset({"row"}), phrase("a row over repeated parts")
WANTED = {
    NUMBER: phrase("a single number"), ROW: phrase("a number or a row over repeated parts"), CURVE: phrase("a number, a row or a curve"),
    CURVE_INPUT: phrase("an input declared as a CurveInput"), frozenset({"list of parts", "block"}): phrase("the id of PartNames"),
}  # fmt: skip
LABELS = {
    "formula": (phrase("formula"), phrase("the formula")),
    "equation": (phrase("equation"), phrase("equation")),
    "condition": (phrase("condition"), phrase("the condition")),
}
OF_UNIT = ("formula", "low", "high")  # formulas that give a quantity of the step's unit

Item = dict[str, Any]  # what is printed


class TakenName(NamedTuple):
    """Hold what a step takes by a field: the name, what it may stand for, and in words what is wanted."""

    field: str
    name: str
    allowed: Kinds
    wanted: str = ""

    @property
    def wanted_text(self) -> str:
        """Return in words what is wanted."""
        return self.wanted or WANTED[self.allowed]


class StepFormula(NamedTuple):
    """Hold a formula of a step: what it is called as a part and as a field, whether it gives the step's unit, and what it may take."""

    part: str
    field: str
    formula: Written
    is_of_unit: bool
    takes: Kinds
    is_condition: bool = False

    @property
    def options(self) -> tuple[Bound, ...]:
        """Return it bound to what it takes; of a choice by a text the formulas of all its values."""
        return self.formula.options() if isinstance(self.formula, ByText) else (bound(self.formula),)


class Called(NamedTuple):
    """Hold how many things a function is called with, by position, and which in words."""

    arguments: int
    words: str = ""


class Impossible(Exception):
    """Report that the machine cannot exist: the keys to change, each with the reason in words."""

    def __init__(self, reasons: Sequence[tuple[str, str]]) -> None:
        super().__init__("; ".join(message for _, message in reasons))
        self.reasons = tuple(reasons)
        self.key, self.message = self.reasons[0]


class ImpossibleTogether(Impossible):
    """Report that plain code refuses many machines at once, which does not say whether each of them cannot exist."""


class Names(Protocol):
    """Answer what a mechanism's names stand for, while its declaration is checked."""

    @property
    def world(self) -> Any:
        """Return the inputs, and which of them may be given together."""

    def givers(self, name: str) -> list[Any]:
        """Return what gives a name: inputs and steps."""

    def axes(self, name: str) -> set[str]:
        """Return the abscissas or lists that a name may run over."""

    def units(self, name: str) -> set[str]:
        """Return the units that a quantity may have."""

    def without(self, when: Any, given: str) -> Any:
        """Return when something is made while an input is not given."""

    def incomplete(self, by: str, rows: Mapping[str, Any], when: Any, none: str) -> Iterator[str]:
        """Yield what is wrong with a choice by a text: each text that may be given has its row."""


class MachineValues(Protocol):
    """Hold what is known of one machine, or of many variants at once; numbers have the shape (variants, 1), rows (variants, parts)."""

    count: int
    is_partial: bool
    meta: dict[str, Any]
    inputs: dict[str, Any]
    values: dict[str, Array]
    steps: dict[str, Any]
    axis: dict[str, str]
    branch: dict[str, Array]
    middle: dict[str, Array]
    proof: dict[str, float]
    part_names: dict[str, tuple[str, ...]]
    withheld: dict[str, Array]
    flaws: dict[int, tuple[str, str]]

    @property
    def curves(self) -> dict[str, Any]:
        """The curves that are known, as they are declared."""

    @property
    def domains(self) -> Mapping[str, Any]:
        """The abscissas with their smooth pieces."""

    @property
    def possible(self) -> Array:
        """Which variants are possible, as far as is known."""

    def __getitem__(self, name: str) -> Array:
        """A quantity, or an input."""

    def apply(self, part: Written) -> Array:
        """Return what a formula of numbers or rows gives."""

    def existing(self, step: Any, values: Array) -> Array:
        """Return a quantity's numbers, NaN for the machines that do not have it."""

    def step_or_input(self, name: str) -> Any:
        """Return what declares a quantity: its symbol, unit and description."""


class StepEngine(MachineValues, Protocol):
    """Run the steps of a calculation."""

    SAME_HEIGHT: float

    def mark(self, step: Any, bad: Array, words: str) -> None:
        """Refuse a single machine as not proved; mark these variants among several."""

    def prove(self, step: Any, residual: Array, tolerance: float = ...) -> None:
        """Refuse a result whose residual is greater; keep the residual for print."""

    def refuse(self, variant: int, key: str, message: str) -> None:
        """Mark a variant as impossible, with the key to change, unless it is already; a single machine is refused."""

    def filled(self, text: str, variant: int, places: Mapping[str, int]) -> str:
        """Return a message with its ``{ids}`` printed."""

    def open_abscissa(self, step: Any, period: Array, points: int, intervals: int) -> None:
        """Let curves run over a step's abscissa."""

    def root(self, step: Any) -> tuple[Array, Array]:
        """Find a root in its bracket, and how far the relation that proves it is off."""

    def extreme(self, curve: str, sign: float) -> tuple[Array, Array, Array]:
        """Return a curve's greatest (sign 1) or least value, its place, and the middle of its smooth piece."""

    def beyond(self, curve: str, value: Array, sign: float) -> Array:
        """Return how far a curve is beyond an extreme that was found, relative, at other places."""

    def crossings(self, curve: str) -> tuple[Array, Array]:
        """Return the places where a curve changes its sign, NaN-padded, and what is left of the curve there."""

    def integral(self, curve: str, power: int) -> tuple[Array, Array]:
        """Return the integral of a curve's power over the period, and how far another rule is from it."""

    def accumulate(self, step: Any) -> Array:
        """Make the running integral of a curve known; return how far another rule is from it."""

    def differentiate(self, step: Any) -> Array:
        """Make the derivative of a curve known; return how far its series is from the curve."""

    def add_curves(self, curves: Mapping[str, Any], axis: str) -> None:
        """Take note of curves that plain code gives."""

    def withdraw(self, fact: str) -> None:
        """Let the steps take no part that need a fact which no machine meets."""

    def call(self, step: Any, taken: Sequence[Any]) -> Any:
        """Call plain code; what it refuses is an impossible machine."""

    def computed(self, step: Any, taken: Sequence[Any]) -> Any:
        """Call plain code, for each of many machines where what it takes knows one alone."""

    def prepared(self, step: Any, known: Mapping[str, Any]) -> Any:
        """Call plain code that knows one machine, for each of many, with a mapping."""

    def names_of_parts(self, step: Any) -> tuple[str, ...] | None:
        """Return the names of the parts of a row or curve; Impossible where a result would be called as another one."""

    def again(self, step: Any) -> Any:
        """Return what calculates the same machines with other inputs."""


class StepPrinter(Protocol):
    """Print numbers, formulas and tables of one calculated machine."""

    @property
    def calc(self) -> MachineValues:
        """The calculation."""

    def value_at(self, name: str, axis: str | None) -> float:
        """Return a number, a curve's value where formulas are shown, or that of the part that is shown."""

    def result(self, step: Any, value: float) -> Item:
        """Return a number that a step gives as text, in its unit."""

    def printed(self, name: str) -> str:
        """Return a quantity as one would say it."""

    def place(self, axis: str, place: float) -> Item:
        """Return a place of an abscissa as text."""

    def shown(self, axis: str) -> Item:
        """Return the place of an abscissa at which formulas are shown."""

    def residual(self, step: Any) -> Item:
        """Return by how much a result missed what proves it."""

    def over_axis(self, step: Any) -> tuple[bool, Item]:
        """Return whether a flag is shown in the middle of its smooth piece, and where a formula over an abscissa is shown."""

    def formula(self, step: Any, part: Bound, elsewhere: bool = ...) -> Item:
        """Return a formula in symbols, with numbers in, and its result."""

    def sides(self, part: Bound, held: bool, axis: str | None = ..., elsewhere: bool = ...) -> tuple[Any, Any]:
        """Return the condition that holds, this one or its opposite, in symbols and with numbers."""

    def symbolic(self, part: Bound) -> Any:
        """Return a formula in symbols."""

    def case_taken(self, step: Any, elsewhere: bool) -> int:
        """Return which case of a choice is taken where formulas are shown."""

    def parts_shown(self, step: Any, item: Item, names: Sequence[str]) -> list[Item]:
        """Return the formula of a row with the part that it is shown for, and the row as a table beside what it takes."""

    def has_tables(self, parts: str) -> bool:
        """Return whether rows over repeated parts are printed in tables that are declared."""

    def is_index(self, name: str) -> bool:
        """Return whether a quantity is the index of the part with whose numbers the formulas of a list are shown."""

    def table(self, step: Any, names: Sequence[str]) -> Item:
        """Return rows over repeated parts as a table, a line for each part."""

    def table_of_parts(self, step: Any, parts: str, names: Sequence[str]) -> Item:
        """Return rows over declared parts, or a list of the inputs: a line for each part by its name."""

    def table_of_places(self, step: Any, places: Sequence[float]) -> Item:
        """Return places of an abscissa as a table."""

    def table_of_curves(self, step: Any, at: Item) -> Item:
        """Return the curves of named parts where they are shown."""

    def listing(self, step: Any) -> list[Item]:
        """Return a table that plain code makes."""
