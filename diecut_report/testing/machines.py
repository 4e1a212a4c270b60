"""Many machines at once are each machine alone: the same numbers, curves, verdicts and reasons."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery, DuplicateKind, Origin, UnknownKind
from diecut_report.errors import UserError
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.steps.run import calculate as many_machines_calculate
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.inputs import Quantity, fields
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Crossings, Pick, Value, named
from diecut_report.press import Press
from diecut_report.results.checks import applies, judged
from diecut_report.testing.values import MechanismFound
from diecut_report.text.catalogues import built_in
from diecut_report.text.phrases import Phrase, phrase

CLOSE = 1e-9  # relative, of numbers and curves
OF_SCALE = 1e-11  # of the greatest number of a unit: a difference of such numbers is not more exact than they are
OF_PLACE = 1e-5  # of places that were found by search
NUDGED = 8  # machines whose inputs differ by rounding
FURTHER = 16  # times as far as these another rounding may lead
Ranges = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class MachineCase:
    """Hold a machine: its inputs in SI as the engine takes them, and which of them vary widely, between which limits."""

    mechanism: Mechanism
    values: Mapping[str, Any]
    widely: Ranges = field(default_factory=dict)

    def together(self, count: int, seed: int) -> tuple[dict[str, Any], Calculation]:
        """Return so many machines at once, after the inputs in which they differ."""
        varied = self.varied(count, seed)
        return varied, many_machines_calculate(self.mechanism, {**self.values, **varied}, count)

    def varied(self, count: int, seed: int) -> dict[str, Any]:
        """Return the inputs of so many machines, without those that they share: some differ widely, all other numbers a little."""
        draw, known = np.random.default_rng(seed), dict(fields(self.mechanism.inputs))
        found: dict[str, Any] = {}
        for name, value in self.values.items():
            meta, parts = known.get(name), value if isinstance(value, tuple) else (value,)
            if not isinstance(meta, Quantity) or not all(isinstance(part, int | float) for part in parts):
                continue
            if name in self.widely:
                drawn = draw.uniform(*self.widely[name], count)
                found[name] = np.round(drawn) if meta.integer else drawn
            elif not meta.integer:
                near = [part * draw.uniform(0.99, 1.01, count) for part in parts]
                rows = [np.where(meta.holds(each), each, part) for each, part in zip(near, parts, strict=True)]
                found[name] = tuple(rows) if isinstance(value, tuple) else rows[0]
        return found


def unlike(machine: MachineCase, count: int, alone: int, seed: int) -> Iterator[tuple[str, str]]:
    """Yield what differs between machines together and alone: its id, and in words how. So many are tried alone, impossible ones too."""
    varied, together = machine.together(count, seed)
    impossible, possible = sorted(together.flaws), [i for i in range(count) if i not in together.flaws]
    few = impossible[: max(alone // 3, alone - len(possible))]
    for i in [*few, *possible[: alone - len(few)]]:
        values = {**machine.values, **one_of(varied, i)}
        if found := list(_unlike_alone(machine.mechanism, values, together, i)):
            moved = moved_by_rounding(machine.mechanism, values)
            yield from ((name, words) for name, words, apart in found if not apart <= FURTHER * moved.get(name, -1.0))


def _unlike_alone(
    mechanism: Mechanism, values: Mapping[str, Any], together: Calculation, i: int
) -> Iterator[tuple[str, str, float]]:
    """What differs between one of many machines and the same alone, and how far numbers and curves are apart; zero of all else."""
    try:
        single = many_machines_calculate(mechanism, values)
    except Impossible as refused:
        if together.flaws.get(i) not in refused.reasons:
            yield refused.key, _refused_alone(refused.message, together, i), 0.0
    except Unproven as refused:
        if together.flaws.get(i, ("", ""))[1] != str(refused):
            yield "", _refused_alone(str(refused), together, i), 0.0
    else:
        for name, words in _differences(together, single, i):
            yield name, words, _distance(together, i, single, name)


def moved_by_rounding(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, float]:
    """Return how far apart machines alone are whose inputs differ by rounding, by the ids of what differs in them.

    NumPy rounds arrays otherwise than single numbers, by less than the inputs are moved here. What moves with them beyond ``CLOSE``
    is what is left of numbers that cancel, or a verdict at its limit.
    """
    draw, moved = np.random.default_rng(0), dict[str, float]()
    counts = {name for name, meta in fields(mechanism.inputs) if isinstance(meta, Quantity) and meta.integer}
    for _ in range(NUDGED):
        nudged = {name: value if name in counts else _nudged(value, draw) for name, value in values.items()}
        try:
            among = many_machines_calculate(mechanism, nudged)
        except (Impossible, Unproven) as refused:
            among = Calculation(mechanism, nudged, 1)
            among.flaws[0] = refused.reasons[0] if isinstance(refused, Impossible) else ("", str(refused))
        for name, _, apart in _unlike_alone(mechanism, values, among, 0):
            moved[name] = max(apart, moved.get(name, 0.0))
    return moved


def _distance(among: Calculation, i: int, alone: Calculation, name: str) -> float:
    if name in among.curves and name in alone.curves:
        found, own = among.curve_samples(name)[i], alone.curve_samples(name)[0]
    elif name in among.values and name in alone.values:
        found, own = among.values[name][i], alone.values[name][0]
    else:
        return 0.0
    if found.dtype == object:
        return 0.0
    length = min(len(found), len(own))
    return float(np.nanmax(np.abs(found[:length] - own[:length]), initial=0.0))


def _nudged(value: Any, draw: np.random.Generator) -> Any:
    if isinstance(value, tuple):
        return tuple(_nudged(part, draw) for part in value)
    return value * (1 + draw.integers(-4, 5) * np.finfo(float).eps) if isinstance(value, float) else value


def _refused_alone(why: str, together: Calculation, i: int) -> str:
    if i in together.flaws:
        other = phrase(together.flaws[i][1])
        template = "a machine is refused on its own ({why}), and in a batch for another reason ({other})"
        return Phrase(template, why=phrase(why), other=other)
    return Phrase("a machine is refused on its own ({why}), but calculated in a batch", why=phrase(why))


def _among(found: str, alone: str) -> str:
    return Phrase("is {found} in a batch, {alone} on its own", found=found, alone=alone)


def _differences(together: Calculation, alone: Calculation, i: int) -> Iterator[tuple[str, str]]:
    if i in together.flaws:
        key, message = together.flaws[i]
        yield key, Phrase("a machine is refused in a batch ({why}), but calculated on its own", why=phrase(message))
        return
    yield from unlike_numbers(together, alone, i)
    yield from unlike_curves(together, alone, i)
    yield from unlike_verdicts(together, alone, i)


def one_of(varied: Mapping[str, Any], i: int) -> dict[str, Any]:
    """Return the inputs of one of many machines."""
    return {name: tuple(float(part[i]) for part in value) if isinstance(value, tuple) else float(value[i])
            for name, value in varied.items()}  # fmt: skip


def unlike_numbers(together: Calculation, alone: Calculation, i: int) -> Iterator[tuple[str, str]]:
    """Yield the numbers, rows, texts and places of one among many that are not those of the same machine alone."""
    scale = scales(alone)
    for name in alone.values.keys() - together.values.keys():
        yield name, phrase("is there for a machine on its own, but not in a batch")
    for name, values in together.values.items():
        found, expected = values[i], alone.values[name][0] if name in alone.values else np.array([np.nan])
        if values.dtype == object:
            if list(found) != list(expected):
                yield name, _among(", ".join(map(str, found)), ", ".join(map(str, expected)))
            continue
        length = min(len(found), len(expected))  # a list of crossings is as long as the machine that has most
        within = OF_PLACE if is_placed(together, name) else OF_SCALE * scale.get(unit_of(together, name), 0.0)
        same = np.isclose(found[:length], expected[:length], rtol=CLOSE, atol=within, equal_nan=True)
        if not same.all() or np.isfinite(found[length:]).any():
            yield name, _among(_first(found[:length], ~same), _first(expected[:length], ~same))


def _first(values: Array, unlike: Array) -> str:
    places = np.flatnonzero(unlike)
    return f"{values[places[0]]:.6g}" if len(places) else "–"


def unit_of(calc: Calculation, name: str) -> str:
    """Return the unit of a number; none for how many crossings there are."""
    return "1" if name.endswith("_count") and name not in calc.steps else calc.step_or_input(name).unit


def scales(calc: Calculation) -> dict[str, float]:
    """Return the greatest number in each unit: a difference of such numbers is no more exact than they are."""
    found: dict[str, float] = {}
    given = {name: values for name, values in calc.inputs.items() if isinstance(calc.meta.get(name), Quantity)}
    numbers = {name: values for name, values in given.items() if isinstance(values, np.ndarray)}
    for name, values in (numbers | calc.values | {name: calc.curve_samples(name) for name in calc.curves}).items():
        if values.dtype != object and np.isfinite(values).any():
            unit = unit_of(calc, name)
            found[unit] = max(found.get(unit, 0.0), float(np.nanmax(np.abs(values))))
    return found


def is_place(calc: Calculation, name: str) -> bool:
    """Return whether a number is a place that was found by search."""
    found = named(name, calc.steps)
    is_found = found is not None and found.role in ("place", "crossing")
    return is_found or isinstance(calc.steps.get(name), Crossings)


def is_placed(calc: Calculation, name: str) -> bool:
    """Return whether a number is such a place, or one of its unit that follows from it: its distance from another place."""
    step = calc.steps.get(name)
    places = [each for each in taken(step) if is_place(calc, each)] if isinstance(step, Value) else []
    return is_place(calc, name) or any(unit_of(calc, each) == unit_of(calc, name) for each in places)


def unlike_curves(together: Calculation, alone: Calculation, i: int) -> Iterator[tuple[str, str]]:
    """Yield the curves whose samples are not the machine's own."""
    scale = scales(alone)
    for name in alone.curves:
        found, expected = together.curve_samples(name)[i], alone.curve_samples(name)[0]
        great = float(np.max(np.abs(expected), initial=0.0))
        within = max(CLOSE * great, OF_SCALE * scale.get(unit_of(alone, name), 0.0))  # a curve may be rounding alone
        same = np.isclose(found, expected, rtol=CLOSE, atol=within, equal_nan=True)
        if not same.all():
            yield name, _among(_first(found, ~same), _first(expected, ~same))


