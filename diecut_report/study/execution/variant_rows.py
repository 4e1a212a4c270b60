"""Rows of a study: variants in, columns of outputs, verdicts and reasons out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.expansion import Expanded, with_parts
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.plugins import said
from diecut_report.config.source_hashes import plugin_code
from diecut_report.config.yaml import KeyPath, Scalar
from diecut_report.errors import PluginError, Problem
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.soundness import is_made
from diecut_report.mechanism import steps
from diecut_report.mechanism.checks import Check, by_part
from diecut_report.mechanism.inputs import Quantity, Samples, list_inputs
from diecut_report.mechanism.mechanism import missing_keys
from diecut_report.quantities.units import unit
from diecut_report.results import checks
from diecut_report.results.checks import judged
from diecut_report.results.coherence import DRIVE_LINE, finding_check
from diecut_report.results.press_run import Tell
from diecut_report.results.usual import usual_check
from diecut_report.standards.ranges import ranges_of
from diecut_report.study.definition.base_inputs import (
    MECHANISMS,
    Input,
    UnknownPath,
    find_input,
    is_of_parts,
    number_of,
    present_value,
    typed_data,
    typed_place,
)
from diecut_report.study.execution.press_batch import (
    CalculatedVariants,
    Mixed,
    NotOnArrays,
    calculated,
    of_plugin,
    untold,
)
from diecut_report.study.storage.description import Kind, ResultColumn
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.time_limit import contained

# Columns of results: what is known of each before anything is calculated, and its values for many variants.


STATUS = np.array([None, "pass", "warn", "fail", "error"], dtype=object)
PASS, WARN, FAIL, ERROR = 1, 2, 3, 4


def columns_of(config: Config) -> list[ResultColumn]:
    """Return the columns of all outputs and checks of a config's mechanisms; PluginError where what one declares cannot be read."""
    found: list[ResultColumn] = []
    for name, instance in config.instances.items():
        if instance is not None and instance.mechanism is not None and name != PRESS:
            try:
                with contained():
                    found += [*_outputs(name, instance), *_checks(name, instance)]
            except Exception as cause:
                raise PluginError(said(cause), instance.mechanism.kind, name) from cause
    return found


def curve_columns(config: Config, names: Iterable[str]) -> Iterator[ResultColumn]:
    """Yield the columns of curves, such as ``drive.crank_torque``: a list of numbers for each variant."""
    for name in names:
        home, _, curve = name.partition(".")
        instance = config.instances[home]
        if instance is not None and curve in instance.declared_steps:
            _, step = instance.declared_steps[curve]
            yield column_of(name, "curve", step.unit, step)


def column_of(name: str, kind: Kind, display: str, declared: steps.Step | Quantity) -> ResultColumn:
    """Return the column of a quantity that is declared so, in SI; ``display`` is the unit that people read."""
    si = unit(display).si
    return ResultColumn(name, kind, si, display if display != si else "", declared.symbol, declared.description)


def _outputs(name: str, instance: Instance) -> Iterator[ResultColumn]:
    assert instance.mechanism is not None
    axes = instance.mechanism.axes(instance.given)
    counts = _counts(instance)
    for _, step in instance.mechanism.active(instance.given):
        home = axes.get(step.id)
        if not step.output or isinstance(step, steps.SilentStep) or (home is not None and home not in counts):
            continue
        parts = _names(step, counts[home] if home else None, instance.names_of_parts(step.named_by))
        for part in parts:
            is_count = part.role == "count"
            kind: Kind = "int" if is_count else _kind(step)
            column = column_of(f"{name}.{part.name}", kind, "1" if is_count else step.unit, step)
            which = "how many in a turn" if is_count else f"no. {part.number}"
            yield column if len(parts) == 1 else replace(column, description=f"{step.description}: {which}")


def _counts(instance: Instance) -> dict[str, int]:
    """Return how many parts rows have, by what they run over: lists that are given, and parts that follow from them."""
    assert instance.mechanism is not None
    counts = {path: _length(instance.data, path) for path in list_inputs(instance.model).values()}
    for _, step in instance.mechanism.active(instance.given):
        if isinstance(step, steps.PartNames) and step.count is not None:
            counts[step.id] = step.count(partial(_length, instance.data))
    return counts


