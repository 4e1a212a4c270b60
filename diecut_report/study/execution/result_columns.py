"""Columns of results: what is known of each before anything is calculated, and its values for many variants."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from diecut_report.config.discovery import said
from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.contract.checks import Check, by_part
from diecut_report.contract.code_steps import PartNames
from diecut_report.contract.input_lists import list_inputs
from diecut_report.contract.mechanism import is_text
from diecut_report.contract.missing_keys import missing_keys
from diecut_report.contract.result_names import CROSSING_COLUMNS, ResultName, count_name, result_names
from diecut_report.contract.steps import SILENT, Crossings, Step, Value
from diecut_report.engine import Calculation
from diecut_report.engine.steps.extreme_checks import is_made
from diecut_report.errors import PluginError
from diecut_report.expressions import Array
from diecut_report.quantities.units import unit
from diecut_report.results.checks import checks_of, is_sized, judged
from diecut_report.results.unchecked import is_of_machine, missing, without_basis
from diecut_report.study.execution.press_batch import of_plugin
from diecut_report.study.storage.description import Kind, ResultColumn

STATUS = np.array([None, "pass", "warn", "fail", "error"], dtype=object)
PASS, WARN, FAIL, ERROR = 1, 2, 3, 4


def columns_of(config: Config) -> list[ResultColumn]:
    """Return the columns of all outputs and checks of a config's mechanisms."""
    found: list[ResultColumn] = []
    for name, instance in config.instances.items():
        if instance is not None and instance.mechanism is not None and name != PRESS:
            found += _declared(name, instance, instance.mechanism.kind)
    return found


def _declared(name: str, instance: Instance, kind: str) -> list[ResultColumn]:
    """Return the columns of a mechanism; PluginError where what it declares cannot be read."""
    try:
        return [*_outputs(name, instance), *_checks(name, instance)]
    except Exception as cause:
        raise PluginError(said(cause), kind, name) from cause


def curve_columns(config: Config, names: Iterable[str]) -> Iterator[ResultColumn]:
    """Yield the columns of curves, such as ``drive.crank_torque``: a list of numbers for each variant."""
    for name in names:
        home, _, curve = name.partition(".")
        instance = config.instances[home]
        if instance is not None and curve in instance.declared_steps:
            _, step = instance.declared_steps[curve]
            yield _column(name, "curve", step.unit, step)


def _column(name: str, kind: Kind, display: str, step: Step) -> ResultColumn:
    """A column of what a step gives: SI, and the unit that the report prints it in."""
    si = unit(display).si
    return ResultColumn(name, kind, si, display if display != si else "", step.symbol, step.description)


def _outputs(name: str, instance: Instance) -> Iterator[ResultColumn]:
    assert instance.mechanism is not None
    axes = instance.mechanism.axes(instance.given)
    counts = _counts(instance)
    for _, step in instance.mechanism.active(instance.given):
        home = axes.get(step.id)
        if not step.output or isinstance(step, SILENT) or (home is not None and home not in counts):
            continue
        parts = _names(step, counts[home] if home else None, instance.names_of_parts(step.named_by))
        for part in parts:
            count = part.role == "count"
            kind: Kind = "int" if count else _kind(step)
            one = _column(f"{name}.{part.name}", kind, "1" if count else step.unit, step)
            yield one if len(parts) == 1 else replace(one, description=_numbered(step, part))


def _counts(instance: Instance) -> dict[str, int]:
    """Return how many parts rows have, by what they run over: lists that are given, and parts that follow from them."""
    assert instance.mechanism is not None
    counts = {path: _length(instance.data, path) for path in list_inputs(instance.model).values()}
    for _, step in instance.mechanism.active(instance.given):
        if isinstance(step, PartNames) and step.count is not None:
            counts[step.id] = step.count(partial(_length, instance.data))
    return counts


def _length(data: Any, path: str) -> int:
    """Return how many blocks a list has in the config; none where it is not given."""
    for part in path.split("."):
        data = data.get(part) if isinstance(data, Mapping) else None
    return len(data or ())


def _numbered(step: Step, part: ResultName) -> str:
    """Return what one of several results of a step is."""
    return f"{step.description}: {'how many in a turn' if part.role == 'count' else f'no. {part.number}'}"


def _names(step: Step, parts: int | None, parts_names: Sequence[str] | None) -> list[ResultName]:
    """Return the results of a step by name, as in the results file, where an extreme's place stands beside its value."""
    names = result_names(step, CROSSING_COLUMNS if isinstance(step, Crossings) else parts, parts_names)
    return [each for each in names if each.role != "place"]


