"""Files that a configuration names beside it: tables of the user's own, and the organisation's logo (``report: {logo: FILE}``)."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any, NamedTuple

from diecut_report.config import yaml
from diecut_report.config.model import texts
from diecut_report.config.validation import ConfigPlace, names_something, quoted
from diecut_report.config.yaml import KeyPath, Tree, printable, too_much
from diecut_report.errors import Problem, UserError
from diecut_report.files import content
from diecut_report.pictures import MAX_BYTES as MAX_LOGO_BYTES
from diecut_report.pictures import PictureFault, media_type
from diecut_report.text.phrases import Phrase, phrase

# Tables that a user keeps beside a configuration (``materials: my_steels.yaml``): entries by name, whose keys a block takes.
#
#     source: Saarstahl, data sheet 34CrNiMo6, 2021
#     steels:
#       34CrNiMo6+QT:
#         strengths:
#           - {diameter: 40 mm, tensile_strength: 1100 MPa, yield_strength: 900 MPa}
#
# A file is read and judged as a configuration is: what is wrong with it is told with its own name, line and key.


OWN_TABLES_KEY = "materials"
SOURCE, VERSION = "source", "schema_version"
MAX_FILES = 20  # of one configuration
TABLE_MISSING = phrase("there is no file {path}. Tables are sought from the configuration's folder; check the name.")
LOGO_MISSING = phrase("there is no file {path}. A logo is sought from the configuration's folder; check the name.")
Find = Callable[[str], Path]


@dataclass(frozen=True, eq=False)
class Entry:
    """Hold an entry of a table: its keys, where they stand, and the source that is printed with them."""

    name: str
    keys: Mapping[str, Any]
    source: str
    tree: Tree
    path: KeyPath

    @property
    def file(self) -> str:
        """Return the name of its file, without folders."""
        return printable(PurePosixPath(self.tree.name.replace("\\", "/")).name)

    @property
    def note(self) -> str:
        """Return what stands beside a value that was taken from it."""
        return f"{self.name}, {self.file}: {self.source}"


@dataclass
class OwnTables:
    """Hold the tables of a configuration by their names, the files that they were read from, and what is wrong with them."""

    entries: dict[str, dict[str, Entry]] = field(default_factory=dict)
    trees: dict[str, Tree] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)
    judged: set[KeyPath] = field(default_factory=set)

    @staticmethod
    def read(config: Tree, find: Find | None) -> OwnTables:
        """Return the tables that a configuration names; ``find`` says where a file is, else it is beside the configuration."""
        tables, place = OwnTables(), ConfigPlace(config)
        given = config.data.get(OWN_TABLES_KEY) if isinstance(config.data, dict) else None
        names = given if isinstance(given, list) else [] if given is None else [given]
        if len(names) > MAX_FILES:
            template = "names {count} files; at most {most} are allowed. Put several tables into one file."
            tables.problems.append(place.problem((OWN_TABLES_KEY,), template, count=len(names), most=MAX_FILES))
            return tables
        for index, name in enumerate(names):
            key = (OWN_TABLES_KEY, index) if isinstance(given, list) else (OWN_TABLES_KEY,)
            try:
                tables._add(name, yaml.load(_named_file(name, name_fault(name), place, key, find, TABLE_MISSING)))
            except UserError as error:
                tables.problems += error.problems
        return tables

    def _add(self, name: str, tree: Tree) -> None:
        excess = too_much(tree)
        self.problems += excess
        self.trees[name] = tree
        for entry in () if excess else _entries(tree, self.problems):
            known = self.entries.setdefault(str(entry.path[0]), {})
            if entry.name in known:
                template = "stands in {file} too; leave one of them out"
                file = known[entry.name].file
                self.problems.append(ConfigPlace(tree).problem(entry.path, template, at_key=True, file=file))
            known.setdefault(entry.name, entry)


def table_faults(raw: bytes, file: str) -> list[Problem]:
    """Return what is wrong with a file of tables of that name."""
    tables = OwnTables()
    try:
        tables._add(file, yaml.load(Path(file), raw))
    except UserError as error:
        return list(error.problems)
    return tables.problems


def _named_file(name: str, fault: str, place: ConfigPlace, key: KeyPath, find: Find | None, missing: str) -> Path:
    """Return where a file is that the configuration names; UserError where it cannot be one or is ``missing``."""
    if fault:
        raise UserError(place.problem(key, fault))
    path = find(name) if find else Path(place.tree.file).parent / name
    if not os.path.exists(path):
        raise UserError(place.problem(key, missing, path=path))
    return path


def _entries(tree: Tree, problems: list[Problem]) -> Iterator[Entry]:
    """Yield the entries of a file, and add to ``problems`` what is wrong with it."""
    data, place = tree.data, ConfigPlace(tree)
    if not isinstance(data, dict):
        template = "The file holds {data}; it needs a source and tables, as in steels: {NAME: {…}}."
        problems.append(Problem(Phrase(template, data=quoted(data)), tree.file))
        return
    for key, text in texts(data):
        if "${" in text:
            problems.append(place.problem(key, "is {text}; a table holds values, and no references", text=quoted(text)))
    if data.get(VERSION, 1) != 1:
        problems.append(place.problem((VERSION,), "is {data}; the number 1 is needed", data=quoted(data[VERSION])))
    common = _source(data, (), place, problems)
    for table, rows in data.items():
        if table in (SOURCE, VERSION):
            continue
        if not isinstance(rows, dict):
            template = "is {rows}; entries by their names are needed, as in {table}: {NAME: {…}}"
            problems.append(place.problem((table,), template, rows=quoted(rows), table=table))
            continue
        for name, keys in rows.items():
            path = (table, name)
            if not isinstance(keys, dict):
                problems.append(place.problem(path, "is {keys}; a block of keys is needed", keys=quoted(keys)))
            elif source := _source(keys, path, place, problems) or common:
                yield Entry(name, {key: each for key, each in keys.items() if key != SOURCE}, source, tree, path)
            else:
                template = (
                    "has no source; say in {source}: … where its numbers are from, here or at the top of the file"
                )
                problems.append(place.problem(path, template, source=SOURCE))


def _source(data: Mapping[str, Any], path: KeyPath, place: ConfigPlace, problems: list[Problem]) -> str | None:
    given = data.get(SOURCE)
    if SOURCE in data and (not isinstance(given, str) or not names_something(given)):
        template = "is {given}; a text is needed that says where the numbers are from"
        problems.append(place.problem((*path, SOURCE), template, given=quoted(given)))
        return None
    return given


def name_fault(name: Any) -> str:
    """Return what is wrong with the name of a file of tables; "" where it leads to a YAML file beside the configuration or below."""
    if not isinstance(name, str):
        template = "is {name}; the name of a YAML file is needed, such as my_steels.yaml, or a list of such names"
        return Phrase(template, name=quoted(name))
    if fault := place_fault(name, phrase("tables lie")):
        return fault
    if PurePosixPath(name).suffix not in (".yaml", ".yml"):
        return Phrase("is {name}; a YAML file is needed, such as my_steels.yaml", name=quoted(name))
    return ""


def place_fault(name: str, lie: str) -> str:
    """Return that a name leads elsewhere than beside the configuration or below; ``lie`` names what: "tables lie"."""
    windows = PureWindowsPath(name)
    if not windows.name:
        return Phrase("is {name}, which names no file", name=quoted(name))
    if windows.is_absolute() or windows.drive or PurePosixPath(name).is_absolute() or ".." in windows.parts:
        template = (
            "is {name}; {lie} beside the configuration or in a folder below it: give a name without a folder above"
        )
        return Phrase(template, name=quoted(name), lie=lie)
    if any(part.startswith(".") for part in windows.parts):  # shells and tools load such files by themselves
        return Phrase("is {name}; a name that begins with a dot is hidden: give another one", name=quoted(name))
    return ""


KEY = ("report", "logo")
PICTURES = (".png", ".svg")


class Logo(NamedTuple):
    """A picture, by the name that the configuration gives it."""

    name: str
    content: bytes
    media_type: str

    @property
    def sha256(self) -> str:
        """The hash of the file."""
        return sha256(self.content).hexdigest()


def logo_of(config: Tree, find: Find | None) -> tuple[Logo | None, list[Problem]]:
    """Return the logo that a configuration names, and what is wrong with it; ``find`` says where a file is, else it is beside it."""
    report = config.data.get(KEY[0]) if isinstance(config.data, dict) else None
    name = report.get(KEY[1]) if isinstance(report, dict) else None
    place = ConfigPlace(config)
    if name is None:
        return None, []
    try:
        file = _named_file(name, logo_fault(name), place, KEY, find, LOGO_MISSING)
        found = content(file, MAX_LOGO_BYTES, phrase("a PNG or SVG picture"))
        return Logo(name, found, media_type(found)), []
    except UserError as error:
        return None, list(error.problems)
    except PictureFault as fault:
        return None, [place.problem(KEY, "{name} {fault}", name=quoted(name), fault=fault)]


def logo_fault(name: object) -> str:
    """Return what is wrong with the name of a logo; "" where it leads to a file beside the configuration or below."""
    if not isinstance(name, str) or not name.strip():
        return Phrase("is {name}; the name of a PNG or SVG file is needed, such as logo.svg", name=quoted(name))
    if fault := place_fault(name, phrase("a logo lies")):
        return fault
    if PurePosixPath(name).suffix.lower() not in PICTURES:
        return Phrase("is {name}; the name of a PNG or SVG file is needed, such as logo.svg", name=quoted(name))
    return ""
