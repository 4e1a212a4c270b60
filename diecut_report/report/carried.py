"""What a report carries of its calculation: the results file and the configuration, attached to the PDF, linked in the HTML."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Mapping
from datetime import datetime
from hashlib import sha256
from typing import Any, NamedTuple

from diecut_report.results.results_file import config_content, encoded, results_text

RESULTS, CONFIG = "results.json", "config.yaml"
"""What the files are called in each report, whatever theirs are called: `extract` and `verify` find them by these names."""
DATE = datetime(1980, 1, 1)  # of the attachments, which must have one: equal inputs give equal bytes
PACKED = ".gz"
LEVEL = 6  # 9 takes half as long again, and saves less than a hundredth


class CarriedFile(NamedTuple):
    """A file that a report carries."""

    name: str
    media_type: str
    description: str
    content: bytes
    relationship: str = "Data"  # to the document, as PDF/A-3 has it: "Source", "Data"

    @property
    def address(self) -> str:
        """The file as a data address."""
        return f"data:{self.media_type};base64,{base64.b64encode(self.content).decode()}"

    @property
    def digest(self) -> str:
        """The SHA-256 of the file."""
        return sha256(self.content).hexdigest()

    @property
    def packed(self) -> CarriedFile:
        """The file packed by gzip, without a date."""
        content = gzip.compress(self.content, LEVEL, mtime=0)
        return CarriedFile(self.name + PACKED, "application/gzip", self.description, content)


def carried_files(results: Mapping[str, Any], words: Mapping[str, str]) -> tuple[CarriedFile, CarriedFile]:
    """Return the configuration and the results, in the order of their names."""
    text = encoded(results_text(results))
    return (
        CarriedFile(CONFIG, "application/yaml", words["configuration"], config_content(results), "Source"),
        CarriedFile(RESULTS, "application/json", words["carried_results"], text),
    )
