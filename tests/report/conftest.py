"""A results document made by hand that holds every kind of item and figure, and its reports."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

from diecut_report.report import Rendering, figures
from tests.report.made_results import sample


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
    return Rendering(sample())


@pytest.fixture(scope="session")
def html(rendering: Rendering) -> str:
    """The sample as HTML."""
    return rendering.html()


@pytest.fixture
def style() -> Iterator[None]:
    """The report's fonts and settings, for what is drawn or measured apart from a whole figure."""
    figures.load_fonts()
    with mpl.rc_context(figures.style("x")):  # type: ignore[arg-type]
        yield


class Records(logging.Handler):
    """Keeps what is logged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage())


@pytest.fixture
def weasyprint_log() -> Iterator[list[str]]:
    """What WeasyPrint warns of."""
    handler = Records()
    logger = logging.getLogger("weasyprint")
    logger.addHandler(handler)
    yield handler.messages
    logger.removeHandler(handler)


@pytest.fixture(scope="session")
def pdf(rendering: Rendering, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample as a PDF file."""
    path = tmp_path_factory.mktemp("report") / "sample.pdf"
    path.write_bytes(rendering.pdf())
    return path
