"""Configurations calculated side by side on all cores: of each its results, or what is wrong with it."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import redirect_stdout
from dataclasses import asdict, dataclass, field, replace
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Any

from diecut_report.config import yaml
from diecut_report.config.loader import is_study
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import Tree
from diecut_report.errors import Problem, UserError
from diecut_report.quantities.units import pretty
from diecut_report.report.text import translated
from diecut_report.results.conclusion import SELF_TEST, doubtful_kinds
from diecut_report.results.mechanism_record import CheckRecord, MechanismRecord, QuantityRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.study.execution.engines import WorkerSetup, local_engine, results, settle
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import localised

ENDINGS = (".yaml", ".yml")
MAX_MACHINES = 10_000  # machines of one check
UNUSED: dict[str, Any] = {"curves": {}, "values": {}, "lists": {}} | {
    key: [] for key in ("sections", "figures", "exports", "assumptions", "sources", "errata", "absent")
}
BAD, BROKEN = "bad", "error"  # states beside pass, warn and fail: the file is bad, a plugin broke


@dataclass
class CheckedMachine:
    """Hold what came out of a configuration: its results without curves and print, and the words of what is wrong with it."""

    file: str
    status: str
    results: ResultsRecord | None = None
    words: list[str] = field(default_factory=list)

    @property
    def mechanisms(self) -> Mapping[str, MechanismRecord]:
        """Return the results of its mechanisms."""
        return self.results.mechanisms if self.results else {}


@dataclass
class FoundFiles:
    """Hold the files to calculate, and those of folders that are passed over, each with why."""

    files: list[Path] = field(default_factory=list)
    passed_over: dict[Path, str] = field(default_factory=dict)


def configurations(given: Sequence[Path]) -> FoundFiles:
    """Return the files to calculate: those named, and of folders all configurations, by name; UserError where there are none."""
    found = FoundFiles()
    for path in given:
        if not os.path.isdir(path):
            found.files.append(path)
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
        raise UserError(Problem(Phrase(template, count=len(found.files), most=MAX_MACHINES)))
    return found


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
    files: Sequence[Path | Tree], folders: Sequence[str], jobs: int | None = None
) -> Iterator[tuple[int, CheckedMachine]]:
    """Yield each configuration's number and what came out, in the order in which they are ready."""
    key = sha256(repr((folders, os.getcwd())).encode()).hexdigest()
    chunks = [(number, given if isinstance(given, Tree) else str(given)) for number, given in enumerate(files)]
    with local_engine(jobs, len(files), WorkerSetup(key, _loaded, (tuple(folders),))) as engine:
        for (number, _), made in results(engine, calculated, chunks):
            yield number, made


def _loaded(folders: tuple[str, ...]) -> Discovery:
    settle()
    return Discovery(tuple(map(Path, folders)))


def calculated(discovery: Discovery, chunk: tuple[int, str | Tree]) -> CheckedMachine:
    """Return what comes out of a file, or of what was read of it."""
    from diecut_report.press import Press

    given = chunk[1] if isinstance(chunk[1], Tree) else Path(chunk[1])
    file = given.file if isinstance(given, Tree) else str(given)
    try:
        with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere):  # a plugin may print
            made = Press.read(given, discovery).calculate()
    except UserError as error:
        problems = error.problems
        try:  # all that is wrong: calculating stops at the first of its checks
            Press.validate(given, discovery)
        except UserError as more:
            problems = more.problems
        return CheckedMachine(file, BAD, None, [str(problem) for problem in problems])
    status = BROKEN if made.broken else made.results.status
    return CheckedMachine(file, status, _lean(made.results), [*map(str, made.broken), *made.warnings])


def _lean(whole: ResultsRecord) -> ResultsRecord:
    """Return results without what a comparison does not show, so that they travel fast between processes."""
    kept = {name: data.with_(**UNUSED) for name, data in whole.mechanisms.items()}
    config = whole.config.with_(source_text="", resolved={}, materials=[], logo=None)
    return whole.with_(config=config, mechanisms=kept, comparisons={})


# What machines have in common and where they differ: verdicts, the matrix of checks, unlike inputs, advice. Plain data.


Data = Mapping[str, Any]
NOT_CHECKED, INCOMPLETE = "not_checked", "incomplete"
STATES = {
    "pass": phrase("pass"),
    INCOMPLETE: phrase("conditional"),
    "warn": phrase("warn"),
    "fail": phrase("fail"),
    BROKEN: phrase("error"),
    BAD: phrase("bad"),
    "skipped": phrase("skipped"),
    NOT_CHECKED: phrase("not checked"),
}


@dataclass(frozen=True)
class Verdict:
    """Hold a machine's line of the table of verdicts; ``words`` say what is wrong with a bad file, or with a plugin."""

    machine: str
    file: str
    status: str
    governing: str = ""
    utilisation: float | None = None
    failed: int = 0
    not_checked: int = 0
    warnings: int = 0
    words: tuple[str, ...] = ()
    formulas_with_faults: bool = False
    assumed: int = 0
    conclusion: str = ""

    @property
    def face(self) -> str:
        """Return the verdict as it is shown: one that passes, but leaves something open, is conditional."""
        is_open = self.not_checked or self.assumed or self.formulas_with_faults
        return INCOMPLETE if self.status == "pass" and is_open else self.status


