"""What each sheet says of the document: title, number, revision, date, status, and whether it may be released at all."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.results.plugin_checks import calculated, is_doubtful

Data = Mapping[str, Any]
PLAIN, ISO, DSTU = "plain", "iso7200", "dstu2104"
DRAFT, RELEASED = "draft", "released"
FIELDS = (
    "title", "document_number", "revision", "date", "organisation", "department", "document_type", "prepared_by",
    "checked_by", "norm_checked_by", "approved_by",
)  # fmt: skip
REVISION = ("revision", "date", "description", "by")
SIGNERS = ("prepared", "checked", "norm_checked", "approved")
"""Who signs a report; a PDF has a field for each that is named after it."""
LOWER_WORD = re.compile(r"(?<![^\W_])(?![A-ZА-ЯІЇЄҐ])[^\W\d_]{3,}")


@dataclass(frozen=True)
class TitleBlock:
    """What stands in the title block; ``project`` holds its texts, of which one that is not given is empty."""

    project: Data
    press: str
    frame: str
    status: str  # in words
    is_held: bool  # it may not be released: a check fails or is not made

    @property
    def signers(self) -> list[tuple[str, str]]:
        """Who signs, with their names; norm control where somebody does it, or the frame has a place for it."""
        is_asked = self.frame == DSTU or self.project["norm_checked_by"]
        return [(key, self.project[f"{key}_by"]) for key in SIGNERS if key != "norm_checked" or is_asked]


def title_block(results: Data, words: Catalogue) -> TitleBlock:
    """Return what the sheets of a report say of it."""
    asked = results.get("report", {})
    is_held = held(results)
    status = asked.get("status", DRAFT)
    shown = words["not_released"] if is_held and status == RELEASED else words[f"status_{status}"]
    return TitleBlock(
        _texts(results["project"], words), results["press"]["name"], asked.get("frame", PLAIN), shown, is_held
    )


def held(results: Data) -> bool:
    """Return whether a calculation cannot be released: a check fails, is not made, something could not be calculated, or formulas have faults."""
    parts = calculated(results)
    is_left = any(check["status"] == "not_checked" for data in parts for check in data.get("checks", ()))
    return is_left or any(map(is_doubtful, parts)) or results["status"] not in ("pass", "warn")


def _texts(project: Data, words: Catalogue) -> Data:
    """The project's texts; what is not given is empty, but for the type of the document."""
    revisions = [{key: str(row.get(key) or "") for key in REVISION} for row in project.get("revisions") or ()]
    found = {key: str(project.get(key) or "") for key in FIELDS}
    return found | {"document_type": found["document_type"] or words["calculation"], "revisions": revisions}


def machine_named(name: str, words: Catalogue) -> str:
    """What is calculated, as the first sheet names it: a designation as that of a press, a name in words as it is."""
    is_said = LOWER_WORD.search(name) or name.casefold().startswith(words["press"].casefold())
    return name if is_said else f"{words['press']} {name}"
