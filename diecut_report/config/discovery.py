"""Finds the kinds of mechanisms and loads a kind when it is asked for, so that a broken plugin hurts only its users.

Kinds come from three places: the program's own folder of plugins, the entry points (group "diecut_report.plugins",
the name is the kind) of installed packages, and local folders. A folder of plugins may hold a list ``kinds.yaml``
(``KIND: FILE.py`` or ``KIND: FILE.py:ATTRIBUTE``); without it each ``NAME.py`` and each folder ``NAME`` with an
``__init__.py`` is the kind NAME; the project of a package (pyproject.toml) gives the kinds that it announces. The attribute that
holds the mechanism is MECHANISM unless it is named.

A file ``extend_NAME.py`` of a local folder, or an entry point of the group "diecut_report.extensions", is not a kind: it is run
before a configuration is read, to add to a registry (such as the motion laws).
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

from diecut_report.config import yaml_tree
from diecut_report.config.announced_kinds import announced, source_of
from diecut_report.config.contract_version import other_program, refuse_other_contract
from diecut_report.config.imports_beside import beside
from diecut_report.config.local_modules import attribute_of, module_of_file, module_of_project
from diecut_report.config.source_hashes import file_of, module_hash, note_check, note_plugin
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.place import Misdeclared
from diecut_report.errors import PluginError, Problem, UserError, nearest
from diecut_report.expressions.source import FormulaError
from diecut_report.languages.phrases import Phrase, joined, phrase
from diecut_report.time_limit import in_time

GROUP = "diecut_report.plugins"
EXTENSIONS = "diecut_report.extensions"
EXTENSION = "extend_"
ATTRIBUTE = "MECHANISM"
LIST = "kinds.yaml"


class UnknownKind(LookupError):
    """No plugin gives this kind; the text says so, with the nearest known kind."""


class DuplicateKind(LookupError):
    """Two plugins give one kind; the text names both origins."""


@dataclass(frozen=True)
class Origin:
    """Where a kind comes from, in words, and how its mechanism is loaded from there."""

    kind: str
    told: str
    load: Callable[[], Any]
    file: Callable[[], Path]  # of the module, when it is loaded
    is_own: bool = False  # of the program itself, whose declarations its tests check


class Discovery:
    """The kinds that are known here: built in, installed, and in the given folders."""

    def __init__(self, folders: Iterable[Path] = ()) -> None:
        self._folders = tuple({folder.resolve(): folder for folder in folders}.values())
        self._loaded: dict[str, Mechanism | PluginError] = {}
        self.extended: dict[str, str] = {}  # the extensions that were run, with the hashes of their code

    @cached_property
    def origins(self) -> dict[str, list[Origin]]:
        """Each kind with all places that give it; more than one is a fault that shows when the kind is used."""
        found: dict[str, list[Origin]] = {}
        for origin in [*_built_in(), *_installed(), *(o for folder in self._folders for o in in_folder(folder))]:
            found.setdefault(origin.kind, []).append(origin)
        return dict(sorted(found.items()))

    @cached_property
    def _extensions(self) -> list[Origin]:
        return [*_installed_extensions(), *(origin for folder in self._folders for origin in _extensions(folder))]

    def extend(self) -> None:
        """Run what adds to the registries, once; UserError where it cannot be run."""
        while self._extensions:
            origin = self._extensions.pop()
            try:
                with in_time():
                    origin.load()
                self.extended[origin.kind] = module_hash(origin.file())
            except (Exception, SystemExit) as cause:
                raise UserError(
                    Problem(Phrase("This extension cannot be loaded: {said}.", said=said(cause)), origin.told)
                ) from cause

    def mechanism(self, kind: str) -> Mechanism:
        """The mechanism of a kind.

        Raises UnknownKind or DuplicateKind with the words for the user, PluginError where the plugin is broken.
        """
        origin = self._only_origin(kind)
        if kind not in self._loaded:
            self._loaded[kind] = _loaded(origin)
        found = self._loaded[kind]
        if isinstance(found, PluginError):
            raise found
        return found

    def _only_origin(self, kind: str) -> Origin:
        origins = self.origins.get(kind)
        if not origins:
            near = nearest(kind, self.origins)
            words = "{kind} is not a known kind{nearest}. Known: {known}."
            raise UnknownKind(Phrase(words, kind=repr(kind), nearest=near, known=", ".join(self.origins)))
        if len(origins) > 1:
            places = joined((origin.told for origin in origins), " and from ")
            words = "The kind {kind} comes from {places}. Remove or rename one of them."
            raise DuplicateKind(Phrase(words, kind=repr(kind), places=places))
        return origins[0]


def _loaded(origin: Origin) -> Mechanism | PluginError:
    try:
        refuse_other_contract(origin.file)
        with in_time():
            found = origin.load()
        digest = module_hash(origin.file())
    except (Exception, SystemExit) as cause:
        words = "it cannot be loaded from {told}: {said}"
        error = PluginError(
            Phrase(words, told=origin.told, said=said(cause)) + beside(origin.file(), cause), origin.kind
        )
        error.__cause__ = cause
        return error
    if not isinstance(found, Mechanism):
        words = "{told} gives a {name}, where a Mechanism is needed"
        return PluginError(Phrase(words, told=origin.told, name=type(found).__name__), origin.kind)
    if found.kind != origin.kind:
        words = "{told} gives the kind {kind}; name it {wanted} there"
        named = {"told": origin.told, "kind": repr(found.kind), "wanted": repr(origin.kind)}
        return PluginError(Phrase(words, named), origin.kind)
    note_plugin(found, digest, None if origin.is_own else origin.file())
    return found if origin.is_own else _sound(origin, found)


def _sound(origin: Origin, mechanism: Mechanism) -> Mechanism | PluginError:
    """A mechanism of which nothing that it declares is wrong."""
    from diecut_report.config import press_defaults
    from diecut_report.declaration import faults_at_load
    from diecut_report.formula_checks.remembered_faults import faults_of_formulas

    try:
        found = [str(fault) for fault in faults_at_load(mechanism) or press_defaults.faults(mechanism)]
    except Exception as cause:
        words = "what {told} declares cannot be read: {said}"
        error = PluginError(Phrase(words, told=origin.told, said=said(cause)), origin.kind)
        error.__cause__ = cause
        return error
    if not found:
        for each in (mechanism, *(comparison.mechanism for comparison in mechanism.comparisons)):
            note_check(each, faults_of_formulas(each))
        return mechanism
    head = Phrase("{told} declares what cannot be", told=origin.told)
    return PluginError(
        joined([head, found[0]], ": ") if len(found) == 1 else joined([head + ":", *found], "\n  "), origin.kind
    )


def said(cause: BaseException) -> str:
    """An exception of a plugin in one line: its type, its text, and the last file and line of the plugin that led to it."""
    if isinstance(cause, Misdeclared):  # tells its own place
        return str(cause)
    frames = [f for f in traceback.extract_tb(cause.__traceback__) if not f.filename.startswith("<")]
    own = [f for f in frames if not _is_foreign(Path(f.filename))] or frames
    tells_place = isinstance(cause, SyntaxError | FormulaError) or getattr(cause, "tells_place", False)
    declared = Path(getattr(cause, "at", "")).name  # of what is not proved, which the engine tells
    place = f" ({declared or f'{Path(own[-1].filename).name}:{own[-1].lineno}'})" if own and not tells_place else ""
    return f"{type(cause).__name__}: {other_program(cause) or ' '.join(str(cause).split())}{place}"


PROGRAM = Path(__file__).parents[1]
LIBRARIES = ("numpy", "scipy", "pydantic", "pint")
STANDARD = Path(traceback.__file__).parent


def _is_foreign(file: Path) -> bool:
    """Whether a file is not a plugin's: of the program, of the standard library, of a library that plugins use."""
    of_program = file.is_relative_to(PROGRAM) and not file.is_relative_to(PROGRAM / GROUP.rpartition(".")[2])
    of_library = "site-packages" in file.parts and any(name in file.parts for name in LIBRARIES)
    return of_program or of_library or file.parent == STANDARD


