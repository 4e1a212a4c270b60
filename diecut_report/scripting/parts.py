"""The parts of a mechanism's results: checks, curves, phases and figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, overload

from diecut_report.errors import Problem, UnknownName, nearest
from diecut_report.quantities.units import unit
from diecut_report.results.mechanism_record import CheckRecord, CurveRecord, PhaseRecord
from diecut_report.scripting.values import QuantityValue, told_in
from diecut_report.text.phrases import Phrase, phrase

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from diecut_report.scripting.values import Printable


# Parts by their names, and the error of a name that is not known.


PartT = TypeVar("PartT")
SHOWN = 20  # known names that a message lists


def unknown(what: str, name: str, known: Sequence[str], *, also: Sequence[str] = ()) -> UnknownName:
    """Return the error of a name that is not known; ``what`` says of what, ``drive has no figure``. The nearest is sought ``also`` in others."""
    near = nearest(name, (*known, *also)) or _listed(known)
    return UnknownName(Problem(Phrase("{what} {name}{nearest}.", what=what, name=repr(name), nearest=near)))


def _listed(known: Sequence[str]) -> str:
    return Phrase("; there are {known}", known=", ".join(known[:SHOWN])) if known else ""


class NamedParts(Mapping[str, PartT]):
    """Hold parts by their names, as a mapping; another name is an UnknownName (a KeyError) that tells the nearest."""

    def __init__(self, parts: Mapping[str, PartT], missing: str, language: str | None) -> None:
        self._parts, self._missing, self._language = dict(parts), missing, language

    def __getitem__(self, name: str) -> PartT:
        """Return a part by its name; UnknownName where there is none."""
        if name not in self._parts:
            with told_in(self._language):
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


Data = Mapping[str, Any]


@dataclass(frozen=True)
class CheckResult:
    """Hold a check: what the machine needs (``demand``) against what it may (``limit``), and the verdict.

    ``status`` is ``pass``, ``warn``, ``fail`` or ``not_checked``, where ``missing`` names the keys that it needs; ``check_class`` is
    ``function``, ``strength``, ``practice`` or ``numerical``; ``margin`` is
    below zero where the limit is not kept; ``utilisation`` is a share of 1, None where it cannot be told.
    """

    name: str
    mechanism: str
    id: str
    title: str
    check_class: str
    status: str
    demand: QuantityValue | None
    operator: str
    limit: QuantityValue | None
    margin: QuantityValue | None
    utilisation: float | None
    message: str
    source: str
    missing: tuple[str, ...]

    def __repr__(self) -> str:
        share = "" if self.utilisation is None else f" {100 * self.utilisation:.1f} %"
        return f"<check {self.name}: {self.status}{share}>"


def check_result(mechanism: str, data: CheckRecord) -> CheckResult:
    """Return a check of the results."""
    demand, limit = data.demand, data.limit
    margin = None if demand is None or limit is None else limit - demand
    sides = ((demand, data.demand_display), (limit, data.limit_display), (margin, data.margin_display))
    shown = [
        None if value is None else QuantityValue(value, data.unit, display=(text.text, text.unit) if text else None)
        for value, text in sides
    ]
    return CheckResult(
        f"{mechanism}.{data.id}", mechanism, data.id, str(data.title), data.check_class, data.status, shown[0],
        data.operator, shown[1], shown[2], data.utilisation, str(data.message), data.source,
        tuple(data.missing),
    )  # fmt: skip


class CheckList(Sequence[CheckResult]):
    """Hold checks in their order: by number, or by name (``checks["crank_torque"]``); as a table by ``to_arrow``, ``to_pandas``, ``to_polars``."""

    def __init__(self, checks: Sequence[CheckResult], results: Printable) -> None:
        self._checks, self._results = tuple(checks), results

    @overload
    def __getitem__(self, which: int | str) -> CheckResult: ...
    @overload
    def __getitem__(self, which: slice) -> CheckList: ...
    def __getitem__(self, which: int | str | slice) -> CheckResult | CheckList:
        """Return a check by its number, its id, or its name with its mechanism; UnknownName where there is none of that name."""
        if isinstance(which, slice):
            return CheckList(self._checks[which], self._results)
        if isinstance(which, int):
            return self._checks[which]
        found = [check for check in self._checks if which in (check.name, check.id)]
        with told_in(self._results.language):
            if len(found) > 1:
                told = ", ".join(check.name for check in found)
                raise UnknownName(
                    Problem(Phrase("several checks are called {name}: {names}.", name=repr(which), names=told))
                )
            if not found:
                names = [check.name for check in self._checks]
                raise unknown(phrase("there is no check"), which, names, also=[check.id for check in self._checks])
        return found[0]

    def __len__(self) -> int:
        return len(self._checks)

    def failing(self) -> CheckList:
        """Return the checks that fail."""
        return CheckList([check for check in self._checks if check.status == "fail"], self._results)

    def to_arrow(self) -> Any:
        """Return them as a table of pyarrow, a row each; demand, limit and margin in the SI unit of the column ``unit``."""
        from diecut_report.study.storage.parts import plain_table

        return plain_table([_row(check) for check in self._checks])

    def to_pandas(self) -> Any:
        """Return them as a table of pandas; ConfigError where pandas is not installed."""
        from diecut_report.scripting.values import to_pandas

        return to_pandas(self.to_arrow(), self._results.language)

    def to_polars(self) -> Any:
        """Return them as a table of polars; ConfigError where polars is not installed."""
        from diecut_report.scripting.values import to_polars

        return to_polars(self.to_arrow(), self._results.language)

    def __repr__(self) -> str:
        return "\n".join(map(repr, self._checks)) or "<no checks>"

    def _repr_html_(self) -> str:
        from diecut_report.scripting.values import checks_html

        return checks_html(self._results, {check.name for check in self})


def _row(check: CheckResult) -> dict[str, Any]:
    def number(side: QuantityValue | None) -> float | None:
        return None if side is None else side.si

    return {
        "id": check.id, "mechanism": check.mechanism, "title": check.title, "class": check.check_class, "status": check.status,
        "demand": number(check.demand), "limit": number(check.limit), "margin": number(check.margin),
        "unit": check.demand.unit if check.demand else "", "utilisation": check.utilisation, "message": check.message,
    }  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class CurveResult:
    """Hold a curve: ``values`` at the places of its abscissa, in ``unit`` (SI). A place that stands twice is a jump, before and after it.

    ``abscissa`` is the curve that it runs over, None of an abscissa itself. At ``breakpoints`` it may jump: from ``left`` to ``right``.
    """

    name: str
    values: NDArray[np.float64]
    unit: str
    abscissa: CurveResult | None
    symbol: str
    description: str
    display_unit: str
    breakpoints: tuple[float, ...]
    left: tuple[float, ...]
    right: tuple[float, ...]

    def to(self, other: str) -> NDArray[np.float64]:
        """Return the values in another unit of its dimension; ConfigError for one of another."""
        QuantityValue(1.0, self.unit, self.name).m_as(other)
        return self.values / unit(other).factor

    def __len__(self) -> int:
        return len(self.values)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the values for NumPy, in the SI unit."""
        import numpy as np

        return np.array(self.values, dtype=dtype) if copy or dtype else self.values

    def __repr__(self) -> str:
        over = f" over {self.abscissa.name}" if self.abscissa else ""
        return f"<curve {self.name}{over}: {len(self)} values in {self.unit}>"


