"""The author's form: a chapter of the calculation, written quantity by quantity in the order in which they are calculated.

Each method declares one step: its id, symbol, unit and description, then what gives it. A formula is a lambda whose parameters
are named for the quantities that it takes (``lambda radius, height: radius - height``), or ``bind(formula, parameter="id")``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Unpack

from diecut_report.contract.between import Between, Interpolation
from diecut_report.contract.binding import as_binding, bind
from diecut_report.contract.code_steps import CodeForm
from diecut_report.contract.listings import ListingForm
from diecut_report.contract.made_curves import MadeCurveForm
from diecut_report.contract.options import Options, StepCondition, Written
from diecut_report.contract.part_steps import Interpolated, Lookup, Neighbour, Part, Pick, Running, Total
from diecut_report.contract.phases import PhaseForm
from diecut_report.contract.place import Misdeclared, placed
from diecut_report.contract.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Case,
    Choice,
    Clash,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    Operation,
    Reduction,
    Require,
    Root,
    Step,
    Value,
    Words,
)
from diecut_report.errors import nearest
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.standards import StandardSeries, StandardTable


@dataclass(eq=False)
class Steps(PhaseForm, MadeCurveForm, CodeForm, ListingForm):
    """Hold declared steps in the order in which they are calculated; a family of them may be added to several chapters."""

    steps: Sequence[Step] = field(default=(), kw_only=True)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def add(self, *steps: Step | Iterable[Any]) -> None:
        """Add steps that are declared elsewhere: a family, several of them, or what several chapters share."""
        for step in steps:
            if isinstance(step, Step):
                if any(step is other for other in self.steps):
                    raise Misdeclared(Phrase("{id} is added twice; add it once", id=step.id))
                self.steps = (*self.steps, step)
            else:
                self.add(*step)

    def value(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        formula: Written,
        *,
        per_piece: bool = False,
        **options: Unpack[Options],
    ) -> None:
        """Declare a closed formula: a number, a curve where it takes a curve or an abscissa, a row over repeated parts.

        ``per_piece`` marks a flag of a curve's smooth pieces (direction of motion, cutting), taken at the middle of the piece.
        """
        self._give(Value, id, symbol, unit, description, options, formula=as_binding(formula, id), per_piece=per_piece)

    def choice(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        *cases: Case,
        per_piece: bool = False,
        **options: Unpack[Options],
    ) -> None:
        """Declare a value (number or text) chosen by conditions; the last case has none. The branch taken is printed."""
        self._give(
            Choice,
            id,
            symbol,
            unit,
            description,
            options,
            cases=cases,
            per_piece=per_piece,
        )

    def root(
        self, id: str, symbol: str, unit: str, description: str, equation: Written, *, low: Written, high: Written, left: Written,
        right: Written, unknown: str = "", tolerance: float = 1e-9, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a root in [low, high] of ``equation``, zero there; ``left`` = ``right`` is printed and proves it.

        The equation names the unknown by this step's id, or by ``unknown``.
        """
        parts = {"equation": equation, "low": low, "high": high, "left": left, "right": right}
        bound = {name: as_binding(part, f"{id} ({name})") for name, part in parts.items()}
        self._give(Root, id, symbol, unit, description, options, unknown=unknown or id, tolerance=tolerance, **bound)

    def abscissa(
        self, id: str, symbol: str, unit: str, description: str, period: float | str, *, points: str = "n_points", shown_at: str = "",
        intervals: int = 64, speed: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare what curves run over, [0, period): see ``Abscissa``."""
        own = {"period": period, "points": points, "shown_at": shown_at, "intervals": intervals, "speed": speed}
        self._give(Abscissa, id, symbol, unit, description, options, **own)

    def breakpoints(self, id: str, abscissa: str, *places: str, every: str = "", **when: Unpack[StepCondition]) -> None:
        """Declare places of an abscissa where a curve jumps or has a corner: see ``Breakpoints``."""
        self.add(Breakpoints(id=id, abscissa=abscissa, places=places, every=every, **when))

    def crossings(self, id: str, symbol: str, unit: str, description: str, of: str, **options: Unpack[Options]) -> None:
        """Declare all places where the curve ``of`` changes its sign: outputs ``ID_count``, ``ID_1``, ``ID_2`` …"""
        self._give(Crossings, id, symbol, unit, description, options, of=of)

    def reduction(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        operation: Operation,
        of: str,
        **options: Unpack[Options],
    ) -> None:
        """Declare one number of the curve ``of`` over its abscissa; extremes also give their place, the quantity ``ID_at``."""
        self._give(Reduction, id, symbol, unit, description, options, operation=operation, of=of)

    def accumulated(
        self, id: str, symbol: str, unit: str, description: str, of: str, **options: Unpack[Options]
    ) -> None:
        """Declare the running integral of the curve ``of`` over its abscissa, a curve."""
        self._give(Accumulated, id, symbol, unit, description, options, of=of)

    def derivative(
        self, id: str, symbol: str, unit: str, description: str, of: str, **options: Unpack[Options]
    ) -> None:
        """Declare the derivative of the curve ``of`` by its abscissa, a curve."""
        self._give(Derivative, id, symbol, unit, description, options, of=of)

    def computed(
        self, id: str, symbol: str, unit: str, description: str, function: Callable[..., Any], takes: tuple[str, ...], method: str,
        *, over: str = "", is_text: bool = False, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a number that plain code finds, where no closed formula tells it: see ``Computed``."""
        own = {"function": function, "takes": takes, "method": method, "over": over}
        self._give(Computed, id, symbol, unit, description, options, **own, is_text=is_text)

    def curve_period(
        self, id: str, symbol: str, unit: str, description: str, given: str, otherwise: str, **options: Unpack[Options]
    ) -> None:
        """Declare the period of what the curve input ``given`` refers to: see ``CurvePeriod``."""
        self._give(CurvePeriod, id, symbol, unit, description, options, given=given, otherwise=otherwise)

    def from_curve(
        self, id: str, symbol: str, unit: str, description: str, given: str, abscissa: str, *, start: str = "", lasts: str = "",
        gains: bool = False, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a curve input taken over as a curve of this mechanism: see ``FromCurve``."""
        own = {"given": given, "abscissa": abscissa, "start": start, "lasts": lasts, "gains": gains}
        self._give(FromCurve, id, symbol, unit, description, options, **own)

    def require(self, id: str, condition: Written, key: str, message: str, **when: Unpack[StepCondition]) -> None:
        """Declare what must hold for the machine to be possible, the key to change, and what is said where it does not."""
        self.add(Require(id=id, condition=as_binding(condition, id), key=key, message=message, **when))

    def clash(
        self, id: str, function: Callable[..., Array], takes: tuple[str, ...], key: str, message: str, **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare which of repeated parts stand in each other's way: see ``Clash``."""
        self.add(Clash(id=id, function=function, takes=takes, key=key, message=message, **when))

    def words(
        self,
        id: str,
        function: Callable[..., str | tuple[str, ...]],
        takes: tuple[str, ...],
        *,
        each_part: bool = False,
        output: bool = True,
        **when: Unpack[StepCondition],
    ) -> None:
        """Declare a text that plain code makes of numbers, for messages: see ``Words``."""
        self.add(Words(id=id, function=function, takes=takes, each_part=each_part, output=output, **when))

    def total(
        self, id: str, symbol: str, unit: str, description: str, operation: Literal["sum", "product", "min", "max"], of: str, *,
        among: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare the sum, product, least or greatest of a row, or of its parts where the row ``among`` is above zero."""
        self._give(Total, id, symbol, unit, description, options, operation=operation, of=of, among=among)

    def neighbour(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        of: str,
        shift: Literal[1, -1] = 1,
        **options: Unpack[Options],
    ) -> None:
        """Declare a row: the value of the next part (1) or of the one before (-1), the parts standing in a closed loop."""
        self._give(Neighbour, id, symbol, unit, description, options, of=of, shift=shift)

    def running(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        operation: Literal["sum", "product"],
        of: str,
        **options: Unpack[Options],
    ) -> None:
        """Declare a row: the sum or product of a row's parts from the first one up to each."""
        self._give(Running, id, symbol, unit, description, options, operation=operation, of=of)

    def part(
        self, id: str, symbol: str, unit: str, description: str, of: str, index: int, **options: Unpack[Options]
    ) -> None:
        """Declare the value of one part of a row: the first (``index`` = 0), the last (-1)."""
        self._give(Part, id, symbol, unit, description, options, of=of, index=index)

    def lookup(
        self, id: str, symbol: str, unit: str, description: str, table: Mapping[str, float] | StandardTable, by: str, *,
        column: str = "", given: str = "", sought_in: str = "", key: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a number from a row of a table, by the text input or the number ``by``: see ``Lookup``.

        ``column`` is one of several columns; with the optional input ``given`` its value is taken where it is given.
        """
        own = {"table": table, "by": by, "column": column, "given": given, "sought_in": sought_in, "key": key}
        self._give(Lookup, id, symbol, unit, description, options, **own)

    def interpolated(
        self, id: str, symbol: str, unit: str, description: str, table: StandardTable, of: str, *, column: str = "", key: str = "",
        interpolation: Interpolation = "linear", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a value between the rows of a table of numbers, by the quantity ``of``: see ``Interpolated``."""
        formula = bind(Between(table, column, id, interpolation), x=of)
        own = {"formula": formula, "of": of, "table": table, "column": column, "key": key}
        self._give(Interpolated, id, symbol, unit, description, options, **own)

    def pick(
        self, id: str, symbol: str, unit: str, description: str, rule: Literal["above", "below", "nearest"], of: str,
        series: tuple[float, ...] | StandardSeries | Mapping[str, StandardSeries], *, by: str = "",
        beyond: Literal["impossible", "last"] = "impossible", given: str = "", key: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a value of a standard series, taken by the quantity ``of``; its neighbours are printed: see ``Pick``.

        With the optional input ``given`` its value is taken where it is given.
        """
        own = {"rule": rule, "of": of, "series": series, "by": by, "beyond": beyond, "given": given, "key": key}
        self._give(Pick, id, symbol, unit, description, options, **own)

    def _give(
        self, kind: type[Step], id: str, symbol: str, unit: str, description: str, options: Options, **own: Any
    ) -> None:
        """Declare a step that gives a quantity."""
        given: dict[str, Any] = {"symbol": symbol, "unit": unit, "description": description, **options, **own}
        exists = options.get("exists")
        given["exists"] = None if exists is None else as_binding(exists, f"{id} (exists)")
        for name in given.keys() - (known := kind.__dataclass_fields__).keys():
            raise Misdeclared(Phrase("{id} has no option {name}{near}", id=id, name=name, near=nearest(name, known)))
        self.add(kind(id=id, **given))


MISSING = "{missing}"  # in the words of a chapter that is left out: the keys that are not given


@dataclass(eq=False)
class Chapter(Steps):
    """Declare a chapter of the calculation; ``absent`` says in words what it lacks: ``{missing}`` are the needed keys not given."""

    title: str
    text: str = field(default="", kw_only=True)
    needs: tuple[str, ...] = field(default=(), kw_only=True)
    absent: str = field(default="", kw_only=True)
    at: str = placed()
