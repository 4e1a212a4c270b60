"""The first sheets of a report: what machine it is, what is open, what inputs move, what changed, and what the report carries."""

from __future__ import annotations

import base64
import gzip
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from hashlib import sha256
from typing import NamedTuple, TypeVar

from markupsafe import Markup

from diecut_report.quantities.formatting import number_text
from diecut_report.report.chapters.printed_tables import DASH
from diecut_report.report.model import CheckRow, TornadoFigure, utilisation
from diecut_report.report.symbols import symbol
from diecut_report.report.text import Catalogue, joined, number, quantity
from diecut_report.results.conclusion import VALUES
from diecut_report.results.mechanism_record import CheckRecord, ItemRecord, MechanismRecord, QuantityRecord
from diecut_report.results.model import (
    ChanceRecord,
    ChangedCheckRecord,
    ChangedDocumentRecord,
    ChangedQuantityRecord,
    ChangesRecord,
    CheckSideRecord,
    OpenRecord,
    QuantitySideRecord,
    ResultsRecord,
    TolerancesRecord,
    TornadoRecord,
)
from diecut_report.results.results_file import encoded, results_text, source_content

DIGITS = 4
NUMBER = "1.{n}"  # of a figure: those of mechanisms begin with a letter


@dataclass(frozen=True)
class PrintedTornado:
    """Hold a number, its figure with the number of that, and a row for each input: its name, lowered and raised, and what comes of both."""

    title: str
    number: str
    figure: TornadoFigure
    rows: list[tuple[str, str, str, str, str]]
    rest: str


class ChanceRow(NamedTuple):
    """Hold a check, how probable it is that it holds, with its interval, and in how many machines it did."""

    title: str
    probability: str
    interval: str
    held: str


@dataclass(frozen=True)
class PrintedInfluence:
    """Hold the chapter: its words, its tornados, and what tolerances do."""

    lead: str
    tornados: list[PrintedTornado]
    scatter: str = ""
    chances: list[ChanceRow] = field(default_factory=list)
    sure: str = ""

    @property
    def figures(self) -> list[tuple[str, TornadoFigure]]:
        """The figures with their numbers; none of a number that nothing moves."""
        return [(each.number, each.figure) for each in self.tornados if each.rows]


def printed_influence(results: ResultsRecord, words: Catalogue, before: int = 0) -> PrintedInfluence | None:
    """Return the chapter as it is printed; None where the results hold none. So many figures stand ``before`` its own."""
    found = results.influence
    if not found:
        return None
    lead, drawn = words.say("influence_lead", by=_told(100 * found.by, "%", words)), found.tolerances
    tornados = [_tornado(results, each, index, words) for index, each in enumerate(found.tornados, before + 1)]
    if not drawn:
        return PrintedInfluence(lead, tornados)
    unsure = [drawn.whole, *(each for each in drawn.checks if each.held < each.count)]
    chances = [_chance(results, each, words) for each in unsure]
    sure = words.say("influence_sure", n=len(drawn.checks) - len(unsure) + 1)
    return PrintedInfluence(lead, tornados, _scatter(drawn, words), chances, sure)


def _tornado(results: ResultsRecord, found: TornadoRecord, index: int, words: Catalogue) -> PrintedTornado:
    title, unit = _title(results, found.name, words), found.unit
    rows = [
        (bar.name, _told(bar.lowered, bar.unit, words), _told(bar.low, unit, words), _told(bar.raised, bar.unit, words),
         _told(bar.high, unit, words))
        for bar in found.bars
    ]  # fmt: skip
    shown = "" if unit == "1" else quantity("", unit).strip()
    figure = TornadoFigure(
        words.say("influence_on", what=f"{title} ({shown})" if shown else title), found.today, found.bars
    )
    rest = [words.say("influence_today", value=_told(found.today, unit, words))]
    counts = {"more": found.more, "still": found.still, "at_default": found.at_default}
    rest += [words.say(f"influence_{key}", n=count) for key, count in counts.items() if count]
    return PrintedTornado(title, NUMBER.format(n=index), figure, rows, " ".join(rest))


