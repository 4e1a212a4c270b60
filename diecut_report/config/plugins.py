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

import hashlib
import os
import re
import reprlib
import sys
import tomllib
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from importlib import import_module, metadata, util
from pathlib import Path
from traceback import walk_tb
from types import ModuleType
from typing import Any

from diecut_report import __version__
from diecut_report.config import yaml
from diecut_report.config.source_hashes import file_of, module_hash, note_check, note_plugin, noting_what_is_read
from diecut_report.errors import PluginError, Problem, UserError, nearest, refusal
from diecut_report.formulas.expression import FormulaError
from diecut_report.mechanism.mechanism import CONTRACT, Mechanism
from diecut_report.mechanism.names import Misdeclared
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues, UnknownLanguage, built_in
from diecut_report.text.phrases import Phrase, joined, phrase
from diecut_report.text.translation import spoken_language
from diecut_report.time_limit import Escaped, in_time

# Modules of plugins that are not installed: those of single files and folders, and those of a package in its project.


OF_PROJECTS: dict[str, Path] = {}
"""The packages that were loaded of projects, by their names, each with its first file."""


def module_of_file(file: Path) -> ModuleType:
    """Return the module of a local file; it stands in sys.modules while it runs, or postponed annotations would not resolve."""
    digest = hashlib.sha256(str(file.resolve()).encode()).hexdigest()[:16]
    name = f"diecut_report_local_{digest}_{re.sub(r'[^A-Za-z0-9]', '_', file.stem)}"
    if name in sys.modules:
        return sys.modules[name]
    before = set(sys.modules)
    module = _local_modules_loaded(name, file)
    _refuse_strays({other for other in sys.modules.keys() - before if not other.startswith(name)}, file)
    return module


def _refuse_strays(names: Iterable[str], file: Path) -> None:
    """Raise ImportError where a module beside a plugin was imported by way of sys.path: another plugin would take it for its own."""
    found = {other: getattr(sys.modules[other], "__file__", None) for other in names}
    folder = file.parent.resolve()  # below which libraries may lie, too
    own = {str(folder / each) for other in found for each in (f"{other}.py", f"{other}/__init__.py")}
    strays = [other for other, path in found.items() if path in own]
    for other in strays:
        del sys.modules[other]
    if strays:
        message = Phrase("it imports {name} by way of sys.path, where other plugins would find it too", name=strays[0])
        raise ImportError(message + _made_a_folder(file))


def module_of_project(file: Path, source: Path) -> ModuleType:
    """Return a module of a package that stands in a folder of its project, under its own name, by which its modules import each other.

    A module that is not in a package stands for itself. ImportError in words where another package of this name is loaded already.
    """
    place = file.parent if file.name == "__init__.py" else file.with_suffix("")
    package, *inner = place.relative_to(source).parts
    whole = source.resolve() / package / "__init__.py"
    if not whole.is_file():
        return module_of_file(file)
    if OF_PROJECTS.get(package) != whole:
        _begin(package, whole)
    return import_module(".".join([package, *inner]))


def _begin(package: str, file: Path) -> None:
    """Load a package, in the place of one of the same name that another project gave; ImportError where a library has this name."""
    if OF_PROJECTS.pop(package, None):
        _forget(package)
    if place := _elsewhere(package, file):
        template = "there is another package {name}, {place}; uninstall it, or give this one another name"
        raise ImportError(Phrase(template, name=package, place=place))
    try:
        _local_modules_loaded(package, file)
    except BaseException:
        _forget(package)
        raise
    OF_PROJECTS[package] = file


def _elsewhere(package: str, file: Path) -> str:
    """Return where an import of this name finds or would find another module; empty where it finds none."""
    if package in sys.modules:
        return getattr(sys.modules[package], "__file__", None) or "Python"
    found = util.find_spec(package)
    if found is None or (found.origin and Path(found.origin).resolve() == file):
        return ""
    return found.origin or "Python"


