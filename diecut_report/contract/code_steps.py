"""Steps of plain code over prepared objects: curves for all variants, and repeated parts that follow from the inputs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Unpack

from diecut_report.contract.options import Options
from diecut_report.contract.phases import StepHolder
from diecut_report.contract.steps import SilentStep, Step
from diecut_report.expressions import Array


@dataclass(frozen=True, kw_only=True, eq=False)
class ComputedCurve(Step):
    """Declare a curve over ``abscissa`` that plain code gives for all variants, from the prepared object ``of``.

    ``function`` takes it, the places x of shape (rows, points), the middles of their smooth pieces (of any shape that broadcasts to
    that) and the variants ``rows`` (None: all, or the only one); it gives values of the shape of x. ``joints`` gives from the object
    the places where the curve jumps or has a corner, of shape (variants, places), NaN where there is none. With ``named_by`` there is a
    curve for each named part: ``function`` takes the part's index before all else.
    """

    of: str
    abscissa: str
    function: Callable[..., Array]
    method: str
    joints: Callable[[Any], Array] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class PartNames(SilentStep):
    """Declare repeated parts that are no list of the inputs, but follow from them: ``function`` gives their names.

    Rows run over its id. Formulas of them are shown with the numbers of the part ``shown_at`` (the id of its index from 0).
    """

    function: Callable[..., list[str]]
    takes: tuple[str, ...]
    shown_at: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class PartTable(SilentStep):
    """Declare a table that is printed here: the rows ``columns`` over the declared ``parts``, a line for each by its name."""

    parts: str
    columns: tuple[str, ...]


class CodeForm:
    """Give chapters the calls that declare these steps."""

    def computed_curve(
        self: StepHolder, id: str, symbol: str, unit: str, description: str, function: Callable[..., Array], of: str, abscissa: str,
        method: str, *, joints: Callable[[Any], Array] | None = None, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a curve that plain code gives: see ``ComputedCurve``."""
        own: dict[str, Any] = {"function": function, "of": of, "abscissa": abscissa, "method": method, "joints": joints}
        self.add(ComputedCurve(id=id, symbol=symbol, unit=unit, description=description, **own, **options))  # type: ignore[arg-type]

    def part_names(
        self: StepHolder, id: str, description: str, function: Callable[..., list[str]], takes: tuple[str, ...], *, shown_at: str = ""
    ) -> None:  # fmt: skip
        """Declare repeated parts that follow from the inputs: see ``PartNames``."""
        self.add(PartNames(id=id, description=description, function=function, takes=takes, shown_at=shown_at))

    def part_table(self: StepHolder, id: str, description: str, parts: str, columns: tuple[str, ...]) -> None:
        """Declare a table of rows over such parts, printed here: see ``PartTable``."""
        self.add(PartTable(id=id, description=description, parts=parts, columns=columns))