def _title(results: ResultsRecord, name: str, words: Catalogue) -> str:
    """What a number is called: a check's utilisation, a result, or an input, by its mechanism."""
    home, _, own = name.partition(".")
    data = results.mechanisms.get(home)
    if data is None:
        return name
    if own.startswith("checks.") and own.endswith(".utilisation"):
        check = own.removeprefix("checks.").removesuffix(".utilisation")
        return f"{data.title} · {_check_title(results, f'{home}.{check}')}: {words['influence_utilisation']}"
    row = data.outputs.get(own) or data.inputs.get(own)
    return f"{data.title} · {row.description}" if row else name


def _chance(results: ResultsRecord, found: ChanceRecord, words: Catalogue) -> ChanceRow:
    data = results.mechanisms.get(found.check.partition(".")[0])
    title = f"{data.title} · {_check_title(results, found.check)}" if data else words["influence_all"]
    low, high, probability = (_told(100 * share, "%", words) for share in (found.low, found.high, found.probability))
    held = words.say("influence_of", n=found.held, total=found.count)
    return ChanceRow(title, probability, f"{low} … {high}", held)


def _scatter(drawn: TolerancesRecord, words: Catalogue) -> str:
    inputs = ", ".join(
        f"{each.name} {_told(each.value, each.unit, words)} ± {_told(each.tolerance, each.unit, words)}"
        for each in drawn.inputs
    )
    return words.say(f"influence_{drawn.distribution}", inputs=inputs, n=drawn.count, seed=drawn.seed)


def _told(value: float | None, unit: str, words: Catalogue) -> str:
    if value is None:
        return words["influence_none"]
    return quantity(number_text(value, DIGITS), unit, words["decimal"])


# The changes between two results documents with printed numbers, ready for a page, a report or a terminal.


MOST_PER_CENT = 1000
SHORT = 12  # of a hash


class ChangedRow(NamedTuple):
    """An input or a result that changed."""

    path: str
    description: str
    symbol: Markup
    old: str
    new: str
    change: str
    note: str


class ChangedCheck(NamedTuple):
    """A check that changed; of a side without it the status is empty."""

    mechanism: str
    title: str
    old_status: str
    old: str
    new_status: str
    new: str
    change: str
    message: str


@dataclass
class PrintedChanges:
    """All that changed, each list the most important first; ``old`` and ``new`` name the two documents."""

    old: ChangedDocumentRecord
    new: ChangedDocumentRecord
    mechanisms: list[tuple[str, str, str]] = field(default_factory=list)
    checks: list[ChangedCheck] = field(default_factory=list)
    inputs: list[ChangedRow] = field(default_factory=list)
    following: list[ChangedRow] = field(default_factory=list)
    outputs: list[ChangedRow] = field(default_factory=list)
    code: list[tuple[str, str, str]] = field(default_factory=list)

    @property
    def names(self) -> tuple[str, str]:
        """How the two are told apart: by their revisions, where these differ, else by their files."""
        revisions = [str(side.revision) for side in (self.old, self.new)]
        if all(revisions) and revisions[0] != revisions[1]:
            return revisions[0], revisions[1]
        return self.old.file, self.new.file

    def __bool__(self) -> bool:
        return bool(self.mechanisms or self.checks or self.inputs or self.following or self.outputs)


def printed_changes(changes: ChangesRecord, words: Mapping[str, str]) -> PrintedChanges:
    """Return the changes as they are printed."""
    inputs = [(row, _row(row, words)) for row in changes.inputs]
    return PrintedChanges(
        changes.old,
        changes.new,
        [(each.name, each.old or DASH, each.new or DASH) for each in changes.mechanisms],
        [_check(row, words) for row in changes.checks],
        [made for row, made in inputs if not row.follows],
        [made for row, made in inputs if row.follows],
        [_row(row, words) for row in changes.outputs],
        [
            (row.name, f"{row.old[0]} ({row.old[1][:SHORT]})", f"{row.new[0]} ({row.new[1][:SHORT]})")
            for row in changes.code
        ],
    )


