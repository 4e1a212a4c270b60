"""All texts that a plugin's declarations bring into a report, in the order in which they are declared."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import lru_cache
from itertools import chain, combinations
from pathlib import Path
from typing import Any, NamedTuple, get_args

from diecut_report.declaration.formulas import lacking
from diecut_report.declaration.inputs import of_input
from diecut_report.declaration.names import DeclaredNames, Fault, declared_in, fault, short, unknown
from diecut_report.errors import nearest
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.figures import Spectrum
from diecut_report.mechanism.inputs import Block, Quantity, Samples, keys
from diecut_report.mechanism.mechanism import Comparison, CurveTable, Mechanism, Profile
from diecut_report.mechanism.names import When
from diecut_report.mechanism.steps import Case, SilentStep, Step, has_own_names, names_ahead, numbered_symbol
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.phrases import PLACE, Phrase, named, phrase, worded

SAID = frozenset({"title", "summary", "text", "absent", "description", "method", "otherwise", "words", "message", "demand_label",
                  "limit_label", "at_least_label", "consequence", "caption", "label", "assumptions"})  # fmt: skip
"""Fields of declared things that the report prints."""
ENTERED = frozenset({"chapters", "steps", "checks", "figures", "panels", "series", "levels", "marks", "spans", "groups", "cases", "columns",
                     "errata", "exports", "comparisons", "spectra", "table", "mechanism"})  # fmt: skip
"""Fields that hold further declared things."""

WORD = re.compile(r"[^\W\d_]{2,}")


class DeclaredText(NamedTuple):
    """Hold a text with what it is of, for whoever translates it."""

    text: str
    of: str


def texts(mechanism: Mechanism) -> Iterator[DeclaredText]:
    """Yield each text once: those of the mechanism, of its inputs, and of the comparisons that it declares."""
    seen = set()
    for found in (*inputs_texts(mechanism.inputs), *_of_declared(mechanism)):
        if found.text and found.text not in seen and is_text(found.text):
            seen.add(found.text)
            yield found


def is_text(text: str) -> bool:
    """Return whether there are words in it: not a symbol, a sign or a number alone."""
    return WORD.search(PLACE.sub(" ", text)) is not None


def inputs_texts(model: type[Block]) -> Iterator[DeclaredText]:
    """Yield what inputs are, and in words what texts they may be."""
    for key in keys(model).values():
        if key.meta is not None:
            yield DeclaredText(key.meta.description, f"input {key.path}")
            known = (*getattr(key.meta, "options", ()), *getattr(key.meta, "words", ()), *_literals(key.annotation))
            own = (text for text in known if text.isidentifier() and text.islower())
            yield from (DeclaredText(worded(text), f"{text}, a text of {key.path}") for text in own)


def _literals(annotation: Any) -> Iterator[str]:
    for part in get_args(annotation):
        yield from [part] if isinstance(part, str) else _literals(part)


def _of_declared(declared: Any) -> Iterator[DeclaredText]:
    if isinstance(declared, Comparison):
        yield from texts(declared.mechanism)
    elif isinstance(declared, StandardTable | StandardSeries):
        yield from _of_table(declared)
    elif isinstance(declared, Mapping) or (isinstance(declared, tuple | list) and not hasattr(declared, "_fields")):
        for part in declared.values() if isinstance(declared, Mapping) else declared:
            yield from _of_declared(part)
    else:
        kind = type(declared).__name__.lower()
        yield from _of_fields(declared, f"{kind} {getattr(declared, 'id', '')}".strip())


def _of_table(declared: StandardTable | StandardSeries) -> Iterator[DeclaredText]:
    """What a table of the plugin's own is; those of the program it translates itself."""
    if not declared.is_of_the_program:
        title = declared.title  # of the series that a column is: both, each by itself
        parts = title.values if isinstance(title, Phrase) else {}
        yield DeclaredText(parts.get("title", title), "table")
        yield DeclaredText(parts.get("column", ""), "column of a table")
        yield DeclaredText(declared.only_source, "why a table has one source only")


def _of_fields(declared: Any, told: str) -> Iterator[DeclaredText]:
    own = (field.name for field in fields(declared)) if is_dataclass(declared) else getattr(declared, "_fields", ())
    for name in own:
        value = getattr(declared, name)
        if name in SAID:
            whole = [value] if isinstance(value, str) else value
            yield from (DeclaredText(text, told) for each in whole for text in _own_texts(each))
        elif name == "bars":
            yield from (DeclaredText(label, told) for label, _ in value)
        elif isinstance(declared, Case) and isinstance(value, str):  # what a choice gives
            yield DeclaredText(worded(value), told)
        elif name in ENTERED:
            yield from _of_declared(value)
    if isinstance(declared, Spectrum):
        yield from (DeclaredText(line.description, told) for line in declared.lines())