def curve_results(data: Mapping[str, CurveRecord]) -> dict[str, CurveResult]:
    """Return the curves of a mechanism by name, abscissae first."""
    found: dict[str, CurveResult] = {}
    for name, each in sorted(data.items(), key=lambda pair: bool(pair[1].abscissa)):
        found[name] = _curve(name, each, found.get(each.abscissa))
    return {name: found[name] for name in data}


def _curve(name: str, data: CurveRecord, abscissa: CurveResult | None) -> CurveResult:
    import numpy as np

    values = np.array(data.values, dtype=float)
    values.setflags(write=False)
    sides = (tuple(each) for each in (data.breakpoints, data.left, data.right))
    return CurveResult(name, values, data.unit, abscissa, data.symbol, str(data.description), data.display_unit, *sides)


@dataclass(frozen=True, repr=False)
class PhaseResult:
    """Hold a phase: what it is (``role``), the abscissa it runs over with its period, and its intervals, each from one place to another."""

    name: str
    role: str
    description: str
    abscissa: str
    period: QuantityValue
    intervals: tuple[tuple[QuantityValue, QuantityValue], ...]

    def __repr__(self) -> str:
        return f"<phase {self.name}: {', '.join(f'{start} … {end}' for start, end in self.intervals)}>"


def phase_results(data: Mapping[str, PhaseRecord]) -> Iterator[PhaseResult]:
    """Yield the phases of a mechanism."""
    for name, each in data.items():
        own, shown = each.unit, each.display.unit

        def at(value: float, own: str = own, shown: str = shown) -> QuantityValue:
            return QuantityValue(value, own, display=QuantityValue(value, own).to(shown).printed)

        intervals = tuple((at(start), at(end)) for start, end in each.intervals)
        yield PhaseResult(name, each.role, str(each.description), each.abscissa, at(each.period), intervals)


@dataclass(frozen=True, repr=False)
class FigureResult:
    """Hold a figure as drawn for a report: ``svg`` is its text; a notebook shows it."""

    id: str
    title: str
    svg: str

    def save(self, file: str | Path) -> Path:
        """Write it as an SVG file; Unwritable in words where that is not possible."""
        from diecut_report.files import write_all

        path = Path(file)
        write_all({path: self.svg.encode()}, keep=None)
        return path

    def __repr__(self) -> str:
        return f"<figure {self.id}: {self.title}>"

    def _repr_html_(self) -> str:
        from diecut_report.scripting.values import figure_html

        return figure_html(self.svg, self.title)
