"""A report made again from its results alone, whoever wrote them: nothing is calculated, and what cannot be set is told in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from diecut_report.config.plugins import Discovery
from diecut_report.design.findings import decided
from diecut_report.errors import MAX_PRINTED_MECHANISMS, PluginError, Problem, UserError, refusal
from diecut_report.exchange.carried import MOST as SIDES_MOST
from diecut_report.exchange.carried import carried_results, form_of, other_form
from diecut_report.files import content, write_all
from diecut_report.press import AskedReport, Drawn, Lost, Press, ReportOutcome, Source, Tell, drawn, exported
from diecut_report.report.chapters.front import ChangedCheck, ChangedRow, printed_changes
from diecut_report.report.pages import html
from diecut_report.report.pages.firm_templates import HouseStyle
from diecut_report.report.text import Catalogue, translated_changes
from diecut_report.results.conclusion import doubtful
from diecut_report.results.model import ChangedDocumentRecord, ChangesRecord, ResultsRecord
from diecut_report.text.catalogues import Catalogues
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import say, spoken_language


def render(
    file: Path, folder: Path, formats: Sequence[str], tell: Tell, discovery: Discovery, language: str | None = None,
    house: HouseStyle | None = None,
) -> tuple[ReportOutcome, list[Lost]]:  # fmt: skip
    """Write the report of a results file, or of a report, as ``STEM.html``, ``STEM.pdf`` and the exports beside it.

    Return what was written, and the figures and exports that could not be drawn. UserError where nothing can be made of the file.
    """
    carried = carried_results(file)
    results = AskedReport(language, house=house).noted(carried.results)
    if not house:  # the pages may be set with other templates than those were
        results = results.with_(report=results.report.with_(template_sha256=""))
    made, (profiles, unwritten) = document(results, formats, discovery, tell, str(file), house), exported(results, tell)
    files = {folder / f"{file.stem}.{ending}": content for ending, content in (made.contents | profiles).items()}
    write_all(files, keep=file)
    outcome = ReportOutcome(results, tuple(files), (), (*made.untranslated, *doubtful(results)))
    return outcome, [*made.lost, *unwritten]


def document(
    results: ResultsRecord, formats: Sequence[str], discovery: Discovery, tell: Tell, file: str, house: HouseStyle | None = None
) -> Drawn:  # fmt: skip
    """Return a report of results, as ``drawn`` does; UserError where these are not results of the program."""
    count = len(results.mechanisms)
    if "pdf" in formats and count > MAX_PRINTED_MECHANISMS:
        template = "There are {count} mechanisms; a PDF has at most {most}. Leave it out with --format html."
        raise refusal(template, file, count=count, most=MAX_PRINTED_MECHANISMS)
    try:
        return drawn(results, formats, discovery, tell, house, file)
    except UserError:
        raise
    except Exception as cause:  # of any kind: whoever wrote the file may have put anything in any place
        missing = Phrase("{cause} is missing", cause=cause) if isinstance(cause, KeyError) else None
        template = "The report cannot be made of these results: {told}. Give results as the program wrote them."
        message = Phrase(template, told=missing or f"{type(cause).__name__}: {cause}")
        raise UserError([Problem(each, file) for each in (message, other_form(results.data())) if each]) from cause


def told(lost: Iterable[Lost]) -> list[str]:
    """Return in words what could not be drawn."""
    template = "{what} {id} of mechanism {mechanism} cannot be drawn: {words}"
    return [Phrase(template, what=phrase(each.what), id=repr(each.id), mechanism=repr(each.mechanism), words=phrase(each.words))
            for each in lost]  # fmt: skip


# What changed between two calculations, as one HTML file without scripts or network.


def page(changes: ChangesRecord) -> str:
    """Return the page of the changes of `results.changes`."""
    words = Catalogue(spoken_language())
    made = printed_changes(changes, words)
    title = words.say("changes_of", old=made.names[0], new=made.names[1])
    return html.styled_page("diff.html.j2", "screen", ("changes",), c=made, title=title)


# What changed between two calculations, as lines for a terminal.


WIDEST = 60  # letters of a column; what is longer is not aligned
MOST = {"changed_checks": 40, "changed_inputs": 40, "changed_outputs": 20}  # rows of a block
Cells = Sequence[str]


def lines(changes: ChangesRecord, *, all_rows: bool = False) -> Iterator[str]:
    """Give the changes of `results.changes` line by line; of the results the first ones, with the others counted."""
    words = Catalogue(spoken_language())
    made = printed_changes(changes, words)
    yield from _aligned([_head(say("old"), made.old, words), _head(say("new"), made.new, words)], indent="")
    if not made:
        yield words["no_changes"]
    mechanisms = [(name, old, "→", new) for name, old, new in made.mechanisms]
    yield from _block("changed_mechanisms", mechanisms, words, all_rows)
    yield from _block("changed_checks", [_check(row, words) for row in made.checks], words, all_rows)
    yield from _block("changed_inputs", map(_row, made.inputs), words, all_rows)
    if all_rows:
        yield from _block("following_inputs", map(_row, made.following), words, all_rows)
    elif made.following:
        yield say("  and {n} that follow from other changes by reference (--all shows them)", n=len(made.following))
    yield from _block("changed_outputs", map(_row, made.outputs), words, all_rows)
    yield from _block("changed_code", [(name, old, "→", new) for name, old, new in made.code], words, all_rows)


def said_changes(
    changes: ChangesRecord, old: ResultsRecord, new: ResultsRecord, catalogues: Catalogues
) -> ChangesRecord:
    """Return the changes with their texts in the language of the catalogues; ``old`` and ``new`` are the results of both sides."""
    for data in (*old.calculated.values(), *new.calculated.values()):
        catalogues.of(data.kind)
    return translated_changes(changes, catalogues)


def _head(name: str, side: ChangedDocumentRecord, words: Catalogue) -> Cells:
    """What a side is; that all checks hold is no verdict, as values may be open."""
    counts = [f"{n} {words[status]}" for status, n in side.checks.items() if n]
    status = words[side.status] if side.status != "pass" else ""
    revision = say("revision {name}", name=side.revision) if side.revision else ""
    governing = say("governing {check}", check=side.governing) if side.governing else ""
    return name, side.file, revision, status, ", ".join(counts), governing


def _check(row: ChangedCheck, words: Catalogue) -> Cells:
    sides = (row.old_status, row.old), (row.new_status, row.new)
    old, new = (f"{words[status]} {used}".rstrip() if status else "–" for status, used in sides)
    return row.change, f"{row.mechanism}: {row.title}", old, "→", new


def _row(row: ChangedRow) -> Cells:
    return row.path, row.old, "→", row.new, row.change, row.note


def _block(key: str, given: Iterable[Cells], words: Catalogue, all_rows: bool) -> Iterator[str]:
    """A title and its rows, the first ones alone where there are many."""
    if not (rows := list(given)):
        return
    yield ""
    yield f"{words[key]}: {len(rows)}"
    shown = rows if all_rows else rows[: MOST.get(key, len(rows))]
    yield from _aligned(shown)
    if len(shown) < len(rows):
        yield say("  and {n} more (--all shows them)", n=len(rows) - len(shown))


def _aligned(rows: Sequence[Cells], indent: str = "  ") -> Iterator[str]:
    widths = [min(max(map(len, column)), WIDEST) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True) if width)
        yield f"{indent}{'  '.join(cells)}".rstrip()


# One side of a comparison: the results of a report or a results file as they stand, those of a configuration by calculating it.


def side(given: Source, discovery: Discovery, tell: Tell) -> tuple[ResultsRecord, tuple[PluginError, ...]]:
    """Return the results of one side, and the plugins that broke where it was calculated; UserError where it cannot be read."""
    if isinstance(given, Path) and _carries_results(given):
        return carried_results(given).results, ()
    made = decided(Press.read(given, discovery, tell).calculate())
    return made.results, made.broken


def _carries_results(path: Path) -> bool:
    """Whether a file is a report or a results file; a configuration may be written as JSON too."""
    whole = content(path, SIDES_MOST, phrase("a configuration, a results file or a report"))
    form = form_of(whole)
    return form in ("pdf", "html") or (form == "json" and b'"program"' in whole and b'"mechanisms"' in whole)