def _own_texts(text: str) -> Iterable[str]:
    """A text; of one of the program that is filled with the plugin's, as of a point's coordinates, these alone."""
    filled = isinstance(text, Phrase) and text.values
    return [each for each in filled.values() if isinstance(each, Phrase)] if filled else [text]


# ``needs`` and ``lacks``: each names an input that there is, or a text that it may be.


TOKENS = ("needs", "lacks", "only_with", "asks_for", "at_best", "founded", "sized_unless", "scaled_by")


def token_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the tokens that can never hold."""
    for declared in declared_in(names.mechanism):
        for field in TOKENS:
            tokens = getattr(declared, field, None) or ()
            if isinstance(tokens, str) and field != "scaled_by":
                template = '{field} is the text {tokens}; write a tuple, {field}=("{tokens}",)'
                yield fault(declared, Phrase(template, field=field, tokens=tokens))
                continue
            for text in filter(
                None, (_told(names, token) for token in ((tokens,) if isinstance(tokens, str) else tokens))
            ):
                yield fault(declared, Phrase("{field} names {text}", field=field, text=text))
        for fact in sorted(names.mechanism.facts.intersection(getattr(declared, "lacks", ()))):
            yield fault(declared, Phrase("lacks names the fact {fact}; a fact can only be needed", fact=fact))


def not_an_input(names: DeclaredNames, path: str) -> str:
    """Return a name that is not an input, with what it is, or the nearest input."""
    what: str = phrase("a step; only inputs can be named")
    if not names.givers(path):
        what = Phrase("not an input{nearest}", nearest=nearest(path, names.world.keys))
    return Phrase("{path}, which is {what}", path=path, what=what)


def _told(names: DeclaredNames, token: str) -> str:
    """What is wrong with a token, in words; empty where nothing is."""
    path, is_text, text = token.partition("=")
    key = names.world.keys.get(path)
    if key is None:
        return not_an_input(names, path)
    if not is_text:
        return ""
    if key.home:
        return Phrase("{token}, but each part of {home} has a text of its own", token=token, home=key.home)
    if not key.texts:
        template = "{token}, but {path} is not a text with allowed values; name {path} alone"
        return Phrase(template, token=token, path=path)
    if text in key.texts:
        return ""
    near, texts = nearest(text, key.texts), ", ".join(key.texts)
    return Phrase("{token}{nearest}; {path} may be {texts}", token=token, nearest=near, path=path, texts=texts)


# What is said beside the calculation: sources, errata, key results, exports, spectra and comparisons name what there is.


CITED = re.compile(r"(?:^|; ?)(?:(\d{3,})\b|(\S+?),? (?:eq\.|Fig\.|Table|erratum)\s)")
PAPER = re.compile(r"(?:^|; ?)(?:(\d{3,})|([^\W\d_]+\d+))\b(?! series)")
"""What looks like the id of a paper, unlike a standard (ISO 281), an author or a series (R40 series)."""


def document_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what names a source or a quantity that there is none of."""
    yield from _sources(names.mechanism)
    yield from _titles(names)
    for first, second in combinations(names.mechanism.sources, 2):
        if first.id == second.id:
            template = "has the id of another source (at {place}); give it another"
            yield fault(second, Phrase(template, place=short(first.at)))
    yield from _errata(names)
    for name in names.mechanism.key_results:
        text = _key_result(names, name)
        if text:
            yield Fault(names.mechanism.at, "key_results", text)
    for name in names.mechanism.reactions:
        if not any(giver.kind == "curve" for giver in names.givers(name)):
            yield Fault(names.mechanism.at, "reactions", Phrase("{name} is not a curve", name=name))
    for profile in names.mechanism.exports:
        yield from (fault(profile, text) for text in _export(profile, names))
    for comparison in names.mechanism.comparisons:
        yield from (fault(comparison, text) for text in _comparison(names, comparison))


def _errata(names: DeclaredNames) -> Iterator[Fault]:
    """Errata of sources that are not listed, and those that touch what there is not."""
    known = [source.id for source in names.mechanism.sources]
    silent = {step.id for _, step in names.mechanism.steps if isinstance(step, SilentStep)}
    for erratum in names.mechanism.errata:
        if erratum.source not in known:
            template = "is of no listed source{nearest}; listed: {known}"
            yield fault(erratum, Phrase(template, nearest=nearest(erratum.source, known), known=", ".join(known)))
        for name in erratum.touches:
            if not names.givers(name) and name not in silent:
                yield fault(erratum, Phrase("touches {unknown}", unknown=unknown(name, names.known)))


