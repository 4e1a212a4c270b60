"""What stands before the chapters of a DOCX: title block, contents, summary with the verdict, changes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from diecut_report.report.changes import ChangedCheck, ChangedRow, PrintedChanges
from diecut_report.report.document import ReportDocument, former
from diecut_report.report.model import CheckRow
from diecut_report.report.office.word_body import MARKS, WordBody
from diecut_report.report.office.wordml import (
    FIELD_END,
    Inline,
    TableColumn,
    bold,
    field,
    key,
    link,
    new_line,
    paragraph,
    rich,
    run,
    small,
)
from diecut_report.report.scope import BRIEF, FULL
from diecut_report.report.symbols import prose
from diecut_report.report.title_block import REVISION, machine_named

STATUSES = ("fail", "warn", "pass", "not_checked")


FACTS = (("document", "document_number"), ("revision", "revision"), ("date", "date"))


def title_block(body: WordBody, document: ReportDocument) -> None:
    """Whose calculation of what this is, its status, who signs it, and its revisions."""
    words, project, block = document.words, document.project, document.block
    body.say(
        small(" · ".join(filter(None, (project["organisation"], project["department"], project["document_type"]))))
    )
    body.say(run(document.title), "Title")
    body.say(bold(words["across"]) if block.is_held else "")
    body.say(run(machine_named(document.press["name"], words)))
    facts = [*((words[name], project[of]) for name, of in FACTS), (words["status"], block.status)]
    cells = [small(name) + new_line() + bold(text or "–") for name, text in facts]
    body.table([TableColumn("", 1)] * len(facts), [cells], headed=False)
    columns = [body.head(word, share) for word, share in (("release", 2), ("name", 3), ("date", 2), ("signature", 3))]
    body.table(columns, [[run(words[role]), run(who), "", ""] for role, who in block.signers])
    columns = [
        body.head(word, share) for word, share in (("revision", 1.5), ("date", 2), ("description", 5), ("by", 2.5))
    ]
    body.table(columns, [[run(row[name]) for name in REVISION] for row in project["revisions"]])


def contents(body: WordBody, document: ReportDocument) -> None:
    """A field that the word processor renews with the sheets' numbers; until then the headings with links."""
    body.say(bold(document.words["contents"]), keep=True)
    lines = [
        (depth, link(body.anchor(anchor), run(f"{number}\u2002" if number else "") + rich(prose(title))))
        for anchor, number, title, depth in document.contents
    ]
    begin = field(r'TOC \o "1-2" \h \z \u', is_dirty=True).removesuffix(FIELD_END)
    for index, (depth, line) in enumerate(lines):
        inner = (begin if index == 0 else "") + line + (FIELD_END if index == len(lines) - 1 else "")
        body.parts.append(paragraph(inner, f"TOC{depth}"))


def summary(body: WordBody, document: ReportDocument) -> None:
    """The verdict, what fails, what governs, and how each mechanism fares."""
    words = document.words
    body.heading(1, "1", words["summary"], "summary")
    counts = f" {', '.join(document.counts)}." if document.counts else ""
    is_judged = document.checks or document.unchecked or document.status != "pass"
    body.say((body.status(document.face) + run("  ") if is_judged else "") + bold(document.verdict) + run(counts))
    body.listed(_verdict_lines(body, document))
    if document.detail == FULL:
        _all_checks(body, document)
    elif len(document.chapters) > 1:
        _governing(body, document)
    if document.unchecked:
        body.subheading(words["not_checked"].capitalize())
        columns = [body.head("check", 5), body.head("demand", 2, right=True), body.head("missing", 4)]
        body.table(
            columns, [[_named(body, row), run(row.demand), key(", ".join(row.missing))] for row in document.unchecked]
        )
    _assumed(body, document)
    if document.detail != BRIEF:
        for chapter in document.chapters:
            if not chapter.lost:
                body.subheading(f"{words['key_results']}: {chapter.letter} {chapter.title}")
                body.quantities(chapter.key_results, sourced=False)


def influence(body: WordBody, document: ReportDocument) -> None:
    """What inputs do to the numbers that are looked at, and what tolerances do to the checks."""
    found, words = document.influence, document.words
    if found is None:
        return
    body.heading(1, "", words["influence"], "influence")
    body.tell(found.lead)
    heads = ("influence_lowered", "influence_gives", "influence_raised", "influence_gives")
    columns = [body.head("path", 4), *(body.head(word, 2, right=True) for word in heads)]
    for each in found.tornados:
        body.subheading(each.title)
        if each.rows:
            body.figure(each.number, each.figure["title"], words["influence_caption"])
            body.table(columns, [[key(name), *map(run, values)] for name, *values in each.rows])
        body.tell(each.rest)
    if found.chances:
        body.subheading(words["influence_tolerances"])
        body.tell(found.scatter)
        told = ("influence_probability", "influence_interval", "influence_held")
        columns = [body.head("check", 5), *(body.head(word, 2, right=True) for word in told)]
        rows = [
            [rich(prose(row.title)), run(row.probability), run(row.interval), run(row.held)] for row in found.chances
        ]
        body.table(columns, rows)
        body.tell(found.sure)