def _row(row: ChangedQuantityRecord, words: Mapping[str, str]) -> ChangedRow:
    bases = [side.basis if side else "" for side in (row.old, row.new)]
    note = f"{words[bases[0]]} → {words[bases[1]]}" if all(bases) and bases[0] != bases[1] else ""
    if row.follows:
        note = words["follows"].format(path=row.follows)
    old, new = (_value(side, words["decimal"]) for side in (row.old, row.new))
    change = relative(row.relative, words["decimal"])
    return ChangedRow(row.path, row.description, symbol(row.symbol), old, new, change, note)


def _value(side: QuantitySideRecord | None, decimal: str = ".") -> str:
    return DASH if side is None else quantity(side.display.text, side.display.unit, decimal) or DASH


def relative(share: float | None, decimal: str) -> str:
    """Return a change in per cent with its sign, or as a factor where it is beyond tenfold; nothing where there is none."""
    if share is None or share == 0:
        return ""
    is_factor = 100 * share >= MOST_PER_CENT
    value = 1 + share if is_factor else 100 * share
    printed = number(f"{float(f'{value:.3g}'):g}", decimal)
    return f"× {printed}" if is_factor else joined(f"{'+' if share > 0 else ''}{printed}", "%")


def _check(row: ChangedCheckRecord, words: Mapping[str, str]) -> ChangedCheck:
    sides = [_used(side, words["decimal"]) for side in (row.old, row.new)]
    statuses = [side.status if side else "" for side in (row.old, row.new)]
    message = row.new.message if row.new and row.new.status != "pass" else ""
    change = words[f"checks_{row.change}"]
    return ChangedCheck(row.mechanism, row.title, statuses[0], sides[0], statuses[1], sides[1], change, message)


def _used(side: CheckSideRecord | None, decimal: str) -> str:
    return "" if side is None or side.utilisation is None else utilisation(side.utilisation, side.status, decimal)


def marked(results: ResultsRecord) -> ResultsRecord:
    """Return results whose rows know what stood there before, where the results report what changed; else as they are."""
    changes = results.changes
    if not changes:
        return results
    before = {row.path: _value(row.old) for row in (*changes.inputs, *changes.outputs)}
    statuses = {f"{row.mechanism}.{row.id}": _status_before(row.old) for row in changes.checks}

    def mechanism(name: str, data: MechanismRecord) -> MechanismRecord:
        return data.with_(
            inputs={key: _marked(row, f"{name}.{key}", before) for key, row in data.inputs.items()},
            outputs={key: _marked(row, f"{name}.{key}", before) for key, row in data.outputs.items()},
            checks=[_marked(check, f"{name}.{check.id}", statuses) for check in data.checks],
            sections=[
                section.with_(items=[_marked(item, f"{name}.{item.id}", before) for item in section.items])
                for section in data.sections
            ],
        )

    press = results.press.with_(fields=[_marked(row, row.path, before) for row in results.press.fields])
    return results.with_(
        press=press, mechanisms={name: mechanism(name, data) for name, data in results.mechanisms.items()}
    )


Row = TypeVar("Row", QuantityRecord, ItemRecord, CheckRecord)


def _marked(row: Row, path: str, before: Mapping[str, str]) -> Row:
    return row.marked(before[path]) if path in before else row


def _status_before(side: CheckSideRecord | None) -> str:
    return DASH if side is None else f"{side.status.replace('_', ' ')} {_used(side, '.')}".rstrip()


# The line of page 1 on what comes of the advice of all failing checks together.