def unlike_verdicts(together: Calculation, alone: Calculation, i: int) -> Iterator[tuple[str, str]]:
    """Yield the checks whose verdict or utilisation is not the machine's own."""
    for check in filter(partial(applies, alone), together.mechanism.checks):
        found, own = judged(together, check), judged(alone, check)
        same = np.isclose(found.ratio[i], own.ratio[0], rtol=1e-7, atol=1e-6, equal_nan=True)
        if check.check_class == "numerical":  # what it compares is rounding, which is not the same twice
            same = np.ones_like(same)
        if not (same.all() and np.array_equal(found.held[i], own.held[0])):
            yield check.id, phrase("the check has another verdict in a batch than on its own")


# One machine of a mechanism, calculated as a report calculates it: ``calculate(MECHANISM, {"teeth": 30})``.


Keys = Mapping[str, Any]
FILE = "inputs"  # what stands where a message would name the file


class Refused(ValueError):
    """Report inputs that are not allowed, or a machine that cannot be, each in words: ``arm: −3 mm is out of range; …``."""

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


def load(kind: str, folder: str | Path | None = None) -> Mechanism:
    """Return the mechanism of a kind: of a folder of plugins, or of those that are built in or installed.

    LookupError where there is none, PluginError where the plugin is broken, each in words.
    """
    try:
        return Discovery([] if folder is None else [Path(folder)]).mechanism(kind)
    except (UnknownKind, DuplicateKind) as fault:
        raise LookupError(str(fault)) from None


