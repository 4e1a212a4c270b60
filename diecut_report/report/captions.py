"""Captions of a chapter's figures: a long sentence that an earlier one has said is not said again."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from diecut_report.report.figure_places import Placed

BETWEEN = re.compile(r"(?<=[.!?]) (?=[^\W\d_])")  # of sentences
LONG = 80  # letters; a shorter one, as what is shaded, stands with each figure


def told_once(figures: Sequence[Placed]) -> Iterator[Placed]:
    """Yield the figures in their order, each caption without the long sentences of those before it."""
    told: set[str] = set()
    for each in figures:
        sentences = BETWEEN.split(each.figure["caption"])
        left = [text for text in sentences if text not in told]
        told.update(text for text in sentences if len(text) >= LONG)
        yield each._replace(figure={**each.figure, "caption": " ".join(left)})
