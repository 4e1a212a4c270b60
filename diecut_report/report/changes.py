"""The changes between two results documents with printed numbers, ready for a page, a report or a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from markupsafe import Markup

from diecut_report.report.model import utilisation
from diecut_report.report.number_format import joined, number, quantity
from diecut_report.report.symbols import symbol

Data = Mapping[str, Any]
DASH = "–"
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

    old: Data
    new: Data
    mechanisms: list[tuple[str, str, str]] = field(default_factory=list)
    checks: list[ChangedCheck] = field(default_factory=list)
    inputs: list[ChangedRow] = field(default_factory=list)
    following: list[ChangedRow] = field(default_factory=list)
    outputs: list[ChangedRow] = field(default_factory=list)
    code: list[tuple[str, str, str]] = field(default_factory=list)

    @property
    def names(self) -> tuple[str, str]:
        """How the two are told apart: by their revisions, where these differ, else by their files."""
        revisions = [str(side["revision"]) for side in (self.old, self.new)]
        if all(revisions) and revisions[0] != revisions[1]:
            return revisions[0], revisions[1]
        return str(self.old["file"]), str(self.new["file"])

    def __bool__(self) -> bool:
        return bool(self.mechanisms or self.checks or self.inputs or self.following or self.outputs)


def printed_changes(changes: Data, words: Mapping[str, str]) -> PrintedChanges:
    """Return the changes as they are printed."""
    inputs = [(row, _row(row, words)) for row in changes["inputs"]]
    return PrintedChanges(
        changes["old"],
        changes["new"],
        [(each["name"], each["old"] or DASH, each["new"] or DASH) for each in changes["mechanisms"]],
        [_check(row, words) for row in changes["checks"]],
        [made for row, made in inputs if not row["follows"]],
        [made for row, made in inputs if row["follows"]],
        [_row(row, words) for row in changes["outputs"]],
        list(_code(changes["code"])),
    )


def _row(row: Data, words: Mapping[str, str]) -> ChangedRow:
    note = words["follows"].format(path=row["follows"]) if row["follows"] else _bases(row, words)
    old, new = (_value(row[side], words["decimal"]) for side in ("old", "new"))
    change = relative(row["relative"], words["decimal"])
    return ChangedRow(row["path"], row["description"], symbol(row["symbol"]), old, new, change, note)


def _value(side: Data | None, decimal: str) -> str:
    return DASH if side is None else quantity(side["display"]["text"], side["display"]["unit"], decimal) or DASH


def relative(share: float | None, decimal: str) -> str:
    """Return a change in per cent with its sign, or as a factor where it is beyond tenfold; nothing where there is none."""
    if share is None or share == 0:
        return ""
    if 100 * share >= MOST_PER_CENT:
        return f"× {number(_rounded(1 + share), decimal)}"
    sign = "+" if share > 0 else ""
    return joined(sign + number(_rounded(100 * share), decimal), "%")


def _rounded(value: float) -> str:
    return f"{float(f'{value:.3g}'):g}"


def _bases(row: Data, words: Mapping[str, str]) -> str:
    """What a value rested on and rests on, where that changed."""
    bases = [side.get("basis", "") if side else "" for side in (row["old"], row["new"])]
    if not all(bases) or bases[0] == bases[1]:
        return ""
    return f"{words[bases[0]]} → {words[bases[1]]}"


def _check(row: Data, words: Mapping[str, str]) -> ChangedCheck:
    sides = [_used(row[side], words["decimal"]) for side in ("old", "new")]
    statuses = [row[side]["status"] if row[side] else "" for side in ("old", "new")]
    message = row["new"]["message"] if row["new"] and row["new"]["status"] != "pass" else ""
    change = words[f"checks_{row['change']}"]
    return ChangedCheck(row["mechanism"], row["title"], statuses[0], sides[0], statuses[1], sides[1], change, message)


def _used(side: Data | None, decimal: str) -> str:
    return (
        "" if side is None or side["utilisation"] is None else utilisation(side["utilisation"], side["status"], decimal)
    )


def _code(rows: Sequence[Data]) -> Iterator[tuple[str, str, str]]:
    for row in rows:
        old, new = (f"{version} ({digest[:SHORT]})" for version, digest in (row["old"], row["new"]))
        yield row["name"], old, new


def marked(results: Data) -> Data:
    """Return results whose rows tell what stood there before, where the results tell what changed; else as they are."""
    if "changes" not in results:
        return results
    told = Marks(results["changes"])
    press = results["press"] | {"fields": [told.row(row["path"], row) for row in results["press"]["fields"]]}
    mechanisms = {name: told.mechanism(name, data) for name, data in results["mechanisms"].items()}
    return {**results, "press": press, "mechanisms": mechanisms}


class Marks:
    """What stood before at each place that changed, in words for a mark in the margin."""

    def __init__(self, changes: Data) -> None:
        self.quantities = {row["path"]: _before(row["old"]) for row in (*changes["inputs"], *changes["outputs"])}
        self.checks = {(row["mechanism"], row["id"]): _status_before(row["old"]) for row in changes["checks"]}

    def row(self, path: str, row: Data) -> Data:
        """Return a row of the results, with what stood there before."""
        return {**row, "changed": self.quantities[path]} if path in self.quantities else row

    def mechanism(self, name: str, data: Data) -> Data:
        """Return the results of a mechanism, with what stood there before."""
        groups = {
            group: {key: self.row(f"{name}.{key}", row) for key, row in data[group].items()}
            for group in ("inputs", "outputs")
        }
        keys = {check["id"]: (name, check["id"]) for check in data["checks"]}
        checks = [
            {**check, "changed": self.checks[keys[check["id"]]]} if keys[check["id"]] in self.checks else check
            for check in data["checks"]
        ]
        sections = [
            {**section, "items": [self.row(f"{name}.{item.get('id', '')}", item) for item in section["items"]]}
            for section in data["sections"]
        ]
        return {**data, **groups, "checks": checks, "sections": sections}


def _before(side: Data | None) -> str:
    return DASH if side is None else quantity(side["display"]["text"], side["display"]["unit"]) or DASH


def _status_before(side: Data | None) -> str:
    if side is None:
        return DASH
    used = _used(side, ".")
    return f"{str(side['status']).replace('_', ' ')} {used}".rstrip()
