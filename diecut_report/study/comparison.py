"""Machines side by side in one table: verdicts, chosen results, what was typed differently, checks; a row each, a cell for each machine."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import PurePath
from typing import Any, NamedTuple

from diecut_report.config.validation import GIVEN
from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.quantities.formatting import given_shown
from diecut_report.quantities.formatting import shown as result_shown
from diecut_report.quantities.units import UnitError, pretty, to_display, unit
from diecut_report.report.model import utilisation
from diecut_report.results.changes import differing_kinds, own_changes
from diecut_report.results.conclusion import RANK, SELF_TEST, doubtful_kinds, may_govern, summary_of, weight
from diecut_report.results.mechanism_record import CheckRecord, QuantityRecord
from diecut_report.study.analysis.variants import side_by_side
from diecut_report.study.machines import BAD, ENDINGS, FAULTY, IMPOSSIBLE, WITHOUT_RESULTS, CheckedMachine
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted

CONDITIONAL, NOT_CHECKED = "conditional", "not_checked"
WORDS = {
    "pass": phrase("pass"),
    CONDITIONAL: phrase("conditional"),
    "fail": phrase("fail"),
    "error": phrase("error"),
    BAD: phrase("bad file"),
    IMPOSSIBLE: phrase("impossible machine"),
    FAULTY: phrase("fault of the program"),
    "warn": phrase("warn"),
    "skipped": phrase("skipped"),
    NOT_CHECKED: phrase("not checked"),
}
"""The verdicts of machines and the states of checks in words."""
TITLES = {
    "verdict": phrase("Verdict"),
    "utilisation": phrase("Governing check"),
    "failed": phrase("Checks that fail"),
    "warnings": phrase("Checks that warn"),
    "not_checked": phrase("Checks not made"),
    "assumed": phrase("Assumed values"),
    "parts": phrase("Parts with a strength calculation"),
}
"""What the rows on a machine as a whole are called."""
COUNTED = ("failed", "warnings", "not_checked", "assumed")
MOST_ROWS = 40  # of inputs or checks that a page and a terminal show; files for programs have all


@dataclass(frozen=True)
class Verdict:
    """Hold what is concluded of a machine; ``messages`` say what is wrong with a bad file, or with a plugin."""

    machine: str
    file: str
    status: str
    governing: str = ""
    utilisation: float | None = None
    failed: int = 0
    not_checked: int = 0
    warnings: int = 0
    messages: tuple[str, ...] = ()
    formulas_with_faults: bool = False
    assumed: int = 0
    conclusion: str = ""
    parts: tuple[int, int] | None = None  # that carry load, and those of them that are rated, where parts are modelled
    verdict: str = BAD
    """``pass``, ``conditional`` or ``fail``; ``error`` where a plugin broke, ``bad`` where the file is bad, ``fault`` where the program has one."""


@dataclass(frozen=True)
class ComparedCell:
    """Hold what a machine has in a row: a number in the row's unit or a text, as it is printed, with its verdict and a note."""

    value: float | str | bool | None
    text: str
    status: str = ""
    note: str = ""


@dataclass(frozen=True)
class ComparedRow:
    """Hold a row: its path, what it is, a cell for each machine (None where it has none), the unit of its numbers (``1`` without one)."""

    path: str
    title: str
    cells: list[ComparedCell | None]
    unit: str = "1"

    @property
    def head(self) -> str:
        """Return what the row is, with its unit: ``Mass of the cylinder [kg]``."""
        return f"{self.title} [{pretty(self.unit)}]" if pretty(self.unit) else self.title


@dataclass(frozen=True)
class MachineComparison:
    """Hold machines side by side; each row has a cell for each of ``machines``."""

    machines: list[Verdict]
    results: list[ComparedRow]
    kinds: list[ComparedRow] = field(default_factory=list)
    changes: list[ComparedRow] = field(default_factory=list)
    checks: list[ComparedRow] = field(default_factory=list)
    advice: list[tuple[str, str, str]] = field(default_factory=list)  # machine, check, what to do

    @property
    def names(self) -> list[str]:
        return [each.machine for each in self.machines]

    @property
    def verdicts(self) -> list[ComparedRow]:
        """Return the rows on the machines as wholes."""
        rows = {"verdict": _verdict_cell, "utilisation": _governing} | {key: partial(_count, key) for key in COUNTED}
        rows |= {"parts": _rated} if any(each.parts for each in self.machines) else {}
        return [ComparedRow(key, said(TITLES[key]), list(map(cell, self.machines))) for key, cell in rows.items()]

    @property
    def telling_checks(self) -> list[ComparedRow]:
        """Return the checks that do not hold somewhere, or not everywhere alike, the worst first; the others say nothing."""
        states = [{cell.status for cell in row.cells if cell} for row in self.checks]
        telling = (row for row, own in zip(self.checks, states, strict=True) if own & {"fail", "warn"} or len(own) > 1)
        return sorted(telling, key=_worst_first)

    @property
    def omitted(self) -> Phrase | None:
        """Return how many inputs a page and a terminal leave out; None where they show all."""
        count = len(self.changes) - MOST_ROWS
        one = "{n} more input differs; the workbook and the JSON file (-o DIR) list it."
        many = "{n} more inputs differ; the workbook and the JSON file (-o DIR) list them."
        return Counted(count, one, many) if count > 0 else None


