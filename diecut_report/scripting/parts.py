"""The parts of a mechanism's results, each over its record: checks, curves, phases and figures."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar, Self, TypeVar, overload

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from diecut_report.errors import ConfigError, Problem, UnknownName, nearest
from diecut_report.files import write_all
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.scope import STANDARD
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import CheckRecord, CurveRecord, PhaseRecord, ShownRecord
from diecut_report.results.record import CheckClass, CheckStatus, Record
from diecut_report.scripting.values import Printable, QuantityValue, notebook_page, told_in
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase, phrase

PartT = TypeVar("PartT")
SHOWN = 20  # known names that a message lists


def unknown(what: str, name: str, known: Sequence[str], *, also: Sequence[str] = ()) -> UnknownName:
    """Return the error of a name that is not known; ``what`` says of what, ``drive has no figure``. The nearest is sought ``also`` in others."""
    listed = Phrase("; there are {known}", known=", ".join(known[:SHOWN])) if known else ""
    near = nearest(name, (*known, *also)) or listed
    return UnknownName(Problem(Phrase("{what} {name}{nearest}.", what=what, name=repr(name), nearest=near)))


class NamedParts(Mapping[str, PartT]):
    """Hold parts by their names, as a mapping; another name is an UnknownName (a KeyError) that tells the nearest."""

    def __init__(self, parts: Mapping[str, PartT], missing: str, language: str | None) -> None:
        self._parts, self._missing, self.language = dict(parts), missing, language

    def __getitem__(self, name: str) -> PartT:
        """Return a part by its name; UnknownName where there is none."""
        if name not in self._parts:
            with told_in(self.language):
                raise unknown(self._missing, name, list(self._parts))
        return self._parts[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return repr(self._parts)


class PartList(ABC, Sequence[PartT]):
    """Hold parts in their order: by number, or by name."""

    _missing: ClassVar[str]

    def __init__(self, parts: Sequence[PartT], language: str | None) -> None:
        self._parts, self.language = tuple(parts), language

    @abstractmethod
    def _names(self, part: PartT) -> tuple[str, ...]: ...

    @overload
    def __getitem__(self, which: int | str) -> PartT: ...
    @overload
    def __getitem__(self, which: slice) -> Self: ...
    def __getitem__(self, which: int | str | slice) -> PartT | Self:
        """Return a part by its number or one of its names; UnknownName where there is none of that name, or several."""
        if isinstance(which, slice):
            return self._some(self._parts[which])
        if isinstance(which, int):
            return self._parts[which]
        found = [part for part in self._parts if which in self._names(part)]
        with told_in(self.language):
            if len(found) > 1:
                told = ", ".join(self._names(part)[0] for part in found)
                raise UnknownName(
                    Problem(Phrase("several checks are called {name}: {names}.", name=repr(which), names=told))
                )
            if not found:
                names = [self._names(part) for part in self._parts]
                others = [name for some in names for name in some[1:]]
                raise unknown(self._missing, which, [some[0] for some in names], also=others)
        return found[0]

    def _some(self, parts: Sequence[PartT]) -> Self:
        made = copy(self)
        made._parts = tuple(parts)
        return made

    def __len__(self) -> int:
        return len(self._parts)

    def __repr__(self) -> str:
        return "\n".join(map(repr, self._parts))


class Tabular(ABC):
    """Give a table to other libraries."""

    language: str | None

    @abstractmethod
    def to_arrow(self) -> Any:
        """Return it as a table of pyarrow."""

    def to_pandas(self, *, shown: bool = False) -> Any:
        """Return it as a table of pandas, its units in ``attrs["units"]``; ConfigError where pandas is not installed.

        With ``shown`` numbers are in the units of a report, which stand in the heads: ``drive.torque_max [N·m]``.
        """
        self._library("pandas")
        table, units = self._in_units(shown)
        found = table.to_pandas(strings_to_categorical=False)
        found.attrs["units"] = units
        return found

    def to_polars(self, *, shown: bool = False) -> Any:
        """Return it as a table of polars, as ``to_pandas``; ConfigError where polars is not installed."""
        return self._library("polars").from_arrow(self._in_units(shown)[0])

    def units(self, *, shown: bool = False) -> dict[str, str]:
        """Return the unit of each column that has one: the SI unit, or that of a report."""
        return {}

    def _in_units(self, shown: bool) -> tuple[Any, dict[str, str]]:
        """The table of pyarrow with its units, which stand in the heads where they are those of a report."""
        table, units = self.to_arrow(), self.units(shown=shown)
        if not shown or not units:
            return table, units
        for index, name in enumerate(table.column_names):
            factor, said = unit(units.get(name, "1")).factor, pretty(units.get(name, "1"))
            column = table.column(index)
            if factor != 1:
                column = [[None if each is None else each / factor for each in column.to_pylist()]]  # one chunk
            table = table.set_column(index, f"{name} [{said}]" if said else name, column)
        return table, units

    def _library(self, name: str) -> Any:
        try:
            return import_module(name)
        except ImportError as cause:
            template = "{library} is not installed; install it (pip install {library}), or take the table of pyarrow by to_arrow()."
            with told_in(self.language):
                raise ConfigError(Problem(Phrase(template, library=name))) from cause


class OfRecord:
    """Show a record of the results (docs/results-file.md): its keys are attributes."""

    record: Record

    def __getattr__(self, key: str) -> Any:
        """Return what the record has under a key."""
        if key.startswith("_"):  # what a notebook or a library looks for
            raise AttributeError(key)
        return getattr(self.record, key)


class CheckResult(OfRecord):
    """Hold a check: what the machine needs (``demand``) against what it may (``limit``), and the verdict.

    ``status`` is ``pass``, ``warn``, ``fail`` or ``not_checked``, where ``missing`` names the keys that it needs; ``check_class`` is
    ``function``, ``strength``, ``practice`` or ``numerical``; ``margin`` is below zero where the limit is not kept; ``utilisation`` is
    a share of 1, None where it cannot be told. What else a check of the results file has is an attribute, too.
    """

    record: CheckRecord
    id: str
    title: str
    check_class: CheckClass
    status: CheckStatus
    operator: str
    unit: str
    utilisation: float | None
    message: str
    source: str
    missing: list[str]

    def __init__(self, mechanism: str, record: CheckRecord) -> None:
        self.mechanism, self.record = mechanism, record

    @property
    def name(self) -> str:
        """Return its id with its mechanism."""
        return f"{self.mechanism}.{self.record.id}"

    @property
    def demand(self) -> QuantityValue | None:
        """Return what is needed."""
        return self._side(self.record.demand, self.record.demand_display)

    @property
    def limit(self) -> QuantityValue | None:
        """Return what is allowed."""
        return self._side(self.record.limit, self.record.limit_display)

    @property
    def margin(self) -> QuantityValue | None:
        """Return the limit less the demand."""
        demand, limit = self.record.demand, self.record.limit
        return self._side(None if demand is None or limit is None else limit - demand, self.record.margin_display)

    def _side(self, value: float | None, shown: ShownRecord | None) -> QuantityValue | None:
        display = (shown.text, shown.unit) if shown else None
        return None if value is None else QuantityValue(value, self.record.unit, display=display)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, CheckResult) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash(self.name)

    def __repr__(self) -> str:
        share = "" if self.record.utilisation is None else f" {100 * self.record.utilisation:.1f} %"
        return f"<check {self.name}: {self.record.status}{share}>"


class CheckList(PartList[CheckResult], Tabular):
    """Hold checks in their order: by number, or by name (``checks["crank_torque"]``); as a table by ``to_arrow``, ``to_pandas``, ``to_polars``."""

    _missing = phrase("there is no check")

    def __init__(self, checks: Sequence[CheckResult], results: Printable) -> None:
        super().__init__(checks, results.language)
        self._results = results

    def _names(self, part: CheckResult) -> tuple[str, ...]:
        return part.name, part.record.id

    def failing(self) -> CheckList:
        """Return the checks that fail."""
        return self._some([check for check in self if check.status == "fail"])

    def to_arrow(self) -> Any:
        """Return them as a table of pyarrow, a row each; demand, limit and margin in the SI unit of the column ``unit``."""
        from diecut_report.study.storage.store import plain_table

        def row(check: CheckResult) -> dict[str, Any]:
            sides = {"demand": check.demand, "limit": check.limit, "margin": check.margin}
            return {
                "id": check.id, "mechanism": check.mechanism, "title": str(check.title), "class": check.check_class, "status": check.status,
                **{name: None if side is None else side.si for name, side in sides.items()},
                "unit": check.unit if check.demand else "", "utilisation": check.utilisation, "message": str(check.message),
            }  # fmt: skip

        return plain_table(map(row, self))

    def __repr__(self) -> str:
        return super().__repr__() or "<no checks>"

    def _repr_html_(self) -> str:
        material, names = self._results.material(STANDARD), {check.name for check in self}
        every = (row for part in material.document.chapters for row in part.checks)
        rows = [row for row in every if f"{row.mechanism}.{row.id}" in names]
        return notebook_page("checks", material.words, rows=rows)


class CurveResult(OfRecord):
    """Hold a curve: ``values`` at the even places of its abscissa, in ``unit`` (SI).

    ``abscissa`` is the curve that it runs over, None of an abscissa itself. At ``breakpoints``, which lie between these places, it may jump
    from ``left`` to ``right``, and there its greatest value may be.
    What else a curve of the results file has is an attribute, too.
    """

    record: CurveRecord
    unit: str
    symbol: str
    description: str
    display_unit: str
    breakpoints: list[float]
    left: list[float]
    right: list[float]

    def __init__(self, name: str, record: CurveRecord, abscissa: CurveResult | None) -> None:
        self.name, self.record, self.abscissa = name, record, abscissa

    @cached_property
    def values(self) -> NDArray[np.float64]:
        """Return the values in the SI unit; they cannot be changed."""
        values = np.array(self.record.values, dtype=float)
        values.setflags(write=False)
        return values

    def to(self, other: str) -> NDArray[np.float64]:
        """Return the values in another unit of its dimension; ConfigError for one of another."""
        QuantityValue(1.0, self.record.unit, self.name).m_as(other)
        return self.values / unit(other).factor

    def plot(self, axes: Any = None, **style: Any) -> Any:
        """Draw it over its abscissa, in the units of a report, with its jumps; return the axes of matplotlib, whose ``figure`` a notebook shows."""
        from diecut_report.report.chapters.tables import continuous, period_of
        from diecut_report.report.figures.style import plotted

        over = self.abscissa or self
        labels = axis_label(over.description, over.display_unit), axis_label(self.description, self.display_unit)
        style, own = {"label": self.description, **style}, (self.values, self.values)
        x, y = continuous(self.record, over.record, period_of(over.record)) if self.abscissa else own
        return plotted(x / unit(over.display_unit).factor, y / unit(self.display_unit).factor, labels, axes, **style)

    def __len__(self) -> int:
        return len(self.values)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the values for NumPy, in the SI unit."""
        return np.array(self.values, dtype=dtype) if copy or dtype else self.values

    def __repr__(self) -> str:
        over = f" over {self.abscissa.name}" if self.abscissa else ""
        return f"<curve {self.name}{over}: {len(self)} values in {self.record.unit}>"


