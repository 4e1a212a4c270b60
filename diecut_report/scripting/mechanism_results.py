"""The results of one mechanism, whose outputs are attributes: ``results["drive"].crank_torque_peak.to("N*m")``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeVar

from diecut_report.errors import ConfigError, Problem, UnknownName
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.scripting.named_parts import NamedParts, unknown
from diecut_report.scripting.parts import (
    CheckList,
    CurveResult,
    FigureResult,
    PhaseResult,
    check_result,
    curve_results,
    phase_results,
)
from diecut_report.scripting.spoken import told_in
from diecut_report.scripting.values import InputValue, QuantityValue

if TYPE_CHECKING:
    from diecut_report.scripting.printable import Printable

Data = Mapping[str, Any]
PartT = TypeVar("PartT")


class MechanismResults(Mapping[str, QuantityValue]):
    """Hold what was calculated of a mechanism: a mapping of its outputs, which are attributes, too.

    By its name in brackets any result is found, also an intermediate one, and one whose name is not a name of Python:
    ``train["gears.0.pitch_diameter"]``. An unknown name is an UnknownName (an AttributeError, or a KeyError) that tells the nearest.
    """

    def __init__(self, name: str, data: Data, results: Printable) -> None:
        self.name, self._data, self._results = name, data, results

    # --- what it is --------------------------------------------------------------------------------------------------

    @property
    def kind(self) -> str:
        """Return its kind, as ``cylinder_drive``."""
        return str(self._data["kind"])

    @property
    def title(self) -> str:
        """Return what its kind is called."""
        return str(self._data["title"])

    @property
    def status(self) -> str:
        """Return ``pass``, ``warn`` or ``fail``, the worst of its checks; ``error`` or ``skipped`` where it gives no results."""
        return str(self._data["status"])

    @property
    def error(self) -> str:
        """Return why it gives no results; nothing where it does."""
        return str(self._data.get("error", ""))

    # --- quantities --------------------------------------------------------------------------------------------------

    @cached_property
    def outputs(self) -> NamedParts[QuantityValue]:
        """Return its outputs by name, in SI units."""
        return self._named(
            phrase("{mechanism} has no output"),
            {name: _value(name, each) for name, each in self._data["outputs"].items()},
        )

    @cached_property
    def intermediate(self) -> NamedParts[QuantityValue]:
        """Return the numbers on the way to its outputs by name, in SI units."""
        return self._named(
            phrase("{mechanism} gives no"), {name: _value(name, each) for name, each in self._data["values"].items()}
        )

    @cached_property
    def inputs(self) -> NamedParts[InputValue]:
        """Return its inputs by key, in SI units, each with where it comes from and what it rests on."""
        return self._named(
            phrase("{mechanism} has no input"),
            {name: _input(name, each) for name, each in self._data["inputs"].items()},
        )

    def __getitem__(self, name: str) -> QuantityValue:
        """Return a result by its name; UnknownName where there is none."""
        for found in (self.outputs, self.intermediate):
            if name in found:
                return found[name]
        with told_in(self._results.language):
            raise self._unknown(name)

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

    def _unknown(self, name: str) -> UnknownName:
        if self.error:
            words = Phrase("{name} gives no results: {error}", name=self.name, error=self.error)
            return UnknownName(Problem(words, path=f"{self.name}.{name}"))
        return unknown(Phrase("{mechanism} gives no", mechanism=self.name), name, [*self.outputs, *self.intermediate])

    # --- checks, curves, phases, figures -----------------------------------------------------------------------------

    @cached_property
    def checks(self) -> CheckList:
        """Return its checks of the machine; self-tests of the calculation are not among them."""
        found = [check_result(self.name, each) for each in self._data["checks"] if each["class"] != "numerical"]
        return CheckList(found, self._results)

    @cached_property
    def self_tests(self) -> CheckList:
        """Return the self-tests of the calculation."""
        found = [check_result(self.name, each) for each in self._data["checks"] if each["class"] == "numerical"]
        return CheckList(found, self._results)

    @cached_property
    def curves(self) -> NamedParts[CurveResult]:
        """Return its curves by name, as arrays of NumPy in SI units."""
        return self._named(phrase("{mechanism} has no curve"), curve_results(self._data["curves"]))

    @cached_property
    def phases(self) -> NamedParts[PhaseResult]:
        """Return its phases by name."""
        return self._named(
            phrase("{mechanism} has no phase"), {each.name: each for each in phase_results(self._data["phases"])}
        )

    @property
    def figures(self) -> NamedParts[str]:
        """Return the titles of its figures by their ids, which ``figure`` takes."""
        titles = {str(each["id"]): str(each["title"]) for each in self._data["figures"]}
        return self._named(phrase("{mechanism} has no figure"), titles)

    def figure(self, id: str) -> FigureResult:
        """Return a figure, drawn as in a report; UnknownName where there is none, ConfigError where it cannot be drawn."""
        found = next((each for each in self._data["figures"] if each["id"] == id), None)
        with told_in(self._results.language):
            if found is None:
                raise unknown(Phrase("{mechanism} has no figure", mechanism=self.name), id, list(self.figures))
            return self._drawn(found)

    def _drawn(self, figure: Data) -> FigureResult:
        from diecut_report.scripting.display import drawing

        if "error" not in figure:
            try:
                key = f"{self._results.data['config']['sha256'][:12]}-{self.name}-{figure['id']}"  # ids within it are those of this machine
                svg = drawing(figure, self._data["curves"], self._results.document_language, key)
                return FigureResult(figure["id"], str(figure["title"]), svg)
            except Exception as cause:  # of any kind: what a plugin gives to be drawn is its own
                words = Phrase("This figure cannot be drawn: {cause}", cause=f"{type(cause).__name__}: {cause}")
                raise ConfigError(Problem(words, path=f"{self.name}.{figure['id']}")) from cause
        words = Phrase("This figure cannot be drawn: {cause}", cause=figure["error"])
        raise ConfigError(Problem(words, path=f"{self.name}.{figure['id']}"))

    def _named(self, missing: str, parts: Mapping[str, PartT]) -> NamedParts[PartT]:
        return NamedParts(parts, Phrase(missing, mechanism=self.name), self._results.language)

    # --- shown -------------------------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        numbers = [
            f"{each.name} = {each}" for name, each in self.outputs.items() if self._data["outputs"][name].get("key")
        ]
        return f"<{self.name}: {self.title}, {self.status}{'; ' if numbers else ''}{', '.join(numbers)}>"

    def _repr_html_(self) -> str:
        from diecut_report.scripting.display import mechanism_html

        return mechanism_html(self._results, self.name)


def _value(name: str, data: Data) -> QuantityValue:
    shown = data["display"]
    return QuantityValue(
        data["value"], data["unit"], name, str(data["symbol"]), str(data["description"]), str(data.get("source", "")),
        (shown["text"], shown["unit"]),
    )  # fmt: skip


def _input(name: str, data: Data) -> InputValue:
    shown, value = data["display"], data["value"]
    plain = ", ".join(value) if isinstance(value, list) else value
    origin, path = data["origin"], data.get("path") or ", ".join(data.get("paths", ()))
    return InputValue(
        plain, data["unit"], name, str(data["symbol"]), str(data["description"]), "", (shown["text"], shown["unit"]), origin, path,
        data.get("text", ""), data.get("basis", ""), data.get("note", ""),
    )  # fmt: skip
