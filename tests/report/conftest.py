"""A results document made by hand that holds every kind of item and figure."""

from __future__ import annotations

import json
import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from diecut_report.report import Rendering

SAMPLE = Path(__file__).with_name("sample_results.json")


@pytest.fixture
def results() -> dict[str, Any]:
    """A fresh copy of the sample."""
    found: dict[str, Any] = json.loads(SAMPLE.read_text(encoding="utf-8"))
    return found


@pytest.fixture(scope="session")
def rendering() -> Rendering:
    """The sample's report; its formats are made once for all tests."""
    return Rendering(json.loads(SAMPLE.read_text(encoding="utf-8")))


@pytest.fixture(scope="session")
def html(rendering: Rendering) -> str:
    """The sample as HTML."""
    return rendering.html()


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
