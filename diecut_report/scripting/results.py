"""The results of a machine: its verdict, its mechanisms, the results file, and its report."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from diecut_report.config.loader import Config
from diecut_report.config.model import DETAILS
from diecut_report.config.plugins import Discovery
from diecut_report.design.findings import findings
from diecut_report.errors import ConfigError, PluginError, Problem, UnknownName, nearest
from diecut_report.exchange.rendering import document
from diecut_report.files import write_all
from diecut_report.press import DRAWN, AskedReport, Lost
from diecut_report.report.pages.html import Screen
from diecut_report.report.scope import BRIEF, STANDARD
from diecut_report.report.text import Catalogue
from diecut_report.results.conclusion import SELF_TEST, summary_of
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import MechanismRecord, QuantityRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.results.results_file import encoded, results_text
from diecut_report.scripting.parts import (
    CheckList,
    CheckResult,
    CurveResult,
    FigureResult,
    NamedParts,
    PhaseResult,
    curve_results,
    unknown,
)
from diecut_report.scripting.values import InputValue, Printable, QuantityValue, known_language, notebook_page, told_in
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import said, speaking

# The results of one mechanism, whose outputs are attributes: ``results["drive"].crank_torque_peak.to("N*m")``.


PartT = TypeVar("PartT")


class MechanismResults(Mapping[str, QuantityValue]):
    """Hold what was calculated of a mechanism: a mapping of its outputs, which are attributes, too.

    By its name in brackets any result is found, also an intermediate one, and one whose name is not a name of Python:
    ``train["gears.0.pitch_diameter"]``. An unknown name is an UnknownName (an AttributeError, or a KeyError) that tells the nearest.
    """

    def __init__(self, name: str, data: MechanismRecord, results: Printable) -> None:
        self.name, self._data, self._results = name, data, results

    @property
    def kind(self) -> str:
        """Return its kind, as ``cylinder_drive``."""
        return str(self._data.kind)

    @property
    def title(self) -> str:
        """Return what its kind is called."""
        return str(self._data.title)

    @property
    def status(self) -> str:
        """Return ``pass``, ``warn`` or ``fail``, the worst of its checks; ``error`` or ``skipped`` where it gives no results."""
        return str(self._data.status)

    @property
    def error(self) -> str:
        """Return why it gives no results; nothing where it does."""
        return str(self._data.error)

    @cached_property
    def outputs(self) -> NamedParts[QuantityValue]:
        """Return its outputs by name, in SI units."""
        found = {name: _value(name, each) for name, each in self._data.outputs.items()}
        return self._named(phrase("{mechanism} has no output"), found)

    @cached_property
    def intermediate(self) -> NamedParts[QuantityValue]:
        """Return the numbers on the way to its outputs by name, in SI units."""
        found = {name: _value(name, each) for name, each in self._data.values.items()}
        return self._named(phrase("{mechanism} gives no"), found)

    @cached_property
    def inputs(self) -> NamedParts[InputValue]:
        """Return its inputs by key, in SI units, each with where it comes from and what it rests on."""
        found = {name: _input(name, each) for name, each in self._data.inputs.items()}
        return self._named(phrase("{mechanism} has no input"), found)

    def __getitem__(self, name: str) -> QuantityValue:
        """Return a result by its name; UnknownName where there is none."""
        for found in (self.outputs, self.intermediate):
            if name in found:
                return found[name]
        with told_in(self._results.language):
            if self.error:
                message = Phrase("{name} gives no results: {error}", name=self.name, error=self.error)
                raise UnknownName(Problem(message, path=f"{self.name}.{name}"))
            raise unknown(
                Phrase("{mechanism} gives no", mechanism=self.name), name, [*self.outputs, *self.intermediate]
            )

    def __getattr__(self, name: str) -> QuantityValue:
        """Return a result by its name; UnknownName where there is none."""
        if name.startswith("_"):  # what a notebook or a library looks for
            raise AttributeError(name)
        return self[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.outputs)

    def __len__(self) -> int:
        return len(self.outputs)

    def __dir__(self) -> list[str]:
        """Return what may be written behind a dot: its outputs, and what all mechanisms have."""
        return sorted({*super().__dir__(), *(name for name in self.outputs if name.isidentifier())})

    def _ipython_key_completions_(self) -> list[str]:
        return [*self.outputs, *self.intermediate]

    # --- checks, curves, phases, figures -----------------------------------------------------------------------------

    @cached_property
    def checks(self) -> CheckList:
        """Return its checks of the machine; self-tests of the calculation are not among them."""
        return self._checks(is_self_test=False)

    @cached_property
    def self_tests(self) -> CheckList:
        """Return the self-tests of the calculation."""
        return self._checks(is_self_test=True)

    def _checks(self, *, is_self_test: bool) -> CheckList:
        some = (each for each in self._data.checks if (each.check_class == SELF_TEST) is is_self_test)
        return CheckList([CheckResult(self.name, each) for each in some], self._results)

    @cached_property
    def curves(self) -> NamedParts[CurveResult]:
        """Return its curves by name, as arrays of NumPy in SI units."""
        return self._named(phrase("{mechanism} has no curve"), curve_results(self._data.curves))

    @cached_property
    def phases(self) -> NamedParts[PhaseResult]:
        """Return its phases by name."""
        found = {name: PhaseResult(name, each) for name, each in self._data.phases.items()}
        return self._named(phrase("{mechanism} has no phase"), found)

    @property
    def figures(self) -> NamedParts[str]:
        """Return the titles of its figures by their ids, which ``figure`` takes."""
        titles = {each.id: str(each.title) for each in self._data.figures}
        return self._named(phrase("{mechanism} has no figure"), titles)

    def figure(self, id: str) -> FigureResult:
        """Return a figure, drawn as in a report; UnknownName where there is none, ConfigError where it cannot be drawn."""
        found = next((each for each in self._data.figures if each.id == id), None)
        with told_in(self._results.language):
            if found is None:
                raise unknown(Phrase("{mechanism} has no figure", mechanism=self.name), id, list(self.figures))
            return self._drawn(found)

    def _drawn(self, figure: FigureRecord) -> FigureResult:
        from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second

        why, cause = figure.error, None
        if not why:
            key = f"{self._results.data.config.sha256[:12]}-{self.name}-{figure.id}"  # ids within it are those of this machine
            try:
                svg = render(figure, self._data.curves, Catalogue(self._results.document_language), key).text
                return FigureResult(figure.id, str(figure.title), svg)
            except Exception as error:  # of any kind: what a plugin gives to be drawn is its own
                why, cause = f"{type(error).__name__}: {error}", error
        message = Phrase("This figure cannot be drawn: {cause}", cause=why)
        raise ConfigError(Problem(message, path=f"{self.name}.{figure.id}")) from cause

    def _named(self, missing: str, parts: Mapping[str, PartT]) -> NamedParts[PartT]:
        return NamedParts(parts, Phrase(missing, mechanism=self.name), self._results.language)

    def __repr__(self) -> str:
        numbers = [f"{each.name} = {each}" for name, each in self.outputs.items() if self._data.outputs[name].key]
        return f"<{self.name}: {self.title}, {self.status}{'; ' if numbers else ''}{', '.join(numbers)}>"

    def _repr_html_(self) -> str:
        material = self._results.material(STANDARD, self.name)
        chapter = next(part for part in material.document.chapters if part.name == self.name)
        screen = Screen(material)
        return notebook_page(
            "mechanism", material.words, c=chapter, math=screen, figure=screen.figure, failed=material.failed
        )


def _value(name: str, data: QuantityRecord) -> QuantityValue:
    return QuantityValue(*_plain(name, data), str(data.source), (data.display.text, data.display.unit))


def _plain(name: str, data: QuantityRecord) -> tuple[Any, str, str, str, str]:
    value = ", ".join(data.value) if isinstance(data.value, list) else data.value  # several texts are one
    return value, data.unit, name, str(data.symbol), str(data.description)


def _input(name: str, data: QuantityRecord) -> InputValue:
    path, shown = data.path or ", ".join(data.paths), (data.display.text, data.display.unit)
    return InputValue(*_plain(name, data), "", shown, data.origin, path, data.text, data.basis, data.note)


Data = dict[str, Any]


class OpenItem(NamedTuple):
    """Hold what is open of a machine: what it is, the path of its input, check or mechanism, who is to settle it, and why it is open."""

    what: str
    path: str
    owner: str
    why: str


class Results(NamedParts[MechanismResults]):
    """Hold what was calculated of a machine: a mapping of its mechanisms by name.

    ``errors`` are the plugins that broke; the results of the other mechanisms stand. ``config`` is what was calculated, None of
    results that were read from a file.
    """

    def __init__(
        self, data: ResultsRecord, discovery: Discovery, language: str | None, *, config: Config | None = None, errors: Iterable[PluginError] = ()
    ) -> None:  # fmt: skip
        self._data, self._printable = data, Printable(data, discovery, language)
        found = {name: MechanismResults(name, each, self._printable) for name, each in data.mechanisms.items()}
        super().__init__(found, phrase("there is no mechanism"), language)
        self.config, self.errors = config, tuple(errors)

    @property
    def status(self) -> str:
        """Return the worst of the checks: ``pass``, ``warn`` or ``fail``; ``error`` where a mechanism could not be calculated."""
        return str(self._data.status)

    @property
    def verdict(self) -> str:
        """Return the verdict on the machine: ``pass`` only where nothing is open, ``conditional`` where something is, ``fail``."""
        return str(summary_of(self._data).verdict)

    @property
    def open(self) -> list[OpenItem]:
        """Return what is open: values that are assumed or at their default, parts and checks that are not calculated, warnings."""
        with speaking(self.language or SOURCE_LANGUAGE):
            return [OpenItem(each.what, each.path, each.owner, said(each.why)) for each in summary_of(self._data).open]

    @property
    def summary(self) -> Data:
        """Return how many checks there are of each status, the governing one, and the paths of assumed inputs (``summary`` of the results file)."""
        return dict(self.data["summary"])

    @property
    def conclusion(self) -> str:
        """Return the first line on the machine, as the report says it: what fails, and what is left open."""
        with speaking(self.language or SOURCE_LANGUAGE):
            return said(summary_of(self._data).conclusion)

    @property
    def governing(self) -> CheckResult | None:
        """Return the check that governs; None where none is made."""
        named = self._data.governing
        return None if named is None else self[named.mechanism].checks[named.check]

    @cached_property
    def checks(self) -> CheckList:
        """Return the checks of all mechanisms, in their order."""
        return CheckList([check for mechanism in self.values() for check in mechanism.checks], self._printable)

    @cached_property
    def comparisons(self) -> NamedParts[MechanismResults]:
        """Return the comparisons between mechanisms by name."""
        found = {name: MechanismResults(name, data, self._printable) for name, data in self._data.comparisons.items()}
        return NamedParts(found, phrase("there is no comparison"), self.language)

    # --- the results file --------------------------------------------------------------------------------------------

    @cached_property
    def data(self) -> Data:
        """Return the results as plain data, as in the results file (docs/results-file.md); what is changed in it changes nothing else."""
        found: Data = json.loads(self.to_json())
        return found

    @property
    def sha256(self) -> str:
        """Return the SHA-256 of the configuration that they follow from."""
        return str(self._data.config.sha256)

    def to_json(self) -> str:
        """Return the results file, which is that of the command ``calc``."""
        return results_text(self._data)

    def save(self, file: str | Path) -> Path:
        """Write the results file; Unwritable in words where that is not possible."""
        return self._write(Path(file), encoded(self.to_json()))

    def _write(self, path: Path, content: bytes) -> Path:
        with told_in(self.language):
            write_all({path: content}, keep=Path(self.config.tree.file) if self.config else None)
        return path

    # --- the report --------------------------------------------------------------------------------------------------

    def report(
        self, file: str | Path, *, detail: str | None = None, only: Iterable[str] = (), language: str | None = None
    ) -> Path:
        """Write the report as PDF, HTML, DOCX or XLSX, by the ending of the file; it is that of the command ``report``.

        ``detail`` is ``brief``, ``standard`` or ``full``, ``only`` the mechanisms that alone are shown, ``language`` that of the
        document; without them as the configuration has it. ConfigError for another ending, detail, mechanism or language, Unwritable
        where the file cannot be written; PluginError where a figure cannot be drawn: the file is written then without it.
        """
        path = Path(file)
        with told_in(self.language):
            form = _form(path)
            asked = AskedReport(known_language(language), _detail(detail), tuple(only))
        for name in asked.only:
            self[name]
        with told_in(self.language):
            content, lost = self._rendered(form, asked)
        self._write(path, content)
        for each in lost:
            raise PluginError(f"{each.what} {each.id}: {each.words}", self[each.mechanism].kind, each.mechanism)
        return path

    def _rendered(self, form: str, asked: AskedReport) -> tuple[bytes, list[Lost]]:
        data = self._printable.in_language()
        # what of the assumed values matters, and what comes of the advice
        if self.config is not None and not self.errors:
            data = findings(self.config, data, lambda _: None)
        made = document(asked.noted(data), (form,), self._printable.discovery, lambda _: None, self._data.config.file)
        return made.contents[form], made.lost

    def __repr__(self) -> str:
        counts = self._data.summary
        known = ((counts.of(status), status) for status in ("fail", "warn", "pass", "not_checked"))
        told = ", ".join(f"{count} {status}" for count, status in known if count)
        return f"<results of {self._data.press.name}: {self.status} ({told or 'no checks'}); {', '.join(self)}>"

    def _repr_html_(self) -> str:
        material = self._printable.material(BRIEF)
        return notebook_page("results", material.words, doc=material.document)


def _form(path: Path) -> str:
    form = path.suffix.removeprefix(".").lower()
    if form not in DRAWN:
        template = "{form} is not a format of a report; known: {known}."
        raise ConfigError(Problem(Phrase(template, form=repr(path.suffix), known=", ".join(DRAWN)), str(path)))
    return form


def _detail(detail: str | None) -> str | None:
    if detail is None or detail in DETAILS:
        return detail
    template = "{given} is not a detail{nearest}; known: {known}."
    message = Phrase(template, given=repr(detail), nearest=nearest(detail, DETAILS), known=", ".join(DETAILS))
    raise ConfigError(Problem(message, path="detail"))
