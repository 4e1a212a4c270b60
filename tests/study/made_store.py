"""A made study for the tests of store and engines: nothing is calculated by the program."""

from __future__ import annotations

import os
import signal
import struct
import time
from dataclasses import replace
from hashlib import sha256
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.study.execution.engines import WorkerSetup
from diecut_report.study.storage.description import Description, ResultColumn, StudySource

SPEED, MASS = "mechanisms.drive.crank_speed", "cylinder.mass"
COLUMNS = (
    ResultColumn(SPEED, "float", "rad/s", symbol="ω", description="Crank speed"),
    ResultColumn(MASS, "float", "kg"),
    ResultColumn("train.teeth", "int"),
    ResultColumn("drive.reversed", "bool"),
    ResultColumn("drive.law", "text"),
)


def source(file: str, text: str) -> StudySource:
    return StudySource(file, sha256(text.encode()).hexdigest(), text.encode())


def description(rows: int = 100, chunk: int = 10, **other: Any) -> Description:
    """A study of `rows` variants in parts of `chunk`."""
    study, base = source("speeds.yaml", "count: 9\n"), source("press.yaml", "title: press\nmass: 5 kg\n")
    return replace(Description(study, base, COLUMNS, rows, chunk), **other)


def part(first: int, count: int) -> dict[str, Any]:
    """Columns of some variants, each value a plain function of its number."""
    number = np.arange(first, first + count)
    return {
        "variant": number,
        SPEED: number / 7,
        MASS: np.where(number % 5 == 0, np.nan, number * 2.0),
        "train.teeth": number + 17,
        "drive.reversed": number % 2 == 0,
        "drive.law": ["harmonic" if n % 3 else None for n in number],
        "status": ["fail" if n % 4 == 0 else "pass" for n in number],
        "governing": ["drive.checks.torque"] * count,
        "error": [None] * count,
    }


def warm(folder: Path, key: str = "made") -> WorkerSetup:
    """Workers load a number, and leave a file for each loading."""
    return WorkerSetup(key, load, (str(folder),))


def load(folder: str) -> str:
    (Path(folder) / f"loaded.{os.getpid()}.{time.monotonic_ns()}").touch()
    return folder


def square(folder: str, chunk: int) -> int:
    return chunk * chunk


def slow_square(folder: str, chunk: int) -> tuple[int, int]:
    """Some work, and the process that did it; says in the folder that it has begun."""
    (Path(folder) / f"begun.{os.getpid()}.{chunk}").touch()
    time.sleep(0.2)
    return chunk * chunk, os.getpid()


def fails_at_three(folder: str, chunk: int) -> int:
    if chunk == 3:
        raise ZeroDivisionError("nothing to divide by")
    return chunk


def dies_at_three(folder: str, chunk: int) -> int:
    """Counts its calls by files; number three ends its process each time."""
    (Path(folder) / f"call.{chunk}.{os.getpid()}").touch()
    if chunk == 3:
        os._exit(9)
    return chunk


def sleeps(folder: str, chunk: int) -> int:
    (Path(folder) / f"begun.{os.getpid()}.{chunk}").touch()
    time.sleep(600)
    return chunk


def dies_in_its_result(folder: str, chunk: int) -> int:
    """The first call ends its process in the middle of its result, while another process has the pipe open too."""
    mark = Path(folder) / f"begun.{os.getpid()}.{chunk}"
    if chunk == 0 and not list(Path(folder).glob("begun.*.0")):

        def half_sent(self: Connection, _: bytes) -> None:
            os.write(self.fileno(), struct.pack("!i", 1000) + b"half")
            os.kill(os.getpid(), signal.SIGKILL)

        Connection._send_bytes = half_sent  # type: ignore[attr-defined]
    mark.touch()
    time.sleep(0.2)
    return chunk
