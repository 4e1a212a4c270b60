"""What became of a machine that was to be mended, in words."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.design.advice import InputChange, Mended
from diecut_report.design.conflicts import CheckConflict
from diecut_report.languages.phrases import Counted, Phrase, phrase
from diecut_report.languages.speech import localised
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import UnitError, number_and_unit


def lines(found: Mended) -> Iterator[str]:
    """Yield what became of the machine, in words."""
    failing = [name for name, _ in found.before.checks("fail")]
    if not failing:
        words = "no check fails: nothing is to be mended (governing: {check})"
        yield Phrase(words, check=found.before.governing or phrase("none"))
        return
    yield Counted(
        len(failing), "{n} check fails today: {checks}", "{n} checks fail today: {checks}", checks=", ".join(failing)
    )
    if found.machine is None:
        yield from _without(found)
        return
    one = "with {n} change none fails, calculated as a machine of its own:"
    yield Counted(len(found.changes), one, "with {n} changes none fails, calculated as a machine of its own:")
    width = max(len(each.name) for each in found.changes)
    yield from (_change(each, width) for each in found.changes)
    words = "sum of the changes: {size} % of today's values; governing: {check}"
    yield Phrase(
        words, size=localised(number_text(100 * found.size, 3)), check=found.machine.governing or phrase("none")
    )
    if warned := [name for name, _ in found.machine.checks("warn")]:
        yield Phrase("with a warning: {checks}", checks=", ".join(warned))


def share_told(share: float) -> str:
    """Return a change as a share of today's value, in percent with a sign: two digits, or a whole number of more."""
    percent = 100 * share
    told = number_text(round(percent) if abs(percent) >= 100 else percent, 2)
    return f"{'+' * (share > 0)}{localised(told)} %"


def _change(change: InputChange, width: int) -> Phrase:
    share = "" if change.share is None else f"  ({share_told(change.share)})"
    before = change.before or phrase("not given")
    return Phrase(
        "  {name}  {before} → {after}{share}",
        name=change.name.ljust(width),
        before=before,
        after=_said(change.after),
        share=share,
    )


def _said(typed: str) -> str:
    """A value as it is typed, with its unit as one writes it."""
    try:
        number, own = number_and_unit(typed)
    except UnitError:  # a text or a yes/no
        return typed
    return with_unit(f"{number}", own or "1")


def _without(found: Mended) -> Iterator[Phrase]:
    words = "none of the {machines} machines that were calculated with other values of the free inputs ({free}) passes"
    if found.calculated:
        yield Phrase(words, machines=found.calculated, free=found.free)
    if found.is_ended:
        yield phrase(
            "that is as many as the search may calculate: it is not at its end; let it calculate more with --most"
        )
    if found.calculated and found.left:
        one = "of the best of them {n} check fails: {checks}"
        many = "of the best of them {n} checks fail: {checks}"
        yield Counted(len(found.left), one, many, checks=", ".join(found.left))
    if found.conflict:
        yield from _conflict(found.conflict)
    if found.untried:
        words = "not tried, as --free must name them, and then names all that may be changed: {names}"
        yield Phrase(words, names=", ".join(found.untried))
    yield phrase("let more inputs be changed with --free, or change what the machine is made of")


def _conflict(found: CheckConflict) -> Iterator[Phrase]:
    """What is proved of it, and what is not."""
    count, checks = len(found.checks), ", ".join(found.checks)
    if found.is_proved:
        one = "proved: {checks} follows from none of the free inputs, and fails with all of their values"
        many = "proved: {checks} follow from none of the free inputs, and fail with all of their values"
        yield Counted(count, one, many, checks=checks)
    elif count == 1:
        yield Phrase("no machine was found in which {checks} holds; that there is none is not proved", checks=checks)
    elif found.is_least:
        yield Phrase(
            "no machine was found in which these hold together; that there is none is not proved: {checks}",
            checks=checks,
        )
        yield phrase("with any one of them left out, the others hold in a machine that was calculated")
    else:
        words = "no machine was found in which these hold together, of which not all may be needed for that: {checks}"
        yield Phrase(words, checks=checks)