def axis_label(description: str, shown: str) -> str:
    """Return what stands at an axis: the quantity and its unit."""
    return f"{description}, {pretty(shown)}" if pretty(shown) else description


def curve_results(data: Mapping[str, CurveRecord]) -> dict[str, CurveResult]:
    """Return the curves of a mechanism by name."""
    found: dict[str, CurveResult] = {}
    for name, each in sorted(data.items(), key=lambda pair: bool(pair[1].abscissa)):  # abscissae first
        found[name] = CurveResult(name, each, found.get(each.abscissa))
    return {name: found[name] for name in data}


class PhaseResult(OfRecord):
    """Hold a phase: what it is (``role``), the abscissa it runs over with its period, and its intervals, each from one place to another."""

    record: PhaseRecord
    role: str
    description: str
    abscissa: str

    def __init__(self, name: str, record: PhaseRecord) -> None:
        self.name, self.record = name, record

    @property
    def period(self) -> QuantityValue:
        """Return the period of its abscissa."""
        return self._at(self.record.period)

    @property
    def intervals(self) -> tuple[tuple[QuantityValue, QuantityValue], ...]:
        """Return its intervals."""
        return tuple((self._at(start), self._at(end)) for start, end in self.record.intervals)

    def _at(self, value: float) -> QuantityValue:
        own = self.record.unit
        return QuantityValue(value, own, display=QuantityValue(value, own).to(self.record.display.unit).printed)

    def __repr__(self) -> str:
        return f"<phase {self.name}: {', '.join(f'{start} … {end}' for start, end in self.intervals)}>"


@dataclass(frozen=True, repr=False)
class FigureResult:
    """Hold a figure as drawn for a report: ``svg`` is its text; a notebook shows it."""

    id: str
    title: str
    svg: str

    def save(self, file: str | Path) -> Path:
        """Write it as an SVG file; Unwritable in words where that is not possible."""
        path = Path(file)
        write_all({path: self.svg.encode()}, keep=None)
        return path

    def __repr__(self) -> str:
        return f"<figure {self.id}: {self.title}>"

    def _repr_html_(self) -> str:
        # matplotlib escapes the texts within the drawing
        return notebook_page("figure", Catalogue(SOURCE_LANGUAGE), svg=Markup(self.svg), title=self.title)
