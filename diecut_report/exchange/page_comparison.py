"""Whether a document is, byte for byte, what this program makes of the results in it, but for signatures."""

from __future__ import annotations

from collections.abc import Callable

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.exchange.carried_results import CarriedResults
from diecut_report.exchange.rendering import document, template_of
from diecut_report.exchange.signatures import Signature
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.report.house_style import HouseStyle

SHORT = 12  # of a hash, as in a report
Found = tuple[str, bool]  # what was found, in words, and whether it is as it should be
MADE = phrase("byte for byte what the program makes of these results")
SIGNED = phrase("byte for byte what the program makes of these results, and after it the signatures")
PAINTED = phrase(
    "not what the program makes of these results: what was added later, with a signature, changes what the document shows or holds"
)
OTHERS = phrase(
    "not what the program makes of these results: it was changed or saved by another program, or set with other libraries of "
    "the system. The numbers above are those that it carries; what its pages show may be others"
)


def compared(
    carried: CarriedResults, signed: list[Signature], house: HouseStyle | None, discovery: Discovery, tell: Callable[[str], None]
) -> Found:  # fmt: skip
    """Return whether the pages of a report are those that are set again of its results, and nothing was added but signatures."""
    if reason := other_templates(carried, house):
        return reason, False
    made, content = _set_again(carried, tell, house, discovery), carried.content
    if content == made:
        return MADE, True
    if not (carried.form == "pdf" and content.startswith(made)):
        return OTHERS, False
    from diecut_report.exchange.later_changes import only_signed

    if not signed or not all(each.holds for each in signed):
        words = "what the program makes of these results, with {more} bytes that were added later (a signature, a note)"
        return Phrase(words, more=len(content) - len(made)), False
    return (SIGNED, True) if only_signed(made, content) else (PAINTED, False)


def other_templates(carried: CarriedResults, house: HouseStyle | None) -> str:
    """Return why the pages cannot be compared with the templates that are given; nothing where they can."""
    asked = template_of(carried.results)
    if asked == (house.sha256 if house else ""):
        return ""
    own = Phrase("templates of their own (SHA-256 {asked})", asked=asked[:SHORT])
    own = own if asked else phrase("the program's templates alone")
    return Phrase("not compared, since they are set with {own}; --template DIR names the templates", own=own)


def _set_again(
    carried: CarriedResults, tell: Callable[[str], None], house: HouseStyle | None, discovery: Discovery
) -> bytes:
    """What this program makes of the results in a document, in the document's form."""
    catalogues = pipeline.catalogues_of(carried.results, discovery, [carried.form], str(carried.path))
    contents, _ = document(carried.results, [carried.form], tell, str(carried.path), catalogues, house)
    return contents[carried.form]
