"""Papers that plugins call by a number of their own, by their place in the report's list of sources: 002 eq. 6 as [2] eq. 6."""

from __future__ import annotations

import re

from diecut_report.results.model import ResultsRecord
from diecut_report.results.record import TextRole

PAPER = re.compile(r"\d{3}")
BRACKETS = re.compile(r"\((\[\d+\])\)")  # about the brackets of a number
CITING = (TextRole.TEXT, TextRole.DRAWN, TextRole.SOURCE)


def numbered(results: ResultsRecord) -> ResultsRecord:
    """Return the results with each paper named by its number in the list of sources, in brackets."""
    ids = {source.id for data in results.calculated.values() for source in data.sources}
    papers = {id: f"[{number}]" for number, id in enumerate(sorted(filter(PAPER.fullmatch, ids)), 1)}
    if not papers:
        return results
    named = re.compile(rf"(?<![\w.,\u202f\u2009\u00a0−-])(?<!\d )(?:{'|'.join(papers)})(?![\w\u202f\u2009\u00a0]|\.\d)")

    def text(role: TextRole, text: str) -> str:
        """Name papers by their numbers; what follows digits is no paper: 10 000 h. A text that names none stays, so that it can be translated."""
        made = named.sub(lambda found: papers[found[0]], text) if role in CITING else text
        return text if made == text else BRACKETS.sub(r"\1", made)

    return results.with_(
        mechanisms={name: data.with_texts(text) for name, data in results.mechanisms.items()},
        comparisons={name: data.with_texts(text) for name, data in results.comparisons.items()},
        changes=results.changes and results.changes.with_texts(text),
    )