def calculate(
    mechanism: Mechanism, inputs: Keys, *, press: Keys | None = None, others: Mapping[str, Keys] | None = None,
    plugins: Iterable[str | Path] = (),
) -> MechanismFound:  # fmt: skip
    """Return what a mechanism gives for inputs that are written as in a configuration: numbers, or texts with units.

    ``press`` are keys of the press (productivity, sheet), ``others`` further mechanisms by their names, for what is referred to
    (``"motion": "${cams.position}"``), ``plugins`` folders with their kinds. Raises Refused where inputs are not allowed or the
    machine cannot be, PluginError where the plugin breaks, with file and line.
    """
    try:
        made = configured(mechanism, inputs, press, others, plugins).calculate()
    except UserError as error:
        own = f"mechanisms.{mechanism.kind}"
        told = ((each.path.removeprefix(own).removeprefix("."), each.message) for each in error.problems)
        raise Refused(": ".join(filter(None, each)) for each in told) from None
    if made.has_broken:
        raise made.broken[0]
    found = made.results.mechanisms[mechanism.kind]
    if found.status == "skipped":
        raise Refused([found.error])
    return MechanismFound(found)


def configured(
    mechanism: Mechanism, inputs: Keys, press: Keys | None, others: Mapping[str, Keys] | None, plugins: Iterable[str | Path]
) -> Press:  # fmt: skip
    """Return the press of one machine; UserError with all that is wrong with it."""
    blocks = {**(others or {}), mechanism.kind: {"kind": mechanism.kind, **inputs}}
    whole = {
        "schema_version": 1, "project": {"title": mechanism.title}, "press": {"name": "-", **(press or {})}, "mechanisms": blocks,
    }  # fmt: skip
    text = json.dumps(whole, default=_plain, ensure_ascii=False)
    file, is_own = Path(mechanism.at.rpartition(":")[0]), built_in(mechanism.kind) is not None
    origin = Origin(mechanism.kind, str(file), lambda: mechanism, lambda: file, is_own)  # it is in memory
    made = Press.read(yaml.parse(text, FILE), Discovery(map(Path, plugins), [origin]))
    if broken := made.config.broken.get(mechanism.kind):
        raise broken
    return made


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    allowed = "a number, a text, true or false, a list, keys with values"
    raise TypeError(f"{value!r} is not what a configuration may hold: {allowed}")


