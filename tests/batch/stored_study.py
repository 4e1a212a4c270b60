"""A small stored study of two mechanisms, as a run leaves it: made here by plain arithmetic, without the program."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

SPEED, BORE, LAW = "mechanisms.drive.crank_speed", "mechanisms.cylinder.bore_radius", "mechanisms.drive.motion_law"
UNITS = {
    SPEED: "rad/s", BORE: "m", "cylinder.mass": "kg", "cylinder.radius": "m", "drive.crank_torque_peak": "N*m", "drive.power_peak": "W",
    "drive.slip": "1", "drive.idle_ratio": "1",
}  # fmt: skip
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


def columns_of(speed: Any, bore: Any, law: list[str]) -> dict[str, Any]:
    """Columns of a study by simple rules: a heavier cylinder and a faster crank ask for more torque."""
    mass = 7800 * 0.7 * math.pi * (0.105**2 - bore**2)
    torque = mass * 0.02 * speed**2 * np.where(np.array(law) == "harmonic", 1.0, 1.3)
    power = torque * speed
    play = torque / 60.0
    wall = np.where(bore < 0.09, 0.01 / (0.105 - bore), np.nan)
    broken = bore > 0.1
    status = np.where(play > 1, "fail", np.where(play > 0.9, "warn", "pass")).astype(object)
    thin = np.where(np.isnan(wall), "fail", "pass").astype(object)
    whole = np.where((status == "fail") | (thin == "fail"), "fail", status).astype(object)
    governing = np.where(thin == "fail", "cylinder.checks.wall", "drive.checks.play").astype(object)
    return _masked(
        {
            "variant": np.arange(len(bore)), SPEED: speed, BORE: bore, LAW: np.array(law, dtype=object), "cylinder.mass": mass,
            "cylinder.radius": np.full(len(bore), 0.105), "cylinder.checks.wall.utilisation": wall, "cylinder.checks.wall.status": thin,
            "drive.crank_torque_peak": torque, "drive.power_peak": power, "drive.slip": play > 1.2, "drive.idle_ratio": torque / power,
            "drive.checks.play.utilisation": play, "drive.checks.play.status": status, "status": whole, "governing": governing,
            "error": np.full(len(bore), None, dtype=object),
        },
        broken,
    )  # fmt: skip


def _masked(columns: dict[str, Any], broken: Any) -> dict[str, Any]:
    """Variants that cannot exist have inputs and a reason, and nothing else."""
    inputs = ("variant", SPEED, BORE, LAW)
    found = {}
    for name, values in columns.items():
        missing = np.zeros(len(broken), bool) if name in inputs else broken
        if values.dtype == float:
            missing = missing | np.isnan(values)
        found[name] = pa.array(values.tolist(), mask=missing, type=_type(values))
    reasons = [
        f"bore_radius {bore:.4g} m leaves no wall" if bad else None
        for bad, bore in zip(broken, columns[BORE], strict=True)
    ]
    status = ["error" if bad else value for bad, value in zip(broken, columns["status"], strict=True)]
    return found | {"error": pa.array(reasons, pa.string()), "status": pa.array(status, pa.string())}


def _type(values: Any) -> pa.DataType:
    return {"f": pa.float64(), "i": pa.int64(), "b": pa.bool_()}.get(values.dtype.kind, pa.string())


def made(folder: Path, speed: Any, bore: Any, law: list[str] | None = None, parts: int = 2, **study: Any) -> Path:
    """Writes a study's folder with its part files; ``study`` is put into study.json."""
    columns = columns_of(np.asarray(speed, float), np.asarray(bore, float), law or ["harmonic"] * len(bore))
    table = pa.table(columns)
    (folder / "variants").mkdir(parents=True)
    size = -(-len(table) // parts)
    for part in range(parts):
        pq.write_table(table.slice(part * size, size), folder / "variants" / f"part-{part:05}.parquet")
    told = {
        "state": "complete", "study": "study.yaml", "schema_version": 1, "columns": {name: {"unit": unit} for name, unit in UNITS.items()},
        "varied": [SPEED, BORE, LAW] if law else [SPEED, BORE], "objectives": [{"minimise": "drive.power_peak"}, {"minimise": "cylinder.mass"}],
        "program": {"name": "diecut-report", "version": "0.1.0"}, "counts": {"sample": len(bore), "variants": len(bore)}, "seconds": 1.5, "slow": {},
    }  # fmt: skip
    (folder / "study.json").write_text(json.dumps(told | study), encoding="utf-8")
    (folder / "base.yaml").write_text(BASE, encoding="utf-8")
    return folder


def ten(folder: Path, **study: Any) -> Path:
    """Ten variants: passing, with a warning, failing by either check, and one that cannot exist."""
    rpm = 2 * math.pi / 60
    speed = [rpm * n for n in (40, 50, 60, 40, 50, 60, 40, 35, 60, 60)]
    bore = [0.055, 0.055, 0.055, 0.065, 0.065, 0.065, 0.07, 0.095, 0.08, 0.104]
    return made(folder, speed, bore, **study)


def many(folder: Path, count: int, seed: int = 0, **study: Any) -> Path:
    """A large random study."""
    draw = np.random.default_rng(seed)
    law = draw.choice(["harmonic", "cycloidal"], count).tolist()
    return made(folder, draw.uniform(3, 7, count), draw.uniform(0.05, 0.103, count), law, parts=8, **study)
