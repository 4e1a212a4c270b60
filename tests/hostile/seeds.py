"""Sound inputs that the fuzzer grows its own from (scripts/fuzz.py), by what reads them, and the words that they are made of."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from diecut_report.config.plugins import Discovery
from diecut_report.config.schema import config_schema
from diecut_report.formulas.conditions import FUNCTIONS, KEYWORDS
from diecut_report.quantities.units import TABLE_FILE
from diecut_report.study.definition.schema import study_schema
from tests.configs import EXAMPLES, SMALL
from tests.hostile.made_tables import SHEET, plain_workbook, workbook
from tests.hostile.readers import ENDINGS, STUDY, XML, stored_study

STUDIES = (
    STUDY,
    STUDY.replace("{method: grid}", "{method: latin_hypercube, count: 20, seed: 3}")
    .replace("[120 mm, 130 mm, 140 mm]", "{from: 120 mm, to: 140 mm}")
    .replace("[100 N*m, 300 N*m]", "{distribution: normal, mean: 200 N*m, sd: 9 N*m, low: 150 N*m, high: 250 N*m}"),
    STUDY
    + "constraints: [\"mechanisms.clutch.shoe_radius < '2 m'\"]\nobjectives: [{minimise: clutch.pressing_force}]\n"
    "reports: best 1\noutputs: [clutch.pressing_force]\n",
)


def seeds(target: str) -> list[bytes]:
    """Sound inputs of a reader; none where the kept corpus holds some."""
    if target == "config":
        return [SMALL.encode(), *(path.read_bytes() for path in EXAMPLES)]
    if target == "study":
        return [text.encode() for text in STUDIES]
    with TemporaryDirectory() as folder:
        if target == "stored":
            return [(stored_study(Path(folder)) / "study.json").read_bytes()]
        return _tables(Path(folder)) if target == "table" else []


def _tables(folder: Path) -> list[bytes]:
    """A small table in each format, and the sheet of a workbook; the first byte tells the reader which."""
    (folder / "a.csv").write_text("a [mm],b\n1,x\n2.5 mm,y\n")
    workbook({}, folder / "a.xlsx")
    pq.write_table(pa.table({"a": [1.0, 2.0], "b": ["x", "y"]}), folder / "a.parquet")
    files = [bytes([number]) + (folder / f"a{ending}").read_bytes() for number, ending in enumerate(ENDINGS)]
    return [*files, bytes([XML]) + plain_workbook()[SHEET]]


def words(target: str) -> set[str]:
    """What the fuzzer puts into its inputs: the words of the sound ones, and the keys that the reader knows."""
    found = {word for seed in seeds(target) for word in re.findall(r"[\w.*/]{2,40}", seed.decode("utf-8", "ignore"))}
    if target == "config":
        kinds = Discovery()
        found |= set(_keys(config_schema({kind: kinds.mechanism(kind) for kind in kinds.origins}, {})))
    if target == "study":
        found |= set(_keys(study_schema()))
    if target in ("condition", "constraint"):
        found |= {*KEYWORDS, *FUNCTIONS} | words("stored")
    if target == "unit":
        found |= set(re.findall(r'"(\w+)": ', TABLE_FILE.read_text("utf-8")))
    return found


def _keys(schema: Any) -> Iterable[str]:
    """The names of all properties in a JSON schema."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {})
        for inner in schema.values():
            yield from _keys(inner)
    elif isinstance(schema, list):
        for inner in schema:
            yield from _keys(inner)
