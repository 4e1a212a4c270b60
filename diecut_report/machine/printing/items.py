"""The calculation as it is printed: for each step an item with its formula, the numbers in it and the result."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.printing.page import Page
from diecut_report.mechanism.steps import Step
from diecut_report.mechanism.steps.protocols import Item
from diecut_report.text.phrases import Phrase, phrase

TO_ROUNDING = "0 to machine precision"


def section_items(calc: Calculation) -> list[Item]:
    """Return the chapters of the calculation with their items, for the first (only) machine."""
    page = Page(calc)
    chapters: dict[str, Item] = {}
    for section, step in calc.mechanism.active(calc.given):
        chapter = chapters.setdefault(section.title, {"title": section.title, "text": section.text, "items": []})
        chapter["items"] += _once(chapter["items"], [*_with_rounding(calc, items(calc, step))])
        if step.is_shown_at_place and calc.axis.get(step.id) in calc.domains:
            place = page.shown(calc.axis[step.id])
            chapter["shown"] = [*(at for at in chapter.get("shown", []) if at != place), place]
    return [chapter for chapter in chapters.values() if chapter["items"]]


def items(calc: Calculation, step: Step) -> list[Item]:
    """Return what is printed of a step (nothing of breakpoints and requirements)."""
    if not step.printed:
        return []
    row = calc.values[step.id][0] if step.exists is not None and step.id in calc.values else None
    if row is not None and row.dtype.kind in "fc" and np.isnan(row).all():
        text = Phrase("{title}: does not apply to this machine.", title=phrase(step.description))
        return [step.head() | {"type": "note", "text": text}]
    return step.items(Page(calc))


def _with_rounding(calc: Calculation, items: Iterable[Item]) -> Iterator[Item]:
    for item in items:
        is_zero = item.get("result", {}).get("text") == "0" and item["id"] not in calc.axis and "note" not in item
        yield item | {"note": TO_ROUNDING} if is_zero and calc[item["id"]][0, 0] else item


def _once(before: list[Item], new: list[Item]) -> list[Item]:
    """New items; of numbers taken one after another from a table of several columns the first alone names its sources."""
    last = before[-1] if before else {}
    for item in new:
        is_again = item["type"] == last.get("type") == "lookup" and "column" in item
        if is_again and (item["table"], item["key"]) == (last["table"], last["key"]):
            item.pop("note")
    return new