def _verdict_cell(of: Verdict) -> ComparedCell:
    note = say("formulas with faults") if of.formulas_with_faults else ""
    return ComparedCell(of.verdict, said(WORDS[of.verdict]), of.verdict, note)


def _governing(of: Verdict) -> ComparedCell | None:
    """Return the utilisation of the check that governs, and which it is; of one that has none the verdict."""
    return share_cell(of.utilisation, of.status, of.governing) if of.governing else None


def _rated(of: Verdict) -> ComparedCell | None:
    if of.parts is None:
        return None
    carrying, rated = of.parts
    return ComparedCell(rated, str(rated), note=say("of {n}", n=carrying))


def _count(key: str, of: Verdict) -> ComparedCell | None:
    count = getattr(of, key)
    return None if of.status in WITHOUT_RESULTS else ComparedCell(count, str(count))


def share_cell(share: float | None, status: str, note: str = "") -> ComparedCell:
    """Return a utilisation as a cell, printed in per cent; of a check that has none its state in words."""
    text = said(WORDS[status]) if share is None else utilisation(share, status, decimal_sign())
    return ComparedCell(share, text, status, note)


def _worst_first(row: ComparedRow) -> tuple[int, float]:
    cells = [cell for cell in row.cells if cell]
    used = [cell.value for cell in cells if isinstance(cell.value, float)]
    return -max(RANK.get(cell.status, 0) for cell in cells), -max(used, default=math.inf)


def text_table(made: MachineComparison, names: Sequence[str], width: int | None) -> str:
    """Return a comparison as people read it on a terminal, the machines called by ``names``; what has a path is called by it."""
    rows = [(row.path if "." in row.path else row.title, row) for row in (*made.verdicts, *made.results)]
    rows += [(row.path, row) for row in (*made.kinds, *made.changes[:MOST_ROWS])]
    return side_by_side(names, ([head, pretty(row.unit), *map(_in_lines, row.cells)] for head, row in rows), width)


def _in_lines(cell: ComparedCell | None) -> str:
    return "\n".join(filter(None, (cell.text, cell.note))) if cell else "–"


# What is concluded of each machine, and what it is called.


def named_checks(machine: CheckedMachine) -> Iterator[tuple[str, CheckRecord]]:
    """Yield the checks of a machine by MECHANISM.ID, without the self-tests of the calculation."""
    for name, data in machine.mechanisms.items():
        yield from ((f"{name}.{each.id}", each) for each in data.checks if each.check_class != SELF_TEST)


def verdict(machine: CheckedMachine, name: str) -> Verdict:
    """Return what is concluded of a machine that is called so."""
    results = machine.results
    if results is None:
        return Verdict(name, machine.file, machine.status, messages=tuple(machine.words), verdict=machine.status)
    checks, summary = dict(named_checks(machine)), summary_of(results)
    governing = str(results.governing) if results.governing else ""
    count = Counter(check.status for check in checks.values())
    parts = summary.parts  # results of machines without a model of parts have none
    concluded = machine.status if machine.status == "error" else str(summary.verdict)
    return Verdict(
        name, machine.file, machine.status, governing,
        utilisation=checks[governing].utilisation if governing in checks else None,
        failed=count["fail"], not_checked=summary.not_checked, warnings=count["warn"], messages=tuple(machine.words),
        formulas_with_faults=bool(doubtful_kinds(results)), assumed=len(summary.assumed), conclusion=summary.conclusion,
        parts=(parts.carrying, parts.rated) if parts else None, verdict=concluded,
    )  # fmt: skip