def _kind(step: Step) -> Kind:
    if is_text(step):
        return "text"
    if isinstance(step, Value) and step.is_condition:
        return "bool"
    return "int" if step.whole else "float"


def _checks(name: str, instance: Instance) -> Iterator[ResultColumn]:
    for check in _reported(instance):
        yield ResultColumn(f"{name}.checks.{check.id}.utilisation", "float", description=f"{check.title}: utilisation")
        yield ResultColumn(f"{name}.checks.{check.id}.status", "text", description=f"{check.title}: verdict")


def _reported(instance: Instance) -> Iterator[Check]:
    """Yield the checks that are made, or would be with more keys, each id once; self-tests of the calculation have no columns."""
    mechanism = instance.mechanism
    assert mechanism is not None
    ids: set[str] = set()
    for check in by_part(mechanism.checks, lambda names: _names_of_parts(instance, names)):
        if check.id not in ids and is_of_machine(check) and missing_keys(mechanism, check, instance.given) is not None:
            ids.add(check.id)
            yield check


def _names_of_parts(instance: Instance, path: str) -> list[str] | None:
    """The names that a list's blocks have in the config; None where there is no such list."""
    return instance.names_of_parts(path) or None


def output_values(name: str, calc: Calculation) -> dict[str, Array]:
    """Return the outputs of many variants by column; NaN (None for texts and flags) where there is none."""
    found: dict[str, Array] = {}
    for step in calc.steps.values():
        if (
            not step.output
            or isinstance(step, SILENT)
            or step.id not in calc.values
            or not _is_counted(calc, calc.axis.get(step.id))
        ):
            continue
        values = calc.values[step.id]
        if isinstance(step, Crossings):
            values = np.concatenate([calc.values[count_name(step.id)], _wide(values)], axis=1)
        parts = None if isinstance(step, Crossings) or step.id not in calc.axis else values.shape[1]
        names = _names(step, parts, calc.inputs.get(step.named_by))
        found |= {f"{name}.{part.name}": values[:, index] for index, part in enumerate(names)}
    return found


def _is_counted(calc: Calculation, home: str | None) -> bool:
    """Whether it is known ahead how many parts rows over something have."""
    step = calc.steps.get(home or "")
    return not isinstance(step, PartNames) or step.count is not None


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


def _wide(places: Array) -> Array:
    """Crossings in as many columns as there are for them, NaN where there are fewer."""
    room = np.full((len(places), CROSSING_COLUMNS), np.nan)
    shown = places[:, :CROSSING_COLUMNS]
    room[:, : shown.shape[1]] = shown
    return room


@dataclass
class Verdicts:
    """Hold of each check the status codes and utilisations of many variants, shape (checks, variants).

    ``unchecked`` are the checks that need more keys, ``sized`` says which show no reserve, and ``faults`` is for each
    variant whose calculation contradicts itself what does not hold.
    """

    names: list[str]
    codes: Array
    ratios: Array
    sized: Array
    unchecked: list[str]
    faults: dict[int, str]


def verdicts(calculations: Mapping[str, Calculation], count: int) -> Verdicts:
    """Return all checks of all mechanisms; code 0 where a check does not apply."""
    names, codes, ratios, sized, unchecked = [], [], [], [], []
    faults: dict[int, str] = {}
    for name, calc in calculations.items():
        for check in checks_of(calc):
            if not is_made(calc, check):
                unchecked += [f"{name}.checks.{check.id}"] if missing(calc, check) else []
                continue
            found = judged(calc, check)
            there, held, ratio = (found.governing(part) for part in (found.there, found.held, found.ratio))
            if not is_of_machine(check):
                faults |= {
                    int(row): f"{name}: {check.title}. {check.consequence}" for row in np.flatnonzero(there & ~held)
                }
                continue
            if without_basis(calc, check):  # what holds by what was typed alone is not checked
                there = there & ~held
                if not there.any():
                    unchecked.append(f"{name}.checks.{check.id}")
                    continue
            names.append(f"{name}.checks.{check.id}")
            codes.append(np.where(there, np.where(held, PASS, np.where(check.is_failure(ratio), FAIL, WARN)), 0))
            ratios.append(np.where(there, ratio, np.nan))
            sized.append(is_sized(calc.given, check) or check.presumed)
    shape = (len(names), count)
    unchecked = [name for name in dict.fromkeys(unchecked) if name not in names]
    return Verdicts(names, np.reshape(codes, shape).astype(int), np.reshape(ratios, shape).astype(float),
                    np.array(sized, dtype=bool), unchecked, faults)  # fmt: skip


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
