"""What `verify` found of a report, as lines for a terminal."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from diecut_report.languages.phrases import Counted, Phrase, cell, phrase
from diecut_report.languages.speech import said, say

if TYPE_CHECKING:
    from diecut_report.exchange.agreement import Agreement, Difference
    from diecut_report.exchange.carried_results import CarriedResults
    from diecut_report.exchange.recalculation import Found
    from diecut_report.exchange.verification import Verification

SHOWN = 20  # differences that are told


def verification_lines(carried: CarriedResults, found: Verification) -> Iterator[str]:
    """Give what was found of a report line by line, and last whether everything agrees."""
    project = carried.results["project"]
    named = [str(project.get(key) or "") for key in ("title", "document_number", "revision")]
    yield f"{carried.path}: {', '.join(map(cell, filter(None, named)))}"
    yield _line(say("program"), found.program)
    yield from (_line(say("plugins"), told) for told in found.plugins)
    yield _line(say("configuration"), found.config)
    yield from (_line(say("options"), each) for each in found.options)
    yield _line(say("numbers"), (_numbers(found.agreement), not found.agreement.differences))
    yield from (f"    {_difference(each)}" for each in found.agreement.differences[:SHOWN])
    if len(found.agreement.differences) > SHOWN:
        yield say("    and {n} more", n=len(found.agreement.differences) - SHOWN)
    if found.pages:
        yield _line(say("pages"), found.pages)
    elif carried.form != "json":
        yield f"– {say('pages'):13}  {say('not compared, since --numbers asks for the results alone')}"
    yield from (_line(say("signature"), (each.words, each.holds)) for each in found.signatures)
    if carried.form == "pdf" and not found.signatures:
        yield _line(say("signature"), (phrase("none: the report is not signed"), True))
    yield _last(carried, found)


def _last(carried: CarriedResults, found: Verification) -> str:
    if not found.holds:
        return say("Not everything agrees.")
    if found.pages is None and carried.form != "json":
        return say("The results agree; what the pages show was not compared.")
    return say("Everything agrees.")


def _line(what: str, told: Found) -> str:
    words, good = told
    return f"{'✓' if good else '✗'} {what:13}  {said(words)}"


def _numbers(found: Agreement) -> str:
    agreeing = found.numbers - found.differing
    some = Phrase("{n} of them exactly", n=found.exact)
    exactly = phrase("all of them exactly") if found.exact == found.numbers else some
    if not found.differences:
        return Phrase("{n} of {total} agree, {exactly}", n=found.numbers, total=found.numbers, exactly=exactly)
    others = len(found.differences) - found.differing
    texts = Counted(others, ", and {n} other value differs", ", and {n} other values differ") if others else ""
    words = "{n} of {total} agree{texts}; in the report, and calculated now:"
    return Phrase(words, n=max(agreeing, 0), total=found.numbers, texts=texts)


def _difference(each: Difference) -> str:
    return f"{each.path}: {_value(each.first)} → {_value(each.second)}"


def _value(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, dict | list):
        return say("a block of keys") if isinstance(value, dict) else say("a list of {n}", n=len(value))
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= 80 else f"{text[:80]}…"