def _forget(package: str) -> None:
    for name in [each for each in sys.modules if each == package or each.startswith(f"{package}.")]:
        del sys.modules[name]


def _local_modules_loaded(name: str, file: Path) -> ModuleType:
    if file.exists() and not file.is_file():
        raise OSError(phrase("it is not a regular file"))  # a pipe would be waited for
    folder = [str(file.parent)] if file.name == "__init__.py" else None
    spec = util.spec_from_file_location(name, file, submodule_search_locations=folder)
    assert spec is not None and spec.loader is not None, file
    module = sys.modules[name] = util.module_from_spec(spec)
    try:
        with noting_what_is_read(file):
            spec.loader.exec_module(module)
    except BaseException:
        sys.modules.pop(name, None)
        raise
    return module


def _attribute(name: str, module_of: Callable[..., ModuleType], *given: Any) -> Any:
    """Return what stands under a name in the module that is loaded; AttributeError in words where there is none."""
    module = module_of(*given)
    if not hasattr(module, name):
        raise AttributeError(Phrase("there is no {name} in it", name=name))
    return getattr(module, name)


# What is told of a plugin of one file that imports another file of its folder, which it cannot.


def beside(file: Path, cause: BaseException) -> str:
    """Return in words what to do where the cause is such an import; empty for other causes."""
    if not isinstance(cause, ImportError) or file.name == "__init__.py":
        return ""
    if "relative import" not in str(cause.msg) and not (
        cause.name and file.with_name(f"{cause.name.partition('.')[0]}.py").is_file()
    ):
        return ""
    return _made_a_folder(file)


def _made_a_folder(file: Path) -> str:
    template = (
        "; a plugin of one file cannot import what lies beside it: make a folder {name}/ of it, with {file} as its __init__.py, "
        "and import from there, as in from ._helpers import …"
    )
    return Phrase(template, name=file.parent.name if file.name == "__init__.py" else file.stem, file=file.name)


# The kinds that a package announces in its project file, as they lie in its sources.


PROJECT = "pyproject.toml"
SOURCES = "src"


def _announced(folder: Path) -> dict[str, tuple[str, str]]:
    """Return the kinds that the project of a package announces, each with its module's place and the attribute that is named.

    It need not be installed. There are none where the folder is no such project.
    """
    project = folder / PROJECT
    if not project.is_file():
        return {}
    try:
        told = tomllib.loads(project.read_text("utf-8", "replace")).get("project", {})
        found = told.get("entry-points", {}).get(GROUP, {})
        places = {kind: str(place).partition(":") for kind, place in found.items()}
    except (tomllib.TOMLDecodeError, AttributeError) as error:
        raise refusal("This project of a package cannot be read: {error}", project, error=error) from None
    return {kind: (_source(folder, module), attribute) for kind, (module, _, attribute) in places.items()}


def _source(folder: Path, module: str) -> str:
    name = module.replace(".", "/")
    found = folder / SOURCES / name
    return f"{SOURCES}/{name}" if found.exists() or found.with_name(f"{found.name}.py").exists() else name


# Plugins that are written for another version of what the program offers to them.


API = "diecut_report.api"
NEEDED = re.compile(r"^CONTRACT\s*(?::\s*\w+\s*)?=\s*(\d+)", re.MULTILINE)
NAME = re.compile(r"cannot import name '(\w+)'")


class OtherContract(ImportError):
    """Report a plugin that says that it is written for another contract."""


def refuse_other_contract(file: Callable[[], Path]) -> None:
    """Refuse a plugin that names another contract than this program has, before its code is run: it may not even load."""
    try:
        found = NEEDED.search(file().read_text("utf-8", "replace")) if file().is_file() else None
    except (KeyError, OSError):  # an installed package tells its needs to the installer; loading will tell of a file
        return
    if found and int(found[1]) != CONTRACT:
        template = "it is written for contract {needed}, this program ({version}) has contract {own}; "
        newer = phrase("install a newer version of diecut-report")
        older = phrase("use a newer version of the plugin")
        message = Phrase(template, needed=found[1], version=__version__, own=str(CONTRACT))
        raise OtherContract(message + (newer if int(found[1]) > CONTRACT else older))


