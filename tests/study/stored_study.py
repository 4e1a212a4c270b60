"""A small stored study of two mechanisms, as a run leaves it, and questions to it: calculated here by plain arithmetic, stored by the program."""

from __future__ import annotations

import math
from collections.abc import Generator, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.study.analysis.answers import Request, answer
from diecut_report.study.storage.description import Description, ResultColumn, StudySource
from diecut_report.study.storage.store import Store

SPEED, BORE, LAW = "mechanisms.drive.crank_speed", "mechanisms.cylinder.bore_radius", "mechanisms.drive.motion_law"
INPUTS = (
    ResultColumn(SPEED, "float", "rad/s", "rpm", "n", "Speed of the crank"),
    ResultColumn(BORE, "float", "m", "mm", "R_b", "Radius of the bore (below the radius)"),
    ResultColumn(LAW, "text", description="Law of motion"),
)
RESULTS = (
    ResultColumn("cylinder.mass", "float", "kg", symbol="m", description="Mass of the cylinder"),
    ResultColumn("cylinder.radius", "float", "m", "mm", "R", "Radius"),
    ResultColumn("cylinder.checks.wall.utilisation", description="Wall at the flat: utilisation"),
    ResultColumn("cylinder.checks.wall.status", "text", description="Wall at the flat: verdict"),
    ResultColumn("drive.crank_torque_peak", "float", "N*m", symbol="M_max", description="Maximum torque"),
    ResultColumn("drive.power_peak", "float", "W", symbol="P_max", description="Maximum power"),
    ResultColumn("drive.slip", "bool", description="Whether the clutch slips"),
    ResultColumn("drive.idle_ratio", "float", description="Idle ratio"),
    ResultColumn("drive.crank_torque", "curve", "N*m", description="Torque over a turn"),
    ResultColumn("drive.checks.play.utilisation", description="Play of the joints: utilisation"),
    ResultColumn("drive.checks.play.status", "text", description="Play of the joints: verdict"),
)
BASE = """\
schema_version: 1
project: {title: Two mechanisms}   # the title
press:
  name: DCP-700
  sheet: {length: 700 mm, thickness: 0.6 mm}
mechanisms:
  cylinder:
    kind: cylinder_sizing
    bore_radius: 70 mm   # bored
    segment_height: 40 mm
  drive:
    kind: cylinder_drive
    motion_law: harmonic
    crank_speed: ${press.productivity}   # a reference
    gears:
      - {driver_teeth: 20, driven_teeth: 60}
      - driver_teeth: 18   # second stage
        driven_teeth: 36
"""

STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: latin_hypercube, count: 13, seed: 4}
vary:
  mechanisms.drive.crank_speed: {from: 30 rpm, to: 6.6e1 rpm}   # the crank
  mechanisms.cylinder.bore_radius: {distribution: normal, mean: 70 mm, sd: 5 mm, low: 50 mm}
  mechanisms.drive.motion_law: ["harmonic", cycloidal]
constraints:
  - mechanisms.cylinder.bore_radius <= mechanisms.cylinder.radius - '1 mm'
objectives:
  - minimise: drive.power_peak
  - minimise: cylinder.mass
