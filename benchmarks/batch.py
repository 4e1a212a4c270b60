"""How fast a study is calculated: the full press against ``calc``, two processes against one, cost and memory by size.

    python benchmarks/batch.py press | cores | scale

press   the example study (all mechanisms of the flat-cylinder press) in one process: time of a variant against the time of
        one ``diecut-report calc`` process of its base. The aim: at least 200 × as fast.
cores   the same study in one process and in two, from the first variant to the last written part. The aim: at least 1.7 ×.
scale   a study of the cylinder's drive alone with 10³ to 10⁶ variants, each size in a fresh process: seconds, exponent of the
        cost (slope of log time over log size), peak memory. The aims: an exponent of 1, memory flat and below 1 GB.
"""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from importlib import import_module
from pathlib import Path

import numpy as np
from calc import COMMANDS, seconds

from diecut_report.config.plugins import Discovery
from diecut_report.study.definition.study_file import Study, load_study
from diecut_report.study.execution import worker
from diecut_report.study.execution.study_run import Where, run_study

CONFIGS = Path(import_module("diecut_report.configs").__path__[0])
STUDY, BASE = CONFIGS / "flat_cylinder_study.yaml", CONFIGS / "flat_cylinder_mechanisms.yaml"
PRESS_ROWS, CORES_ROWS, ROUNDS = 4096, 131072, 5
SIZES = (1_000, 10_000, 100_000, 1_000_000)
DRIVE = """\
schema_version: 1
base: base.yaml
sample: {{method: sobol, count: {count}, seed: 1}}
vary:
  mechanisms.drive.crank_speed: {{from: 40 rpm, to: 60 rpm}}
  mechanisms.drive.cylinder_mass: {{from: 70 kg, to: 100 kg}}
"""
DRIVE_BASE = """\
schema_version: 1
project: {title: Drive}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470.7 mm, thickness: 0.6 mm}}
mechanisms:
  drive: {kind: cylinder_drive, cylinder_radius: 105 mm, cylinder_length: 700 mm, cylinder_mass: 80 kg, cylinder_inertia: 0.9 kg*m**2}
"""


def example(folder: Path, count: int) -> Study:
    """The example study with so many variants."""
    shutil.copy(BASE, folder)
    text, changed = re.subn(r"(?m)^  count: \d+", f"  count: {count}", STUDY.read_text("utf-8"))
    assert changed == 1
    (folder / "study.yaml").write_text(text, "utf-8")
    return load_study(folder / "study.yaml", Discovery([]))


def press(folder: Path) -> None:
    """Time of a variant against one calc process, in turns."""
    study = example(folder, PRESS_ROWS)
    calc = variant = math.inf
    worker.calculate(study, worker.Chunk(0, 0, 256))
    for _ in range(ROUNDS):
        calc = min(calc, seconds(COMMANDS["full"]))
        start = time.perf_counter()
        done = worker.calculate(study, worker.Chunk(0, 0, PRESS_ROWS))
        variant = min(variant, (time.perf_counter() - start) / len(done.columns["variant"]))
    print(f"calc, one process   {calc:.3f} s")
    print(f"a variant           {variant * 1e3:.2f} ms   {1 / variant:.0f} variants a second")
    print(f"calc / variant      {calc / variant:.0f}")


def cores(folder: Path) -> None:
    """Variants a second of whole runs in one process and in two."""
    study = example(folder, CORES_ROWS)
    best = {}
    for jobs in (1, 2):
        start = time.perf_counter()
        outcome = run_study(study, folder / f"{jobs}", Where(jobs=jobs), resume=False, tell=lambda _: None)
        best[jobs] = time.perf_counter() - start
    for jobs, spent in best.items():
        print(f"{jobs} in parallel   {spent:6.1f} s   {outcome.counts['variants'] / spent:.0f} variants a second")
    print(f"two / one       {best[1] / best[2]:.2f}")


def scale(folder: Path) -> None:
    """Seconds and peak memory of the whole command by size, and the exponent of what it takes to calculate and store."""
    (folder / "base.yaml").write_text(DRIVE_BASE, "utf-8")
    spent = []
    for count in SIZES:
        (folder / "study.yaml").write_text(DRIVE.format(count=count), "utf-8")
        target = folder / f"{count}"
        command = [sys.executable, "-m", "diecut_report", "batch", "--quiet", "--jobs", "1", "-o", str(target)]
        start = time.perf_counter()
        _, code, usage = os.wait4(subprocess.Popen([*command, str(folder / "study.yaml")]).pid, 0)
        whole = time.perf_counter() - start
        if os.waitstatus_to_exitcode(code) not in (0, 1):
            raise SystemExit(f"the study of {count} variants ended with {os.waitstatus_to_exitcode(code)}")
        spent.append(json.loads((target / "study.json").read_text("utf-8"))["seconds"])
        told = f"calculated in {spent[-1]:6.1f} s, {spent[-1] / count * 1e6:4.0f} µs each; whole command {whole:6.1f} s"
        print(f"{count:9,} variants   {told}, {usage.ru_maxrss / 1024:4.0f} MB", flush=True)
    print(f"exponent   {np.polyfit(np.log(SIZES), np.log(spent), 1)[0]:.2f}")


if __name__ == "__main__":
    parts = {"press": press, "cores": cores, "scale": scale}
    if len(sys.argv) != 2 or sys.argv[1] not in parts:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as name:
        parts[sys.argv[1]](Path(name))