def other_program(cause: BaseException) -> str:
    """Return in words that a plugin takes a name of the program that this version does not have; empty for other causes."""
    if not isinstance(cause, ImportError) or cause.name != API:
        return ""
    found = NAME.search(str(cause))
    template = "{api} of this version ({version}) has no {name}; the plugin is written for another version"
    return Phrase(template, api=API, version=__version__, name=repr(found[1])) if found else ""


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
    label: str
    load: Callable[[], Any]
    file: Callable[[], Path]  # of the module, when it is loaded
    is_own: bool = False  # of the program itself, whose declarations its tests check
    package: Path | None = None  # the first file of the package that the module is in, where that has more modules


class Discovery:
    """The kinds that are known here: built in, installed, and in the given folders; ``first`` stand before others of their name."""

    def __init__(self, folders: Iterable[Path] = (), first: Iterable[Origin] = ()) -> None:
        self._first = {origin.kind: [origin] for origin in first}
        self.folders = tuple({os.path.realpath(folder): folder for folder in folders}.values())
        self._loaded: dict[str, Mechanism | PluginError] = {}
        self.extended: dict[str, str] = {}  # the extensions that were run, with the hashes of their code

    @property
    def paths(self) -> tuple[str, ...]:
        """Return the folders by their full paths, for other processes."""
        return tuple(str(folder.absolute()) for folder in self.folders)

    @cached_property
    def origins(self) -> dict[str, list[Origin]]:
        """Each kind with all places that give it; more than one is a fault that shows when the kind is used."""
        _require_unlike_packages(self.folders)
        found: dict[str, list[Origin]] = {}
        for origin in [*_built_in(), *_installed(), *(o for folder in self.folders for o in in_folder(folder))]:
            found.setdefault(origin.kind, []).append(origin)
        return dict(sorted(found.items())) | self._first

    @cached_property
    def _extensions(self) -> list[Origin]:
        template = "{name} of an installed package"
        found = []
        for each in entry_points(group=EXTENSIONS):
            label = Phrase(template, name=each.name)
            found.append(Origin(each.name, label, each.load, partial(file_of, each.module)))
        for file in (file for folder in self.folders for file in sorted(folder.glob(f"{EXTENSION}*.py"))):
            found.append(Origin(file.stem, str(file), partial(module_of_file, file), partial(Path, file)))
        return found

    def extend(self) -> None:
        """Run what adds to the registries, once; UserError where it cannot be run."""
        while self._extensions:
            origin = self._extensions.pop()
            try:
                with in_time():
                    origin.load()
                self.extended[origin.kind] = module_hash(origin.file())
            except Exception as cause:
                raise refusal("This extension cannot be loaded: {said}.", origin.label, said=said(cause)) from cause

    def mechanism(self, kind: str) -> Mechanism:
        """The mechanism of a kind.

        Raises UnknownKind or DuplicateKind with the words for the user, PluginError where the plugin is broken.
        """
        origin = self._only_origin(kind)
        if kind not in self._loaded:
            try:
                self._loaded[kind] = _loaded(origin)
            except PluginError as error:
                self._loaded[kind] = error
        found = self._loaded[kind]
        if isinstance(found, PluginError):
            raise found
        return found

    def unknown(self, kind: str) -> Phrase:
        """Return what is said of a kind that nothing gives."""
        template = "{kind} is not a known kind{nearest}. Known: {known}."
        return Phrase(template, kind=repr(kind), nearest=nearest(kind, self.origins), known=", ".join(self.origins))

    def _only_origin(self, kind: str) -> Origin:
        origins = self.origins.get(kind)
        if not origins:
            raise UnknownKind(self.unknown(kind))
        if len(origins) > 1:
            places = joined((origin.label for origin in origins), " and from ")
            template = "The kind {kind} comes from {places}. Remove or rename one of them."
            raise DuplicateKind(Phrase(template, kind=repr(kind), places=places))
        return origins[0]


