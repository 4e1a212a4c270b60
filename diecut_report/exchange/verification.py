"""A report judged by calculating it again: the same program, the same plugins, the same numbers and texts, the same pages?"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import Tree
from diecut_report.design.findings import decided, with_findings
from diecut_report.errors import PluginError, UserError
from diecut_report.exchange.carried import VERSION, CarriedResults
from diecut_report.exchange.rendering import document
from diecut_report.press import AskedReport, CalculatedPress, Press
from diecut_report.report.pages.firm_templates import HouseStyle
from diecut_report.results.changes import compare_with, is_number
from diecut_report.results.model import CarriedConfigRecord, ProgramRecord, ResultsRecord
from diecut_report.results.results_file import source_content
from diecut_report.text.phrases import Counted, Phrase, cell, joined, phrase

if TYPE_CHECKING:
    from diecut_report.exchange.signatures import Signature

# Two results documents held against each other, value by value: how many numbers agree, how exactly, and which differ.


CLOSE = 1e-9  # relative: other processors and libraries round differently in the last digits
NOISE = 1e-12  # of the greatest value of a list, below which nothing but rounding is left
TINY = 1e-15
ORDER = ("status", "summary", "governing", "inputs", "checks", "outputs", "values", "phases", "curves")
"""The parts of results from the most important on; what is not named here comes last."""
WORDS = ("text", "message")

Value = Any
NOWHERE = object()


@dataclass(frozen=True)
class Difference:
    """Hold a place of the results with what stands there in both; None where there is nothing."""

    path: str
    first: Value
    second: Value

    @property
    def order(self) -> tuple[int, bool]:
        """Return by what differences are sorted: the part of the results, and last the words, which follow from the numbers."""
        parts = self.path.split(".")
        named = [ORDER.index(part) for part in (parts[0], *parts[2:3]) if part in ORDER]
        return named[0] if named else len(ORDER), parts[-1] in WORDS


@dataclass
class Agreement:
    """Hold the count of the numbers, of those that are exactly alike, and what differs, the most important first."""

    numbers: int = 0
    exact: int = 0
    differences: list[Difference] = field(default_factory=list)

    @property
    def differing(self) -> int:
        """Return how many numbers differ."""
        return sum(is_number(each.first) or is_number(each.second) for each in self.differences)


def agreement(first: Mapping[str, Any], second: Mapping[str, Any]) -> Agreement:
    """Return how far two results documents agree."""
    made = Agreement()
    made.differences = sorted(_differences(first, second, "", made, 0.0), key=lambda each: each.order)
    return made


def _differences(a: Value, b: Value, path: str, made: Agreement, scale: float) -> Iterator[Difference]:
    if isinstance(a, dict) and isinstance(b, dict):
        for key in dict.fromkeys([*a, *b]):
            yield from _differences(a.get(key, NOWHERE), b.get(key, NOWHERE), _below(path, key), made, 0.0)
        yield from _order_of_keys(a, b, path)
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        scale = max((abs(each) for each in a if is_number(each)), default=0.0)
        for index, pair in enumerate(zip(a, b, strict=True)):
            part = pair[0]["id"] if isinstance(pair[0], dict) and isinstance(pair[0].get("id"), str) else index
            yield from _differences(*pair, _below(path, part), made, scale)
    elif not _agree(a, b, made, scale):
        yield Difference(path, None if a is NOWHERE else a, None if b is NOWHERE else b)


def _order_of_keys(a: dict[str, Value], b: dict[str, Value], path: str) -> Iterator[Difference]:
    """What stands in another order is shown in another order."""
    orders = [[key for key in side if key in other] for side, other in ((a, b), (b, a))]
    if orders[0] != orders[1]:
        first = next(index for index, pair in enumerate(zip(*orders, strict=True)) if pair[0] != pair[1])
        yield Difference(_below(path, "(order)"), *(", ".join(order[first:]) for order in orders))


def _agree(a: Value, b: Value, made: Agreement, scale: float) -> bool:
    if isinstance(a, str) and isinstance(b, str):  # a name that knows its formula is a text, too
        return str(a) == str(b)
    if not (is_number(a) and is_number(b)):
        return type(a) is type(b) and bool(a == b)
    made.numbers += 1
    made.exact += a == b
    return math.isclose(a, b, rel_tol=CLOSE, abs_tol=max(NOISE * scale, TINY))


def _below(path: str, key: object) -> str:
    return f"{path}.{key}" if path else f"{key}"


# The results document of a report made once more: from the configuration that it carries and the options that it tells, by this program.


Found = tuple[str, bool]  # what was found, in words, and whether it is as it should be
SHORT = 12  # of a hash, as in a report


def recalculated(
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], previous: ResultsRecord | None
) -> tuple[ResultsRecord, tuple[PluginError, ...], tuple[Found, ...]]:  # fmt: skip
    """Return the results document as this program makes it of the configuration and the options in a report, the plugins that broke, and
    what was found of the options.

    ``previous`` are the results of the former revision, where they are given; else they are calculated from what the report carries
    of it. UserError where the configuration cannot be calculated any more.
    """
    given = carried.results
    made = _calculated(given.config, carried.tables, f"{carried.path} (its configuration)", discovery, tell)
    # without any part of a report they are as ``calc`` writes them, and ``render`` sets them
    is_tried = bool(given.summary.tried or given.summary.moves) and not made.results.summary.tried
    has_influence = given.influence or (carried.form != "json" and made.press.config.report.influence)
    made = with_findings(made) if is_tried or given.summary.advice or has_influence else made
    results = made.results
    # as far as the command takes them; what it does not take differs from what comes out now
    only = given.report.only if results.mechanisms.keys() >= set(given.report.only) else []
    asked = AskedReport(given.project.language, given.report.detail, tuple(dict.fromkeys(only)))
    former, lost = _former(carried, discovery, tell, previous)
    options = _options(given, results, asked)
    again = asked.noted(results)
    again = compare_with(former, again) if former else again
    settings = again.report.with_(template_sha256=given.report.template_sha256)  # judged with the pages
    again = again.with_(report=settings)
    again = again.with_(changes=given.changes, former=given.former) if lost else again
    found = [options, *([(lost, False)] if lost else [])]
    if previous is None and given.changes != again.changes:
        template = "not those that come of the former configuration in the report; where another program calculated that, --previous FILE proves them"
        found.append((phrase(template), False))
    return again, made.broken, tuple(found)


def _calculated(
    config: CarriedConfigRecord, tables: Mapping[str, bytes], file: str, discovery: Discovery, tell: Callable[[str], None]
) -> CalculatedPress:  # fmt: skip
    """A configuration in a report, calculated; it is called as the report calls it, and problems name the report (``file``).

    Its tables are those that the report carries, and none that lie beside it by chance.
    """
    with TemporaryDirectory(prefix="diecut-report-") as folder:
        places = {name: Path(folder) / f"{number}" / Path(name).name for number, name in enumerate(tables)}
        for name, path in places.items():
            path.parent.mkdir()
            path.write_bytes(tables[name])
        tree = yaml.parse(config.source_text, file)
        named = Tree(tree.root, tree.file, tree.text, sha256(source_content(config)).hexdigest(), config.file)
        missing = Path(folder) / "not carried"
        press = Press.read(named, discovery, tell, find=lambda name: places.get(name, missing / name))
        return decided(press.calculate())


def _options(given: ResultsRecord, again: ResultsRecord, asked: AskedReport) -> Found:
    """The options in words: what a report shows by them does not follow from its configuration."""
    former = given.former
    told = [
        f"--language {asked.language}" if asked.language != again.project.language else "",
        f"--detail {asked.detail}" if asked.detail != again.report.detail else "",
        f"--only {','.join(asked.only)}" if asked.only else "",
        f"--template (SHA-256 {given.report.template_sha256[:SHORT]})" if given.report.template_sha256 else "",
        f"--previous {f'{cell(former.file)} (SHA-256 {former.sha256[:SHORT]})' if former else '…'}"
        if given.changes
        else "",
    ]
    named = " ".join(filter(None, told))
    none = "none: the report shows what its configuration asks for, and no changes since a former revision"
    template = "made with {options}; all else follows from the configuration"
    return Phrase(template, options=named) if named else phrase(none), True


def _former(
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], previous: ResultsRecord | None
) -> tuple[ResultsRecord | None, str]:
    """The results of the former revision, or in words what keeps the changes since then from being proved."""
    former = carried.results.former
    if previous is not None or not carried.results.changes:
        return previous, ""
    if not former:
        template = (
            "not proved: the report does not carry the former configuration; --previous FILE names the former report"
        )
        return None, phrase(template)
    try:
        file = f"{carried.path} (its former configuration)"
        return _calculated(former, carried.former_tables, file, discovery, tell).results, ""
    except UserError:
        template = "not proved: the former configuration cannot be calculated any more; --previous FILE names the former report"
        return None, phrase(template)


# Whether a document is, byte for byte, what this program makes of the results in it, but for signatures.


def compared(
    carried: CarriedResults, signed: list[Signature], house: HouseStyle | None, discovery: Discovery, tell: Callable[[str], None]
) -> Found:  # fmt: skip
    """Return whether the pages of a report are those that are set again of its results, and nothing was added but signatures."""
    if reason := other_templates(carried, house):
        return reason, False
    again = document(carried.results, [carried.form], discovery, tell, str(carried.path), house)
    made, content = again.contents[carried.form], carried.content
    if content == made:
        return phrase("byte for byte what the program makes of these results"), True
    if not (carried.form == "pdf" and content.startswith(made)):
        template = (
            "not what the program makes of these results: it was changed or saved by another program, or set with other libraries of "
            "the system. The numbers above are those that it carries; what its pages show may be others"
        )
        return phrase(template), False
    if not signed or not all(each.holds for each in signed):
        template = (
            "what the program makes of these results, with {more} bytes that were added later (a signature, a note)"
        )
        return Phrase(template, more=len(content) - len(made)), False
    from diecut_report.exchange.later_changes import only_signed

    if only_signed(made, content):
        return phrase("byte for byte what the program makes of these results, and after it the signatures"), True
    template = "not what the program makes of these results: what was added later, with a signature, changes what the document shows or holds"
    return phrase(template), False


def other_templates(carried: CarriedResults, house: HouseStyle | None) -> str:
    """Return why the pages cannot be compared with the templates that are given; nothing where they can."""
    asked = carried.results.report.template_sha256
    if asked == (house.sha256 if house else ""):
        return ""
    own = Phrase("templates of their own (SHA-256 {asked})", asked=cell(asked[:SHORT]))
    own = own if asked else phrase("the program's templates alone")
    return Phrase("not compared, since they are set with {own}; --template DIR names the templates", own=own)


@dataclass
class Verification:
    """Hold what was found of a report; ``broken`` are plugins that broke while it was calculated again.

    ``pages`` is None where they were not asked for, and of results alone, which have none.
    """

    program: Found
    plugins: list[Found]
    config: Found
    options: tuple[Found, ...]
    agreement: Agreement
    pages: Found | None
    broken: tuple[PluginError, ...]
    signatures: tuple[Signature, ...]

    @property
    def holds(self) -> bool:
        """Return whether everything agrees."""
        found = [self.program, *self.plugins, self.config, *self.options, *([self.pages] if self.pages else [])]
        return (
            all(good for _, good in found)
            and all(each.holds for each in self.signatures)
            and not self.agreement.differences
            and not self.broken
        )


def verify(
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], *, pages: bool = True,
    trusted: Path | None = None, house: HouseStyle | None = None, previous: ResultsRecord | None = None,
) -> Verification:  # fmt: skip
    """Calculate the configuration of a report again and hold the report against that; without ``pages`` its results alone.

    ``trusted`` holds the certificates that signatures must lead to; without it anybody's signature holds that is whole. ``previous``
    are the results since which the report shows changes. UserError where its configuration cannot be calculated any more.
    """
    carried.require_own_name()
    results = carried.results
    signed = _signatures(carried, trusted)
    again, broken, options = recalculated(carried, discovery, tell, previous)
    program, plugins = _program(results, again), list(_plugins(results, again))
    numbers = agreement(_compared(results, again, program), _compared(again, again, program))
    shown: Found | None = None
    if pages and carried.form == "json":  # without pages, but it may tell of templates
        reason = other_templates(carried, house)
        shown = (reason, False) if reason else None
    elif pages and not (program[1] and not numbers.differences):
        shown = phrase("not compared, since the program or the numbers are others"), False
    elif pages:
        shown = compared(carried, signed, house, discovery, tell)
    return Verification(program, plugins, _config(carried), options, numbers, shown, broken, tuple(signed))


def _signatures(carried: CarriedResults, trusted: Path | None) -> list[Signature]:
    """The signatures; the libraries that judge them are loaded where there is something to judge."""
    whole = carried.content if carried.form == "pdf" else b""
    if trusted is None and b"/ByteRange" not in whole:
        return []
    from diecut_report.exchange.signatures import signatures

    return signatures(whole, trusted)


def _compared(results: ResultsRecord, again: ResultsRecord, program: Found) -> Mapping[str, Any]:
    """What must come out again: all that the results hold, but what has a line of its own, as it tells of the code."""
    known = again.program.libraries
    libraries = {
        name: known[name] if name in known and VERSION.fullmatch(version) else version
        for name, version in results.program.libraries.items()
    }
    no_code = {"plugin_version": "", "plugin_sha256": ""}
    made = results.with_(
        program=again.program.with_(name=results.program.name, libraries=libraries),
        mechanisms={name: data.with_(**no_code) for name, data in results.mechanisms.items()},
        comparisons={name: data.with_(**no_code) for name, data in results.comparisons.items()},
    )
    return (made if program[1] else made.with_(form_version=again.form_version)).data()


def _program(first_results: ResultsRecord, again_results: ResultsRecord) -> Found:
    first, again = first_results.program, again_results.program
    named, old, new = cell(f"{first.name} {first.version}"), first.source_sha256, again.source_sha256
    if (first.version, old, first.extensions) == (again.version, new, again.extensions):
        template = "{named}, source {old}: the same{others}"
        return Phrase(template, named=named, old=cell(old[:SHORT]), others=_others(first, again)), True
    if first.version != again.version:
        return Phrase("{named} made the report, this is {version}", named=named, version=again.version), False
    if old != new:
        template = "{named}, but its source is another one ({old} then, {new} now)"
        return Phrase(template, named=named, old=cell(old[:SHORT]), new=new[:SHORT]), False
    return Phrase("{named}, but its extensions are others", named=named), False


def _others(first: ProgramRecord, again: ProgramRecord) -> str:
    """Which libraries have another version now, where the report tells theirs: it may explain what differs."""
    old, new = first.libraries, again.libraries
    told = [
        Phrase("{name} {old} then, {new} now", name=name, old=version, new=new.get(name) or phrase("none"))
        for name, version in old.items()
        if new.get(name) != version
    ]
    return "; " + phrase(joined(told, ", ")) if told else ""


def _plugins(first: ResultsRecord, again: ResultsRecord) -> Iterator[Found]:
    """One line for all kinds that are the same, one for each other; mechanisms of one kind have the same code."""
    old, now = _codes(first), _codes(again)
    same = [kind for kind, codes in old.items() if now.get(kind) == codes]
    if same:
        yield Phrase("{n} of {total} kinds: the same versions and sources", n=len(same), total=len(old)), True
    for kind, codes in old.items():
        if kind not in now:
            yield Phrase("{kind}: not calculated any more", kind=kind), False
        elif now[kind] != codes:
            other = next(iter(sorted(codes - now[kind])), ("", ""))
            told = {"old": _named_code(other), "new": _named_code(*sorted(now[kind])[:1])}
            yield Phrase("{kind}: {old} then, {new} now", told, kind=kind), False
    yield from ((Phrase("{kind}: not in the report", kind=kind), False) for kind in now if kind not in old)


def _codes(results: ResultsRecord) -> dict[str, set[tuple[str, str]]]:
    found: dict[str, set[tuple[str, str]]] = {}
    for data in results.calculated.values():
        found.setdefault(data.kind, set()).add((data.plugin_version, data.plugin_sha256))
    return found


def _named_code(code: tuple[str, str]) -> str:
    return Phrase("version {version}, source {digest}", version=cell(code[0]), digest=cell(code[1][:SHORT]))


def _config(carried: CarriedResults) -> Found:
    """Whether the configuration and its tables are those whose hashes the report names."""
    config = carried.results.config
    contents = {config.file: source_content(config)} | carried.tables
    files = (*config.materials, *([config.logo] if config.logo else ()), config)
    hashes = {file.file: file.sha256 for file in files}
    for name, content in contents.items():
        found = sha256(content).hexdigest()
        if found != hashes[name]:
            template = "{name} is not the one that the report names (SHA-256 {hashes}, found {found})"
            return Phrase(template, name=cell(name), hashes=cell(hashes[name][:SHORT]), found=found[:SHORT]), False
    told = {"files": ", ".join(map(cell, contents)), "digest": cell(config.sha256[:SHORT])}
    one = "{files}, SHA-256 {digest}: the one that the report names"
    return Counted(len(contents), one, "{files}, SHA-256 {digest}: the ones that the report names", told), True