def _titles(names: DeclaredNames) -> Iterator[Fault]:
    """Chapters of one title that may stand in one report."""
    for first, second in combinations(names.mechanism.chapters, 2):
        both = When(frozenset(first.needs + second.needs))
        if first.title == second.title and names.world.example(both) is not None:
            template = "has the title of another chapter (at {place}); give it another, or put their steps into one"
            yield fault(second, Phrase(template, place=short(first.at)))


def _sources(mechanism: Mechanism) -> Iterator[Fault]:
    """Sources that are cited by their id and not listed; a mechanism that lists none cites elsewhere."""
    known = [source.id for source in mechanism.sources]
    for citing, name in unlisted(mechanism, CITED) if known else ():
        template = "cites {name}, which is not a source{nearest}; listed: {known}"
        yield fault(citing, Phrase(template, name=name, nearest=nearest(name, known), known=", ".join(known)))


def unlisted(mechanism: Mechanism, pattern: re.Pattern[str]) -> Iterator[tuple[Step | Check, str]]:
    """Yield the steps and checks that cite in this form what the mechanism does not list, with its name."""
    ids = "|".join(re.escape(source.id) for source in mechanism.sources)
    known = re.compile(rf"[; ]*(?:{ids})(?!\w)") if ids else re.compile("(?!)")
    declared: list[Step | Check] = [*(step for _, step in mechanism.steps), *mechanism.checks]
    for citing in declared:
        for found in pattern.finditer(citing.source):
            if not known.match(citing.source, found.start()):
                yield citing, found[1] or found[2]


def _key_result(names: DeclaredNames, name: str) -> str:
    givers = [giver for giver in names.givers(name) if giver.step is not None]
    if not givers:
        steps = [known for known, all_ in names.known.items() if any(giver.step for giver in all_)]
        return Phrase("{name} is not a step{nearest}; name what a step gives", name=name, nearest=nearest(name, steps))
    if not any(giver.step and giver.step.output for giver in givers):
        return Phrase("{name} is not an output; take output=False away from its step", name=name)
    is_curve = {g.kind for g in givers} <= {"curve", "abscissa"}
    return Phrase("{name} is a curve; name an extreme of it", name=name) if is_curve else ""


def _export(profile: Profile, names: DeclaredNames) -> Iterator[str]:
    if isinstance(profile, CurveTable):
        if [names.kinds(name) for name in profile.columns] != [{"abscissa"}]:
            template = 'has columns={columns}; name the abscissa of its curves alone: ("angle",)'
            yield Phrase(template, columns=repr(profile.columns))
        return
    if len(profile.columns) < 2:
        yield phrase("has fewer than two columns; name x and y at least")
    for name in profile.columns:
        curves = [giver for giver in names.givers(name) if giver.kind == "curve"]
        if absent := lacking(names, name, When(frozenset(profile.needs))):
            yield Phrase("writes {absent}", absent=absent)
        elif not curves:
            yield Phrase("writes {name}, which is not a curve", name=name)
        elif not all(giver.step and giver.step.output for giver in curves):
            yield Phrase("writes {name}, which is not an output; take output=False away from its step", name=name)
    axes = set().union(*(names.axes(name) for name in profile.columns))
    if len(axes) > 1:
        yield Phrase("writes curves over {axes}; give each its own export", axes=named(sorted(axes), " and over "))


def _comparison(names: DeclaredNames, comparison: Comparison) -> Iterator[str]:
    known = keys(comparison.mechanism.inputs)
    for key, (kind, name) in comparison.takes.items():
        if key not in known:
            yield Phrase("fills {key}, which is not an input of it{nearest}", key=key, nearest=nearest(key, known))
        if kind == names.mechanism.kind and not names.givers(name):
            yield Phrase("takes {unknown} in {kind}", unknown=unknown(name, names.known), kind=kind)
    for name, declared in comparison.mechanism.inputs.model_fields.items():
        if declared.is_required() and name not in comparison.takes:
            template = "fills nothing into {name}, which is required; add it to takes, or give it a default"
            yield Phrase(template, name=name)


# Symbols: within a mechanism no two quantities that may be there together are printed by one symbol.


NO_SYMBOLS = frozenset("$\\{}<>&#%^~")  # letters that mean something to LaTeX or HTML


class Printed(NamedTuple):
    """Hold what has a symbol: a quantity's name, its place, when it is there, and the step that gives it, if none an input.

    ``is_points`` is the number of samples, whose symbol no author chose: it is the other one that gets another.
    """

    name: str
    at: str
    when: When
    step: Step | None = None
    is_points: bool = False

    @property
    def giver(self) -> str:
        """Return what it belongs to: the row of a part."""
        return self.step.id if self.step else self.name