# --- the three places ------------------------------------------------------------------------------------------------


def _built_in() -> Iterator[Origin]:
    package = import_module(GROUP)
    for kind in _names_in(Path(package.__path__[0])):
        name = f"{GROUP}.{kind}"
        yield Origin(
            kind, phrase("the program itself"), partial(_of_module, name), partial(_file_of_module, name), is_own=True
        )


def _installed() -> Iterator[Origin]:
    for entry in entry_points(group=GROUP):
        package = (
            Phrase("the package {name} {version}", name=entry.dist.name, version=entry.dist.version)
            if entry.dist
            else phrase("an installed package")
        )
        load = entry.load if entry.attr else partial(_of_module, entry.module)
        yield Origin(entry.name, package, load, partial(file_of, entry.module))


def _installed_extensions() -> Iterator[Origin]:
    for entry in entry_points(group=EXTENSIONS):
        told = Phrase("{name} of an installed package", name=entry.name)
        yield Origin(entry.name, told, entry.load, partial(file_of, entry.module))


def _extensions(folder: Path) -> Iterator[Origin]:
    for file in sorted(folder.glob(f"{EXTENSION}*.py")):
        yield Origin(file.stem, str(file), partial(module_of_file, file), partial(Path, file))


def in_folder(folder: Path) -> Iterator[Origin]:
    """Yield the kinds of a folder of plugins, or of the project of a package; UserError where there is no such folder."""
    if not folder.is_dir():
        raise UserError(
            Problem(phrase("There is no such folder of plugins. Check the name given with --plugins."), str(folder))
        )
    if (folder / LIST).is_file():
        yield from _in_files(folder, _listed(folder))
    elif kinds := announced(folder, GROUP):
        yield from (_in_project(folder, kind, *place) for kind, place in kinds.items())
    else:
        yield from _in_files(folder, {name: (name, ATTRIBUTE) for name in _names_in(folder)})