def names(files: Sequence[str]) -> list[str]:
    """Return what machines are called: their files' names, with so much of the path as tells them apart; no two are alike."""
    paths = list(map(PurePath, files))
    parts = [(path.with_suffix("") if path.suffix in ENDINGS else path).parts for path in paths]
    length = 1
    while length < max(map(len, parts)) and len({part[-length:] for part in parts}) < len(set(parts)):
        length += 1
    called = ["/".join(part[-length:]) for part in parts]
    count = Counter(called)  # press.yaml and press.yml are alike without their endings
    whole = ["/".join(path.parts[-length:]) for path in paths]
    return [long if count[short] > 1 else short for short, long in zip(called, whole, strict=True)]


# The rows.


def compared(
    machines: Sequence[CheckedMachine], results: Sequence[ComparedRow], units: Sequence[str] = ()
) -> MachineComparison:
    """Return machines side by side with these rows of results; ``units`` are chosen for quantities of their dimensions."""
    called = names([machine.file for machine in machines])
    sides = [machine.results for machine in machines]
    checks = [dict(named_checks(machine)) for machine in machines]
    titles = {key: check.title for some in checks for key, check in some.items()}
    return MachineComparison(
        [verdict(machine, name) for machine, name in zip(machines, called, strict=True)],
        list(results),
        kinds=[ComparedRow(name, say("Kind of the mechanism"), [ComparedCell(kind, kind) if kind else None for kind in kinds])
               for name, kinds in differing_kinds(sides).items()],
        changes=[row for path, records in own_changes(sides) for row in quantity_rows(path, records, units)],
        checks=[ComparedRow(key, title, [_check_cell(some.get(key)) for some in checks]) for key, title in titles.items()],
        advice=[(name, key, str(check.message)) for name, some in zip(called, checks, strict=True)
                for key, check in some.items() if check.status in ("fail", "warn")],
    )  # fmt: skip


def _check_cell(check: CheckRecord | None) -> ComparedCell | None:
    if check is None:
        return None
    note = "" if check.status == "pass" or check.utilisation is None else said(WORDS[check.status])
    return share_cell(check.utilisation, check.status, note)


def quantity_rows(path: str, records: Sequence[QuantityRecord | None], units: Sequence[str]) -> Iterator[ComparedRow]:
    """Yield the row of a quantity; several where machines have it in several dimensions. What it rests on is noted where that differs."""
    kinds = dict.fromkeys(record.unit for record in records if record)
    bases = {record.basis or GIVEN for record in records if record}
    for si in kinds:
        own = [record if record and record.unit == si else None for record in records]
        first = next(record for record in own if record)
        chosen = chosen_unit(first.display.unit, units)
        cells = [_quantity_cell(each, chosen, len(bases) > 1) for each in own]
        yield ComparedRow(path, first.description, cells, chosen)


def chosen_unit(display: str, units: Sequence[str]) -> str:
    """Return the unit among those asked for that fits a quantity; its own where none does."""
    return next((each for each in units if unit(each).kind == unit(display).kind), display)


def _quantity_cell(record: QuantityRecord | None, chosen: str, says_basis: bool) -> ComparedCell | None:
    if record is None:
        return None
    note = say(record.basis) if says_basis and record.basis not in ("", GIVEN) else ""
    value, display = record.value, record.display
    if isinstance(value, bool) or not isinstance(value, int | float):
        text = said(display.text)
        return ComparedCell(text, text, note=note)
    text = display.text if display.unit == chosen else ""
    return number_cell(value, chosen, text, note=note, is_typed=bool(record.origin))


def number_cell(value: float, chosen: str, text: str = "", *, note: str = "", is_typed: bool = False) -> ComparedCell:
    """Return an SI value as a cell in a unit; ``text`` is how it is printed there, if that is known, else as a result or as it was typed."""
    text = text or (given_shown if is_typed else result_shown)(value, chosen)["text"]
    return ComparedCell(float(f"{to_display(value, chosen):.15g}"), localised(text), note=note)


def as_data(made: MachineComparison) -> dict[str, Any]:
    """Return a comparison as the JSON file holds it: numbers, each row with its unit."""

    def of_each(row: ComparedRow) -> dict[str, Any]:
        cells = dict(zip(made.names, row.cells, strict=True))
        notes = {name: cell.note for name, cell in cells.items() if cell and cell.note}
        values = {name: cell.value if cell else None for name, cell in cells.items()}
        own = {"path": row.path, "description": row.title, "unit": row.unit, "machines": values}
        return own | {"notes": notes} if notes else own

    def of_check(row: ComparedRow) -> dict[str, Any]:
        cells = zip(made.names, row.cells, strict=True)
        machines = {name: cell and {"status": cell.status, "utilisation": cell.value} for name, cell in cells}
        return {"id": row.path, "title": row.title, "machines": machines}

    return {
        "schema_version": 2,
        "machines": [vars(each) | {"messages": list(each.messages)} for each in made.machines],
        "results": [of_each(row) for row in made.results],
        "mechanisms": [of_each(row) for row in made.kinds],
        "own_changes": [of_each(row) for row in made.changes],
        "checks": [of_check(row) for row in made.checks],
        "advice": [{"machine": machine, "check": check, "text": text} for machine, check, text in made.advice],
    }


