"""What machines have in common and where they differ: verdicts, the matrix of checks, unlike inputs, advice. Plain data."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import PurePath
from typing import Any

from diecut_report.languages.catalogues import SOURCE_LANGUAGE, Catalogues
from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import localised
from diecut_report.quantities.units import pretty
from diecut_report.report.translated import translated
from diecut_report.results.conclusion import is_open
from diecut_report.results.doubtful_plugins import doubtful_kinds
from diecut_report.results.summary import SELF_TEST
from diecut_report.study.machines.calculation import BAD, BROKEN, CheckedMachine

Data = Mapping[str, Any]
NOT_CHECKED, CONDITIONAL = "not_checked", "conditional"
STATES = {
    "pass": phrase("pass"),
    "warn": phrase("warn"),
    "fail": phrase("fail"),
    BROKEN: phrase("error"),
    BAD: phrase("bad"),
    "skipped": phrase("skipped"),
    NOT_CHECKED: phrase("not checked"),
    CONDITIONAL: phrase("conditional"),
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
    is_open: bool = False

    @property
    def face(self) -> str:
        """The verdict as it is shown: one that passes, but leaves something open, is conditional."""
        return CONDITIONAL if self.status == "pass" and self.is_open else self.status


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
        checks = [
            {"id": name, "title": title, "machines": dict(zip(self.machines, cells, strict=True))}
            for name, title, cells in self.checks
        ]
        inputs = [
            {"path": path, "description": told, "machines": dict(zip(self.machines, cells, strict=True))}
            for path, told, cells in self.inputs
        ]
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
    checks = list(_checks(machine))
    found = machine.results.get("governing")
    named = f"{found['mechanism']}.{found['check']}" if found else ""
    ratio = next((check["utilisation"] for key, check in checks if key == named), None)
    return Verdict(
        name, machine.file, machine.status, named, ratio,
        sum(check["status"] == "fail" for _, check in checks),
        machine.results.get("summary", {}).get(NOT_CHECKED, sum(check["status"] == NOT_CHECKED for _, check in checks)),
        sum(check["status"] == "warn" for _, check in checks), tuple(machine.words), bool(machine.results and doubtful_kinds(machine.results)),
        bool(machine.results and is_open(machine.results)),
    )  # fmt: skip


def _checks(machine: CheckedMachine) -> Iterator[tuple[str, Data]]:
    for name, data in machine.mechanisms.items():
        own = (check for check in data["checks"] if check.get("class") != SELF_TEST)
        yield from ((f"{name}.{check['id']}", check) for check in own)


def names(files: Sequence[str]) -> list[str]:
    """Return what machines are called: their files' names, with so much of the path as tells them apart."""
    parts = [PurePath(file).with_suffix("").parts for file in files]
    length = 1
    while len({part[-length:] for part in parts}) < len(set(parts)):
        length += 1
    return ["/".join(part[-length:]) for part in parts]


def language_of(machines: Sequence[CheckedMachine]) -> str:
    """Return the language that the projects of all machines share; English where they do not."""
    found = {machine.results["project"].get("language") or SOURCE_LANGUAGE for machine in machines if machine.results}
    return found.pop() if len(found) == 1 else SOURCE_LANGUAGE


def in_language(machines: Sequence[CheckedMachine], catalogues: Catalogues) -> list[CheckedMachine]:
    """Return machines with their texts in the language of the catalogues."""
    if catalogues.language == SOURCE_LANGUAGE:
        return list(machines)
    return [
        replace(each, results=dict(translated(each.results, catalogues))) if each.results else each for each in machines
    ]


def compared(machines: Sequence[CheckedMachine]) -> MachineComparison:
    """Return machines side by side; bad ones have a verdict alone."""
    called = names([machine.file for machine in machines])
    verdicts = [verdict(machine, name) for machine, name in zip(machines, called, strict=True)]
    good = [(name, machine) for name, machine in zip(called, machines, strict=True) if machine.status != BAD]
    sides = [machine for _, machine in good]
    advice = [(name, told) for name, machine in good if (told := list(_advice(machine)))]
    return MachineComparison([name for name, _ in good], verdicts, _matrix(sides), _differing(sides), advice)


def _matrix(machines: Sequence[CheckedMachine]) -> list[tuple[str, str, list[dict[str, Any] | None]]]:
    made = [dict(_checks(machine)) for machine in machines]
    titles = {key: str(check["title"]) for checks in made for key, check in checks.items()}
    return [(key, title, [_cell(checks.get(key)) for checks in made]) for key, title in titles.items()]


def _cell(check: Data | None) -> dict[str, Any] | None:
    return None if check is None else {"status": check["status"], "utilisation": check["utilisation"]}


def _differing(machines: Sequence[CheckedMachine]) -> list[tuple[str, str, list[str]]]:
    """The inputs that are not alike in all machines, as they are printed."""
    made = [dict(_inputs(machine)) for machine in machines]
    told = {key: str(row["description"]) for inputs in made for key, row in inputs.items()}
    rows = [(key, text, [_shown(inputs.get(key)) for inputs in made]) for key, text in told.items()]
    return [row for row in rows if len(set(row[2])) > 1]


def _inputs(machine: CheckedMachine) -> Iterator[tuple[str, Data]]:
    for row in machine.results["press"]["fields"]:
        yield row["path"], row
    for name, data in machine.mechanisms.items():
        yield from ((f"{name}.{key}", row) for key, row in data["inputs"].items())


def _shown(row: Data | None) -> str:
    if row is None:
        return ""
    return f"{localised(row['display']['text'])} {pretty(row['display']['unit'])}".rstrip()


def _advice(machine: CheckedMachine) -> Iterator[str]:
    """What the checks that do not pass tell to do."""
    for name, check in _checks(machine):
        if check["status"] in ("fail", "warn"):
            yield f"{name}: {check['message']}"
