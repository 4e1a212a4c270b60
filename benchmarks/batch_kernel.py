"""The engine on arrays of variants against a kernel written by hand for one kind of mechanism, ``cylinder_drive``; one core, one run.

    python benchmarks/batch_kernel.py [ROUNDS]

Both give all numbers of the drive and the verdicts and utilisations of its checks, as arrays. The kernel (``drive_kernel``) takes
every curve at 720 crank angles, refines extremes by a parabola and crossings by a line; the engine finds both to rounding, with
one-sided limits at jumps, and proves them. They run in turns, the least times are compared.
The aim: at least half of the kernel's variants a second.
"""

from __future__ import annotations

import os

os.environ |= dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")  # one core

import sys
import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from drive_kernel import Kernel

from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.cylinder_drive import MECHANISM
from diecut_report.results.checks import applies, judged
from diecut_report.study.execution.engines import settle

VARIANTS = 4096
ENGINE_CHUNKS, KERNEL_CHUNKS = (512, 1024, 2048), (32, 64, 128, 256, 512)
BASE: dict[str, float] = {
    "frame_ratio": 5, "coupler_ratio": 5, "rocker_ratio": 2.05, "crank_speed": 2 * np.pi * 50 / 60, "cylinder_radius": 0.105,
    "cylinder_length": 0.7, "cylinder_mass": 80.9077, "cylinder_inertia": 0.63623, "static_unbalance": 1.97727,
    "cutting_force_per_length": 25e3, "ejection_force_per_length": 5e3, "material_thickness": 0.6e-3, "rolling_coefficient": 0.3,
    "cutting_arc_fraction": 0.712481, "efficiency_sector": 0.96, "efficiency_gear": 1, "efficiency_four_bar": 0.95,
    "efficiency_bearings": 0.99, "efficiency_chain": 0.95, "n_points": 720, "min_transmission_angle": np.radians(40),
    "segment_height": 0.04, "carriage_clearance": 0.03, "crank_length": 0.1, "pinion_radius": 0.07, "pressure_angle": np.radians(20),
    "standstill_rotation": np.radians(2),
}  # fmt: skip
SPANS: dict[str, tuple[float, float]] = {  # of the factors that each variant's inputs are multiplied by
    "frame_ratio": (0.99, 1.03), "rocker_ratio": (0.95, 1.05), "crank_speed": (0.8, 1.2), "cylinder_mass": (0.9, 1.3),
    "cylinder_inertia": (0.8, 1.2), "static_unbalance": (0.1, 1.0), "cutting_arc_fraction": (0.8, 1.2),
}  # fmt: skip


def variants(count: int, seed: int = 0) -> dict[str, Any]:
    """The published drive with seven inputs varied at random, SI."""
    random = np.random.default_rng(seed)
    spread = {name: random.uniform(*span, count) for name, span in SPANS.items()}
    return {name: value * spread.get(name, np.ones(count)) for name, value in BASE.items()}


def by_engine(values: Mapping[str, Any], count: int) -> dict[str, Any]:
    """All numbers and checks of variants, by the engine."""
    calc = calculate(MECHANISM, values, count)
    checks = [check for check in MECHANISM.checks if applies(calc, check)]
    found = {check.id: judged(calc, check) for check in checks}
    return calc.values | {name: (one.governing(one.held), one.governing(one.ratio)) for name, one in found.items()}


def rate(function: Callable[[Mapping[str, Any], int], Any], inputs: Mapping[str, Any], chunk: int) -> float:
    """Variants a second of processor time in chunks, over all inputs or as many as half a second allows."""
    start, done = time.process_time(), 0
    while done + chunk <= VARIANTS and time.process_time() - start < 0.5:
        function({name: value[done : done + chunk] for name, value in inputs.items()}, chunk)
        done += chunk
    return done / (time.process_time() - start)


def main(rounds: int) -> None:
    """Run both in turns and print variants a second, and the ratio of the best."""
    settle()  # as workers of a study do
    inputs = variants(VARIANTS)
    runs: dict[tuple[str, int], Callable[[Mapping[str, Any], int], Any]] = {
        ("engine", n): by_engine for n in ENGINE_CHUNKS
    }
    runs |= {("kernel", n): Kernel(n).calculate for n in KERNEL_CHUNKS}
    best = dict.fromkeys(runs, 0.0)
    for _ in range(rounds):
        for key, function in runs.items():
            best[key] = max(best[key], rate(function, inputs, key[1]))
    for (name, chunk), found in best.items():
        print(f"{name} in chunks of {chunk:4}   {found:8.0f} variants a second")
    engine, kernel = (max(value for (name, _), value in best.items() if name == own) for own in ("engine", "kernel"))
    print(f"engine / kernel   {engine / kernel:.2f}")
    for name, off in differences(inputs):
        print(f"the kernel's {name:20} is up to {off:.1e} of the number off the engine's")


def differences(inputs: Mapping[str, Any], count: int = 512) -> Iterator[tuple[str, float]]:
    """How far off the kernel's sampled numbers are, which the engine finds to rounding."""
    some = {name: value[:count] for name, value in inputs.items()}
    found, exact = Kernel(count).calculate(some, count), calculate(MECHANISM, some, count)
    for name in ("velocity_max", "crank_torque_peak", "crank_torque_mean", "joint_force_max"):
        yield name, float(np.max(np.abs(found[name] / exact[name][:, 0] - 1)))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 7)
