"""A results document made by hand that holds every kind of item and figure, and its reports."""

from __future__ import annotations

import json
import logging
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from diecut_report.report.figures.style import styled
from diecut_report.report.rendering import Rendering
from tests.report.made_results import sample, typed
from tests.shared import once


@pytest.fixture
def results() -> dict[str, Any]:
    """A fresh copy of the sample."""
    return sample()


@pytest.fixture
def plain() -> dict[str, Any]:
    """A fresh copy of the sample without its figures, which take most of the time of a report."""
    found = sample()
    for mechanism in (*found["mechanisms"].values(), *found["comparisons"].values()):
        mechanism["figures"] = []
    return found


@pytest.fixture(scope="session")
def rendering() -> Rendering:
    """The sample's report; its formats are made once for all tests."""
    return Rendering(typed(sample()))


@pytest.fixture(scope="session")
def html(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The sample as HTML, made once for all workers."""

    def make(folder: Path) -> None:
        rendering: Rendering = request.getfixturevalue("rendering")
        (folder / "sample.html").write_text(rendering.html(), "utf-8")

    return (once(tmp_path_factory, "sample_html", make) / "sample.html").read_text("utf-8")


@pytest.fixture
def style() -> Iterator[None]:
    """The report's fonts and settings, for what is drawn or measured apart from a whole figure."""
    with styled("x"):
        yield


class Records(logging.Handler):
    """Keeps what is logged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage())


@dataclass(frozen=True)
class Printed:
    """A PDF file, what WeasyPrint warned of, how many formulas were set for the HTML, and how many more for the PDF."""

    path: Path
    warnings: list[str]
    set_for_html: int
    set_anew: int


@pytest.fixture(scope="session")
def printed(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Printed:
    """The sample as PDF, made once for all workers."""

    def make(folder: Path) -> None:
        rendering: Rendering = request.getfixturevalue("rendering")
        rendering.html()
        handler, logger = Records(), logging.getLogger("weasyprint")
        known = rendering.typesetter.outline.cache_info().currsize
        logger.addHandler(handler)
        (folder / "sample.pdf").write_bytes(rendering.pdf())
        logger.removeHandler(handler)
        anew = rendering.typesetter.outline.cache_info().currsize - known
        told = {"warnings": handler.messages, "set_for_html": known, "set_anew": anew}
        (folder / "told.json").write_text(json.dumps(told))

    folder = once(tmp_path_factory, "sample", make)
    return Printed(folder / "sample.pdf", **json.loads((folder / "told.json").read_text()))


@pytest.fixture(scope="session")
def pdf(printed: Printed) -> Path:
    """The sample as a PDF file."""
    return printed.path
