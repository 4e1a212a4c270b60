"""Judges plugins: which kinds are meant, on which machines they are tried, and what was found."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from importlib.resources import as_file, files
from itertools import groupby
from pathlib import Path
from typing import Any

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery, DuplicateKind, Origin, in_folder
from diecut_report.errors import PluginError, Problem, UserError, refusal
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.press import Press
from diecut_report.testing.contract import WORST_LAST, ContractTest, TriedRule, write_missing
from diecut_report.text.phrases import Counted, Phrase, joined
from diecut_report.text.po_files import ChangedCatalogue
from diecut_report.text.translation import said

# Machines to try a plugin on: of the configurations that are named, or of those that lie beside the plugin.


FOLDERS = (".", "examples", "configs")
Machine = tuple[Config, str]
LEVELS = 3  # folders above a plugin in which its examples are sought
INSTALLED = "site-packages"
MAX_FILE_BYTES = 1_000_000  # bytes of a file that is looked through


def named_machines(files: Iterable[Path], kind: str, discovery: Discovery) -> list[Machine]:
    """Return all machines of a kind in these configurations with their names; UserError where one of them is wrong."""
    configs = [Press.read(file, discovery).config for file in files]
    return [(config, name) for config in configs for name, own in config.kinds.items() if own == kind]


def machines_beside(origin: Origin, discovery: Discovery) -> tuple[list[Machine], list[Problem]]:
    """Return all machines of a kind in sound configurations beside its plugin; where there are none, why others are not sound."""
    found: list[Machine] = []
    refused: list[Problem] = []
    names_it = re.compile(rf"\bkind:\s*[\"']?{re.escape(origin.kind)}\b")
    for file in (file for folder in _folders(origin) for file in sorted(folder.glob("*.yaml"))):
        is_small = file.is_file() and file.stat().st_size < MAX_FILE_BYTES
        if is_small and names_it.search(file.read_text("utf-8", "replace")):
            try:
                found += named_machines([file], origin.kind, discovery)
            except UserError as error:  # of something else, which its user knows, if there is a sound one
                refused += error.problems
    return found, [] if found else refused


def _folders(origin: Origin) -> Iterator[Path]:
    if origin.is_own:
        with as_file(files("diecut_report.configs")) as examples:
            yield examples
        return
    for level, home in enumerate(origin.file().resolve().parents):
        if level >= LEVELS or home.name == INSTALLED:
            return
        yield from (home / name for name in FOLDERS if (home / name).is_dir())


# Tries a plugin on each machine of its kind that is known, not on the first alone.


ON_EACH = ("example", "alone", "figures")  # the others depend on the plugin alone, or put every input to the test


def tried_on_each(first: ContractTest, others: Sequence[Machine]) -> Iterator[TriedRule]:
    """Yield each rule with what was found on the first machine and, where what is given matters, on each of the others."""
    tests: Iterable[ContractTest] = _tests(first, others)
    for found in first.tried():
        if found.id not in ON_EACH or found.status == "not_tried":
            yield found
            continue
        also = [(test, test.tried_alone(found.id)) for test in tests]
        yield _merged(first, found, also) if also else found
        tests = [test for test, own in also if own.id != "example" or own.status == "pass"]


def _tests(first: ContractTest, others: Sequence[Machine]) -> Iterator[ContractTest]:
    """The tests of the other machines; those of one configuration calculate its press once."""
    latest = first
    for config, name in others:
        test = latest.of(config, name)
        yield test
        latest = test


def _merged(first: ContractTest, found: TriedRule, also: Sequence[tuple[ContractTest, TriedRule]]) -> TriedRule:
    faults = list(found.faults)
    for test, own in also:
        template = "{file}, mechanism {name}: {fault}"
        place = {"file": _file(test), "name": test.name}
        faults += [Phrase(template, place, fault=fault) for fault in own.faults if fault not in found.faults]
    status = max((found, *(own for _, own in also)), key=lambda each: WORST_LAST.index(each.status)).status
    told = _machines([first, *(test for test, _ in also)]) if found.id == "example" and found.summary else found.summary
    if told and found.id != "example":
        told += Counted(len(also), "; on {n} other machine too", "; on {n} other machines too")
    return replace(found, status=status, summary=told, faults=tuple(faults))


def _machines(tests: Sequence[ContractTest]) -> str:
    told = []
    for file, group in groupby(tests, key=_file):
        names = [test.name for test in group]
        template = "{file}, mechanism {name}" if len(names) == 1 else "{file}, mechanisms {name}"
        told.append(Phrase(template, file=file, name=", ".join(names)))
    return joined(told, "; ")


def _file(test: ContractTest) -> Path | str:
    assert test.config is not None
    return test.config.tree.name


PLUGINS = "plugins"  # the folder of a new plugin's project that holds the plugin


@dataclass
class CheckedPlugin:
    """Hold what was found of a plugin: each rule of the contract, and its chapter as HTML."""

    kind: str
    origin: str
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
        rules = [{"rule": each.id, "status": each.status, "told": said(each.summary), "faults": [said(fault) for fault in each.faults],
                  "places": [getattr(fault, "values", {}).get("place", "") for fault in each.faults]}
                 for each in self.rules]  # fmt: skip
        made = {"kind": self.kind, "version": version, "from": said(self.origin), "status": self.status, "rules": rules}
        return made | ({"error": said(self.error)} if self.error else {})


def home_of(asked: str, folders: Sequence[Path]) -> Path:
    """Return the folder of the files of what a name or a folder means, also where it cannot be loaded; UserError where there are none."""
    place = Path(asked)
    if place.is_dir():
        meant(asked, folders)
        return place
    known, (kind,) = meant(asked, folders)
    return known.origins[kind][0].file().parent


def meant(asked: str, folders: Sequence[Path]) -> tuple[Discovery, list[str]]:
    """Return the kinds that a name or a folder means, and what knows them; UserError where there are none.

    Those of the folder stand before installed ones of the same name.
    """
    place = Path(asked)
    if not place.is_dir():
        if place.suffix or "/" in asked:
            raise refusal("There is no such folder of plugins: give a folder, or the name of a kind.", asked)
        known = Discovery(folders)
        if asked not in known.origins:
            raise refusal(known.unknown(asked))
        return known, [asked]
    for folder in (place, place / PLUGINS):
        if own := list(in_folder(folder)) if folder.is_dir() else []:
            return Discovery([folder, *folders], own), [origin.kind for origin in own]
    template = "There is no plugin in this folder: a plugin is NAME.py, or a folder NAME with an __init__.py."
    raise refusal(template, asked)


def checked(
    known: Discovery,
    kind: str,
    configs: Sequence[Path],
    language: str,
    *,
    write_po: bool = False,
    is_part: bool = False,
) -> CheckedPlugin:
    """Return what the rules of the contract find of a kind; UserError where a configuration cannot be used.

    With ``write_po`` the plugin's catalogues get the texts that they lack, and what nothing says is marked, before its words are tried;
    with ``is_part`` its chapter is made to stand within another page.
    """
    origin = known.origins[kind][0]
    found = CheckedPlugin(kind, origin.label)
    if write_po and origin.is_own:
        raise refusal("{kind} comes with the program, whose catalogues are made by its own tool.", kind=kind)
    try:
        known.extend()
        found.mechanism = known.mechanism(kind)
    except (PluginError, DuplicateKind) as error:
        found.error = error.message if isinstance(error, PluginError) else str(error)
        return found
    machines, refused = (named_machines(configs, kind, known), []) if configs else machines_beside(origin, known)
    if configs and not machines:
        raise refusal("There is no mechanism of the kind {kind} in it.", configs[0], kind=repr(kind))
    config, name = machines[0] if machines else (None, "")
    test = ContractTest(found.mechanism, known, config, name, language, refused, is_part)
    if write_po:
        found.changed = write_missing(test, origin)
    found.rules += tried_on_each(test, machines[1:])
    found.page = test.page
    return found