# Machines so unlike each other that they take other values of the series: a pick is tried where it changes.


WIDTHS = (1.2, 2.0, 5.0)  # by what numbers are multiplied and divided, until each pick changes


def picks(machine: MachineCase, seed: int, count: int) -> tuple[MachineCase, int, int]:
    """Return the machine with its numbers varied until its picks change, how many of them do then, and how many there are."""
    found, most, all_of_them = machine, 0, 0
    for width in WIDTHS if any(isinstance(step, Pick) for _, step in machine.mechanism.steps) else ():
        wide = replace(machine, widely={**_ranges(machine, width), **machine.widely})
        changing = list(_changing(wide.together(count, seed)[1]))
        all_of_them = max(all_of_them, len(changing))
        if sum(changing) > most or found is machine:
            found, most = wide, sum(changing)
        if all(changing):
            break
    return found, most, all_of_them


def _changing(calc: Calculation) -> Iterator[bool]:
    """Of each pick whether machines that can be take unlike values."""
    possible = [row for row in range(calc.count) if row not in calc.flaws]
    for id in calc.branch:
        if isinstance(calc.steps[id], Pick):
            yield len(np.unique(calc.branch[id][possible])) > 1


def _ranges(machine: MachineCase, width: float) -> Ranges:
    known, found = dict(fields(machine.mechanism.inputs)), dict[str, tuple[float, float]]()
    for name, value in machine.values.items():
        meta = known.get(name)
        is_free = isinstance(meta, Quantity) and not meta.integer and not meta.listed
        if isinstance(meta, Quantity) and is_free and isinstance(value, float) and value > 0:
            ends = np.array([value / width, value * width])
            low, high = np.where(meta.holds(ends), ends, value)
            found[name] = float(low), float(high)
    return found
