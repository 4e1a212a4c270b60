"""Configurations and variants of studies, calculated side by side on all cores: of each its results, or what is wrong with it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass, field, replace
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diecut_report.config import yaml
from diecut_report.config.loader import Config, is_study
from diecut_report.config.parts.reading import typed_places, typed_value
from diecut_report.config.plugins import Discovery
from diecut_report.config.validation import value_at
from diecut_report.config.yaml import KeyPath, Tree
from diecut_report.errors import PluginError, Problem, UserError, own_fault, refusal
from diecut_report.quantities.formatting import given_shown
from diecut_report.report.text import translated
from diecut_report.results.mechanism_record import MechanismRecord, QuantityRecord, ShownRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.study.analysis.variant_config import variant_config, variant_named
from diecut_report.study.analysis.variants import opened
from diecut_report.study.definition.base_inputs import UnknownPath, present_value, varied_input
from diecut_report.study.execution.engines import WorkerSetup, local_engine, results, settle
from diecut_report.study.storage.description import STATE
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues
from diecut_report.text.phrases import Phrase, phrase

if TYPE_CHECKING:
    from diecut_report.press import CalculatedPress

Finish = Callable[["CalculatedPress"], "CalculatedPress"]

ENDINGS = (".yaml", ".yml")
MAX_MACHINES = 10_000  # machines of one check
MAX_VARIANTS = 100  # of a study that is named as a whole: each is calculated anew
UNUSED: dict[str, Any] = {"curves": {}, "values": {}, "lists": {}} | {
    key: [] for key in ("sections", "figures", "exports", "assumptions", "sources", "errata", "absent")
}
BAD, IMPOSSIBLE, BROKEN, FAULTY = "bad", "impossible", "error", "fault"
"""States beside pass, warn and fail: the file is bad, it describes a machine that cannot exist, a plugin broke, the program itself did."""
WITHOUT_RESULTS = (BAD, IMPOSSIBLE, FAULTY)


@dataclass
class CheckedMachine:
    """Hold what came out of a configuration: its results without curves and print, and the words of what is wrong with it."""

    file: str
    status: str
    results: ResultsRecord | None = None
    words: list[str] = field(default_factory=list)

    @property
    def mechanisms(self) -> Mapping[str, MechanismRecord]:
        return self.results.mechanisms if self.results else {}


@dataclass
class FoundFiles:
    """Hold the files to calculate, and those of folders that are passed over, each with why."""

    files: list[Path] = field(default_factory=list)
    passed_over: dict[Path, str] = field(default_factory=dict)


def configurations(given: Sequence[Path]) -> FoundFiles:
    """Return what to calculate: what is named, of folders all configurations by name, of a study's results the variants ``DIR#N``.

    UserError where there is nothing.
    """
    found = FoundFiles()
    for path in given:
        if not os.path.isdir(path):
            found.files.append(path)
            continue
        if os.path.exists(path / STATE):
            _add_variants(path, found)
            continue
        for inner in sorted(each for each in path.rglob("*") if each.suffix in ENDINGS and each.is_file()):
            if why := _why_no_configuration(inner):
                found.passed_over[inner] = why
            else:
                found.files.append(inner)
    found.files = list(dict.fromkeys(found.files))
    if not found.files:
        template = "There is no configuration in {given}. Name files, or folders with .yaml files."
        others = [Problem(Phrase("skipped: {why}", why=why), str(path)) for path, why in found.passed_over.items()]
        raise UserError([Problem(Phrase(template, given=", ".join(map(str, given)))), *others])
    if len(found.files) > MAX_MACHINES:
        template = "These are {count} configurations; at most {most} are checked at once."
        raise refusal(template, count=len(found.files), most=MAX_MACHINES)
    return found


def _add_variants(folder: Path, found: FoundFiles) -> None:
    """Add all variants of a study of few; the folder itself where that is not possible, which is reported with the others."""
    try:
        variants = _few_variants(folder)
    except UserError:
        found.files.append(folder)
        return
    for number, status in variants:
        if status == BROKEN:
            found.passed_over[Path(f"{folder}#{number}")] = phrase("this variant cannot be calculated")
        else:
            found.files.append(Path(f"{folder}#{number}"))


def _few_variants(folder: Path) -> list[tuple[Any, ...]]:
    """Return the number and the status of each variant of a study; UserError where there are too many to compare, or none to read."""
    with opened(folder) as stored:
        variants = stored.rows(f"SELECT variant, status FROM v ORDER BY variant LIMIT {MAX_VARIANTS + 1}")
    if len(variants) > MAX_VARIANTS:
        template = "This study has more than {most} variants. Name some: {folder}#3 {folder}#17; `diecut-report variants {folder}` finds them."
        raise refusal(template, folder, most=MAX_VARIANTS, folder=folder)
    return variants


def _why_no_configuration(path: Path) -> str:
    """Return why a file of a folder is not meant, empty where it is: also one that cannot be read, so that its fault is reported."""
    try:
        tree = yaml.load(path)
    except UserError:
        return ""
    if isinstance(tree.data, dict) and "mechanisms" in tree.data:
        return ""
    if is_study(tree):
        return phrase("it is a study, which batch calculates")
    return phrase("it has no key mechanisms, and so is not a configuration")


def machines(
    files: Sequence[Path | Tree], folders: Sequence[str], jobs: int | None, finish: Finish
) -> Iterator[tuple[int, CheckedMachine]]:
    """Yield each configuration's number and what came out, in the order in which they are ready.

    ``finish`` is a function of a module, called with each calculated press in its process; it returns it with what is asked for besides.
    """
    key = sha256(repr((folders, os.getcwd())).encode()).hexdigest()
    chunks = [(number, given if isinstance(given, Tree) else str(given)) for number, given in enumerate(files)]
    with local_engine(jobs, len(files), WorkerSetup(key, _loaded, (tuple(folders),))) as engine:
        for (number, _), made in results(engine, partial(calculated, finish=finish), chunks):
            yield number, made


def _loaded(folders: tuple[str, ...]) -> Discovery:
    settle()
    return Discovery(tuple(map(Path, folders)))


def calculated(discovery: Discovery, chunk: tuple[int, str | Tree], finish: Finish) -> CheckedMachine:
    """Return what comes out of a file or a variant ``DIR#N``, or of what was read of it; a fault of the program hides no other file."""
    given = chunk[1]
    file = given.file if isinstance(given, Tree) else given
    try:
        return _calculated(discovery, given, file, finish)
    except PluginError:
        raise
    except Exception as fault:
        return CheckedMachine(file, FAULTY, None, [str(Problem(own_fault(fault), file))])


