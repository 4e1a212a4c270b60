"""A mechanism: the whole of what a plugin declares."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from diecut_report.contract.checks import Check
from diecut_report.contract.figures import Figure
from diecut_report.contract.inputs import CurveInput, Inputs, fields, list_inputs
from diecut_report.contract.steps import (
    Abscissa,
    Breakpoints,
    Choice,
    Crossings,
    FromCurve,
    Reduction,
    Require,
    Section,
    Step,
    Value,
)
from diecut_report.units import unit

MOST_CROSSINGS = 99  # places of one curve that a reference may name; how many there are shows only in calculating


def axes(steps: tuple[Step, ...], inputs: type[Inputs]) -> dict[str, str]:
    """For each curve its abscissa, for each row over like parts its list; single numbers are left out."""
    found = {name: name.rsplit(".", 1)[0] for name in list_inputs(inputs)}
    for step in steps:
        match step:
            case Abscissa():
                found[step.id] = step.id
            case FromCurve():
                found[step.id] = step.abscissa
            case Value() | Choice():
                own = {found[n] for n in step.takes() if isinstance(n, str) and n in found}
                if len(own) > 1:
                    raise ValueError(f"{step.id} mixes {' and '.join(sorted(own))}")
                found |= {step.id: own.pop()} if own else {}
    return found


@dataclass(frozen=True, eq=False)
class Source:
    """A publication that formulas come from."""

    id: str
    citation: str


@dataclass(frozen=True, eq=False)
class Erratum:
    """A mistake found in a source, and the quantities (ids) that it touches."""

    source: str
    text: str
    touches: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Mechanism:
    """A kind of mechanism: inputs, calculation, checks, figures, and what is said of it in the report.

    ``key_results`` are the ids of the outputs that the report's summary shows.
    """

    kind: str
    version: str
    title: str
    summary: str
    inputs: type[Inputs]
    sections: tuple[Section, ...]
    key_results: tuple[str, ...] = ()
    checks: tuple[Check, ...] = ()
    figures: tuple[Figure, ...] = ()
    assumptions: tuple[str, ...] = ()
    sources: tuple[Source, ...] = ()
    errata: tuple[Erratum, ...] = ()

    @cached_property
    def steps(self) -> tuple[tuple[Section, Step], ...]:
        """All steps in the order in which they are calculated, each with its section."""
        return tuple((section, step) for section in self.sections for step in section.steps)

    def active(self, given: frozenset[str]) -> Iterator[tuple[Section, Step]]:
        """The steps that take part when these optional inputs are given."""
        for section, step in self.steps:
            if given.issuperset(section.needs + step.needs) and given.isdisjoint(step.lacks):
                yield section, step

    def results_of(self, given: frozenset[str]) -> dict[str, tuple[str | None, bool]]:
        """What a reference may name, without calculating: the SI unit (None for a text), and whether it is a curve."""
        found: dict[str, tuple[str | None, bool]] = {}
        for _, step in self.active(given):
            if isinstance(step, Require | Breakpoints):
                continue
            if isinstance(step, Crossings):
                found |= {f"{step.id}_count": ("1", False)}
                found |= {f"{step.id}_{i}": (unit(step.unit).si, False) for i in range(1, MOST_CROSSINGS + 1)}
                continue
            text = isinstance(step, Choice) and isinstance(step.cases[0].value, str)
            found[step.id] = (None if text else unit(step.unit).si, self.axis_of(step.id, given) is not None)
            if isinstance(step, Reduction) and step.operation in ("max", "min", "abs_max"):
                abscissa = found[self.axis_of(step.of, given) or ""]
                found[f"{step.id}_at"] = abscissa[0], False
        return found

    def axis_of(self, name: str, given: frozenset[str]) -> str | None:
        """The abscissa that a quantity runs over, or the list whose parts it has a row for; None for a single number."""
        return self.axes(given).get(name)

    def axes(self, given: frozenset[str]) -> dict[str, str]:
        """For each curve its abscissa, for each row over like parts its list; single numbers are left out."""
        if given not in self._axes:
            self._axes[given] = axes(tuple(step for _, step in self.active(given)), self.inputs)
        return self._axes[given]

    @cached_property
    def _axes(self) -> dict[frozenset[str], dict[str, str]]:
        return {}

    @cached_property
    def curve_inputs(self) -> frozenset[str]:
        """The inputs that are curves."""
        return frozenset(name for name, meta in fields(self.inputs) if isinstance(meta, CurveInput))

    def __post_init__(self) -> None:
        unused = [e for e in self.errata if e.source not in {s.id for s in self.sources}]
        if unused:
            raise ValueError(f"{self.kind}: erratum of an unnamed source {unused[0].source}")