@dataclass(frozen=True)
class MachineComparison:
    """Hold machines side by side: a row has a cell for each of ``machines``, "" or None where a machine lacks it."""

    machines: list[str]
    verdicts: list[Verdict]
    checks: list[tuple[str, str, list[dict[str, Any] | None]]]  # id, title, status and utilisation of each
    inputs: list[tuple[str, str, list[str]]]  # path, description, what each has
    advice: list[tuple[str, list[str]]]  # machine, what to do

    def as_data(self) -> dict[str, Any]:
        """Return it as the JSON file holds it."""

        def of_each(cells: Sequence[Any]) -> dict[str, Any]:
            return dict(zip(self.machines, cells, strict=True))

        checks = [{"id": name, "title": title, "machines": of_each(cells)} for name, title, cells in self.checks]
        inputs = [{"path": path, "description": text, "machines": of_each(cells)} for path, text, cells in self.inputs]
        return {
            "schema_version": 1,
            "machines": [asdict(verdict) for verdict in self.verdicts],
            "checks": checks,
            "differing_inputs": inputs,
            "advice": dict(self.advice),
        }


def verdict(machine: CheckedMachine, name: str) -> Verdict:
    """Return a machine's line."""
    if machine.status == BAD:
        return Verdict(name, machine.file, BAD, words=tuple(machine.words))
    results = machine.results
    assert results is not None, "only a bad file has none"
    checks = dict(_checks(machine))
    governing = str(results.governing) if results.governing else ""
    count = Counter(check.status for check in checks.values())
    return Verdict(
        name, machine.file, machine.status, governing,
        utilisation=checks[governing].utilisation if governing in checks else None,
        failed=count["fail"], not_checked=results.summary.not_checked, warnings=count["warn"],
        words=tuple(machine.words), formulas_with_faults=bool(doubtful_kinds(results)),
        assumed=len(results.summary.assumed), conclusion=results.summary.conclusion,
    )  # fmt: skip


def _checks(machine: CheckedMachine) -> Iterator[tuple[str, CheckRecord]]:
    for name, data in machine.mechanisms.items():
        own = (check for check in data.checks if check.check_class != SELF_TEST)
        yield from ((f"{name}.{check.id}", check) for check in own)


def names(files: Sequence[str]) -> list[str]:
    """Return what machines are called: their files' names, with so much of the path as tells them apart."""
    parts = [PurePath(file).with_suffix("").parts for file in files]
    length = 1
    while len({part[-length:] for part in parts}) < len(set(parts)):
        length += 1
    return ["/".join(part[-length:]) for part in parts]


def language_of(machines: Sequence[CheckedMachine]) -> str:
    """Return the language that the projects of all machines share; English where they do not."""
    found = {machine.results.project.language for machine in machines if machine.results}
    return found.pop() if len(found) == 1 else SOURCE_LANGUAGE


def in_language(machines: Sequence[CheckedMachine], catalogues: Catalogues) -> list[CheckedMachine]:
    """Return machines with their texts in the language of the catalogues."""
    if catalogues.language == SOURCE_LANGUAGE:
        return list(machines)
    return [replace(each, results=translated(each.results, catalogues)) if each.results else each for each in machines]


def compared(machines: Sequence[CheckedMachine]) -> MachineComparison:
    """Return machines side by side; bad ones have a verdict alone."""
    called = names([machine.file for machine in machines])
    verdicts = [verdict(machine, name) for machine, name in zip(machines, called, strict=True)]
    good = {name: machine for name, machine in zip(called, machines, strict=True) if machine.status != BAD}
    checks = [dict(_checks(machine)) for machine in good.values()]
    titles = {key: check.title for some in checks for key, check in some.items()}
    matrix = [(key, title, [_cell(some.get(key)) for some in checks]) for key, title in titles.items()]
    inputs = [dict(_inputs(machine)) for machine in good.values()]
    described = {key: row.description for some in inputs for key, row in some.items()}
    rows = [(key, text, [_shown(some.get(key)) for some in inputs]) for key, text in described.items()]
    advice = [(name, _advice(some)) for name, some in zip(good, checks, strict=True)]
    differing = [row for row in rows if len(set(row[2])) > 1]
    return MachineComparison(list(good), verdicts, matrix, differing, [each for each in advice if each[1]])


def _cell(check: CheckRecord | None) -> dict[str, Any] | None:
    return None if check is None else {"status": check.status, "utilisation": check.utilisation}


def _inputs(machine: CheckedMachine) -> Iterator[tuple[str, QuantityRecord]]:
    yield from ((row.path, row) for row in (machine.results.press.fields if machine.results else ()))
    for name, data in machine.mechanisms.items():
        yield from ((f"{name}.{key}", row) for key, row in data.inputs.items())


def _shown(row: QuantityRecord | None) -> str:
    return f"{localised(row.display.text)} {pretty(row.display.unit)}".rstrip() if row else ""


def _advice(checks: Mapping[str, CheckRecord]) -> list[str]:
    failing = ((name, check) for name, check in checks.items() if check.status in ("fail", "warn"))
    return [f"{name}: {check.message}" for name, check in failing]