def _length(data: Any, path: str) -> int:
    for part in path.split("."):
        data = data.get(part) if isinstance(data, Mapping) else None
    return len(data or ())


def _names(step: steps.Step, parts: int | None, parts_names: Sequence[str] | None) -> list[steps.ResultName]:
    """Return the results of a step by name, as in the results file, where an extreme's place stands beside its value."""
    names = steps.result_names(
        step, steps.CROSSING_COLUMNS if isinstance(step, steps.Crossings) else parts, parts_names
    )
    return [each for each in names if each.role != "place"]


def _kind(step: steps.Step) -> Kind:
    if step.is_text:
        return "text"
    if isinstance(step, steps.Value) and step.is_condition:
        return "bool"
    return "int" if step.whole else "float"


def _checks(name: str, instance: Instance) -> Iterator[ResultColumn]:
    """Yield the checks that are made, or would be with more keys, each id once; self-tests of the calculation have no columns."""
    mechanism = instance.mechanism
    assert mechanism is not None
    ids: set[str] = set()
    for check in by_part(mechanism.checks, lambda path: instance.names_of_parts(path) or None):
        if (
            check.id not in ids
            and checks.is_of_machine(check)
            and missing_keys(mechanism, check, instance.given) is not None
        ):
            ids.add(check.id)
            yield from _check(name, check)
    if ranges_of(mechanism.kind):
        yield from _check(name, usual_check([]))
    for level in ("warning", "fail") if mechanism.kind == DRIVE_LINE else ():
        yield from _check(name, finding_check(level, []))


def _check(name: str, check: Check) -> Iterator[ResultColumn]:
    column = f"{name}.checks.{check.id}"
    yield ResultColumn(f"{column}.utilisation", "float", description=f"{check.title}: utilisation")
    yield ResultColumn(f"{column}.status", "text", description=f"{check.title}: verdict")


def output_values(name: str, calc: Calculation) -> dict[str, Array]:
    """Return the outputs of many variants by column; NaN (None for texts and flags) where there is none."""
    found: dict[str, Array] = {}
    for step in calc.steps.values():
        if not step.output or isinstance(step, steps.SilentStep) or step.id not in calc.values:
            continue
        home = calc.steps.get(calc.axis.get(step.id, ""))
        if isinstance(home, steps.PartNames) and home.count is None:  # how many there are is not known ahead
            continue
        values = calc.values[step.id]
        if isinstance(step, steps.Crossings):  # as many columns as there are for them, NaN where there are fewer
            places = values[:, : steps.CROSSING_COLUMNS]
            room = np.full((len(places), steps.CROSSING_COLUMNS - places.shape[1]), np.nan)
            values = np.concatenate([calc.values[steps.count_name(step.id)], places, room], axis=1)
        parts = None if isinstance(step, steps.Crossings) or step.id not in calc.axis else values.shape[1]
        names = _names(step, parts, calc.inputs.get(step.named_by))
        found |= {f"{name}.{part.name}": values[:, index] for index, part in enumerate(names)}
    return found


def curve_values(calculations: Mapping[str, Calculation], names: Iterable[str]) -> dict[str, list[Array]]:
    """Return curves of many variants by column, each at the samples of its abscissa; those that these variants have."""
    found = {}
    for name in names:
        home, _, curve = name.partition(".")
        calc = calculations.get(home)
        if calc is not None and curve in calc.domains:
            samples = calc.domains[curve].samples
            found[name] = list(np.broadcast_to(samples, (calc.count, samples.shape[1])))
        elif calc is not None and curve in calc.curves:
            with of_plugin(calc.mechanism.kind):
                found[name] = list(calc.curve_samples(curve))
    return found


@dataclass
class Verdicts:
    """Hold of each check the status codes and utilisations of many variants, shape (checks, variants).

    ``unchecked`` are the checks that need more keys, ``sized`` says which show no reserve, and ``faults`` is for each
    variant whose calculation contradicts itself what does not hold. ``left`` says of which variants a check is not made, shape as ``codes``.
    """

    names: list[str]
    codes: Array
    ratios: Array
    sized: Array
    left: Array
    unchecked: list[str]
    faults: dict[int, str]

    @property
    def unmade(self) -> Array:
        """Return of which variants some check is not made."""
        return np.asarray(self.left.any(axis=0) | bool(self.unchecked))


