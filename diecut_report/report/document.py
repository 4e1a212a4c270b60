"""The report's content in its order, ready for any template: what is said where, with its numbers. No markup but symbols."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import cos, radians, sin
from pathlib import PurePath
from typing import Any

from diecut_report.report.chapters.chapters import chapter
from diecut_report.report.chapters.drive_line import DriveLineFigure, drive_line_figures
from diecut_report.report.chapters.front import (
    NUMBER,
    NotCovered,
    OpenGroup,
    PrintedInfluence,
    followed_line,
    machine_facts,
    not_covered,
    open_groups,
    printed_influence,
)
from diecut_report.report.chapters.repetition import ToldBefore
from diecut_report.report.equations import Equations
from diecut_report.report.model import (
    CheckRow,
    JudgedPart,
    PrintedChapter,
    QuantityRow,
    judged_parts,
    quantity_row,
    rested,
)
from diecut_report.report.scope import BRIEF, FULL, Scope, parts, scope
from diecut_report.report.symbols import BOLD, drawn, measured
from diecut_report.report.text import Catalogue, sentence
from diecut_report.results.model import (
    ChangedDocumentRecord,
    ConfigRecord,
    PressRecord,
    ProgramRecord,
    ResultsRecord,
)
from diecut_report.text.translation import said, speaking

# What each sheet says of the document: title, number, revision, date, status, and whether it may be released at all.


Data = Mapping[str, Any]
ISO, DSTU, RELEASED = "iso7200", "dstu2104", "released"
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


def title_block(results: ResultsRecord, words: Catalogue) -> TitleBlock:
    """Return what the sheets of a report say of it."""
    project, status, is_held = results.project, results.report.status, held(results)
    texts: dict[str, Any] = {key: getattr(project, key) or "" for key in FIELDS}
    texts["document_type"] = project.document_type or words["calculation"]
    texts["revisions"] = [{key: getattr(row, key) or "" for key in REVISION} for row in project.revisions]
    shown = words["not_released"] if is_held and status == RELEASED else words[f"status_{status}"]
    return TitleBlock(texts, results.press.name, results.report.frame, shown, is_held)


def held(results: ResultsRecord) -> bool:
    """Return whether a calculation cannot be released: a check fails, is not made, something could not be calculated, or formulas have faults."""
    parts = results.calculated.values()
    is_left = any(check.status == "not_checked" for data in parts for check in data.checks)
    return is_left or any(data.is_doubtful for data in parts) or results.status not in ("pass", "warn")


def machine_named(name: str, words: Catalogue) -> str:
    """What is calculated, as the first sheet names it: a designation as that of a press, a name in words as it is."""
    is_said = LOWER_WORD.search(name) or name.casefold().startswith(words["press"].casefold())
    return name if is_said else f"{words['press']} {name}"


APPENDIX = (
    ("self-tests", "5.1", "self_test_list"),
    ("curves", "5.2", "curves"),
    ("configuration", "5.3", "configuration"),
)
CONTENTS_COLUMNS = 3
MOST_CONTENTS = 80  # lines, for which the contents leave room for the verdict on the first sheet


@dataclass(frozen=True)
class ReportDocument:
    """A whole report."""

    block: TitleBlock
    results: ResultsRecord
    detail: str
    chapters: list[PrintedChapter]
    words: Catalogue
    verdict: str
    counts: list[str]
    notes: list[str]
    press_rows: list[QuantityRow]
    facts: list[tuple[str, str]]
    drive_line: list[tuple[str, DriveLineFigure]]
    not_covered: list[NotCovered]
    open_groups: list[OpenGroup]
    contents: list[tuple[str, str, str, int]]
    influence: PrintedInfluence | None

    @property
    def press(self) -> PressRecord:
        return self.results.press

    @property
    def program(self) -> ProgramRecord:
        """What calculated it."""
        return self.results.program

    @property
    def config(self) -> ConfigRecord:
        return self.results.config

    @property
    def status(self) -> str:
        return self.results.status

    @cached_property
    def checks(self) -> list[CheckRow]:
        """The checks that are made of the machine, the most important first."""
        rows = (row for part in self.chapters for row in part.checks if row.is_made)
        return sorted(rows, key=lambda row: row.order)

    @property
    def failures(self) -> list[CheckRow]:
        """What fails, first what the machine does not do that it is for, then what breaks."""
        failed = (row for row in self.checks if row.status == "fail")
        return sorted(failed, key=lambda row: row.check_class != "function")

    @property
    def unchecked(self) -> list[CheckRow]:
        """The checks that are not made."""
        return [row for part in self.chapters for row in part.checks if row.status == "not_checked"]

    @property
    def sized(self) -> list[CheckRow]:
        """The checks of what the program sized to their limits."""
        return [row for row in self.checks if row.is_sized]

    @property
    def self_tests(self) -> list[CheckRow]:
        """The self-tests of the calculation."""
        return [row for part in self.chapters for row in part.checks if row.is_self_test]

    @property
    def governing(self) -> CheckRow | None:
        """The check that governs the whole."""
        named = self.results.governing
        found = (row for row in self.checks if named and (row.mechanism, row.id) == (named.mechanism, named.check))
        return next(found, None)

    @property
    def sources(self) -> list[tuple[str, str]]:
        """All sources of the mechanisms, each once, with its ids; several papers of one volume share an id."""
        found: dict[str, set[str]] = {}
        for _, data in parts(self.results):
            for source in data.sources:
                found.setdefault(source.citation, set()).add(source.id)
        named = ((", ".join(sorted(ids)), citation) for citation, ids in found.items())
        return sorted(named, key=lambda source: (not source[0].startswith("["), source[0].casefold(), source[1]))

    @property
    def errata(self) -> list[tuple[str, str, str]]:
        """What was found wrong in the sources that this press uses, each once."""
        return list(dict.fromkeys(erratum for part in self.chapters for erratum in part.errata))

    @property
    def columns(self) -> list[list[tuple[str, str, str, int]]]:
        """The contents in columns of about equal length; of a long report its chapters alone."""
        is_long = len(self.contents) > MOST_CONTENTS
        lines = [line for line in self.contents if line[3] == 1 or not is_long]
        size = -(-len(lines) // CONTENTS_COLUMNS)
        return [lines[start : start + size] for start in range(0, len(lines), size)]

    @property
    def judged_parts(self) -> list[JudgedPart]:
        """The rows of the first page."""
        return judged_parts(self.chapters)

    @property
    def face(self) -> str:
        """The verdict as it is shown; where a mechanism could not be calculated, that."""
        return "error" if self.status == "error" else str(self.results.summary.verdict)

    @property
    def faces(self) -> Data:
        """The verdicts of the chapters as they are shown, by the anchors of the chapters."""
        return {part.anchor: part.face for part in self.chapters}

    @property
    def project(self) -> Data:
        """The texts of the title block."""
        return self.block.project

    @property
    def title(self) -> str:
        return str(self.project["title"])


def document(results: ResultsRecord, equations: Equations, words: Catalogue) -> ReportDocument:
    """The report of the results."""
    whole, block = scope(results), title_block(results, words)
    results, is_brief = whole.results, whole.detail == BRIEF
    chapters = _chapters(whole, equations, words)
    rows = [rested(quantity_row(row, words["decimal"]), row, words) for row in results.press.fields]
    drawn = _drive_line(results, chapters, words)
    with speaking(words.language):
        verdict = said(results.summary.conclusion)
    return ReportDocument(
        block, results, whole.detail, chapters, words, verdict,
        counts=_counts(results, chapters, words),
        notes=[*_notes(whole, chapters, words)],
        press_rows=rows,
        facts=machine_facts(results, words),
        drive_line=drawn,
        not_covered=not_covered(results, words),
        open_groups=open_groups(results, words),
        contents=list(_contents(chapters, words, whole.detail, results)),
        influence=None if is_brief else printed_influence(results, words, len(drawn)),
    )  # fmt: skip


def _drive_line(
    results: ResultsRecord, chapters: list[PrintedChapter], words: Catalogue
) -> list[tuple[str, DriveLineFigure]]:
    """The views of the drive line with their numbers, their parts leading to the chapters."""
    checks = {name: data.checks for name, data in results.mechanisms.items()}
    links = {part.name: f"#{part.anchor}" for part in chapters}
    found = drive_line_figures(results.drive_line, checks, links, words)
    return [(NUMBER.format(n=index), each) for index, each in enumerate(found, 1)]


def _chapters(whole: Scope, equations: Equations, words: Catalogue) -> list[PrintedChapter]:
    results = whole.results
    stem = PurePath(results.config.file).stem
    told: dict[str, ToldBefore] = {}
    chapters = []
    for name, data in parts(results):
        letter, kind = whole.letters[name], data.kind
        known = told.setdefault(kind, ToldBefore())
        chapters.append(chapter(letter, name, data, equations, words, stem, whole.detail, known))
        told[kind] = known.next(letter)
    shared = Counter(part.title for part in chapters)
    mechanisms = {part.name: part for part in chapters[: len(results.mechanisms)]}
    left = {each.path.split(".")[1] for each in results.summary.open if each.path.startswith("mechanisms.")}
    for part in chapters:
        part.is_open = part.name in left
        part.is_named = shared[part.title] > 1
        part.title = f"{part.title}: {part.name}" if part.is_named else part.title
        part.between = [mechanisms[name] for name in part.record.between]
    return chapters


def _counts(results: ResultsRecord, chapters: list[PrintedChapter], words: Catalogue) -> list[str]:
    """How many checks pass, as a sentence begins (the first line tells what does not), how many parts are rated, which comparisons are not made."""
    count, left = sum(part.count("pass") for part in chapters), results.comparisons_left_out
    counts = [words.say("count_pass", n=count)] if count else []
    if parts := results.summary.parts:
        counts.append(words.say("count_rated", rated=parts.rated, carrying=parts.carrying))
    counts += [left.message.removesuffix(".")] if left else []
    return [sentence(text) if not k else text for k, text in enumerate(counts)]


def _notes(whole: Scope, chapters: list[PrintedChapter], words: Catalogue) -> Iterator[str]:
    """What stands below the verdict: plugins with faults in their formulas, what the report does not show, the self-tests that hold, advice."""
    for kind in dict.fromkeys(part.record.kind for part in chapters if part.record.is_doubtful):
        yield words.say("doubtful_plugin", kind=kind)
    if whole.is_part:
        told = {"n": len(whole.results.mechanisms), "total": whole.total, "status": words[whole.verdict]}
        yield words.say("only_part", **told)
    rows = [row for part in chapters for row in part.checks]
    if held := sum(row.is_self_test and row.status == "pass" for row in rows):
        yield words.say("self_tests", n=held)
    yield from followed_line(whole.results, words, rows)


def former(old: ChangedDocumentRecord, new: ChangedDocumentRecord, words: Catalogue) -> str:
    """The title of what changed since the former document, which its revision names, or its file."""
    if old.revision and old.revision != new.revision:
        return words.say("changes_since_revision", name=old.revision)
    return words.say("changes_since", name=old.file)


def _contents(
    chapters: list[PrintedChapter], words: Catalogue, detail: str, results: ResultsRecord
) -> Iterator[tuple[str, str, str, int]]:
    yield "summary", "1", words["summary"], 1
    if changes := results.changes:
        yield "changes", "", former(changes.old, changes.new, words), 1
    if detail == BRIEF:
        yield "key-results", "2", words["key_results"], 1
        yield from ((part.anchor, part.letter, part.title, 2) for part in chapters)
        return
    if results.influence:
        yield "influence", "", words["influence"], 1
    yield "press", "2", words["press_data"], 1
    for part in chapters:
        yield part.anchor, part.letter, part.title, 1
        for heading in part.headings:
            yield heading.anchor, heading.number, heading.title, 2
    yield "sources", "3", words["sources"], 1
    yield "program", "4", words["program"], 1
    if detail == FULL:
        yield "appendix", "5", words["appendix"], 1
        yield from ((anchor, number, words[key], 2) for anchor, number, key in APPENDIX)


# What lies behind each sheet's text: the frame, and words across a report that may not be released. Pictures, no text to be read.


WIDTH, HEIGHT = 210, 297  # millimetres
FRAMES = {ISO: (20, 10, 10, 10), DSTU: (20, 5, 5, 5)}  # margins in millimetres: left, top, right, bottom
ACROSS = 0.66  # of the diagonal
HIGHEST = 34.0  # millimetres of an em
SLOPE = radians(54.7)
LINE, STAMP = "0.082 0.11 0.149 RG 0.5 w", "0.957 0.871 0.871 rg"  # ink and width
RULE = '@page {{ background: url("{}") no-repeat fixed; background-size: 210mm 297mm }}'


class Backdrop:
    """An image as WeasyPrint wants it (``get_intrinsic_size``, ``draw``) of what lies behind a sheet; false where that is nothing."""

    def __init__(self, frame: str, across: str) -> None:
        self.operators = _across(across) if across else ""
        if frame in FRAMES:
            left, top, right, bottom = FRAMES[frame]
            self.operators += f" {LINE} {left} {bottom} {WIDTH - left - right} {HEIGHT - top - bottom} re S"

    def __bool__(self) -> bool:
        return bool(self.operators)

    def get_intrinsic_size(self, _resolution: float, _font_size: float) -> tuple[float, float, float]:
        """Width, height and their ratio; the style gives the size on the sheet."""
        return WIDTH, HEIGHT, WIDTH / HEIGHT

    def draw(self, stream: Any, width: float, height: float, _style: Any) -> None:
        """Draw it into a sheet (y downwards)."""
        stream.transform(width / WIDTH, 0, 0, -height / HEIGHT, 0, height)
        stream.stream.append(self.operators)


def _across(text: str) -> str:
    width = measured(text, BOLD)
    size = min(ACROSS * (WIDTH**2 + HEIGHT**2) ** 0.5 / width, HIGHEST)
    along, up = size * cos(SLOPE), size * sin(SLOPE)
    start = f"1 0 0 1 {-width / 2:.4g} -0.36 cm"
    return f"q {STAMP} {along:.5g} {up:.5g} {-up:.5g} {along:.5g} {WIDTH / 2:g} {HEIGHT / 2:g} cm {start} {drawn(text, BOLD)} Q"
