"""Judges plugins: which kinds are meant, on which machines they are tried, and what was found."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from diecut_report.config.discovery import Discovery, DuplicateKind, Origin, UnknownKind, in_folder
from diecut_report.contract.mechanism import Mechanism
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.kit.all_examples import tried_on_each
from diecut_report.kit.example_machines import machines_beside, named_machines
from diecut_report.kit.missing_words import refuse_own, write_missing
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.po_files import ChangedCatalogue
from diecut_report.languages.speech import said
from diecut_report.testing.contract import ContractTest
from diecut_report.testing.tried_rules import TITLES, WORST_LAST, TriedRule

PLUGINS = "plugins"  # the folder of a new plugin's project that holds the plugin


class FolderFirst(Discovery):
    """Knows all kinds that are here; those of one folder stand before installed ones of the same name."""

    def __init__(self, first: Path | None, folders: Sequence[Path]) -> None:
        super().__init__([*([first] if first else []), *folders])
        self.first = first

    @cached_property
    def origins(self) -> dict[str, list[Origin]]:
        """Return each kind with the places that give it."""
        found = super().origins
        return {**found, **{kind: [origin] for kind, origin in self.own_kinds.items()}}

    @cached_property
    def own_kinds(self) -> dict[str, Origin]:
        """Return the kinds of the folder."""
        return {} if self.first is None else {origin.kind: origin for origin in in_folder(self.first)}


@dataclass
class CheckedPlugin:
    """Hold what was found of a plugin: each rule of the contract, and its chapter as HTML."""

    kind: str
    told: str
    mechanism: Mechanism | None = None
    rules: list[TriedRule] = field(default_factory=list)
    page: str = ""
    error: str = ""
    changed: dict[Path, ChangedCatalogue] = field(default_factory=dict)

    @property
    def status(self) -> str:
        """Return the worst that was found: pass, note, fail or broke."""
        found = [rule.status for rule in self.rules if rule.status != "not_tried"]
        return "broke" if self.error else max(found, key=WORST_LAST.index, default="pass")

    @property
    def data(self) -> dict[str, Any]:
        """Return it as plain data."""
        version = self.mechanism.version if self.mechanism else None
        rules = [
            {
                "rule": each.id,
                "status": each.status,
                "told": said(each.told),
                "faults": [said(fault) for fault in each.faults],
            }
            for each in self.rules
        ]
        error = {"error": said(self.error)} if self.error else {}
        return {
            "kind": self.kind,
            "version": version,
            "from": said(self.told),
            "status": self.status,
            "rules": rules,
        } | error


def meant(asked: str, folders: Sequence[Path]) -> tuple[FolderFirst, list[str]]:
    """Return the kinds that a name or a folder means, and what knows them; UserError where there are none."""
    place = Path(asked)
    if not place.is_dir():
        if place.suffix or "/" in asked:
            raise UserError(
                Problem(Phrase("There is no such folder of plugins: give a folder, or the name of a kind."), asked)
            )
        known = FolderFirst(None, folders)
        if asked not in known.origins:
            raise UserError(Problem(_unknown(known, asked)))
        return known, [asked]
    for folder in (place, place / PLUGINS):
        if folder.is_dir() and (own := (known := FolderFirst(folder, folders)).own_kinds):
            return known, list(own)
    words = "There is no plugin in this folder: a plugin is NAME.py, or a folder NAME with an __init__.py."
    raise UserError(Problem(Phrase(words), asked))


def _unknown(known: Discovery, kind: str) -> str:
    try:
        known.mechanism(kind)
    except UnknownKind as fault:
        return str(fault)
    raise AssertionError(kind)


def checked(
    known: FolderFirst, kind: str, configs: Sequence[Path], language: str, *, write_po: bool = False
) -> Iterator[TriedRule | CheckedPlugin]:
    """Yield each rule when it was tried, and at last the whole; UserError where a configuration cannot be used.

    With ``write_po`` the plugin's catalogues get the texts that they lack, and what nothing says is marked, before its words are tried.
    """
    origin = known.origins[kind][0]
    found = CheckedPlugin(kind, origin.told)
    if write_po:
        refuse_own(origin)
    try:
        known.extend()
        found.mechanism = known.mechanism(kind)
    except (PluginError, DuplicateKind) as error:
        found.error = error.message if isinstance(error, PluginError) else str(error)
        yield found
        return
    machines, refused = (named_machines(configs, kind, known), []) if configs else machines_beside(origin, known)
    if configs and not machines:
        words = Phrase("There is no mechanism of the kind {kind} in it.", kind=repr(kind))
        raise UserError(Problem(words, str(configs[0])))
    config, name = machines[0] if machines else (None, "")
    test = ContractTest(found.mechanism, known, config, name, language, refused)
    if write_po:
        found.changed = write_missing(test, origin)
    for rule in tried_on_each(test, machines[1:]):
        found.rules.append(rule)
        yield rule
    found.page = test.page
    yield found


__all__ = ["TITLES", "CheckedPlugin", "FolderFirst", "checked", "meant"]
