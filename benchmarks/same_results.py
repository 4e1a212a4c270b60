"""Store what today's program calculates, and compare it with what a changed one does.

    python benchmarks/same_results.py store FILE
    python benchmarks/same_results.py compare FILE [--tolerance 1e-12]

Stored are all numbers, curves, phases and checks of the example configurations, of MACHINES machines drawn at random from them (a few given
numbers each changed), and of the first rows of the example study. They are read through ``import diecut_report``, so the form of the results
file may change between the two runs. FILE (gzipped JSON) does not belong into the repository.
"""

from __future__ import annotations

import argparse
import gzip
import json
import sys
from collections.abc import Iterator
from importlib import import_module
from itertools import cycle, islice
from pathlib import Path
from typing import Any

import numpy as np

import diecut_report as dr

CONFIGS = Path(import_module("diecut_report.configs").__path__[0])
MACHINES, ROWS, SEED = 300, 200, 30
FACTOR = 1.3  # by which a number is changed, at most
EXAMPLES = sorted(file for file in CONFIGS.glob("*.yaml") if "study" not in file.stem)
VARIED = {
    "drive.cylinder_mass": (60.0, 120.0),
    "press.productivity": (4800.0, 6600.0),
}  # of the study: range, in the unit of the key

Record = dict[str, Any]


def main() -> int:
    """Run what is asked for; 1 where anything differs."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["store", "compare"])
    parser.add_argument("file", type=Path)
    parser.add_argument("--tolerance", type=float, default=1e-12, help="largest relative difference of a number")
    asked = parser.parse_args()
    if asked.what == "store":
        with gzip.open(asked.file, "wt", encoding="utf-8") as stream:
            json.dump(dict(machines()), stream)
        return 0
    with gzip.open(asked.file, "rt", encoding="utf-8") as stream:
        found = [
            line for name, stored in compared(json.load(stream)) for line in differences(name, stored, asked.tolerance)
        ]
    print(*found[:200], f"{len(found)} differences", sep="\n")
    return int(bool(found))


def compared(stored: Record) -> Iterator[tuple[str, tuple[Any, Any]]]:
    """Yield each machine by name with what was stored and what is calculated now."""
    now = dict(machines())
    for name in sorted({*stored, *now}):
        yield name, (stored.get(name), now.get(name))


def machines() -> Iterator[tuple[str, Record]]:
    """Yield all machines by name with what comes out of them."""
    presses = {file.stem: dr.load(file) for file in EXAMPLES}
    for name, press in presses.items():
        yield name, outcome(press)
    random = np.random.default_rng(SEED)
    for number, (name, press) in enumerate(islice(cycle(presses.items()), MACHINES)):
        changed = drawn(press, random)
        yield f"{number} {name} {changed}", outcome(press, changed)
    yield "study", study()


def drawn(press: Any, random: np.random.Generator) -> dict[str, str]:
    """Return one to three given numbers of a press, changed by up to FACTOR; listed ones and references stay."""
    given = [each for each in press.inputs if each.is_given and is_number(each) and "${" not in each.typed]
    chosen = random.choice(len(given), min(len(given), int(random.integers(1, 4))), replace=False)
    factors = FACTOR ** random.uniform(-1, 1, len(chosen))
    return {given[i].path: typed(given[i], factor) for i, factor in zip(chosen, factors, strict=True)}


def is_number(entry: Any) -> bool:
    return (
        entry.value is not None
        and isinstance(entry.value.value, int | float)
        and not isinstance(entry.value.value, bool)
    )


def typed(entry: Any, factor: float) -> str:
    """Return a value as it would be typed: whole numbers stay whole."""
    value = entry.value.value
    changed = round(value * factor) if isinstance(value, int) else float(f"{value * factor:.6g}")
    return f"{changed} {entry.value.unit}".removesuffix(" 1")


def outcome(press: Any, changed: dict[str, str] | None = None) -> Record:
    """Return the numbers of a press with changed inputs, or the keys for which it is refused."""
    try:
        results = press.with_values(changed or {}).calculate()
    except dr.UserError as error:
        return {"refused": sorted(str(problem.path or problem.key) for problem in error.problems)}
    return {"status": results.status} | {
        name: mechanism(part) for name, part in {**results, **results.comparisons}.items()
    }


def mechanism(part: Any) -> Record:
    quantities = {**part.intermediate, **part.outputs}
    return {
        "status": part.status,
        "values": {name: each.value for name, each in quantities.items()},
        "curves": {name: curve(each) for name, each in part.curves.items()},
        "phases": {name: repr(each) for name, each in part.phases.items()},
        "checks": {each.id: check(each) for each in [*part.checks, *part.self_tests]},
    }


def curve(found: Any) -> list[float]:
    """Return enough of a curve to notice a change: its size, moments and ends, and its sides at breakpoints."""
    values = found.values
    moments = [values.min(), values.max(), values.mean(), (values**2).mean(), values[0], values[-1]]
    return [len(values), *map(float, moments), *found.breakpoints, *found.left, *found.right]


def check(found: Any) -> list[Any]:
    return [found.status, *(None if side is None else side.value for side in (found.demand, found.limit))]


def study() -> Record:
    """Return the rows of a small study of the full press."""
    press = dr.load(CONFIGS / "flat_cylinder_press.yaml")
    random = np.random.default_rng(SEED)
    values = {name: random.uniform(*ends, ROWS).tolist() for name, ends in VARIED.items()}
    table = press.sweep(values, method="zip")
    return {name: table[name].tolist() for name in table.columns}


def differences(place: str, pair: tuple[Any, Any], tolerance: float) -> Iterator[str]:
    """Yield in a line each number or word that is not the same."""
    stored, now = pair
    if isinstance(stored, dict) and isinstance(now, dict):
        for name in sorted({*stored, *now}):
            yield from differences(f"{place} / {name}", (stored.get(name), now.get(name)), tolerance)
    elif isinstance(stored, list) and isinstance(now, list) and len(stored) == len(now):
        scale = max((abs(each) for each in stored if isinstance(each, float)), default=0.0)
        for index, each in enumerate(zip(stored, now, strict=True)):
            yield from leaf(f"{place} / {index}", each, tolerance, scale)
    else:
        yield from leaf(place, (stored, now), tolerance, 0.0)


def leaf(place: str, pair: tuple[Any, Any], tolerance: float, scale: float) -> Iterator[str]:
    """Yield a line where two values differ by more than a share of their size, or of that of their curve."""
    stored, now = pair
    if isinstance(stored, int | float) and isinstance(now, int | float):
        both_absent = stored != stored and now != now  # not a number: of a variant that has none
        if both_absent or abs(stored - now) <= tolerance * max(abs(stored), abs(now), scale):
            return
    elif stored == now:
        return
    yield f"{place}: {stored!r} was, {now!r} is"


if __name__ == "__main__":
    sys.exit(main())
