"""What a step may take, and the protocols of what checks, runs and prints it: the declaration check, the engine, the printer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.names import ByText, Written, formula_of
from diecut_report.text.phrases import phrase

# What a name may stand for, and what a step may take.

Kinds = frozenset[str]
NUMBER: Kinds = frozenset({"number"})
ROW: Kinds = frozenset({"number", "row"})
CURVE: Kinds = frozenset({"number", "row", "curve", "abscissa"})
CURVE_INPUT: Kinds = frozenset({"curve input"})
ANY: Kinds = frozenset()  # of what is not asked for
PLAIN: Kinds = ROW | {"text", "curve input", "phase", "mechanism", "prepared", "crossings", "varying"}
A_CURVE, AN_ABSCISSA, A_ROW = (frozenset({kind}) for kind in ("curve", "abscissa", "row"))
A_PLACE = NUMBER | {"crossings"}
PREPARED: Kinds = frozenset({"prepared"})
PARTS: Kinds = frozenset({"list of parts", "block"})
HELD = PLAIN | {"block"}
SAID = ROW | {"text", "prepared", "mechanism"} | CURVE_INPUT
WANTED = {
    NUMBER: phrase("a single number"), ROW: phrase("a number or a row over repeated parts"), CURVE: phrase("a number, a row or a curve"),
    CURVE_INPUT: phrase("an input declared as a CurveInput"), PARTS: phrase("the id of PartNames"),
    A_CURVE: phrase("a curve over an abscissa"), AN_ABSCISSA: phrase("the id of an Abscissa"), A_ROW: phrase("a row over repeated parts"),
    A_PLACE: phrase("a number or found crossings"), PREPARED: phrase("what is prepared"), HELD: phrase("an input or a number"),
    SAID: phrase("a number or a text"), PLAIN: phrase("a number, a text, or what is taken by reference"),
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
    def options(self) -> tuple[Formula, ...]:
        """Return it; of a choice by a text the formulas of all its values."""
        return self.formula.options() if isinstance(self.formula, ByText) else (formula_of(self.formula),)


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
    def world(self) -> Any: ...
    def givers(self, name: str) -> list[Any]: ...
    def axes(self, name: str) -> set[str]: ...
    def units(self, name: str) -> set[str]: ...
    def without(self, when: Any, given: str) -> Any: ...
    def incomplete(self, by: str, rows: Mapping[str, Any], when: Any, none: str) -> Iterator[str]: ...


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
    def curves(self) -> dict[str, Any]: ...
    @property
    def domains(self) -> Mapping[str, Any]: ...
    @property
    def possible(self) -> Array: ...
    def __getitem__(self, name: str) -> Array: ...
    def apply(self, part: Written) -> Array: ...
    def existing(self, step: Any, values: Array) -> Array: ...
    def step_or_input(self, name: str) -> Any: ...


class StepEngine(MachineValues, Protocol):
    """Run the steps of a calculation."""

    SAME_HEIGHT: float

    def part_count(self, over: str) -> int | None: ...
    def mark(self, step: Any, bad: Array, words: str) -> None: ...
    def prove(self, step: Any, residual: Array, tolerance: float = ...) -> None: ...
    def refuse(self, variant: int, key: str, message: str) -> None: ...
    def filled(self, text: str, variant: int, places: Mapping[str, int]) -> str: ...
    def open_abscissa(self, step: Any, period: Array, points: int, intervals: int) -> None: ...
    def root(self, step: Any) -> tuple[Array, Array]: ...
    def proves_nothing(self, step: Any) -> Array: ...
    def extreme(self, curve: str, sign: float) -> tuple[Array, Array, Array]: ...
    def beyond(self, curve: str, value: Array, sign: float) -> Array: ...
    def crossings(self, curve: str) -> tuple[Array, Array]: ...
    def fails(self, step: Any, axis: str) -> dict[int, float]: ...
    def integral(self, curve: str, power: int) -> tuple[Array, Array]: ...
    def accumulate(self, step: Any) -> Array: ...
    def differentiate(self, step: Any) -> Array: ...
    def add_curves(self, curves: Mapping[str, Any], axis: str) -> None: ...
    def withdraw(self, fact: str) -> None: ...
    def call(self, step: Any, taken: Sequence[Any]) -> Any: ...
    def computed(self, step: Any, taken: Sequence[Any]) -> Any: ...
    def prepared(self, step: Any, known: Mapping[str, Any]) -> Any: ...
    def names_of_parts(self, step: Any) -> tuple[str, ...] | None: ...
    def again(self, step: Any) -> Any: ...


class StepPrinter(Protocol):
    """Print numbers, formulas and tables of one calculated machine."""

    @property
    def calc(self) -> MachineValues: ...
    def value_at(self, name: str, axis: str | None, *, part: int | None = ...) -> float: ...
    def shown_part(self, name: str) -> int: ...
    def result(self, step: Any, value: float) -> Item: ...
    def printed(self, name: str) -> str: ...
    def place(self, axis: str, place: float) -> Item: ...
    def shown(self, axis: str) -> Item: ...
    def residual(self, step: Any) -> Item: ...
    def over_axis(self, step: Any) -> tuple[bool, Item]: ...
    def formula(self, step: Any, part: Formula, elsewhere: bool = ...) -> Item: ...
    def sides(self, part: Formula, held: bool, axis: str | None = ..., elsewhere: bool = ...) -> tuple[Any, Any]: ...
    def symbolic(self, part: Formula) -> Any: ...
    def case_taken(self, step: Any, elsewhere: bool) -> int: ...
    def parts_shown(self, step: Any, item: Item, names: Sequence[str]) -> list[Item]: ...
    def has_tables(self, parts: str) -> bool: ...
    def is_index(self, name: str) -> bool: ...
    def table(self, step: Any, names: Sequence[str]) -> Item: ...
    def table_of_parts(self, step: Any, parts: str, names: Sequence[str]) -> Item: ...
    def table_of_places(self, step: Any, places: Sequence[float]) -> Item: ...
    def table_of_curves(self, step: Any, at: Item) -> Item: ...
    def listing(self, step: Any) -> list[Item]: ...
