"""The memory that a PDF takes grows with its sheets, by so much for each, and with nothing else."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.configs import HEAD, saved
from tests.hostile import bounded

MOST_OF_A_SHEET = 10e6  # bytes; 5 MB were measured between 10 and 50 cylinders
MADE = f"""
import json, sys
{bounded.PEAK}
from io import BytesIO
import pikepdf
from diecut_report.report.rendering import Rendering
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.config.plugins import Discovery
from diecut_report.config.loader import load_config

path = Path(sys.argv[1])
config = load_config(path, Discovery())
made = Rendering(document(compute(config, lambda _: None))).pdf()
with pikepdf.open(BytesIO(made)) as opened:
    print(json.dumps([len(opened.pages), memory()]))
"""
CYLINDER = """\
  cylinder_{number}:
    kind: cylinder_sizing
    working_length: {length} mm
    segment_height: 40 mm
    generatrix_length: 700 mm
    bore_radius: 60 mm
"""


def made(folder: Path, count: int) -> tuple[int, int]:
    """Sheets of the report of so many cylinders, and the bytes that the process had at most."""
    cylinders = "".join(CYLINDER.format(number=number, length=470 + number) for number in range(count))
    path = saved(folder, HEAD + cylinders, f"{count}.yaml")
    sheets, peak = json.loads(bounded.run(MADE, path, seconds=900, memory=6_000_000_000))
    return sheets, peak


@pytest.mark.nightly
def test_each_further_sheet_of_a_pdf_takes_a_bounded_share_of_memory(tmp_path: Path) -> None:
    few, many = made(tmp_path, 2), made(tmp_path, 8)
    assert many[0] >= few[0] + 6
    assert many[1] - few[1] <= MOST_OF_A_SHEET * (many[0] - few[0])