def verdicts(calculations: Mapping[str, Calculation], count: int) -> Verdicts:
    """Return all checks of all mechanisms; code 0 where a check does not apply."""
    names, codes, ratios, sized, left, unchecked = [], [], [], [], [], []
    faults: dict[int, str] = {}
    for name, calc in calculations.items():
        for check in checks.checks_of(calc):
            if not is_made(calc, check):
                unchecked += [f"{name}.checks.{check.id}"] if checks.missing_checks(calc, check) else []
                continue
            found = judged(calc, check)
            there, held, ratio = (found.governing(part) for part in (found.there, found.held, found.ratio))
            if not checks.is_of_machine(check):
                fault = f"{name}: {check.title}. {check.consequence}"
                faults |= dict.fromkeys(np.flatnonzero(there & ~held).tolist(), fault)
                continue
            # what holds by what was typed, or for some parts alone, is not checked
            unmade = there & held & (checks.rests_on_typing(calc, check) | bool(checks.left_out(calc, check, found)))
            there = there & ~unmade
            if unmade.all():
                unchecked.append(f"{name}.checks.{check.id}")
                continue
            names.append(f"{name}.checks.{check.id}")
            left.append(unmade)
            codes.append(np.where(there, np.where(held, PASS, np.where(check.is_failure(ratio), FAIL, WARN)), 0))
            ratios.append(np.where(there, ratio, np.nan))
            sized.append(checks.is_sized(calc.given, check) or check.presumed)
    shape = (len(names), count)
    unchecked = [name for name in dict.fromkeys(unchecked) if name not in names]
    return Verdicts(names, np.reshape(codes, shape).astype(int), np.reshape(ratios, shape).astype(float),
                    np.array(sized, dtype=bool), np.reshape(left, shape).astype(bool), unchecked, faults)  # fmt: skip


def governing(found: Verdicts) -> Array:
    """Return for each variant the check that governs: fail before warn before pass, then the greatest utilisation; None without checks.

    What the program sized to its limit, and what the calculation presumes, does not govern where it holds.
    """
    if not found.names:
        return np.full(found.codes.shape[1], None, dtype=object)
    codes = np.where(found.sized[:, None] & (found.codes == PASS), 0, found.codes)
    unknown = np.where(codes == PASS, -np.inf, np.inf)
    ratios = np.where(np.isnan(found.ratios), unknown, found.ratios)
    worst = codes.max(axis=0)
    among = np.where(codes == worst, ratios, -np.inf)
    first = np.argmax(np.where(codes == worst, np.nextafter(among, np.inf), -np.inf), axis=0)
    names: Array = np.array(found.names, dtype=object)[first]
    names[worst == 0] = None
    return names


TOGETHER = 1024  # variants that are calculated at a time: fewer cost more per variant, more take more memory
ALIKE = 1e-6  # relative: rounding moves numbers, and places of extremes, by less
Given = Mapping[Input, Array | list[str]]
Further = Callable[[CalculatedVariants], dict[str, Array]]  # what is kept besides, by column, shape (variants,)


@dataclass
class Rows:
    """Hold what was calculated of a number of variants: columns by name, and for each variant status, governing check and reason."""

    count: int
    curves: Sequence[str] = ()
    further: Further | None = None
    tell: Tell = untold
    columns: dict[str, Array] = field(default_factory=dict)
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)  # plugins that broke for a variant alone, and why

    def __post_init__(self) -> None:
        self.status = np.full(self.count, "pass", dtype=object)
        self.verdict, self.governing, self.errors = (np.full(self.count, None, dtype=object) for _ in range(3))