def _loaded(origin: Origin) -> Mechanism:
    """Load a mechanism; PluginError where it cannot be loaded, or where what it declares cannot be."""
    try:
        refuse_other_contract(origin.file)
        with in_time():
            found = origin.load()
        digest = module_hash(origin.package or origin.file())
    except Exception as cause:
        message = Phrase("it cannot be loaded from {told}: {said}", told=origin.label, said=said(cause))
        raise PluginError(message + beside(origin.file(), cause), origin.kind) from cause
    if not isinstance(found, Mechanism):
        template = "{told} gives a {name}, where a Mechanism is needed"
        raise PluginError(Phrase(template, told=origin.label, name=type(found).__name__), origin.kind)
    if found.kind != origin.kind:
        named = {"told": origin.label, "kind": repr(found.kind), "wanted": repr(origin.kind)}
        raise PluginError(Phrase("{told} gives the kind {kind}; name it {wanted} there", named), origin.kind)
    note_plugin(found, digest, None if origin.is_own else origin.file())
    if not origin.is_own:
        _judge_declarations(origin, found)
    return found


def _judge_declarations(origin: Origin, mechanism: Mechanism) -> None:
    from diecut_report.config import model as press_defaults
    from diecut_report.declaration import faults_at_load
    from diecut_report.declaration.formula_checks import faults_of_formulas

    try:
        with in_time():
            found = [str(fault) for fault in faults_at_load(mechanism) or press_defaults.faults(mechanism)]
    except Exception as cause:
        message = Phrase("the declarations of {told} cannot be read: {said}", told=origin.label, said=said(cause))
        raise PluginError(message, origin.kind) from cause
    if found:
        head = Phrase("{told} has invalid declarations", told=origin.label)
        lines = joined([head, found[0]], ": ") if len(found) == 1 else joined([head + ":", *found], "\n  ")
        raise PluginError(lines, origin.kind)
    for each in (mechanism, *(comparison.mechanism for comparison in mechanism.comparisons)):
        note_check(each, faults_of_formulas(each))


def said(cause: BaseException) -> str:
    """An exception of a plugin in one line: its type, its text, and the last file and line of the plugin that led to it."""
    if isinstance(cause, Misdeclared) or (isinstance(cause, FormulaError) and cause.place):  # tells its own place
        return _text_of(cause)
    if isinstance(cause, Escaped) and cause.__cause__:
        cause = cause.__cause__
    frames = [f for f in traceback.extract_tb(cause.__traceback__) if not f.filename.startswith("<")]
    own = [f for f in frames if not _is_foreign(Path(f.filename))] or frames
    tells_place = isinstance(cause, SyntaxError) or getattr(cause, "tells_place", False)
    declared = Path(getattr(cause, "at", "")).name  # of what is not proved, which the engine tells
    place = f" ({declared or f'{Path(own[-1].filename).name}:{own[-1].lineno}'})" if own and not tells_place else ""
    text = (other_program(cause) or _text_of(cause)) + shadowed(cause)
    return f"{type(cause).__name__}{': ' if text else ''}{text}{place}"


def shadowed(cause: BaseException) -> str:
    """Return in words what to do where another value stands for ``m``, which gives the quantities; empty for other causes."""
    if not isinstance(cause, AttributeError) or cause.obj is None or cause.__traceback__ is None:
        return ""
    *_, (frame, _line) = walk_tb(cause.__traceback__)
    if (frame.f_globals | frame.f_locals).get(QUANTITIES) is not cause.obj:
        return ""
    template = "; {name} is {other} here, and gives no quantities any more: call that otherwise"
    return Phrase(template, name=QUANTITIES, other=reprlib.repr(cause.obj))


