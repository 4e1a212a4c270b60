"""The organisation's logo, which a configuration names (``report: {logo: FILE}``): read from beside it, judged by what it holds."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any, NamedTuple

from diecut_report.config import yaml
from diecut_report.config.model import texts
from diecut_report.config.validation import ConfigPlace, told
from diecut_report.config.yaml import KeyPath, Tree, printable, too_much
from diecut_report.errors import Problem, UserError
from diecut_report.files import content
from diecut_report.pictures import MOST as LOGO_MOST
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
MOST = 20  # files of one configuration
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
        if len(names) > MOST:
            words = Phrase(
                "names {count} files; at most {most} are allowed. Put several tables into one file.",
                count=len(names),
                most=MOST,
            )
            tables.problems.append(place.problem((OWN_TABLES_KEY,), words))
            return tables
        beside = find or (lambda name: Path(config.file).parent / name)
        for index, name in enumerate(names):
            key = (OWN_TABLES_KEY, index) if isinstance(given, list) else (OWN_TABLES_KEY,)
            tables._file(name, place, key, beside)
        return tables

    def _file(self, name: Any, place: ConfigPlace, key: KeyPath, find: Find) -> None:
        if fault := name_fault(name):
            self.problems.append(place.problem(key, fault))
            return
        path = find(name)
        if not os.path.exists(path):
            words = Phrase(
                "there is no file {path}. Tables are sought from the configuration's folder; check the name.", path=path
            )
            self.problems.append(place.problem(key, words))
            return
        try:
            tree = yaml.load(path)
        except UserError as error:
            self.problems += error.problems
            return
        excess = too_much(tree)
        self.problems += excess
        self.trees[name] = tree
        for entry in () if excess else _Reader(tree, self.problems).entries():
            known = self.entries.setdefault(str(entry.path[0]), {})
            if entry.name in known:
                words = Phrase("stands in {file} too; leave one of them out", file=known[entry.name].file)
                self.problems.append(ConfigPlace(tree).problem(entry.path, words, at_key=True))
            known.setdefault(entry.name, entry)

    def names(self, table: str) -> list[str]:
        """Return the names of a table's entries."""
        return list(self.entries.get(table, {}))


@dataclass
class _Reader:
    """Reads the entries of one file."""

    tree: Tree
    problems: list[Problem]

    def __post_init__(self) -> None:
        self.place = ConfigPlace(self.tree)

    def entries(self) -> Iterator[Entry]:
        data = self.tree.data
        if not isinstance(data, dict):
            words = Phrase(
                "The file holds {data}; it needs a source and tables, as in steels: {NAME: {…}}.", data=told(data)
            )
            self.problems.append(Problem(words, self.tree.file))
            return
        self._references(data)
        if data.get(VERSION, 1) != 1:
            self._wrong((VERSION,), Phrase("is {data}; the number 1 is needed", data=told(data[VERSION])))
        common = self._source(data, ())
        for table, rows in data.items():
            if table in (SOURCE, VERSION):
                continue
            if not isinstance(rows, dict):
                self._wrong(
                    (table,),
                    Phrase(
                        "is {rows}; entries by their names are needed, as in {table}: {NAME: {…}}",
                        rows=told(rows),
                        table=table,
                    ),
                )
                continue
            for name, keys in rows.items():
                yield from self._entry((table, name), keys, common)

    def _entry(self, path: KeyPath, keys: Any, common: str | None) -> Iterator[Entry]:
        if not isinstance(keys, dict):
            self._wrong(path, Phrase("is {keys}; a block of keys is needed", keys=told(keys)))
            return
        source = self._source(keys, path) or common
        if not source:
            self._wrong(
                path,
                Phrase(
                    "has no source; say in {source}: … where its numbers are from, here or at the top of the file",
                    source=SOURCE,
                ),
            )
            return
        yield Entry(str(path[1]), {key: each for key, each in keys.items() if key != SOURCE}, source, self.tree, path)

    def _source(self, data: Mapping[str, Any], path: KeyPath) -> str | None:
        given = data.get(SOURCE)
        if SOURCE in data and (not isinstance(given, str) or not given.strip()):
            self._wrong(
                (*path, SOURCE),
                Phrase("is {given}; a text is needed that says where the numbers are from", given=told(given)),
            )
            return None
        return given

    def _references(self, data: Any) -> None:
        for key, text in texts(data):
            if "${" in text:
                self._wrong(key, Phrase("is {text}; a table holds values, and no references", text=told(text)))

    def _wrong(self, key: KeyPath, words: str) -> None:
        self.problems.append(self.place.problem(key, words))


def name_fault(name: Any) -> str:
    """Return what is wrong with the name of a file of tables; "" where it leads to a YAML file beside the configuration or below."""
    if not isinstance(name, str):
        return Phrase(
            "is {name}; the name of a YAML file is needed, such as my_steels.yaml, or a list of such names",
            name=told(name),
        )
    if fault := place_fault(name, phrase("tables lie")):
        return fault
    if PurePosixPath(name).suffix not in (".yaml", ".yml"):
        return Phrase("is {name}; a YAML file is needed, such as my_steels.yaml", name=told(name))
    return ""


def place_fault(name: str, lie: str) -> str:
    """Return that a name leads elsewhere than beside the configuration or below; ``lie`` names what: "tables lie"."""
    windows = PureWindowsPath(name)
    if windows.is_absolute() or windows.drive or PurePosixPath(name).is_absolute() or ".." in windows.parts:
        return Phrase(
            "is {name}; {lie} beside the configuration or in a folder below it: give a name without a folder above",
            name=told(name),
            lie=lie,
        )
    return ""


KEY = ("report", "logo")


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
    if fault := logo_fault(name):
        return None, [place.problem(KEY, fault)]
    path = find(name) if find else Path(config.file).parent / name
    if not os.path.exists(path):
        words = Phrase(
            "there is no file {path}. A logo is sought from the configuration's folder; check the name.", path=path
        )
        return None, [place.problem(KEY, words)]
    try:
        found = content(path, LOGO_MOST, phrase("a PNG or SVG picture"))
        return Logo(name, found, media_type(found)), []
    except UserError as error:
        return None, list(error.problems)
    except PictureFault as fault:
        return None, [place.problem(KEY, Phrase("{name} {fault}", name=told(name), fault=fault))]


def logo_fault(name: object) -> str:
    """Return what is wrong with the name of a logo; "" where it leads to a file beside the configuration or below."""
    if not isinstance(name, str) or not name.strip():
        return Phrase("is {name}; the name of a PNG or SVG file is needed, such as logo.svg", name=told(name))
    return place_fault(name, phrase("a logo lies"))
