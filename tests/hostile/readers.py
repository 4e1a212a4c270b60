"""Readers of all that comes from outside, by what they read: each takes bytes and ends, or says in words why not.

The fuzzer (scripts/fuzz.py) feeds them; test_texts.py feeds them what the fuzzer kept.
"""

from __future__ import annotations

import atexit
import json
import shutil
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.quantities.units import UnitError, parse_quantity
from diecut_report.quantities.units import unit as read_unit
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import Where, run_study
from diecut_report.study.storage.description import write_state
from diecut_report.study.tables.reading import read_table
from tests.configs import SMALL, saved
from tests.hostile.made_tables import SHEET, workbook
from tests.study.stored_study import variants

CORPUS = Path(__file__).parent / "corpus"
Reader = Callable[[bytes], None]
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary:
  mechanisms.clutch.shoe_radius: [120 mm, 130 mm, 140 mm]
  mechanisms.clutch.torque: [100 N*m, 300 N*m]
"""
ENDINGS = (".csv", ".xlsx", ".parquet")
XML = len(ENDINGS)  # stands for the sheet of a workbook
UNITS = ("mm", "rad/s", "1", "%", "kg*m**2", "deg", "kN")


def folder() -> Path:
    """A folder of this process, gone with it."""
    made = Path(tempfile.mkdtemp(prefix="diecut-report-hostile-"))
    atexit.register(shutil.rmtree, made, ignore_errors=True)
    return made


def config() -> Reader:
    """Read bytes as a configuration."""
    place = folder() / "press.yaml"

    def read(data: bytes) -> None:
        place.write_bytes(data)
        with suppress(UserError):
            load_config(place, Discovery([]))

    return read


def study() -> Reader:
    """Read bytes as a study of a small press."""
    place = folder()
    saved(place, SMALL)

    def read(data: bytes) -> None:
        (place / "study.yaml").write_bytes(data)
        with suppress(UserError):
            load_study(place / "study.yaml", Discovery([]))

    return read


def unit() -> Reader:
    """Read a text as a unit, and as a quantity of several."""

    def read(data: bytes) -> None:
        text = data.decode("utf-8", "replace")
        with suppress(UnitError):
            read_unit(text)
        for wanted in UNITS:
            with suppress(UnitError):
                assert parse_quantity(text, wanted) == parse_quantity(text, wanted), (
                    "it is read twice as different numbers"
                )

    return read


def stored_study(place: Path) -> Path:
    """A finished study of six machines."""
    saved(place, SMALL)
    loaded = load_study(saved(place, STUDY, "study.yaml"), Discovery([]))
    run_study(loaded, place / "out", Where(jobs=1), resume=False, tell=lambda _: None)
    return place / "out"


def condition() -> Reader:
    """Ask a stored study with a text as condition."""
    out = stored_study(folder())

    def read(data: bytes) -> None:
        with suppress(UserError):
            list(variants(out, where=data.decode("utf-8", "replace")))

    return read


def constraint() -> Reader:
    """Read a text as the constraint of a study."""
    place = folder()
    saved(place, SMALL)

    def read(data: bytes) -> None:
        saved(place, f"{STUDY}constraints: [{data.decode('utf-8', 'replace')!r}]\n", "study.yaml")
        with suppress(UserError):
            load_study(place / "study.yaml", Discovery([]))

    return read


def table() -> Reader:
    """Read bytes as a table; the first byte says of which format, or that they are the sheet of a sound workbook."""
    place = folder()

    def read(data: bytes) -> None:
        form = data[0] % (XML + 1) if data else 0
        path = place / f"table{'.xlsx' if form == XML else ENDINGS[form]}"
        if form == XML:
            workbook({SHEET: data[1:]}, path)
        else:
            path.write_bytes(data[1:])
        with suppress(UserError):
            found = read_table(path)
            for column in found.columns.values():
                for read_column in (lambda column=column: column.si("mm"), column.texts):
                    with suppress(UserError):
                        read_column()

    return read


def stored() -> Reader:
    """Ask a stored study whose study.json is these bytes, with a sound seal where they are JSON."""
    out = stored_study(folder())

    def read(data: bytes) -> None:
        try:
            write_state(out, json.loads(data))
        except (ValueError, TypeError, RecursionError):
            (out / "study.json").write_bytes(data)
        with suppress(UserError):
            list(variants(out))

    return read


READERS: dict[str, Callable[[], Reader]] = {
    "config": config, "study": study, "unit": unit, "condition": condition, "constraint": constraint,
    "table": table, "stored": stored,
}  # fmt: skip
