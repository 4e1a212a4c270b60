"""A report judged by calculating it again: the same program, the same plugins, the same numbers and texts, the same pages?"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

from diecut_report.config.discovery import Discovery
from diecut_report.errors import PluginError
from diecut_report.exchange.agreement import Agreement, agreement
from diecut_report.exchange.carried_results import CarriedResults
from diecut_report.exchange.page_comparison import compared, other_templates
from diecut_report.exchange.recalculation import SHORT, Found, ReportParts, recalculated
from diecut_report.exchange.signatures import Signature, signatures
from diecut_report.languages.phrases import Counted, Phrase, cell, joined, phrase
from diecut_report.report.house_style import HouseStyle

Data = Mapping[str, Any]
OF_PROGRAM = ("version", "source_sha256", "extensions")
OF_CODE = ("plugin_version", "plugin_sha256")
"""What tells of the code and is held against the program's own apart from the numbers."""
VERSION = re.compile(r"\d[\w.+-]{0,40}", re.ASCII)  # of a library


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
    broken: tuple[PluginError, ...] = field(default=())
    signatures: tuple[Signature, ...] = field(default=())

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
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], parts: ReportParts, *, pages: bool = True,
    trusted: Path | None = None, house: HouseStyle | None = None, previous: Data | None = None,
) -> Verification:  # fmt: skip
    """Calculate the configuration of a report again and hold the report against that; without ``pages`` its results alone.

    ``trusted`` holds the certificates that signatures must lead to; without it anybody's signature holds that is whole. ``previous``
    are the results since which the report shows changes. UserError where its configuration cannot be calculated any more.
    """
    results = carried.results
    signed = signatures(carried.content, trusted) if carried.form == "pdf" else []
    again = recalculated(carried, discovery, tell, parts, dict(previous) if previous is not None else None)
    program = _program(results, again.results)
    plugins = list(_plugins(_calculated(results), _calculated(again.results)))
    numbers = agreement(_compared(results, again.results, program), _compared(again.results, again.results, program))
    is_same = program[1] and not numbers.differences
    shown = _pages(carried, signed, house, discovery, tell, is_same=is_same) if pages else None
    return Verification(program, plugins, _config(carried), again.options, numbers, shown, again.broken, tuple(signed))


def _pages(
    carried: CarriedResults, signed: list[Signature], house: HouseStyle | None, discovery: Discovery, tell: Callable[[str], None],
    *, is_same: bool,
) -> Found | None:  # fmt: skip
    if carried.form == "json":  # without pages, but it may tell of templates
        reason = other_templates(carried, house)
        return (reason, False) if reason else None
    if not is_same:
        return phrase("not compared, since the program or the numbers are others"), False
    return compared(carried, signed, house, discovery, tell)


def _compared(results: Data, again: Data, program: Found) -> Data:
    """What must come out again: all that the results hold, but what has a line of its own, as it tells of the code."""
    kept = dict(results)
    known = again["program"]["libraries"]
    libraries = {
        name: known[name] if name in known and VERSION.fullmatch(version) else version
        for name, version in results["program"].get("libraries", {}).items()
    }
    kept["program"] = {k: v for k, v in results["program"].items() if k not in OF_PROGRAM} | {"libraries": libraries}
    for group in ("mechanisms", "comparisons"):
        if group in results:
            kept[group] = {
                name: {k: v for k, v in data.items() if k not in OF_CODE} for name, data in results[group].items()
            }
    if not program[1]:
        kept.pop("form_version", None)
    return kept


def _calculated(results: Data) -> Data:
    return {**results["mechanisms"], **results.get("comparisons", {})}


def _program(first: Data, again: Data) -> Found:
    first, again = first["program"], again["program"]
    named = f"{first['name']} {first['version']}"
    old, new = (str(each.get("source_sha256", "")) for each in (first, again))
    if (first["version"], old, first.get("extensions")) == (again["version"], new, again.get("extensions")):
        return Phrase(
            "{named}, source {old}: the same{others}", named=named, old=old[:SHORT], others=_others(first, again)
        ), True
    if first["version"] != again["version"]:
        return Phrase("{named} made the report, this is {version}", named=named, version=again["version"]), False
    if old != new:
        return Phrase(
            "{named}, but its source is another one ({old} then, {new} now)",
            named=named,
            old=old[:SHORT],
            new=new[:SHORT],
        ), False
    return Phrase("{named}, but its extensions are others", named=named), False


def _others(first: Data, again: Data) -> str:
    """Which libraries have another version now, where the report tells theirs: it may explain what differs."""
    old, new = first.get("libraries", {}), again["libraries"]
    told = [
        Phrase("{name} {old} then, {new} now", name=name, old=version, new=new.get(name) or phrase("none"))
        for name, version in old.items()
        if new.get(name) != version
    ]
    return "; " + phrase(joined(told, ", ")) if told else ""


def _plugins(first: Data, again: Data) -> Iterator[Found]:
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


def _codes(calculated: Data) -> dict[str, set[tuple[str, str]]]:
    """The versions and sources of each kind."""
    found: dict[str, set[tuple[str, str]]] = {}
    for data in calculated.values():
        code = str(data.get("plugin_version", "")), str(data.get("plugin_sha256", ""))
        found.setdefault(str(data.get("kind", "")), set()).add(code)
    return found


def _named_code(code: tuple[str, str]) -> str:
    return Phrase("version {version}, source {digest}", version=code[0], digest=code[1][:SHORT])


def _config(carried: CarriedResults) -> Found:
    """Whether the configuration and its tables are those whose hashes the report names."""
    said = carried.results["config"]
    contents = {said["file"]: carried.config_content} | carried.tables
    hashes = {file["file"]: str(file["sha256"]) for file in (*said.get("materials", ()), *_logo(said), said)}
    for name, content in contents.items():
        found = sha256(content).hexdigest()
        if found != hashes[name]:
            words = Phrase(
                "{name} is not the one that the report names (SHA-256 {hashes}, found {found})",
                name=cell(name),
                hashes=hashes[name][:SHORT],
                found=found[:SHORT],
            )
            return words, False
    told = {"files": ", ".join(map(cell, contents)), "digest": said["sha256"][:SHORT]}
    return Counted(
        len(contents),
        "{files}, SHA-256 {digest}: the one that the report names",
        "{files}, SHA-256 {digest}: the ones that the report names",
        told,
    ), True


def _logo(said: Data) -> list[Data]:
    return [said["logo"]] if "logo" in said else []