def followed_line(results: ResultsRecord, words: Catalogue, rows: Iterable[CheckRow] = ()) -> Iterator[str]:
    """Yield the line, its checks called as these rows call them; nothing where that was not calculated."""
    advice = results.summary.advice
    if not advice:
        return
    parted = [(each.path, *each.value.partition(" ")) for each in advice.changes]
    changes = ", ".join(f"{path} {number(text, words['decimal'])} {unit}".rstrip() for path, text, _, unit in parted)
    if advice.error:
        yield words.say("advice_impossible", changes=changes)
    elif advice.failing:
        titles = {f"{row.mechanism}.{row.id}": f"{row.home} · {row.title}" for row in rows}
        left = ", ".join(titles.get(check, check) for check in advice.failing)
        yield words.say("advice_leaves", changes=changes, checks=left)
    else:
        yield words.say("advice_passes", changes=changes)


# What machine it is, as the head of page 1 says it: what the press asks for, and of each of these quantities the first that a mechanism has.


FACTS = (
    (("press_consistency", "true_rate"),),
    (("drive_train", "motor_power"),),
    (("cyclogram", "power_mean"), ("cylinder_drive", "power_mean"), ("", "power_mean")),
    (("cyclogram", "torque_peak"), ("cylinder_drive", "crank_torque_peak"), ("", "torque_peak"), ("", "torque_max")),
    (("", "machine_mass"), ("cylinder_sizing", "mass")),
)
"""Kinds of mechanisms, any where there is none, and the ids of their numbers: rates, installed and mean power, peak torque, mass."""


def machine_facts(results: ResultsRecord, words: Catalogue) -> list[tuple[str, str]]:
    """Return what the machine is, as far as the results hold it, each with what it is called: rate, format, board, power, torque, mass."""
    fields = {row.path: row for row in results.press.fields}
    sheet = [_shown(fields[path], words) for path in ("press.sheet.length", "press.sheet.width") if path in fields]
    rate = fields.get("press.productivity")
    found = [(rate.description, _shown(rate, words))] if rate else []
    required = _first(results, [("press_consistency", "required_rate")])
    found += [(words["required_rate"], _shown(required[1], words))] if required else []
    found += [(words["sheet_format"], " × ".join(sheet))] if sheet else []
    board = fields.get("press.sheet.thickness")
    found += [(words["board"], _shown(board, words))] if board else []
    rows = (_first(results, names) for names in FACTS)
    found += [(f"{row.description} ({name})", _shown(row, words)) for name, row in filter(None, rows)]
    return [(label, text) for label, text in found if text]


def _first(results: ResultsRecord, names: Sequence[tuple[str, str]]) -> tuple[str, QuantityRecord] | None:
    for kind, id in names:
        for name, data in results.mechanisms.items():
            row = data.outputs.get(id) or data.inputs.get(id)
            if kind in ("", data.kind) and row is not None and isinstance(row.value, int | float):
                return name, row
    return None


def _shown(row: QuantityRecord, words: Catalogue) -> str:
    return _TYPED.sub("\u00a0", quantity(row.display.text, row.display.unit, words["decimal"]))


# What the verdict leaves open, and what the report does not cover.


_TYPED = re.compile(r"(?<=\d) (?=\S+$)")  # between a number and its unit that were typed as a text


class OpenReason(NamedTuple):
    """Hold values that are open for the same reason, by their keys, and that reason."""

    values: list[tuple[str, str]]
    why: str


class OpenGroup(NamedTuple):
    """Hold the open values of the press or of a mechanism."""

    name: str
    reasons: list[OpenReason]


def open_groups(results: ResultsRecord, words: Catalogue) -> list[OpenGroup]:
    """Return the assumed and default values that are open by what they belong to, in the file's order, those with the same reason together."""
    groups: dict[str, list[OpenRecord]] = {}
    for each in results.summary.open:
        if each.what in VALUES:
            groups.setdefault(_input(results, each.path)[0], []).append(each)
    return [OpenGroup(name, [*_reasoned(results, words, values)]) for name, values in groups.items()]