RATE = "press.productivity"
MOTOR = "motor_power"
TORQUES = ("torque_peak", "torque_max", "torque_min")  # ends of the ids of greatest torques, either way
SHAFTS = "machine_inertia"  # the kind that adds up the masses of all shafts
SHOWN_WORDS = {
    "rate": phrase("Productivity in sheets"),
    "mass": phrase("Mass of the calculated parts"),
    "torque_max": phrase("Greatest torque of all shafts"),
    "motor": phrase("Rated power of the motor"),
    "strength": phrase("Governing strength check"),
    "function": phrase("Governing function check"),
}
"""What is shown where nothing else is asked for, by its short word."""
CLASSES = ("strength", "function")
Row = Mapping[str, QuantityRecord]


class Amount(NamedTuple):
    """A number of a machine: its SI value, the unit in which it is usually shown, and of what it is."""

    value: float
    unit: str
    note: str


@dataclass(frozen=True)
class AskedResults:
    """Hold what a comparison is to show, and the units that are chosen for quantities of their dimensions."""

    names: tuple[str, ...] = tuple(SHOWN_WORDS)
    units: tuple[str, ...] = ()

    def rows(self, machines: Sequence[CheckedMachine]) -> list[ComparedRow]:
        """Return the rows of what is asked for; UserError for a name that no machine has."""
        outputs = [dict(_outputs(machine)) for machine in machines]
        inputs = [dict(_inputs(machine)) for machine in machines]
        known = list(dict.fromkeys(path for some in (*outputs, *inputs) for path in some))
        if known:  # else all files are bad, which is reported
            self._refuse_unknown(known, {path for some in outputs for path in some})
        rows: list[ComparedRow] = []
        for name in self.names:
            if name in SHOWN_WORDS:
                rows += self._of_word(name, machines, outputs)
            else:
                rows += self._of_name(name, [one | other for one, other in zip(inputs, outputs, strict=True)], outputs)
        return rows

    def _refuse_unknown(self, known: Sequence[str], outputs: set[str]) -> None:
        ids = {path.partition(".")[2] for path in outputs}
        allowed = {*SHOWN_WORDS, *known, *ids}
        template = "--show {name}: no machine has this result{nearest}. Name results by their ids, as INSTANCE.OUTPUT, or by the words {words}."
        problems = [
            Problem(Phrase(template, name=name, nearest=nearest(name, allowed), words=", ".join(SHOWN_WORDS)))
            for name in self.names if name not in allowed
        ]  # fmt: skip
        if problems:
            raise UserError(problems)

    def _of_name(self, name: str, quantities: Sequence[Row], outputs: Sequence[Row]) -> Iterator[ComparedRow]:
        """Yield the rows of a path, or of an id in all mechanisms that give it."""
        is_path = any(name in some for some in quantities)
        every = dict.fromkeys(path for some in outputs for path in some)
        for path in [name] if is_path else [each for each in every if each.partition(".")[2] == name]:
            yield from quantity_rows(path, [some.get(path) for some in quantities], self.units)

    def _of_word(self, word: str, machines: Sequence[CheckedMachine], outputs: Sequence[Row]) -> Iterator[ComparedRow]:
        """Yield the row of a short word; none where no machine has it."""
        if word in CLASSES:
            cells = [_governing_check(machine, word) for machine in machines]
            yield from [ComparedRow(word, said(SHOWN_WORDS[word]), cells)] if any(cells) else []
            return
        if word == "mass":
            outputs = [_counted_once(machine, some) for machine, some in zip(machines, outputs, strict=True)]
        found = [_rate(each) for each in machines] if word == "rate" else [AMOUNTS[word](some) for some in outputs]
        first = next(filter(None, found), None)
        if first:
            chosen = chosen_unit(first.unit, self.units)
            cells = [
                each and number_cell(each.value, chosen, note=each.note, is_typed=word == "rate") for each in found
            ]
            yield ComparedRow(word, said(SHOWN_WORDS[word]), cells, chosen)