def _verdict_lines(body: WordBody, document: ReportDocument) -> Iterator[Inline]:
    words, governing = document.words, document.governing
    for row in document.failures:
        yield run(f"{MARKS['fail']} {row.chapter} · ") + body.linked(row) + run(": ") + rich(prose(row.message))
    for chapter in document.chapters:
        if chapter.lost:
            yield run(f"{MARKS['fail']} {chapter.letter} · {chapter.title}: ") + rich(
                prose(chapter.error or words["skipped_text"])
            )
    if governing:
        margin = f", {words.say('reserve', margin=governing.margin)}" if governing.status == "pass" else ""
        yield (
            run(f"{words['governing']}: {governing.chapter} · ")
            + body.linked(governing)
            + run(f", {governing.used}{margin}")
        )
    if document.sized:
        told = ", ".join(f"{row.chapter} · {row.title} ({row.utilisation})" for row in document.sized)
        yield run(f"{words['sized']}: {told}")
    yield from map(run, document.notes)


def _assumed(body: WordBody, document: ReportDocument) -> None:
    """On what is assumed the verdict rests."""
    words, line = document.words, document.assumed
    if document.assumed_groups:
        body.subheading(words["assumed_values"])
        rows = []
        for group in document.assumed_groups:
            told = [f"{name} {value}" + (f" ({moves})" if moves else "") for name, value, moves in group.values]
            rows.append([key(group.name), run(" · ".join(told))])
        body.table([TableColumn("", 1), TableColumn("", 4)], rows, headed=False)
    elif line and document.detail != BRIEF:
        body.say(
            run(
                f"{line.head}: {', '.join(f'{path} ({moves})' if moves else path for path, moves in line.paths)}{line.more}."
            )
        )


def _named(body: WordBody, row: CheckRow) -> Inline:
    kind = f" · {body.words[f'class_{row.check_class}']}" if row.check_class else ""
    return body.linked(row) + new_line() + small(f"{row.chapter} {row.mechanism}{kind}")


def _governing(body: WordBody, document: ReportDocument) -> None:
    """What governs each mechanism, and how many of its checks fail, warn, pass and are not made."""
    columns = [body.head("mechanism", 4), body.head("governing_check", 5), body.head("utilisation", 2.2, right=True)]
    columns += [TableColumn(run(MARKS[status]), 0.7, True) for status in STATUSES] + [body.head("verdict", 2)]
    rows = []
    for chapter in document.chapters:
        row = chapter.governing
        said = body.linked(row) + new_line() + small(f"{row.demand} {row.operator} {row.limit}") if row else run("–")
        title = link(body.anchor(chapter.anchor), run(f"{chapter.letter} ") + rich(prose(chapter.title)))
        counts = [run(str(chapter.count(status) or "–")) for status in STATUSES]
        rows.append([title, said, run(row.utilisation if row else "–"), *counts, body.status(chapter.face)])
    body.table(columns, rows)


def _all_checks(body: WordBody, document: ReportDocument) -> None:
    if document.checks:
        body.subheading(document.words["checks"])
        check_table(body, document.checks)


def check_table(body: WordBody, rows: Sequence[CheckRow]) -> None:
    """Checks, a line for each: what is demanded, what is allowed, how far that is used."""
    columns = [
        body.head("check", 5),
        body.head("demand", 2.2, right=True),
        TableColumn("", 0.6),
        body.head("limit", 2.2),
    ]
    columns += [body.head("margin", 2, right=True), body.head("utilisation", 2.2, right=True), body.head("verdict", 2)]

    def side(text: str, label: str) -> Inline:
        return run(text) + (new_line() + small(prose(label)) if label else "")

    made = [
        [_named(body, row) + (new_line() + small(prose(row.source)) if row.source else ""), side(row.demand, row.demand_label), run(row.operator),
         side(row.limit, row.limit_label), run(row.margin), run(row.utilisation), body.status(row.status)]
        for row in rows
    ]  # fmt: skip
    body.table(columns, made)


def changes(body: WordBody, document: ReportDocument, found: PrintedChanges) -> None:
    """What changed since the former revision."""
    words = document.words
    body.heading(1, "", former({"old": found.old, "new": found.new}, words), "changes")
    if not found:
        body.tell(words["no_changes"])
    _pairs(body, "changed_mechanisms", "mechanism", found.mechanisms)
    _changed_checks(body, found.checks)
    for title, rows in (
        ("changed_inputs", found.inputs),
        ("changed_outputs", found.outputs),
        ("following_inputs", found.following),
    ):
        _changed_rows(body, title, rows)
    _pairs(body, "changed_code", "program", found.code)


def _sides(body: WordBody, what: str) -> list[TableColumn]:
    return [body.head(what, 5), body.head("before", 3), body.head("after", 3)]


def _pairs(body: WordBody, title: str, what: str, rows: Sequence[tuple[str, str, str]]) -> None:
    if rows:
        body.subheading(body.words[title])
        body.table(_sides(body, what), [[key(name), run(old), run(new)] for name, old, new in rows])


def _changed_checks(body: WordBody, rows: Sequence[ChangedCheck]) -> None:
    def side(status: str, used: str) -> Inline:
        return body.status(status) + run(f" {used}") if status else run("–")

    if rows:
        body.subheading(body.words["changed_checks"])
        cells = [
            [
                rich(prose(row.title)) + new_line() + key(row.mechanism),
                side(row.old_status, row.old),
                side(row.new_status, row.new),
                run(row.change),
            ]
            for row in rows
        ]
        body.table([*_sides(body, "check"), body.head("change", 2)], cells)


def _changed_rows(body: WordBody, title: str, rows: Sequence[ChangedRow]) -> None:
    if rows:
        body.subheading(body.words[title])
        cells = [
            [rich(prose(row.description)) + run(" ") + rich(row.symbol) + new_line() + key(row.path), run(row.old), run(row.new),
             run(row.change) + (new_line() + small(row.note) if row.note else "")]
            for row in rows
        ]  # fmt: skip
        body.table([*_sides(body, "quantity"), body.head("change", 2)], cells)