def calculate_rows(
    base: Config,
    given: Given,
    count: int,
    curves: Sequence[str] = (),
    further: Further | None = None,
    tell: Tell = untold,
) -> Rows:
    """Calculate all outputs and checks of the base, and these curves, with other values: arrays of shape (count,), SI, or texts.

    ``further`` gives more columns of variants that are calculated; ``tell`` is as in ``calculated``.

    A variant that cannot exist has the status ``error`` and its reason. Variants with unlike texts are calculated in groups;
    a plugin that cannot take arrays makes its variants be calculated one by one, which ``slow`` reports. One that breaks for
    a variant alone leaves it in error, and is in ``broken``.
    """
    rows = Rows(count, curves, further, tell)
    if not count:  # of a chunk that constraints have emptied
        return rows
    for machine, own, places in _machines_of_parts(base, given, rows):
        for alike, texts in _groups(own, len(places)):
            for chosen in np.array_split(alike, -(-len(alike) // TOGETHER)):
                numbers = {asked: np.asarray(values)[chosen] for asked, values in own.items() if asked not in texts}
                _group(machine, numbers, texts, rows, places[chosen])
    return rows


def _machines_of_parts(base: Config, given: Given, rows: Rows) -> Iterator[tuple[Config, Given, Array]]:
    """Yield the variants by what their parts make: a base, what is varied in it, their rows; of parts that contradict each other rows say why."""
    typed = {asked: values for asked, values in given.items() if is_of_parts(base, asked)}
    if not typed:
        yield base, given, np.arange(rows.count)
        return
    others = {asked: values for asked, values in given.items() if asked not in typed}
    for changes, config, chosen in _by_structure(base, typed, rows):
        rest: dict[Input, Array] = {}
        for asked, values in others.items():
            rest[asked] = np.asarray(values, dtype=None if asked.unit else object)[chosen]
        for asked in dict.fromkeys(asked for own in changes for asked in own):
            today = float(present_value(base, asked) or 0.0)
            rest[asked] = np.array([own.get(asked, today) for own in changes])
        yield config, rest, chosen


def _by_structure(base: Config, typed: Given, rows: Rows) -> Iterator[tuple[list[dict[Input, float]], Config, Array]]:
    """Yield of variants whose parts make the same calculations the numbers that differ from the base, for each, and their rows."""
    kinds = {each.mechanism.kind: each.mechanism for each in base.instances.values() if each and each.mechanism}
    assert base.parts is not None, "without parts nothing follows them"
    found: dict[Any, tuple[list[dict[Input, float]], list[int]]] = {}
    first: dict[Any, Mapping[KeyPath, Scalar]] = {}
    known = _Leaves(base)
    for key, alike in _alike(typed, rows.count).items():
        changes = {
            typed_place(base, asked): typed_data(asked, value)
            for asked, value in zip(typed, key, strict=True)
            if value != present_value(base, asked)
        }
        made = with_parts(base.parts, changes, kinds)
        if made.problems:
            rows.errors[alike] = _reason(made.problems[0])
            rows.status[alike] = "error"
            continue
        numbers, structure = known.differing(made)
        first.setdefault(structure, changes)
        group = found.setdefault(structure, ([], []))
        group[0].extend([numbers] * len(alike))
        group[1].extend(alike)
    own = {each.name for each in columns_of(base)}
    for structure, (numbers_of, chosen) in found.items():
        config, problems = base.retyped(first[structure]) if structure else (base, [])
        reason = _reason(problems[0]) if problems else ""
        if not problems and not {each.name for each in columns_of(config)} <= own:
            reason = phrase(
                "with these values the parts make other calculations than in the base; calculate it as a file of its own"
            )
        if reason:
            rows.errors[chosen], rows.status[chosen] = reason, "error"
            continue
        yield numbers_of, config, np.array(chosen)


def _reason(problem: Problem) -> str:
    return Phrase("{name}: {fault}", name=problem.path, fault=problem.message)


def _alike(typed: Given, count: int) -> dict[tuple[Any, ...], list[int]]:
    """The rows by what is typed in them."""
    found: dict[tuple[Any, ...], list[int]] = {}
    columns = [np.asarray(values, dtype=object) for values in typed.values()]
    for row in range(count):
        found.setdefault(tuple(column[row] for column in columns), []).append(row)
    return found


class _Leaves:
    """Tell in which values the calculations of other parts differ from those of the base."""

    def __init__(self, base: Config) -> None:
        self.base, self.today = base, dict(_leaves(base.tree.data[MECHANISMS]))
        self.found = _findings(base.parts)
        self._inputs: dict[KeyPath, Input | None] = {}

    def differing(self, made: Expanded) -> tuple[dict[Input, float], frozenset[Any]]:
        """Return the numbers that differ (SI), and all else that does, also what is doubtful of the parts: by it the calculations are others."""
        numbers: dict[Input, float] = {}
        rest: set[Any] = {(path, None) for path in self.today} | (self.found ^ _findings(made.parts))
        for path, value in _leaves(made.tree.data[MECHANISMS]):
            rest.discard((path, None))
            if path in self.today and self.today[path] == value:
                continue
            asked = self._input(path)
            number = number_of(asked, value) if asked else None
            if asked is not None and isinstance(number, float) and isinstance(present_value(self.base, asked), float):
                numbers[asked] = number
            else:
                rest.add((path, str(value)))
        return numbers, frozenset(rest)

    def _input(self, path: KeyPath) -> Input | None:
        """The number that stands at a place of the mechanisms; None where none does, or it refers."""
        own = path[:-1] if path[-1] == "value" else path
        if own not in self._inputs:
            self._inputs[own] = None
            with suppress(UnknownPath):
                found = find_input(self.base, ".".join(map(str, (MECHANISMS, *own))))
                self._inputs[own] = (
                    found if isinstance(found.meta, Quantity) and found.node not in self.base.links else None
                )
        return self._inputs[own]


def _findings(parts: MachineParts | None) -> set[Any]:
    """What only warns or fails of the parts, each with where."""
    return {(each.level, each.rule, each.path) for each in parts.findings} if parts else set()


def _leaves(data: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, Any]]:
    """Yield the single values of plain data with their places."""
    if not isinstance(data, dict | list):
        yield path, data
        return
    for key, part in data.items() if isinstance(data, dict) else enumerate(data):
        yield from _leaves(part, (*path, key))


def _groups(given: Given, count: int) -> Iterator[tuple[Array, dict[Input, Any]]]:
    """Yield the variants that have the same texts, and as many points of their curves, by index."""
    common = {asked: values for asked, values in given.items() if asked.unit is None or isinstance(asked.meta, Samples)}
    texts = {asked: np.asarray(values, dtype=object) for asked, values in common.items()}
    if not texts:
        yield np.arange(count), {}
        return
    keys = list(zip(*texts.values(), strict=True))
    for key in dict.fromkeys(keys):
        yield np.flatnonzero([other == key for other in keys]), dict(zip(texts, key, strict=True))


def _group(base: Config, numbers: Mapping[Input, Array], texts: Mapping[Input, Any], rows: Rows, chosen: Array) -> None:
    try:
        variants = calculated(base, {**numbers, **texts}, len(chosen), rows.tell)
        _require_as_alone(base, numbers, texts, variants)
        _kept(variants, rows, chosen)
        variants.release()
    except Mixed as mixed:
        for alike in (mixed.rows, ~mixed.rows):
            _group(base, {asked: values[alike] for asked, values in numbers.items()}, texts, rows, chosen[alike])
    except NotOnArrays as cause:
        if len(chosen) == 1:
            rows.errors[chosen] = str(cause)
            rows.status[chosen] = "error"
            rows.broken[cause.kind] = cause.message
            return
        rows.slow[cause.kind] = cause.message
        for index, row in enumerate(chosen):
            _group(base, {asked: values[[index]] for asked, values in numbers.items()}, texts, rows, np.array([row]))


def _require_as_alone(
    base: Config, numbers: Mapping[Input, Array], texts: Mapping[Input, Any], variants: CalculatedVariants
) -> None:
    """Raise NotOnArrays where a plugin's code reaches over the variants: the first or the last has other numbers alone.

    Plugins of the program itself are tried so by its tests.
    """
    known = variants.calculations.items()
    foreign = {name: calc for name, calc in known if "plugin_file" in plugin_code(calc.mechanism)}
    possible = [row for row in range(variants.count) if row not in variants.reasons]
    for row in {possible[0], possible[-1]} if foreign and len(possible) > 1 else ():
        alone = calculated(base, {asked: values[[row]] for asked, values in numbers.items()} | dict(texts), 1)
        for name, calc in foreign.items():
            single = alone.calculations.get(name)
            every = calc.values.keys() | (single.values if single else ())
            if single is None or not all(_is_as_alone(calc, single, row, each) for each in every):
                words = "calculated together, its variants have other results than each alone: a function mixes them"
                raise NotOnArrays(calc.mechanism.kind, phrase(words))
        alone.release()


def _is_as_alone(together: Calculation, alone: Calculation, row: int, name: str) -> bool:
    if name not in together.values or name not in alone.values:
        return False
    found, own = together.values[name][row], alone.values[name][0]
    if found.dtype == object:
        return list(found) == list(own)
    length = min(len(found), len(own))  # a list of crossings is as long as that of the variant that has most
    rounding = ALIKE**2 * _greatest_of_unit(alone, name)  # what is left of numbers that cancel
    return bool(np.allclose(found[:length], own[:length], rtol=ALIKE, atol=rounding, equal_nan=True))


def _greatest_of_unit(calc: Calculation, name: str) -> float:
    units = {each: getattr(calc.steps.get(each), "unit", "1") for each in calc.values}
    numbers = {each: values for each, values in calc.values.items() if values.dtype != object}
    alike = [values for each, values in numbers.items() if units[each] == units[name]]
    return float(np.max([np.max(np.abs(each), initial=1.0, where=np.isfinite(each)) for each in alike], initial=1.0))


def _kept(variants: CalculatedVariants, rows: Rows, chosen: Array) -> None:
    found = verdicts(variants.calculations, variants.count)
    variants.reasons = {**found.faults, **variants.reasons}
    bad = np.array(sorted(variants.reasons), dtype=int)
    found.codes[:, bad], found.ratios[:, bad] = 0, np.nan
    further = rows.further(variants) if rows.further else {}
    for name, values in {**_all_columns(variants, found), **further}.items():
        column = rows.columns.setdefault(name, _empty(rows.count, values.dtype))
        values = values.copy()
        values[bad] = None if values.dtype == object else np.nan
        column[chosen] = values
    worst = np.maximum(found.codes.max(axis=0, initial=0), PASS)
    worst[bad] = ERROR
    for name, lists in curve_values(variants.calculations, rows.curves).items():
        column = rows.columns.setdefault(name, _empty(rows.count, np.dtype(object)))
        for row, values in zip(chosen, lists, strict=True):
            column[row] = values
        column[chosen[bad]] = None
    rows.status[chosen] = STATUS[worst]
    unchecked = found.codes.max(axis=0, initial=0) == 0
    rows.verdict[chosen] = _verdicts(worst, found.unmade | variants.is_open | unchecked)
    rows.governing[chosen] = governing(found)
    rows.errors[chosen[bad]] = [variants.reasons[int(row)] for row in bad]


def _verdicts(worst: Array, is_open: Array) -> Array:
    """The verdict on each variant by its worst check and whether something is open; none of one that cannot exist."""
    passing = np.where(is_open | (worst == WARN), "conditional", "pass")
    judged = np.where(worst == FAIL, "fail", passing).astype(object)
    judged[worst == ERROR] = None
    return judged


def _all_columns(variants: CalculatedVariants, found: Verdicts) -> dict[str, Array]:
    outputs: dict[str, Array] = {}
    for name, calc in variants.calculations.items():
        for column, values in output_values(name, calc).items():
            plain = values.astype(object) if values.dtype in (bool, object) else values.astype(float)
            if plain.dtype == object:
                plain[plain != plain] = None  # a text that a machine does not have
            outputs[column] = np.broadcast_to(plain, (variants.count,))
    for name, codes, ratios, left in zip(found.names, found.codes, found.ratios, found.left, strict=True):
        outputs |= {f"{name}.utilisation": ratios, f"{name}.status": np.where(left, checks.NOT_CHECKED, STATUS[codes])}
    for name in found.unchecked:
        statuses = np.full(variants.count, checks.NOT_CHECKED, dtype=object)
        outputs |= {f"{name}.utilisation": np.full(variants.count, np.nan), f"{name}.status": statuses}
    return outputs


def _empty(count: int, kind: np.dtype[np.generic]) -> Array:
    return np.full(count, None, dtype=object) if kind.kind == "O" else np.full(count, np.nan)
