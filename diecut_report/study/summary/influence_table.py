"""The influence of the inputs as a table with charts."""

from __future__ import annotations

import re
from typing import NamedTuple

from diecut_report.languages.speech import localised
from diecut_report.study.summary.figures import Figures, SummaryFigure
from diecut_report.study.summary.influence import Influence, Share
from diecut_report.study.summary.quantity_names import named, variants

CHARTED = 3  # quantities that influence is drawn for


class Ranked(NamedTuple):
    """Hold the influence of the inputs: quantities and, for each input, a text for each of them; charts of the first quantities."""

    targets: list[str]
    rows: list[tuple[str, list[str]]]
    figures: list[SummaryFigure]
    variants: str


def ranked(found: list[Influence], figures: Figures) -> Ranked:
    """Return one table for all quantities, its inputs in the order of the first of them."""
    by_target = [{share.column: share for share in each.shares} for each in found]
    inputs = list(dict.fromkeys(column for shares in by_target for column in shares))
    rows = [(named(column), [_share(shares.get(column)) for shares in by_target]) for column in inputs]
    drawn = [figures.influence(each) for each in found if each.is_certain and each.telling][:CHARTED]
    return Ranked([named(each.target) for each in found], rows, drawn, variants(max(each.variants for each in found)))


def _share(share: Share | None) -> str:
    if share is None or not share.is_certain or not share.is_telling:
        return "–"
    if share.total is not None:
        text = f"{share.first:.2f} ± {share.first_error or 0:.2f} / {share.total:.2f} ± {share.total_error or 0:.2f}"
    else:
        text = f"{share.first:.2f}" if share.column.kind == "text" else f"{share.first:+.2f}"
    return localised(re.sub(r"[-+](?=0\.00)", "", text).replace("-", "−"))
