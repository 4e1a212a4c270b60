"""The results that a comparison shows: outputs by their ids, ``INSTANCE.OUTPUT``, or the short words for what a machine is judged by."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.quantities.units import UnitError, pretty, unit
from diecut_report.results.conclusion import may_govern, weight
from diecut_report.results.mechanism_record import QuantityRecord
from diecut_report.study.comparison import (
    ComparedCell,
    ComparedRow,
    chosen_unit,
    named_checks,
    number_cell,
    quantity_rows,
    share_cell,
)
from diecut_report.study.machines import CheckedMachine
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import said, say_counted

RATE = "press.productivity"
MOTOR = "motor_power"
TORQUES = ("torque_peak", "torque_max", "torque_min")  # ends of the ids of greatest torques, either way
SHAFTS = "machine_inertia"  # the kind that adds up the masses of all shafts
WORDS = {
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

    names: tuple[str, ...] = tuple(WORDS)
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
            if name in WORDS:
                rows += self._of_word(name, machines, outputs)
            else:
                rows += self._of_name(name, [one | other for one, other in zip(inputs, outputs, strict=True)], outputs)
        return rows

    def _refuse_unknown(self, known: Sequence[str], outputs: set[str]) -> None:
        ids = {path.partition(".")[2] for path in outputs}
        allowed = {*WORDS, *known, *ids}
        template = "--show {name}: no machine has this result{nearest}. Name results by their ids, as INSTANCE.OUTPUT, or by the words {words}."
        problems = [
            Problem(Phrase(template, name=name, nearest=nearest(name, allowed), words=", ".join(WORDS)))
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
            cells = [_governing(machine, word) for machine in machines]
            yield from [ComparedRow(word, said(WORDS[word]), cells)] if any(cells) else []
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
            yield ComparedRow(word, said(WORDS[word]), cells, chosen)


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


def _governing(machine: CheckedMachine, check_class: str) -> ComparedCell | None:
    """Return the utilisation of the check of a class that governs, and which it is."""
    own = (each for each in named_checks(machine) if each[1].check_class == check_class and may_govern(each[1]))
    name, check = max(own, key=lambda pair: weight(pair[1]), default=("", None))
    return share_cell(check.utilisation, check.status, name) if check else None