def symbol_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the second of two quantities with one symbol, and those in LaTeX; texts, and what only takes another over, may share it."""
    by_symbol: dict[str, list[Printed]] = {}
    for symbol, each in chain(_whole(names), _single(names)):
        by_symbol.setdefault(symbol, []).append(each)
        if letters := NO_SYMBOLS.intersection(symbol):
            template = (
                "has the symbol {symbol} with {letters}; a symbol is plain text, not LaTeX: write α_1, F_max, [σ]"
            )
            yield _of(names.mechanism, each, Phrase(template, symbol=symbol, letters=" ".join(sorted(letters))))
    told: set[tuple[str, str]] = set()
    for symbol, alike in by_symbol.items():
        for one, other in combinations(alike, 2):
            pair = one.giver, other.giver
            if one.name != other.name and pair not in told and _clash(names, one, other):
                told.add(pair)  # of two rows with many parts the first that are alike
                yield _alike(names.mechanism, symbol, *((other, one) if other.is_points else (one, other)))


def _alike(mechanism: Mechanism, symbol: str, one: Printed, other: Printed) -> Fault:
    """The fault of the other; inputs stand where they are declared, their quantity may be one of the program."""
    place = short(one.at if one.step else of_input(mechanism.inputs, one.name, one.at))
    template = (
        "has the symbol {symbol} of {name} ({points}at {place}): both would be printed as one quantity; give it another"
    )
    points = "samples, " * one.is_points
    return _of(mechanism, other, Phrase(template, symbol=symbol, name=one.name, points=points, place=place))


def _of(mechanism: Mechanism, each: Printed, text: str) -> Fault:
    if each.step:
        return Fault(each.at, Phrase("step {id}", id=each.name), text)
    return Fault(of_input(mechanism.inputs, each.name, each.at), Phrase("input {path}", path=each.name), text)


def _whole(names: DeclaredNames) -> Iterator[tuple[str, Printed]]:
    """Yield the symbols that are declared."""
    for key in names.world.keys.values():
        if isinstance(key.meta, Quantity) and key.meta.symbol:
            when, is_points = names.known[key.path][0].when, isinstance(key.meta, Samples)
            yield key.meta.symbol, Printed(key.path, key.meta.at, when, is_points=is_points)
    for step, when in names.steps:
        if step.symbol and step.printed and not isinstance(step, SilentStep) and names.kinds(step.id) != {"text"}:
            yield step.symbol, Printed(step.id, step.at, when, step)


def _single(names: DeclaredNames) -> Iterator[tuple[str, Printed]]:
    """Yield the symbols of parts and crossings that formulas may take by names of their own."""
    for step, when in names.steps:
        if step.symbol and has_own_names(step):
            for each in names_ahead(step):
                if each.role in ("part", "crossing"):
                    yield numbered_symbol(step, each.number), Printed(each.name, step.at, when, step)


def _clash(names: DeclaredNames, one: Printed, other: Printed) -> bool:
    for a, b in ((one, other), (other, one)):
        over = a.step.takes_over() if a.step else set()
        if b.name in over or f"inputs.{b.name}" in over:
            return False
    return names.world.example(one.when.with_(other.when)) is not None


# The files that a plugin is written in, and what stands in them as syntax.


def parsed(file: Path) -> ast.Module:
    """Return a file as syntax; without a statement where it is none, a file of the package that is never imported."""
    return _parsed(file, file.stat().st_mtime_ns)


@lru_cache(maxsize=512)
def _parsed(file: Path, changed: int) -> ast.Module:
    """The file as it is since it was changed."""
    try:
        return ast.parse(file.read_bytes())
    except (SyntaxError, ValueError):
        return ast.Module([], [])


def own_files(mechanism: Mechanism) -> list[Path]:
    """Return the file that declares a mechanism; of a folder that is the plugin all files, but for its tests."""
    file = Path(mechanism.at.rpartition(":")[0])
    if not file.is_file():  # made without a file
        return []
    if file.name != "__init__.py":
        return [file]
    tests = ("test_", "conftest")
    return [each for each in _in_folder(file.parent) if not each.name.startswith(tests) and "tests" not in each.parts]


def files_around(mechanism: Mechanism) -> list[Path]:
    """Return the files that may import what a mechanism's files define: those, and all of their package."""
    file = Path(mechanism.at.rpartition(":")[0])
    return _in_folder(file.parent) if (file.parent / "__init__.py").is_file() else own_files(mechanism)


def _in_folder(folder: Path) -> list[Path]:
    return sorted(file for file in folder.rglob("*.py") if file.is_file())