reports: best 2
"""


def calculated(speed: Any, bore: Any, law: Sequence[str]) -> dict[str, Any]:
    """Columns of a study by simple rules: a heavier cylinder and a faster crank ask for more torque."""
    mass = 7800 * 0.7 * math.pi * (0.105**2 - bore**2)
    torque = mass * 0.02 * speed**2 * np.where(np.array(law) == "harmonic", 1.0, 1.3)
    play = torque / 60.0
    wall = np.where(bore < 0.09, 0.01 / (0.105 - bore), np.nan)
    status = np.where(play > 1, "fail", np.where(play > 0.9, "warn", "pass")).astype(object)
    thin = np.where(np.isnan(wall), "fail", "pass").astype(object)
    worst = np.where((status == "fail") | (thin == "fail"), "fail", status).astype(object)
    curves = np.empty(len(bore), dtype=object)
    curves[:] = [np.array([0.0, each]) for each in torque]
    columns = {
        "cylinder.mass": mass, "cylinder.radius": np.full(len(bore), 0.105), "drive.crank_torque_peak": torque,
        "cylinder.checks.wall.utilisation": wall, "cylinder.checks.wall.status": thin, "drive.power_peak": torque * speed,
        "drive.slip": (play > 1.2).astype(object), "drive.idle_ratio": 1 / speed, "drive.crank_torque": curves,
        "drive.checks.play.utilisation": play, "drive.checks.play.status": status, "status": worst,
        "governing": np.where(thin == "fail", "cylinder.checks.wall", "drive.checks.play").astype(object),
    }  # fmt: skip
    return _without_broken(columns, bore) | {SPEED: speed, BORE: bore, LAW: np.array(law, dtype=object)}


def _without_broken(columns: Mapping[str, Any], bore: Any) -> dict[str, Any]:
    """Variants that cannot exist have inputs and a reason, and nothing else."""
    broken = bore > 0.1
    found = {
        name: np.where(broken, None if values.dtype == object else np.nan, values) for name, values in columns.items()
    }
    found["status"][broken] = "error"
    reasons = [
        f"bore_radius {each:.4g} m leaves no wall" if bad else None for bad, each in zip(broken, bore, strict=True)
    ]
    return found | {"error": np.array(reasons, dtype=object)}


def written(
    folder: Path, columns: Sequence[ResultColumn], values: Mapping[str, Any], parts: int = 1, text: str = STUDY,
    base: str = BASE, dropped: int = 0, **facts: Any,
) -> Path:  # fmt: skip
    """A study's folder with these values, through the store; ``facts`` are what a run notes in study.json.

    ``text`` is the study's file, ``base`` its base; ``dropped`` rows of the sample, the last ones, break a constraint.
    """
    count = len(values["status"]) + dropped
    every = max(1, -(-count // parts))
    study = StudySource("study.yaml", sha256(text.encode()).hexdigest(), text.encode())
    kept = StudySource("press.yaml", sha256(base.encode()).hexdigest(), base.encode())
    store = Store.create(folder, Description(study, kept, tuple(columns), count, every))
    numbered = {"variant": range(len(values["status"])), **values}
    with store.lock():
        for index in range(store.description.parts):
            at = slice(index * every, (index + 1) * every)
            store.write_part(index, {name: column[at] for name, column in numbered.items()})
        store.finish()
        store.note({"slow": {}, "seconds": 1.5} | facts)
    return folder


def made(folder: Path, speed: Any, bore: Any, law: Sequence[str] | None = None, parts: int = 2, **facts: Any) -> Path:
    """A study of the two mechanisms at these speeds, bores and laws; ``facts`` stand in study.json."""
    values = calculated(np.asarray(speed, float), np.asarray(bore, float), law or ["harmonic"] * len(bore))
    inputs = INPUTS if law else INPUTS[:2]
    known = {column.name for column in (*inputs, *RESULTS)} | {"status", "governing", "error"}
    told = {
        "varied": [column.name for column in inputs],
        "objectives": [{"minimise": "drive.power_peak"}, {"minimise": "cylinder.mass"}],
    }
    kept = {name: column for name, column in values.items() if name in known}
    return written(folder, (*inputs, *RESULTS), kept, parts, **(told | facts))


def ten(folder: Path, **facts: Any) -> Path:
    """Ten variants: passing, with a warning, failing by either check, and one that cannot exist."""
    rpm = 2 * math.pi / 60
    speed = [rpm * n for n in (40, 50, 60, 40, 50, 60, 40, 35, 60, 60)]
    bore = [0.055, 0.055, 0.055, 0.065, 0.065, 0.065, 0.07, 0.095, 0.08, 0.104]
    return made(folder, speed, bore, **facts)


def many(folder: Path, count: int, seed: int = 0, **facts: Any) -> Path:
    """A large random study."""
    draw = np.random.default_rng(seed)
    law = draw.choice(["harmonic", "cycloidal"], count).tolist()
    return made(folder, draw.uniform(3, 7, count), draw.uniform(0.05, 0.103, count), law, parts=8, **facts)


def variants(
    folder: Path,
    where: str | None = None,
    sort: str | None = None,
    top: int | None = None,
    format: str = "table",
    columns: Sequence[str] | None = None,
    width: int | None = None,
) -> Generator[str, None, None]:
    """The answer in pieces of text."""
    yield from answer(folder, Request(where, sort, top, columns), format, width=width)