def _calculated(discovery: Discovery, given: str | Tree, file: str, finish: Finish) -> CheckedMachine:
    from diecut_report.press import Press

    notes = list[str]()
    source: Path | Tree | None = None
    status = BAD
    try:
        with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere):  # a plugin may print
            source = _source(given, discovery, notes)
            press = Press.read(source, discovery)
            status = IMPOSSIBLE
            made = finish(press.calculate())
    except UserError as error:
        problems = error.problems
        try:  # all that is wrong: calculating stops at the first of its checks
            if source is not None:
                Press.validate(source, discovery)
        except UserError as more:
            problems = more.problems
        return CheckedMachine(file, status, None, [str(problem) for problem in problems])
    status = BROKEN if made.broken else made.results.status
    lean = _lean(made.results, made.press.config)
    return CheckedMachine(file, status, lean, [*map(str, made.broken), *made.warnings, *notes])


def _source(given: str | Tree, discovery: Discovery, notes: list[str]) -> Path | Tree:
    if isinstance(given, Tree):
        return given
    if Path(given).suffix == ".json":
        template = "This is a results file, or none of a machine. Name configurations; diecut-report diff compares two results files."
        raise refusal(template, given)
    if variant := variant_named(Path(given)):
        folder, number = variant
        return variant_config(folder, number, discovery, f"{folder.resolve().name}-{number}.yaml", notes.append)
    if os.path.exists(Path(given) / STATE):
        _few_variants(Path(given))  # it is here because that is refused
    return Path(given)


def _lean(whole: ResultsRecord, made_of: Config) -> ResultsRecord:
    """Return results without what a comparison does not show, so that they travel fast between processes.

    What is typed at the parts of a machine stands beside the fields of the press; what follows from it was typed by nobody.
    """
    kept = {
        name: data.with_(**UNUSED, inputs=_not_made(name, data, made_of)) for name, data in whole.mechanisms.items()
    }
    config = whole.config.with_(source_text="", resolved={}, materials=[], logo=None)
    press = whole.press.with_(fields=[*whole.press.fields, *typed_at_parts(made_of)])
    return whole.with_(config=config, press=press, mechanisms=kept, comparisons={})


def _not_made(name: str, data: MechanismRecord, config: Config) -> dict[str, QuantityRecord]:
    """The inputs of a mechanism, as left out where they follow from the parts of the machine."""
    parts = config.parts
    if parts is None:
        return dict(data.inputs)
    nodes = ((key, row, (name, *key.split("."))) for key, row in data.inputs.items())
    return {key: row.with_(origin="default") if parts.follows(node) else row for key, row, node in nodes}


def typed_at_parts(config: Config) -> Iterator[QuantityRecord]:
    """What is typed at the parts of a machine, each with its path."""
    if (parts := config.parts) is not None:
        tree = parts.reader.tree
        yield from (_typed_at(config, tree, place, parts.called(place)) for place in typed_places(tree))


def _typed_at(config: Config, tree: Tree, place: KeyPath, path: str) -> QuantityRecord:
    block, scalar = value_at(tree.data, place), typed_value(tree, place)
    basis = block.get("basis", "") if isinstance(block, dict) else ""
    typed = str(scalar).lower() if isinstance(scalar, bool) else str(scalar)
    given: dict[str, Any] = {"origin": "given", "path": path, "text": typed, "basis": basis}
    try:
        asked = varied_input(config, path)
        value = present_value(config, asked)
    except UnknownPath:
        return _as_text(typed, path.rpartition(".")[2], given)
    if not isinstance(value, float):
        return _as_text(typed, asked.meta.description, given)
    shown = ShownRecord(**given_shown(value, asked.display))
    return QuantityRecord(
        value=value,
        unit=asked.unit or "1",
        symbol=asked.meta.symbol,
        description=asked.meta.description,
        display=shown,
        **given,
    )


def _as_text(typed: str, description: str, given: Mapping[str, Any]) -> QuantityRecord:
    shown = ShownRecord(text=typed, unit="1")
    return QuantityRecord(value=typed, unit="1", symbol="", description=description, display=shown, **given)


def language_of(machines: Sequence[CheckedMachine]) -> str:
    """Return the language that the projects of all machines share; English where they do not."""
    found = {machine.results.project.language for machine in machines if machine.results}
    return found.pop() if len(found) == 1 else SOURCE_LANGUAGE


def in_language(machines: Sequence[CheckedMachine], catalogues: Catalogues) -> list[CheckedMachine]:
    """Return machines with their texts in the language of the catalogues."""
    return [replace(each, results=translated(each.results, catalogues)) if each.results else each for each in machines]
