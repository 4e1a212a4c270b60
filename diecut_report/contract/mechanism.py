"""A mechanism: the whole of what a plugin declares."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from diecut_report.contract.chapters import Chapter
from diecut_report.contract.checks import Check
from diecut_report.contract.code_steps import ComputedCurve, Fact
from diecut_report.contract.example import ExampleBlock
from diecut_report.contract.figures import Figure
from diecut_report.contract.input_lists import list_inputs
from diecut_report.contract.inputs import CurveInput, Inputs, fields
from diecut_report.contract.part_steps import Lookup, Neighbour, Running
from diecut_report.contract.place import Misdeclared, placed
from diecut_report.contract.result_names import names_ahead
from diecut_report.contract.sections import settled
from diecut_report.contract.spectra import Spectrum
from diecut_report.contract.steps import (
    SILENT,
    Abscissa,
    Accumulated,
    Choice,
    Computed,
    Crossings,
    Derivative,
    FromCurve,
    Phase,
    Step,
    Value,
)
from diecut_report.languages.phrases import Phrase, named
from diecut_report.quantities.units import unit


def axes(steps: tuple[Step, ...], inputs: type[Inputs]) -> dict[str, str]:
    """Return for each curve its abscissa, for each row over repeated parts its list; single numbers are left out."""
    found = dict(list_inputs(inputs))
    for step in steps:
        match step:
            case Abscissa():
                found[step.id] = step.id
            case FromCurve() | ComputedCurve():
                found[step.id] = step.abscissa
            case Accumulated(of=of) | Derivative(of=of) | Neighbour(of=of) | Running(of=of):
                found[step.id] = found[of]
            case Computed(over=over) if over:
                found[step.id] = over
            case Lookup(by=by) if by in found:
                found[step.id] = found[by]
            case Value() | Choice():
                own = {found[n] for n in step.takes() if isinstance(n, str) and n in found}
                if len(own) > 1:
                    raise ValueError(Phrase("{id} mixes {axes}", id=step.id, axes=named(sorted(own), " and ")))
                found |= {step.id: own.pop()} if own else {}
    return found


def is_text(step: Step) -> bool:
    """Return whether a step gives a text."""
    if isinstance(step, Computed):
        return step.is_text
    return isinstance(step, Choice) and isinstance(step.cases[0].value, str)


@dataclass(frozen=True, eq=False)
class Source:
    """Declare a publication that formulas come from."""

    id: str
    citation: str
    at: str = placed()


@dataclass(frozen=True, eq=False)
class Erratum:
    """Declare a mistake found in a source, and the quantities (ids) that it touches."""

    source: str
    text: str
    touches: tuple[str, ...] = ()
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Profile:
    """Declare curves over one abscissa that are written beside the report as tables and drawings: ``columns`` are x, y, and more.

    ``needs`` as for steps.
    """

    id: str
    title: str
    columns: tuple[str, ...]
    needs: tuple[str, ...] = ()
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class CurveTable(Profile):
    """Declare that all curves over an abscissa, the only one of ``columns``, are written beside the report as a table."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Declare what is calculated last, from the results of mechanisms of the named kinds, where a press has one of each.

    ``takes`` fills the inputs of ``mechanism`` by the kind and the id of an output, input or curve there; what is absent there
    leaves its input without a value.
    """

    kinds: tuple[str, ...]
    mechanism: Mechanism
    takes: Mapping[str, tuple[str, str]]
    at: str = placed()

    def __post_init__(self) -> None:
        foreign = [key for key, (kind, _) in self.takes.items() if kind not in self.kinds]
        if foreign or self.mechanism.checks:
            raise Misdeclared(
                Phrase(
                    "{kind}: a comparison has no checks, and takes from its own kinds only", kind=self.mechanism.kind
                )
            )


@dataclass(frozen=True, kw_only=True, eq=False)
class Partner:
    """Declare another mechanism that a kind takes inputs from: the one that the text input ``key`` names, else the only one of its kinds.

    ``takes`` gives for inputs of this kind the id of a result or the path of an input there; what is given in the block, or is
    absent there, is not taken.
    """

    key: str
    kinds: tuple[str, ...]
    takes: Mapping[str, str]
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Mechanism:
    """Declare a kind of mechanism: inputs, calculation, checks, figures, and what is said of it in the report.

    ``key_results`` are the ids of the outputs that the report's summary shows. ``example`` are inputs with which a configuration begins.
    """

    kind: str
    version: str
    title: str
    summary: str
    inputs: type[Inputs]
    chapters: tuple[Chapter, ...]
    key_results: tuple[str, ...] = ()
    checks: tuple[Check, ...] = ()
    figures: tuple[Figure, ...] = ()
    assumptions: tuple[str, ...] = ()
    sources: tuple[Source, ...] = ()
    errata: tuple[Erratum, ...] = ()
    exports: tuple[Profile, ...] = ()
    comparisons: tuple[Comparison, ...] = ()
    partners: tuple[Partner, ...] = ()
    spectra: tuple[Spectrum, ...] = ()
    example: ExampleBlock | None = None
    at: str = placed()

    @cached_property
    def steps(self) -> tuple[tuple[Chapter, Step], ...]:
        """Return all steps in the order in which they are calculated, each with its chapter."""
        return tuple((chapter, step) for chapter in self.chapters for step in chapter.steps)

    def active(self, given: frozenset[str]) -> tuple[tuple[Chapter, Step], ...]:
        """Return the steps that take part when these optional inputs (and texts, as ``key=value``) are given."""
        if given not in self._active:
            self._active[given] = tuple(self._settled(given))
        return self._active[given]

    def steps_by_id(self, given: frozenset[str]) -> dict[str, Step]:
        """Return those steps by their ids, in a new dictionary."""
        if given not in self._by_id:
            self._by_id[given] = {step.id: step for _, step in self.active(given)}
        return self._by_id[given].copy()

    @cached_property
    def _by_id(self) -> dict[frozenset[str], dict[str, Step]]:
        return {}

    def _settled(self, given: frozenset[str]) -> Iterator[tuple[Chapter, Step]]:
        for chapter, step in self.steps:
            if given.issuperset(chapter.needs + step.needs) and given.isdisjoint(step.lacks):
                yield chapter, settled(step, given)

    @cached_property
    def _active(self) -> dict[frozenset[str], tuple[tuple[Chapter, Step], ...]]:
        return {}

    @cached_property
    def facts(self) -> frozenset[str]:
        """Return the facts that steps may need: each counts as given until a machine turns out not to meet it."""
        return frozenset(step.id for _, step in self.steps if isinstance(step, Fact))

    def results_of(self, given: frozenset[str]) -> Mapping[str, tuple[str | None, bool]]:
        """Return what a reference may name, without calculating: the SI unit (None for a text), and whether it is a curve."""
        if given not in self._results:
            self._results[given] = self._named(given)
        return self._results[given]

    @cached_property
    def _results(self) -> dict[frozenset[str], dict[str, tuple[str | None, bool]]]:
        return {}

    def _named(self, given: frozenset[str]) -> dict[str, tuple[str | None, bool]]:
        found: dict[str, tuple[str | None, bool]] = {}
        for _, step in self.active(given):
            if isinstance(step, SILENT):
                continue
            si = unit(step.unit).si
            for each in names_ahead(step):
                of_place = self._unit_of_axis(step, given, found) if each.role == "place" else None
                found[each.name] = {"count": "1", "place": of_place}.get(each.role, si), False
            if not isinstance(step, Crossings):
                text = is_text(step)
                found[step.id] = None if text else si, self.axis_of(step.id, given) is not None
        return found

    def _unit_of_axis(
        self, step: Step, given: frozenset[str], found: Mapping[str, tuple[str | None, bool]]
    ) -> str | None:
        """The unit of what a curve runs over; None with inputs of which one is missing that gives the curve, which is told of them."""
        axis = self.axis_of(step.of, given)  # type: ignore[attr-defined]
        return found[axis][0] if axis is not None and axis in found else None

    def phases_of(self, given: frozenset[str]) -> dict[str, str]:
        """Return the ids of the phases that take part, each with the SI unit of its abscissa."""
        units = {step.id: unit(step.unit).si for _, step in self.active(given)}
        return {step.id: units[step.abscissa] for _, step in self.active(given) if isinstance(step, Phase)}

    def axis_of(self, name: str, given: frozenset[str]) -> str | None:
        """Return the abscissa that a quantity runs over, or the list whose parts it has a row for; None for a single number."""
        return self.axes(given).get(name)

    def axes(self, given: frozenset[str]) -> dict[str, str]:
        """Return for each curve its abscissa, for each row over repeated parts its list; single numbers are left out."""
        if given not in self._axes:
            self._axes[given] = axes(tuple(step for _, step in self.active(given)), self.inputs)
        return self._axes[given]

    @cached_property
    def _axes(self) -> dict[frozenset[str], dict[str, str]]:
        return {}

    @cached_property
    def curve_inputs(self) -> frozenset[str]:
        """Return the inputs that are curves."""
        return frozenset(name for name, meta in fields(self.inputs) if isinstance(meta, CurveInput))
