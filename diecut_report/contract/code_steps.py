"""Steps of plain code over prepared objects: curves for all variants, repeated parts that follow from the inputs, and facts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Unpack

from diecut_report.contract.binding import Binding, as_binding
from diecut_report.contract.options import Options, StepCondition, Written
from diecut_report.contract.phases import StepHolder
from diecut_report.contract.steps import SilentStep, Step
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase


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

    Rows run over its id. Formulas of them are shown with the numbers of the part ``shown_at`` (the id of its index from 0). ``count`` says
    how many parts there are, of a function that tells the length of a list of the inputs; without it rows have no columns in a study.
    """

    function: Callable[..., list[str]]
    takes: tuple[str, ...]
    shown_at: str = ""
    count: Callable[[Callable[[str], int]], int] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class PartTable(SilentStep):
    """Declare a table that is printed here: the rows ``columns`` over the declared ``parts``, a line for each by its name.

    ``parts`` may be a list of the inputs, too: its rows are then printed in such tables alone.
    """

    parts: str
    columns: tuple[str, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class PartCurves(SilentStep):
    """Declare curves over ``abscissa`` of named parts, from the prepared object ``of``: ``ID_1``, ``ID_2`` … in the results.

    ``names`` gives from it the names of the parts, one for each curve; ``function`` takes it, the part's number (from 0), and
    then what that of ``ComputedCurve`` takes. Each is told by the description and the part's name.
    """

    of: str
    abscissa: str
    names: Callable[[Any], Sequence[str]]
    function: Callable[..., Array]
    method: str
    joints: Callable[[Any], Array] | None = None

    def curves(self, of: Any) -> Iterator[ComputedCurve]:
        """Yield the curve of each part."""
        between = "," if "_" in self.symbol else "_"
        for index, name in enumerate(self.names(of)):
            yield ComputedCurve(
                id=f"{self.id}_{index + 1}", symbol=f"{self.symbol}{between}{index + 1}", unit=self.unit, at=self.at, method=self.method,
                description=Phrase("{title}: {name}", title=phrase(self.description), name=name), source=self.source, of=self.of,
                abscissa=self.abscissa,
                function=lambda of, *places, index=index: self.function(of, index, *places),
            )  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Fact(SilentStep):
    """Declare what other steps stand on: they name its id among their ``needs``, as they do with an input.

    Where the condition does not hold for a machine, they are left out for it, and what refers to them is not calculated;
    ``words`` say why. A check that stands on it is then not checked for want of the first key of ``lacks``, with which the fact is not asked.
    """

    condition: Binding
    words: str


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
        self: StepHolder, id: str, description: str, function: Callable[..., list[str]], takes: tuple[str, ...], *, shown_at: str = "",
        count: Callable[[Callable[[str], int]], int] | None = None,
    ) -> None:  # fmt: skip
        """Declare repeated parts that follow from the inputs: see ``PartNames``."""
        self.add(
            PartNames(id=id, description=description, function=function, takes=takes, shown_at=shown_at, count=count)
        )

    def part_table(self: StepHolder, id: str, description: str, parts: str, columns: tuple[str, ...]) -> None:
        """Declare a table of rows over such parts, printed here: see ``PartTable``."""
        self.add(PartTable(id=id, description=description, parts=parts, columns=columns))

    def part_curves(
        self: StepHolder, id: str, symbol: str, unit: str, description: str, names: Callable[[Any], Sequence[str]],
        function: Callable[..., Array], of: str, abscissa: str, method: str, *, joints: Callable[[Any], Array] | None = None,
        **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare curves of named parts that plain code gives: see ``PartCurves``."""
        own: dict[str, Any] = {
            "names": names,
            "function": function,
            "of": of,
            "abscissa": abscissa,
            "method": method,
            "joints": joints,
        }
        self.add(PartCurves(id=id, symbol=symbol, unit=unit, description=description, **own, **when))

    def fact(self: StepHolder, id: str, condition: Written, words: str, **when: Unpack[StepCondition]) -> None:
        """Declare what steps and chapters may need beside inputs, and what is said where it does not hold: see ``Fact``."""
        self.add(Fact(id=id, condition=as_binding(condition, id), words=words, **when))
