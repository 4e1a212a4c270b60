"""What of a study cannot be said in the language that is spoken, as its plugins bring no words for it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.speech import spoken_language


def untranslated(folder: Path, plugins: Sequence[Path]) -> list[str]:
    """Return in words which foreign plugins of a stored study have no words in the language, or not all: these stay English."""
    if spoken_language() == SOURCE_LANGUAGE:
        return []
    from diecut_report.config.catalogues import lacking, spoken_catalogues
    from diecut_report.config.discovery import Discovery
    from diecut_report.study.storage.state import read_state

    return lacking(spoken_catalogues(Discovery(plugins)), read_state(folder)["plugins"])
