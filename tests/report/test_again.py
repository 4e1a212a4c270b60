"""A report can be made again from a results file alone."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.report import Rendering

EXAMPLE = Path(import_module("diecut_report.configs").__path__[0]) / "flat_cylinder_press.yaml"


def test_the_report_of_a_results_file_is_the_report(tmp_path: Path) -> None:
    pipeline.report(EXAMPLE, Discovery(()), lambda _: None, tmp_path, ("html", "pdf", "json"))
    file = tmp_path / f"{EXAMPLE.stem}.json"
    again = Rendering(json.loads(file.read_text(encoding="utf-8")))
    assert again.html() == file.with_suffix(".html").read_text(encoding="utf-8")
    assert again.pdf() == file.with_suffix(".pdf").read_bytes()