QUANTITIES = "m"  # the name by which authors take quantities


def _text_of(cause: BaseException) -> str:
    """The text of an exception in one line, shortened; nothing where its class cannot tell it."""
    try:
        with in_time():
            text = yaml.printable(" ".join(str(cause).split()))
    except Exception:
        return ""
    return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}…"


LONGEST_TEXT = 1_500  # letters of an exception's text that are told
PROGRAM = Path(__file__).parents[1]
LIBRARIES = ("numpy", "scipy", "pydantic", "pint")
STANDARD = Path(traceback.__file__).parent


def _is_foreign(file: Path) -> bool:
    """Whether a file is not a plugin's: of the program, of the standard library, of a library that plugins use."""
    of_program = file.is_relative_to(PROGRAM) and not file.is_relative_to(PROGRAM / GROUP.rpartition(".")[2])
    of_library = "site-packages" in file.parts and any(name in file.parts for name in LIBRARIES)
    return of_program or of_library or file.parent == STANDARD


def _built_in() -> Iterator[Origin]:
    package = import_module(GROUP)
    for kind in _names_in(Path(package.__path__[0])):
        name = f"{GROUP}.{kind}"
        load, file = partial(_attribute, ATTRIBUTE, import_module, name), partial(_file_of_module, name)
        yield Origin(kind, phrase("the program itself"), load, file, is_own=True)


def _file_of_module(name: str) -> Path:
    return Path(str(sys.modules[name].__file__))


def entry_points(group: str) -> metadata.EntryPoints:
    """Return what installed packages announce of a group; looked up again only where a package may have come or gone."""
    searched = tuple((path, os.stat(path).st_mtime_ns) for path in sys.path if os.path.exists(path))
    found: metadata.EntryPoints = _all_entry_points(searched).select(group=group)
    return found


@lru_cache(1)
def _all_entry_points(_searched: tuple[tuple[str, int], ...]) -> Any:
    return metadata.entry_points()


def _installed() -> Iterator[Origin]:
    for entry in entry_points(group=GROUP):
        label = phrase("an installed package")
        if entry.dist:
            label = Phrase("the package {name} {version}", name=entry.dist.name, version=entry.dist.version)
        load = entry.load if entry.attr else partial(_attribute, ATTRIBUTE, import_module, entry.module)
        yield Origin(entry.name, label, load, partial(file_of, entry.module))


def in_folder(folder: Path) -> Iterator[Origin]:
    """Yield the kinds of a folder of plugins, or of the project of a package; UserError where there is no such folder."""
    if not folder.is_dir():
        raise refusal("There is no such folder of plugins. Check the name given with --plugins.", folder)
    is_listed = (folder / LIST).is_file()
    project = {} if is_listed else _announced(folder)
    alone = _listed(folder) if is_listed else {name: (name, "") for name in _names_in(folder)}
    for kind, (name, attribute) in (project or alone).items():
        package = folder / name / "__init__.py"
        file = package if package.is_file() else folder / f"{name}.py"
        # the modules of a project import each other by its name, as where it is installed
        source = folder / SOURCES if name.startswith(f"{SOURCES}/") else folder
        module = (module_of_project, file, source) if project else (module_of_file, file)
        whole = source / file.relative_to(source).parts[0] / "__init__.py"
        load = partial(_attribute, attribute or ATTRIBUTE, *module)
        yield Origin(kind, str(file), load, partial(Path, file), package=whole if project and whole.is_file() else None)


def _require_unlike_packages(folders: Iterable[Path]) -> None:
    """Raise UserError where two projects have a package of one name: functions of one would import the modules of the other."""
    homes: dict[str, Path] = {}
    for folder in folders:
        is_project = folder.is_dir() and not (folder / LIST).is_file()
        places = [place for place, _ in _announced(folder).values()] if is_project else []
        for package in {place.removeprefix(f"{SOURCES}/").partition("/")[0] for place in places}:
            if homes.setdefault(package, folder) is not folder:
                template = "The package {name} is in {other} too; give one of them another name."
                raise refusal(template, folder, name=package, other=str(homes[package]))


