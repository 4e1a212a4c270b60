"""A value of a standard series."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.steps.protocols import (
    ANY,
    ROW,
    Impossible,
    Item,
    Kinds,
    MachineValues,
    Names,
    StepEngine,
    StepPrinter,
)
from diecut_report.mechanism.steps.table_steps import (
    TableStep,
    as_given,
    given_faults,
    given_of,
    key_faults,
    si_values,
    sources,
    unlike_units,
)
from diecut_report.quantities.formatting import told, with_unit
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase, phrase

SAME = 1e-12  # relative difference within which a quantity is the standard value
SERIES_WORDS = {
    "above": "the next standard value at or above {value}; adjacent values not chosen: {beside}",
    "below": "the next standard value at or below {value}; adjacent values not chosen: {beside}",
    "nearest": "the nearest standard value to {value}; adjacent values not chosen: {beside}",
}


@dataclass(frozen=True, eq=False)
class Pick(TableStep):
    """Declare a value of a standard series: the next one at or above, at or below, or the nearest to a quantity.

    ``series`` are the standard values: in the display unit, or a standard series; or one for each value of the text
    input ``by``. The neighbours that were not taken are printed too. A quantity beyond the end of the series makes the machine
    impossible, for which ``key`` is then the input to change, else ``of``; ``beyond="last"`` takes the last value there, for a mechanism
    that judges it by a check of its own. ``given`` is an optional input: where it is given the step has its value, whatever it is.
    """

    rule: Literal["above", "below", "nearest"]
    of: str
    series: tuple[float, ...] | StandardSeries | Mapping[str, StandardSeries]
    by: str = field(default="", kw_only=True)
    beyond: Literal["impossible", "last"] = field(default="impossible", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"of": ROW, "given": ANY, "by": ANY}

    @property
    def all_series(self) -> tuple[Any, ...]:
        """Return the series that it may pick from."""
        return tuple(self.series.values()) if isinstance(self.series, Mapping) else (self.series,)

    @property
    def standard_values(self) -> set[float]:
        return {value for one in self.all_series for value in (one.values if isinstance(one, StandardSeries) else one)}

    def same_units(self, units: Callable[[str], set[str]], names: Names) -> Iterator[tuple[str, set[str]]]:
        yield self.of, units(self.of)

    def shape_faults(self) -> Iterator[str]:
        yield from super().shape_faults()
        if isinstance(self.series, tuple) and not self.series:
            yield phrase("picks from an empty series; give its values")
        if isinstance(self.series, Mapping) and not self.by:
            template = 'picks from several series ({series}); name the text input that chooses one: by="…"'
            yield Phrase(template, series=", ".join(map(str, self.series)))

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        if isinstance(self.series, Mapping):
            yield from names.incomplete(self.by, self.series, when, phrase("no series"))
        yield from given_faults(self, "of", self.of, names)
        if self.key:
            yield from key_faults(self.key, self.of, names, True, "")
        for one in self.all_series:
            if isinstance(one, StandardTable):
                yield phrase("takes from a table; name its column, table.series(…)")
            elif isinstance(one, StandardSeries):
                title = Phrase("the series “{title}”", title=one.title)
                yield from unlike_units(title, one.unit, self.all_units, phrase("the step"))
                yield from unlike_units(title, one.unit, names.units(self.of), self.of)

    def _own(self, calc: MachineValues) -> tuple[tuple[float, ...], str, StandardSeries | None]:
        """The standard values that it takes from, ascending; their unit; and the standard series, if it is one."""
        series = self.series[str(calc.inputs[self.by])] if isinstance(self.series, Mapping) else self.series
        if isinstance(series, StandardSeries):
            return series.values, series.unit, series
        return tuple(sorted(series)), self.unit, None

    def run(self, calc: StepEngine) -> None:
        given = given_of(calc, self.given)
        if given is not None:
            calc.values[self.id] = given
            return
        values, display, _ = self._own(calc)
        series = si_values(values, display)
        sought = calc[self.of]
        if self.beyond == "impossible":
            self._require_within(calc, sought, series)
        above = np.clip(np.searchsorted(series, sought * (1 - SAME)), 0, len(series) - 1)
        below = np.clip(np.searchsorted(series, sought * (1 + SAME), side="right") - 1, 0, len(series) - 1)
        nearer = np.where(sought - series[below] <= series[above] - sought, below, above)
        calc.branch[self.id] = {"above": above, "below": below, "nearest": nearer}[self.rule]
        calc.values[self.id] = series[calc.branch[self.id]]

    def _require_within(self, calc: StepEngine, sought: Array, series: Array) -> None:
        """Refuse a machine for which the series has no value by the rule: what is sought lies beyond its end; mark such variants."""
        over = sought > series[-1] * (1 + SAME) if self.rule != "below" else np.zeros_like(sought, dtype=bool)
        under = sought < series[0] * (1 - SAME) if self.rule != "above" else np.zeros_like(sought, dtype=bool)
        for variant in np.flatnonzero((over | under).any(axis=1)):
            part = int(np.argmax(over[variant] | under[variant]))
            if over[variant, part]:
                end = Phrase("the greatest value is {value}", value=told(series[-1], self.unit))
            else:
                end = Phrase("the least value is {value}", value=told(series[0], self.unit))
            words = self._beyond(calc, float(sought[variant, part]), end)
            key = self.key or self.of.removeprefix("inputs.")
            if calc.count == 1:
                raise Impossible([(key if self.key or key in calc.inputs else "", words)])
            calc.flaws.setdefault(int(variant), (self.key or self.id, words))

    def _beyond(self, calc: StepEngine, value: float, end: Phrase) -> Phrase:
        declared = calc.step_or_input(self.of)
        template = "{description} ({id}): {sought} is beyond {title}, of which {end}"
        return Phrase(
            template,
            description=self.description,
            id=self.id,
            sought=f"{declared.description}, {declared.symbol} = {told(value, declared.unit)},",
            title=getattr(self._own(calc)[2], "title", phrase("the series")),
            end=end,
        )

    def items(self, page: StepPrinter) -> list[Item]:
        result = page.result(self, float(page.calc[self.id][0, 0]))
        if given_of(page.calc, self.given) is not None:
            return [self.head() | as_given(page, self.given) | {"result": result}]
        values, display, standard = self._own(page.calc)
        index = int(page.calc.branch[self.id][0, 0])
        beside = [with_unit(f"{values[i]:g}", display) for i in (index - 1, index + 1) if 0 <= i < len(values)]
        message = Phrase(SERIES_WORDS[self.rule], value=page.printed(self.of), beside=", ".join(beside))
        item = {"type": "reduction", "of": page.calc.step_or_input(self.of).symbol, "result": result}
        series = {"series": standard.title} if standard else {}
        return [self.head() | item | {"operation": "pick", "method": message} | series | sources(standard)]