def refuse_units(units: Sequence[str]) -> None:
    """Raise UserError for what is not a unit, and for two units of one dimension."""
    known: dict[tuple[float, ...], str] = {}
    for each in units:
        try:
            kind = unit(each).kind
        except UnitError as error:
            raise refusal("--units {unit}: {fault}", unit=each, fault=error.args[0]) from None
        if kind in known:
            template = "--units: {first} and {second} are units of the same dimension. Name one of them."
            raise refusal(template, first=known[kind], second=each)
        known[kind] = each


def refuse_unused_units(units: Sequence[str], rows: Sequence[ComparedRow]) -> None:
    """Raise UserError for a unit that fits nothing of what is shown."""
    shown = dict.fromkeys(row.unit for row in rows if any(cell and isinstance(cell.value, float) for cell in row.cells))
    kinds = {unit(each).kind for each in shown}
    unfit = [each for each in units if unit(each).kind not in kinds]
    if unfit and shown:
        template = "--units {unit}: nothing that is shown has this dimension. Shown are {shown}; name other units, or other results with --show."
        texts = ", ".join(pretty(each) for each in shown if pretty(each))
        raise UserError([Problem(Phrase(template, unit=each, shown=texts)) for each in unfit])


def _outputs(machine: CheckedMachine) -> Iterator[tuple[str, QuantityRecord]]:
    for name, data in machine.mechanisms.items():
        yield from ((f"{name}.{key}", row) for key, row in data.outputs.items())


def _inputs(machine: CheckedMachine) -> Iterator[tuple[str, QuantityRecord]]:
    yield from ((row.path, row) for row in (machine.results.press.fields if machine.results else ()))
    for name, data in machine.mechanisms.items():
        yield from ((f"{name}.{key}", row) for key, row in data.inputs.items())


def _rate(machine: CheckedMachine) -> Amount | None:
    row = dict(_inputs(machine)).get(RATE)
    return Amount(float(row.value), row.display.unit, "") if row and isinstance(row.value, int | float) else None


def _numbers(outputs: Row, si: str) -> Iterator[tuple[str, QuantityRecord, float]]:
    for path, row in outputs.items():
        if row.unit == si and isinstance(row.value, int | float) and not isinstance(row.value, bool):
            yield path, row, float(row.value)


def _counted_once(machine: CheckedMachine, outputs: Row) -> Row:
    """Return the outputs without those whose mass is within that of the machine's shafts, with all that is mounted on them."""
    line = machine.results.drive_line if machine.results else None
    kinds = {name: data.kind for name, data in machine.mechanisms.items()}
    if line is None or SHAFTS not in kinds.values():
        return outputs
    made = tuple(f"shafts_{shaft.name}" for shaft in line.shafts)
    is_mounted = any(part.kind == "flywheel" for shaft in line.shafts for part in shaft.parts)

    def is_within(name: str) -> bool:
        of_shaft = kinds[name] in ("shaft", "shaft_body") and any(
            name == each or name.startswith(f"{each}_") for each in made
        )
        return of_shaft or (is_mounted and kinds[name] == "drive_train")

    return {path: row for path, row in outputs.items() if not is_within(path.partition(".")[0])}


def _mass(outputs: Row) -> Amount | None:
    """Return the sum of the masses that are key results, and of how many results."""
    found = [(row.display.unit, value) for _, row, value in _numbers(outputs, "kg") if row.key]
    note = say_counted(len(found), "{n} result", "{n} results")
    return Amount(sum(value for _, value in found), found[0][0], note) if found else None


def _torque(outputs: Row) -> Amount | None:
    found = [
        (abs(value), path.partition(".")[0], row.display.unit)
        for path, row, value in _numbers(outputs, "N*m") if path.endswith(TORQUES)
    ]  # fmt: skip
    value, name, display = max(found, default=(0.0, "", ""))
    return Amount(value, display, name) if found else None


def _motor(outputs: Row) -> Amount | None:
    motors = (each for each in _numbers(outputs, "W") if each[0].partition(".")[2] == MOTOR)
    found = [(row.display.unit, value) for _, row, value in motors]
    return Amount(sum(value for _, value in found), found[0][0], "") if found else None


AMOUNTS: dict[str, Callable[[Row], Amount | None]] = {"mass": _mass, "torque_max": _torque, "motor": _motor}


def _governing_check(machine: CheckedMachine, check_class: str) -> ComparedCell | None:
    """Return the utilisation of the check of a class that governs, and which it is."""
    own = (each for each in named_checks(machine) if each[1].check_class == check_class and may_govern(each[1]))
    name, check = max(own, key=lambda pair: weight(pair[1]), default=("", None))
    return share_cell(check.utilisation, check.status, name) if check else None