def _in_files(folder: Path, listed: Mapping[str, tuple[str, str]]) -> Iterator[Origin]:
    for kind, (name, attribute) in listed.items():
        file = _file_of(folder, name)
        yield Origin(kind, str(file), partial(_of_file, file, attribute), partial(Path, file))


def _in_project(folder: Path, kind: str, name: str, attribute: str) -> Origin:
    """A kind of the project of a package, whose modules import each other by its name, as where it is installed."""
    file, source = _file_of(folder, name), source_of(folder, name)
    return Origin(kind, str(file), partial(_of_project, file, source, attribute or ATTRIBUTE), partial(Path, file))


def _names_in(folder: Path) -> list[str]:
    files = [path for path in folder.iterdir() if (path if path.suffix == ".py" else path / "__init__.py").is_file()]
    return sorted(path.stem for path in files if not path.name.startswith(("_", ".", EXTENSION)))


def _listed(folder: Path) -> dict[str, tuple[str, str]]:
    tree = yaml_tree.load(folder / LIST)
    if not isinstance(tree.data, dict) or not all(isinstance(value, str) for value in tree.data.values()):
        raise UserError(
            Problem(phrase("A list of kinds is needed, each as KIND: FILE.py or KIND: FILE.py:ATTRIBUTE."), tree.file)
        )
    found = {}
    for kind, place in tree.data.items():
        name, _, attribute = place.partition(":")
        found[kind] = name.removesuffix(".py"), attribute or ATTRIBUTE
    return found


def _file_of(folder: Path, name: str) -> Path:
    package = folder / name / "__init__.py"
    return package if package.is_file() else folder / f"{name}.py"


def _of_module(name: str) -> Any:
    return attribute_of(import_module(name), ATTRIBUTE)


def _file_of_module(name: str) -> Path:
    return Path(str(sys.modules[name].__file__))


def _of_file(file: Path, attribute: str) -> Any:
    return attribute_of(module_of_file(file), attribute)


def _of_project(file: Path, source: Path, attribute: str) -> Any:
    return attribute_of(module_of_project(file, source), attribute)
