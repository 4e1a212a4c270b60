"""A press that a script has loaded: asked for its inputs, changed into another one, calculated, swept, and asked questions."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from diecut_report.config.instances import Instance, Slot
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.plugins import Discovery
from diecut_report.config.references import as_file
from diecut_report.config.validation import GIVEN, Basis
from diecut_report.config.yaml import KeyPath, Tree, key_of, parse, read_text
from diecut_report.design.findings import decided
from diecut_report.design.inputs import allowed_texts
from diecut_report.errors import ConfigError, Problem, UserError
from diecut_report.exchange.carried import carried_results
from diecut_report.files import in_words, write, write_all
from diecut_report.mechanism.curve_inputs import InOtherUnit
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.names import Text
from diecut_report.press import Press
from diecut_report.quantities.formatting import given_shown
from diecut_report.quantities.units import UnitError, number_and_unit, unit, with_point
from diecut_report.report.symbols import symbol
from diecut_report.report.text import Catalogue, quantity
from diecut_report.scripting.parts import NamedParts, PartList
from diecut_report.scripting.results import Results
from diecut_report.scripting.values import (
    QuantityValue,
    known_language,
    notebook_page,
    plain,
    scalar,
    told_in,
    typed,
    whole_path,
)
from diecut_report.study.definition.base_inputs import (
    MECHANISMS,
    Input,
    UnknownPath,
    find_input,
    typed_place,
    varied_input,
)
from diecut_report.study.execution.engines import one_thread
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import said, speaking

if TYPE_CHECKING:
    from diecut_report.design.answers import Answer, FoundValue
    from diecut_report.design.inputs import DesignInput
    from diecut_report.scripting.sweeps import SweepTable


Data = dict[str, Any]


@dataclass(frozen=True, eq=False, repr=False)
class _Answered:
    data: Data
    text: str

    def __str__(self) -> str:
        return self.text

    __repr__ = __str__


@dataclass(frozen=True, eq=False, repr=False)
class Solution(_Answered):
    """Hold the values of an input that answer (``values``, the nearest to today's first); ``press`` is the press with the first, calculated once.

    Of an input that is a text they are texts. Without one ``values`` is empty, ``nearest`` is the value that comes nearest, and ``press`` is
    None. ``data`` is what the command gives as JSON; ``str`` what it says.
    """

    found: bool
    values: tuple[QuantityValue | str, ...]
    nearest: QuantityValue | str | None
    press: LoadedPress | None


@dataclass(frozen=True, eq=False, repr=False)
class MendedPress(_Answered):
    """Hold the least changes with which no check fails: for each path what is to be typed; ``press`` is the press with them.

    ``press`` is None where none was found, or where no check fails today. ``data`` is what the command gives as JSON; ``str`` what it says.
    """

    changes: dict[str, str]
    press: LoadedPress | None


@dataclass(frozen=True, eq=False, repr=False)
class InfluenceTable(_Answered):
    """Hold how far each input moves numbers, the greatest first. ``data`` is what the command gives as JSON; ``str`` what it says."""

    def bars(self) -> list[Data]:
        """Return for each number its inputs, one below the other: ``of``, ``path``, ``low`` and ``high`` (SI), as rows of a table."""
        return [
            {"of": each["name"], "path": bar["path"], "low": bar["low"], "high": bar["high"], "today": each["today"], "unit": each["unit"]}
            for each in self.data["tornados"]
            for bar in each["bars"]
        ]  # fmt: skip


@dataclass(frozen=True)
class LoadedFile:
    """Hold the file that a press was loaded from, if any, and by their SHA-256 what the script knows to stand in it."""

    file: Path | None = None
    known: set[str] = field(default_factory=set)

    def known_in(self, file: Path) -> str | None:
        """Return the SHA-256 of what is to stand in a file that is written: of this file alone, while it is there."""
        if self.file is None or not file.is_file() or file.resolve() != self.file:
            return None
        found = sha256(file.read_bytes()).hexdigest()
        return found if found in self.known else ""


@dataclass(frozen=True, eq=False, repr=False)
class LoadedPress:
    """Hold a valid configuration. It never changes: ``with_values`` gives another one.

    ``press`` is what the program has read, ``language`` that of messages and documents, where
    one was asked for. ``origin`` is shared by all presses that are made of one that was loaded.
    """

    press: Press
    language: str | None
    origin: LoadedFile = field(default_factory=LoadedFile)

    @property
    def config(self) -> Config:
        """Return the configuration as the program has read it."""
        return self.press.config

    @property
    def name(self) -> str:
        """Return the name of the press."""
        return str(self.config.tree.data[PRESS]["name"])

    @property
    def title(self) -> str:
        """Return the title of the project."""
        return str(self.config.project.title)

    @property
    def text(self) -> str:
        """Return the configuration as YAML, to which lines and columns of errors belong."""
        return self.config.tree.text

    @property
    def instances(self) -> NamedParts[str]:
        """Return the mechanisms by name, each with its kind; with those that run by themselves."""
        return NamedParts(self.config.kinds, phrase("there is no mechanism"), self.language)

    @cached_property
    def inputs(self) -> InputList:
        """Return all inputs of the press and of its mechanisms that have a value."""
        return InputList(tuple(press_inputs(self.config)), self.language)

    def validate(self) -> tuple[Problem, ...]:
        """Return why the machine cannot exist, as the command ``validate`` tells it; nothing where it can.

        What is wrong with the file itself is told when it is loaded.
        """
        try:
            with told_in(self.language):
                Press.validate(self.config.tree, self.press.discovery)
        except UserError as error:
            return error.problems
        return ()

    def with_values(self, values: Mapping[str, Any]) -> LoadedPress:
        """Return the press with other values, by path: ``{"drive.crank_length": "120 mm", "press.productivity": 6000}``.

        A value is a number in the unit of its key, a text with a unit, a quantity (of this program or of pint), true or false, a choice,
        or a reference ``"${cylinder.radius}"``. All else in the file stays as it is. ConfigError with path, line and allowed range for
        an unknown path, another dimension, or a value that is out of range; all that is wrong is told at once.
        """
        places: dict[KeyPath, str] = {}
        problems: list[Problem] = []
        with told_in(self.language):
            for path, value in values.items():
                try:
                    place, text = placed(self.config, str(path), value)
                    places[place] = text
                except UserError as error:
                    problems += error.problems
            try:
                changed = self._of(self.press.with_values(places, over_references=True)) if places else self
            except UserError as error:
                raise UserError([*problems, *error.problems]) from error.__cause__
            if problems:
                raise UserError(problems)
            return changed

    def save(self, file: str | Path) -> Path:
        """Write the configuration; Unwritable in words where that is not possible. Tables that it names are sought beside it.

        Where it is the file that the press was loaded from, and another program has saved that since, it is a ConfigError.
        """
        path, content = Path(file), as_file(self.config.tree, self.text)
        with told_in(self.language), in_words(path):
            known = self.origin.known_in(path)
            if known is None:
                write_all({path: content}, keep=None)
            else:
                write(path.resolve(), content, instead_of=known)
                self.origin.known.add(sha256(content).hexdigest())
        return path

    def calculate(self) -> Results:
        """Return the results; ConfigError with places where the machine cannot exist.

        Where a plugin breaks it is in ``errors`` of the results, whose status is ``error``; those of other mechanisms stand.
        """
        with told_in(self.language), one_thread():
            made = decided(self.press.calculate())
        return Results(made.results, self.press.discovery, self.language, config=self.config, errors=made.broken)

    def sweep(
        self, vary: Mapping[str, Any], *, outputs: Iterable[str] | None = None, constraints: Iterable[str] = (), method: str = "grid",
        count: int | None = None, seed: int | None = None,
    ) -> SweepTable:  # fmt: skip
        """Return a table of many machines, calculated together: a row each, with status and governing check.

        ``vary`` has for each path a list or an array of values, ``linspace("80 mm", "120 mm", 41)``, or a range or distribution as in
        [a study](studies.md). ``method`` is ``grid`` (each with each), ``zip``, ``latin_hypercube`` or ``sobol``, the last two with
        ``count`` and ``seed``. ``outputs`` are those to keep, such as ``drive.crank_torque_peak`` (all, where they are not named).
        ``constraints`` are those of a study. A machine that cannot exist has the status ``error`` and says why. ConfigError for all
        that is wrong with the question.
        """
        from diecut_report.scripting.sweeps import swept

        sample = {
            key: value for key, value in (("method", method), ("count", count), ("seed", seed)) if value is not None
        }
        asked = {"constraints": list(constraints)} | ({} if outputs is None else {"outputs": list(outputs)})
        with told_in(self.language, without_places=True), one_thread():
            return swept(self.config, self.press.discovery, self.language, vary, sample, asked)

    def solve(
        self, vary: str, target: str, *, low: str | None = None, high: str | None = None, among: Iterable[str] = (), passing: bool = False
    ) -> Solution:  # fmt: skip
        """Return the values of one input with which a target is met, ``"drive.crank_torque_peak = 400 N*m"``: the command ``solve``.

        It is searched from ``low`` to ``high`` (a third of today's value to three times it), or ``among`` some values, such as bearings;
        with ``passing`` only machines with which no check fails. ConfigError where nothing can be searched.
        """
        from diecut_report.design.answers import data, lines
        from diecut_report.design.inputs import solved_input
        from diecut_report.design.solving import solved

        with told_in(self.language), one_thread():
            press = self.press.usable()
            design = solved_input(press.config, vary, [*among])
            ends = {name: _end(design, given, name) for name, given in (("low", low), ("high", high))}
            answer = solved(press, target, design, passing=passing, **ends)
            values = tuple(_found_value(answer, each) for each in answer.found)
            near = None if answer.nearest is None else _found_value(answer, answer.nearest)
            made = None if answer.machine is None else self._of(answer.machine.press)
            return Solution(data(answer), "\n".join(lines(answer)), bool(values), values, near, made)

    def advise(self, *, free: Iterable[str] = (), keep: Iterable[str] = ()) -> MendedPress:
        """Return the smallest changes with which no check fails: the command ``advise``."""
        from diecut_report.design import advice

        with told_in(self.language), one_thread():
            found = advice.mended(self.press.usable(), free=free, keep=keep)
            press = None if found.machine is None else self._of(found.machine.press)
            changes = {each.design.name: each.after for each in found.changes} if press else {}
            return MendedPress(advice.data(found), "\n".join(advice.lines(found)), changes, press)

    def influence(self, *of: str, share: float = 0.1, defaults: bool = False) -> InfluenceTable:
        """Return how far each input moves a number (the governing checks, where none is named) when it changes by a share of its value.

        These are the inputs that are given; with ``defaults`` those that stand at their default too. ConfigError where the share is not
        between 0 and 1.
        """
        from diecut_report.design import influence

        with told_in(self.language), one_thread():
            config = self.press.usable().config
            if not (math.isfinite(share) and 0 < share <= 1):
                template = "{share} is not a share between 0 and 1, such as 0.1 for a tenth."
                raise ConfigError(Problem(Phrase(template, share=repr(share)), path="share"))
            found = influence.tornados(config, list(of), share, {}, defaults=defaults)
            return InfluenceTable(influence.data(found), "\n".join(influence.lines(found, None, "defaults=True")))

    def _of(self, press: Press) -> LoadedPress:
        return LoadedPress(press, self.language, self.origin)

    def __repr__(self) -> str:
        return f"<press {self.name} of {self.config.tree.name}: {', '.join(self.instances)}>"

    def _repr_html_(self) -> str:
        return self.inputs.html(f"{self.name} · {self.title}")


def _end(design: DesignInput, given: str | None, name: str) -> float | None:
    try:
        return None if given is None else design.read(given)
    except ValueError as fault:
        raise ConfigError(Problem(fault.args[0], path=f"{name} of {design.name}")) from None


def _found_value(answer: Answer, found: FoundValue) -> QuantityValue | str:
    if answer.design.is_text:
        return found.typed
    meta, (number, own) = answer.design.meta, number_and_unit(found.typed)
    shown, name = (str(number), own or "1"), answer.design.name
    return QuantityValue(found.value, meta.parsed_unit.si, name, meta.symbol, meta.description, "", shown)


# Presses and results from files, texts and mappings.


Folder = str | os.PathLike[str]
WITHOUT_FILE = "press.yaml"  # what documents call a configuration that has no file


def load(
    source: Folder | Mapping[str, Any], *, plugins: Iterable[Folder] = (), language: str | None = None
) -> LoadedPress:
    """Return the press of a configuration: of its file, or of a mapping with the same keys, whose values may be quantities.

    ``plugins`` are folders with plugins, which run with your rights; ``language`` is that of messages and
    documents (``en``, ``uk``; without it messages are English, and documents as the project has them). ConfigError with
    file, line, column, key and what is allowed for all that is wrong with it.
    """
    if isinstance(source, Mapping):
        text = yaml.safe_dump(plain(source, ""), allow_unicode=True, sort_keys=False)
        return _press(parse(text, WITHOUT_FILE), plugins, known_language(language), without_places=True)
    return _press(Path(source), plugins, known_language(language))


def loads(text: str, *, plugins: Iterable[Folder] = (), language: str | None = None) -> LoadedPress:
    """Return the press of a configuration that is given as text; tables that it names are sought in the current folder."""
    spoken = known_language(language)
    with told_in(spoken):
        return _press(read_text(text, WITHOUT_FILE), plugins, spoken)


def load_results(file: Folder, *, plugins: Iterable[Folder] = (), language: str | None = None) -> Results:
    """Return the results that a results file, or a report (PDF, HTML), holds; nothing is calculated. ConfigError where it holds none."""
    spoken = known_language(language)
    with told_in(spoken):
        return Results(carried_results(Path(file)).results, _discovery(plugins), spoken)


def _press(
    source: Path | Tree, plugins: Iterable[Folder], language: str | None, *, without_places: bool = False
) -> LoadedPress:
    with told_in(language, without_places=without_places):
        press, origin = Press.read(source, _discovery(plugins)), LoadedFile()
        if isinstance(source, Path):
            origin = LoadedFile(source.resolve(), {press.config.tree.sha256})
        return LoadedPress(press, language, origin)


def _discovery(plugins: Iterable[Folder]) -> Discovery:
    if isinstance(plugins, str | os.PathLike):
        plugins = (plugins,)
    return Discovery([Path(folder) for folder in plugins])


# The inputs of a loaded press as a script sees them: path, value, range, what they rest on.


@dataclass(frozen=True)
class PressInput:
    """Hold an input of the press or of a mechanism: its path (``drive.crank_length``), the kind of its mechanism, and its value (SI).

    ``value`` is None where it follows from something else: ``typed`` is what stands in the file, empty for a default. ``unit`` is that in
    which a bare number counts, ``allowed`` the range in it. ``basis`` is what it rests on, ``note`` what is noted of it.
    """

    path: str
    kind: str
    value: QuantityValue | None
    typed: str
    unit: str
    allowed: str
    symbol: str
    description: str
    basis: str
    note: str

    @property
    def is_given(self) -> bool:
        """Return whether it stands in the file; else it is a default."""
        return bool(self.typed)

    def row(self, words: Catalogue) -> dict[str, object]:
        """Return it as a row of a table, in the language that is spoken."""
        value = "" if self.value is None else quantity(*self.value.printed, words["decimal"])
        basis = words[self.basis] if self.basis else ""
        return vars(self) | {
            "description": said(self.description, self.kind),
            "symbol": symbol(self.symbol),
            "value": value,
            "basis": basis,
        }

    def __repr__(self) -> str:
        return f"<{self.path}: {self.typed if self.value is None else self.value}>"


class InputList(PartList[PressInput]):
    """Hold inputs in the order of the file: by number, or by path (``press.inputs["drive.crank_length"]``)."""

    _missing = phrase("there is no input")

    def _names(self, part: PressInput) -> tuple[str, ...]:
        return part.path, f"{MECHANISMS}.{part.path}"

    def _ipython_key_completions_(self) -> list[str]:
        return [each.path for each in self]

    def html(self, title: str = "") -> str:
        """Return them as a notebook shows them, by mechanism."""
        words = Catalogue(self.language or SOURCE_LANGUAGE)
        with speaking(words.language):
            by_home = groupby(self, lambda each: each.path.split(".")[0])
            groups = [(home, [each.row(words) for each in rows]) for home, rows in by_home]
        return notebook_page("inputs", words, title=title, groups=groups)

    _repr_html_ = html


def press_inputs(config: Config) -> Iterator[PressInput]:
    """Yield all inputs that have a value, those that are given and the defaults."""
    for instance in config.instances.values():
        for slot in instance.slots if instance else ():
            is_single = isinstance(slot.meta, Quantity | Text) and not isinstance(slot.value, list | dict)
            if instance is not None and is_single and slot.value is not None:
                yield _input(config, instance, slot)


def _input(config: Config, instance: Instance, slot: Slot) -> PressInput:
    path = ".".join(map(str, (instance.name, *slot.key)))
    typed = str(instance.place.typed(slot.key) or "")
    is_followed = (instance.name, *slot.key) in config.links
    basis, meta = instance.bases.get(slot.key, Basis()), slot.meta
    kind = instance.mechanism.kind if instance.mechanism else ""
    value = None if is_followed else _value(path, slot, instance.value(slot.key))
    rests, described = basis.basis, meta.description if meta else ""
    if not isinstance(meta, Quantity):
        choices: list[str] = []
        with suppress(UnknownPath):  # of a key that cannot be varied
            choices += allowed_texts(find_input(config, whole_path(path)).annotation)
        return PressInput(path, kind, value, typed, "1", ", ".join(choices), "", described, rests, basis.note)
    rests = rests or (GIVEN if typed else "")
    return PressInput(path, kind, value, typed, meta.unit, meta.allowed, meta.symbol, described, rests, basis.note)


def _value(path: str, slot: Slot, value: Any) -> QuantityValue | None:
    meta = slot.meta
    if isinstance(value, InOtherUnit):
        shown = given_shown(value.value, value.unit)
        words = (meta.symbol, meta.description) if meta else ("", "")
        return QuantityValue(value.value, unit(value.unit).si, path, *words, "", (shown["text"], shown["unit"]))
    if isinstance(meta, Quantity) and isinstance(value, int | float):
        shown = given_shown(float(value), meta.unit)
        printed = shown["text"], shown["unit"]
        return QuantityValue(value, meta.parsed_unit.si, path, meta.symbol, meta.description, "", printed)
    if isinstance(value, bool | int | float | str):
        return QuantityValue(value, "1", path, description=meta.description if meta else "")
    return None


def _typed_at_part(config: Config, found: Input, value: Any) -> str:
    """A value as it is typed at a part, where it may stand within a text of several numbers."""
    given = scalar(value, found.path)
    if not isinstance(found.meta, Quantity) or (isinstance(given, str) and "${" in given):
        return typed(value, found.path)
    try:
        found.meta.validate(given)
    except ValueError as fault:
        raise ConfigError(Problem(str(fault), config.tree.file, path=found.path)) from None
    return str(given)


def placed(config: Config, name: str, value: Any) -> tuple[KeyPath, str]:
    """Return the place in the file of what a path names (an input, or a field of ``project`` or ``report``), and the value as typed there.

    ConfigError in words for an unknown path.
    """
    first, *rest = name.removeprefix(f"{MECHANISMS}.").split(".")
    key = key_of(".".join(rest)) if rest else ()
    if first in ("project", "report"):
        return (first, *key), typed(value, name)
    is_of_parts = first in WORDS and config.parts is not None
    try:
        found = varied_input(config, name) if is_of_parts else find_input(config, whole_path(name))
    except UnknownPath as fault:
        raise ConfigError(Problem(str(fault), config.tree.file, path=name)) from None
    if isinstance(value, str) and isinstance(found.meta, Quantity):
        with suppress(UnitError):  # of an expression, or of what is judged when it is read
            value = with_point(value)
    if is_of_parts:
        return typed_place(config, found), _typed_at_part(config, found, value)
    instance = config.instances[found.instance]
    assert instance is not None, "an input of a broken plugin is not found"
    tree, place = instance.place.stands(found.key)
    return place if tree is config.tree else (*instance.place.root, *found.key), typed(value, name)