def _reasoned(results: ResultsRecord, words: Catalogue, values: list[OpenRecord]) -> Iterator[OpenReason]:
    reasons: dict[tuple[str, str], list[tuple[str, str]]] = {}
    for each in values:
        _, key, row = _input(results, each.path)
        is_unnamed = row is not None and row.basis in ("standard", "catalogue") and not row.note
        what = words["unnamed_basis"] if is_unnamed else words[each.what]
        reasons.setdefault((what, each.why), []).append((key, _shown(row, words) if row else ""))
    for (what, why), same in reasons.items():
        yield OpenReason(same, f"{what}: {why}")


class NotCovered(NamedTuple):
    """Hold something that the report does not cover, and who is to settle it."""

    text: str
    owner: str


def not_covered(results: ResultsRecord, words: Catalogue) -> list[NotCovered]:
    """Return what nothing in the report calculates: parts, load cases, and what lies beyond the methods."""
    owner = results.project.prepared_by
    unrated = [each for each in results.summary.open if each.what == "not_rated"]
    found = [NotCovered(words["beyond_methods"], owner)]
    if unrated and not results.summary.parts:
        found = [NotCovered(words["not_modelled"], owner), NotCovered(words["no_load_cases"], owner), *found]
    home = "mechanisms."  # a part of the machine is named by the reason itself
    names = [f"{each.path.removeprefix(home)}: " if each.path.startswith(home) else "" for each in unrated]
    parts = [NotCovered(f"{name}{each.why}.", each.owner) for name, each in zip(names, unrated, strict=True)]
    parts += [NotCovered(f"{each.why}.", each.owner) for each in results.summary.accepted]
    return [*found[:1], *parts, *found[1:]] if parts else found


def _check_title(results: ResultsRecord, check: str) -> str:
    name, _, own = check.partition(".")
    data = results.mechanisms.get(name)
    return next((each.title for each in data.checks if each.id == own), own) if data else check


def _input(results: ResultsRecord, path: str) -> tuple[str, str, QuantityRecord | None]:
    """Whose input a path names, its key, and its line of the results; None where these do not have it."""
    whose, _, key = path.partition(".")
    if whose == "mechanisms":
        name, _, key = key.partition(".")
        return name, key, results.mechanisms[name].inputs.get(key)
    return whose, key, next((row for row in results.press.fields if row.path == path), None)


# What a report carries of its calculation: the results file and the configuration, attached to the PDF, linked in the HTML.


RESULTS, CONFIG = "results.json", "config.yaml"
"""What the files are called in each report, whatever theirs are called: `extract` and `verify` find them by these names."""
DATE = datetime(1980, 1, 1)  # of the attachments, which must have one: equal inputs give equal bytes
PACKED = ".gz"
LEVEL = 6  # 9 takes half as long again, and saves less than a hundredth


class CarriedFile(NamedTuple):
    """A file that a report carries."""

    name: str
    media_type: str
    description: str
    content: bytes
    relationship: str = "Data"  # to the document, as PDF/A-3 has it: "Source", "Data"

    @property
    def address(self) -> str:
        """The file as a data address."""
        return f"data:{self.media_type};base64,{base64.b64encode(self.content).decode()}"

    @property
    def digest(self) -> str:
        """The SHA-256 of the file."""
        return sha256(self.content).hexdigest()

    @property
    def packed(self) -> CarriedFile:
        """The file packed by gzip, without a date."""
        content = gzip.compress(self.content, LEVEL, mtime=0)
        return CarriedFile(self.name + PACKED, "application/gzip", self.description, content)


def carried_files(results: ResultsRecord, words: Mapping[str, str]) -> tuple[CarriedFile, CarriedFile]:
    """Return the configuration and the results, in the order of their names."""
    text = encoded(results_text(results))
    return (
        CarriedFile(CONFIG, "application/yaml", words["configuration"], source_content(results.config), "Source"),
        CarriedFile(RESULTS, "application/json", words["carried_results"], text),
    )