def _names_in(folder: Path) -> list[str]:
    files = [path for path in folder.iterdir() if (path if path.suffix == ".py" else path / "__init__.py").is_file()]
    return sorted(path.stem for path in files if not path.name.startswith(("_", ".", EXTENSION)))


def _listed(folder: Path) -> dict[str, tuple[str, str]]:
    tree = yaml.load(folder / LIST)
    if not isinstance(tree.data, dict) or not all(isinstance(value, str) for value in tree.data.values()):
        raise refusal("A list of kinds is needed, each as KIND: FILE.py or KIND: FILE.py:ATTRIBUTE.", tree.file)
    places = {kind: place.partition(":") for kind, place in tree.data.items()}
    return {kind: (name.removesuffix(".py"), attribute) for kind, (name, _, attribute) in places.items()}


# The catalogues of the plugins that a report is made with: found without running their code, and judged before they are used.


MAX_LISTED = 3  # texts that are told of an incomplete catalogue


def catalogues_for(language: str, kinds: Iterable[str], discovery: Discovery, file: str = "") -> Catalogues:
    """Return the catalogues for mechanisms of these kinds; UserError where one of the program's own is not complete."""
    try:
        found = Catalogues(language, partial(_plugin, discovery))
    except UnknownLanguage as error:
        raise UserError(Problem(Phrase("The language {error}.", error=error), file, path="project.language")) from None
    if language != SOURCE_LANGUAGE:
        problems = (_incomplete(kind, found, file) for kind in dict.fromkeys(kinds) if built_in(kind))
        if told := list(filter(None, problems)):
            raise UserError(told)
    return found


def spoken_catalogues(discovery: Discovery | None) -> Catalogues:
    """Return those of the language that is spoken."""
    return Catalogues(spoken_language()) if discovery is None else catalogues_of(spoken_language(), discovery)


def catalogues_of(language: str, discovery: Discovery) -> Catalogues:
    """Return the catalogues of a language with those of all plugins; what plugins of others do not have stays English."""
    return Catalogues(language, partial(_plugin, discovery), discovery.origins)


def lacking(catalogues: Catalogues, kinds: Iterable[str]) -> list[str]:
    """Return in words which foreign plugins have no words in the language, or not all: these stay English."""
    if catalogues.language == SOURCE_LANGUAGE:
        return []
    none = "The plugin of {kind} has no catalogue locale/{language}.po; its texts remain in English."
    some = "The catalogue {language} of the plugin of {kind} lacks {count} texts, which remain in English."
    found: list[str] = []
    for kind in dict.fromkeys(kinds):
        own = catalogues.of(kind)
        if not built_in(kind) and (own is None or own.missing):
            count = len(own.missing) if own else 0
            found.append(Phrase(some if own else none, kind=repr(kind), language=catalogues.language, count=count))
    return found


def _incomplete(kind: str, catalogues: Catalogues, file: str) -> Problem | None:
    own = catalogues.of(kind)
    if own is not None and not own.missing:
        return None
    texts = [] if own is None else own.missing
    told = "; ".join(f"“{text}”" for text in texts[:MAX_LISTED])
    template = "Reports in {language} need a translation of {kind}: {count} texts are not translated ({told} …). "
    why = Phrase(template, language=catalogues.language, kind=kind, count=len(texts), told=told)
    advised = Phrase("{words}Give language: {source_language}.", words=why, source_language=SOURCE_LANGUAGE)
    return Problem(advised, file, path="project.language")


def _plugin(discovery: Discovery, kind: str) -> Path | None:
    origins = discovery.origins.get(kind, [])
    try:
        return origins[0].file() if len(origins) == 1 else None
    except KeyError:  # an installed package that was not loaded
        return None
