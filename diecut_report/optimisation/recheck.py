"""The listed machines once more, each by itself: written into the base, read again and calculated as its report would."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from diecut_report.config.discovery import Discovery
from diecut_report.design.proved_machine import ProvedMachine, proved
from diecut_report.errors import PluginError, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.study.analysis.stored_variants import Stored, opened, quoted
from diecut_report.study.analysis.titles import UTILISATION
from diecut_report.study.analysis.variant_config import variant_of
from diecut_report.study.execution.engines import Engine, InProcess, Pool, Warm, results
from diecut_report.study.execution.process_settings import settle
from diecut_report.study.execution.study_run import Where
from diecut_report.study.storage.store import Store

TOLERATED = 1e-6  # share of its size by which a number may differ
FEW = 8  # machines that are calculated sooner than other processes begin


@dataclass(frozen=True)
class SomeMachines:
    """Name machines that are to be calculated, each by itself."""

    variants: tuple[int, ...]

    def __str__(self) -> str:
        return Phrase("machines {variants} by themselves", variants=", ".join(map(str, self.variants)))


@dataclass(frozen=True)
class MachinePlace:
    """Hold where machines are stored, the plugins, and which numbers of them are compared."""

    directory: Path
    discovery: Discovery
    names: tuple[str, ...]


@dataclass(frozen=True)
class Rechecked:
    """Hold what a machine is by itself: its verdict, its numbers (SI, None for none), or why it could not be calculated."""

    status: str
    values: tuple[float | None, ...] = ()
    fault: str = ""


@dataclass(frozen=True)
class Recheck:
    """Hold a machine as it was among many and by itself: verdicts, and the number that differs most, with its share."""

    variant: int
    status: str
    alone: str
    name: str = ""
    share: float = 0.0
    fault: str = ""

    @property
    def is_same(self) -> bool:
        return not self.fault and self.status == self.alone and self.share <= TOLERATED


def rechecked(store: Store, stored: Stored, variants: Sequence[int], where: Where) -> list[Recheck]:
    """Return each of the machines as it was among many and by itself, in their order."""
    goals = [name for each in stored.study.get("objectives") or () for name in each.values()]
    used = [column.name for column, _ in stored.checks.values()]
    names = tuple(name for name in dict.fromkeys([*goals, *used]) if not name.startswith(("mechanisms.", "press.")))
    jobs = min(where.jobs or os.cpu_count() or 1, len(variants)) if len(variants) > FEW else 1
    some = [SomeMachines(tuple(variants[start::jobs])) for start in range(jobs)]
    with _engine(store, where, names, jobs) as engine:
        alone = {variant: each for _, found in results(engine, _alone, some) for variant, each in found.items()}
    return [_compared(stored, variant, names, alone[variant]) for variant in variants]


def _engine(store: Store, where: Where, names: tuple[str, ...], jobs: int) -> Engine:
    plugins = tuple(where.plugins)
    warm = Warm("\n".join(["alone", str(store.directory), *plugins]), _loaded, (store.directory, plugins, names))
    return Pool(jobs, warm) if jobs > 1 else InProcess(warm)


def _loaded(directory: Path, plugins: tuple[str, ...], names: tuple[str, ...]) -> MachinePlace:
    settle()
    return MachinePlace(directory, Discovery([Path(plugin) for plugin in plugins]), names)


def _alone(place: MachinePlace, some: SomeMachines) -> dict[int, Rechecked]:
    """Calculate machines, each by itself."""
    with opened(place.directory) as stored:
        return {variant: _of_one(place, stored, variant) for variant in some.variants}


def _of_one(place: MachinePlace, stored: Stored, variant: int) -> Rechecked:
    try:
        machine = proved(variant_of(stored, variant, place.discovery, f"{variant}.yaml"), {}, place.discovery)
    except (UserError, PluginError) as error:
        return Rechecked("error", fault=str(error).splitlines()[0])
    known = _numbers(machine)
    return Rechecked(machine.status, tuple(known.get(name) for name in place.names))


def _numbers(machine: ProvedMachine) -> dict[str, float]:
    """The outputs of a machine, and the utilisations of its checks."""
    found = dict(machine.outputs)
    for name, checks in machine.checked.items():
        for each in checks:
            column, used = f"{name}.checks.{each['id']}{UTILISATION}", each.get("utilisation")
            if used is not None:  # of repeated parts the one that is used most governs
                found[column] = max(float(used), found.get(column, -math.inf))
    return found


def _compared(stored: Stored, variant: int, names: Sequence[str], alone: Rechecked) -> Recheck:
    listed = ", ".join(map(quoted, names)) or "NULL"
    ((status, *values),) = stored.rows(f"SELECT status, {listed} FROM v WHERE variant = ?", [variant])
    if alone.fault:
        return Recheck(variant, status, alone.status, fault=alone.fault)
    apart = [(_share(one, other), name) for name, one, other in zip(names, values, alone.values, strict=False)]
    share, name = max(apart, default=(0.0, ""))
    return Recheck(variant, status, alone.status, name if share else "", share)


def _share(one: Any, other: float | None) -> float:
    """By which share of its size a number differs; a utilisation of next to nothing by its size itself."""
    if one is None or other is None or not math.isfinite(other):
        return 0.0 if one is None and (other is None or not math.isfinite(other)) else math.inf
    return abs(float(one) - other) / max(abs(float(one)), abs(other), 1e-9)
