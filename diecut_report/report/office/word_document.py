"""The chapters of a DOCX, and what follows them: press data, calculations, sources, program, appendix."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from markupsafe import Markup

from diecut_report.report.chapters.front import ChangedCheck, ChangedRow, PrintedChanges
from diecut_report.report.chapters.value_tables import RecordTable
from diecut_report.report.document import REVISION, ReportDocument, former, machine_named
from diecut_report.report.model import STATUSES, CheckRow, Heading, PrintedChapter, QuantityRow
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
from diecut_report.report.symbols import own_words, prose
from diecut_report.report.text import joined

# What stands before the chapters of a DOCX: title block, contents, summary with the verdict, changes.


FACTS = (("document", "document_number"), ("revision", "revision"), ("date", "date"))


def title_block(body: WordBody, document: ReportDocument) -> None:
    """Whose calculation of what this is, its status, who signs it, and its revisions."""
    words, project, block = document.words, document.project, document.block
    owner = (project["organisation"], project["department"], project["document_type"])
    body.say(small(" · ".join(filter(None, owner))))
    body.say(run(document.title), "Title")
    body.say(bold(words["across"]) if block.is_held else "")
    body.say(run(machine_named(document.press.name, words)))
    facts = [*((words[name], project[of]) for name, of in FACTS), (words["status"], block.status)]
    cells = [small(name) + new_line() + bold(text or "–") for name, text in facts]
    body.table([TableColumn("", 1)] * len(facts), [cells], headed=False)
    signed = [[run(words[role]), run(who), "", ""] for role, who in block.signers]
    body.table(body.heads("release:2 name:3 date:2 signature:3"), signed)
    columns = body.heads("revision:1.5 date:2 description:5 by:2.5")
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
    if document.facts:
        body.say(run(" · ".join(f"{label} {value}" for label, value in document.facts)))
    counts = f" {', '.join(document.counts)}." if document.counts else ""
    is_judged = document.checks or document.unchecked or document.status != "pass"
    body.say((body.status(document.face) + run("  ") if is_judged else "") + bold(document.verdict) + run(counts))
    body.listed(_verdict_lines(body, document))
    for number, each in document.drive_line:
        body.figure(number, each.title, each.caption)
    _not_covered(body, document)
    if document.checks or document.unchecked:
        _worst(body, document)
    if document.checks and document.detail == FULL:
        body.subheading(words["checks"])
        check_table(body, document.checks)
    left = [[_named(body, row), run(row.demand), key(", ".join(row.missing))] for row in document.unchecked]
    body.titled_table(words["not_checked"].capitalize(), "check:5 demand:2> missing:4", left)
    _open(body, document)
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
    columns = body.heads("path:4 influence_lowered:2> influence_gives:2> influence_raised:2> influence_gives:2>")
    for each in found.tornados:
        body.subheading(each.title)
        if each.rows:
            body.figure(each.number, each.figure.title, words["influence_caption"])
            body.table(columns, [[key(name), *map(run, values)] for name, *values in each.rows])
        body.tell(each.rest)
    if found.chances:
        body.subheading(words["influence_tolerances"])
        body.tell(found.scatter)
        heads = body.heads("check:5 influence_probability:2> influence_interval:2> influence_held:2>")
        body.table(heads, [[rich(prose(title)), *map(run, values)] for title, *values in found.chances])
        body.tell(found.sure)


def _verdict_lines(body: WordBody, document: ReportDocument) -> Iterator[Inline]:
    words, governing = document.words, document.governing
    for row in document.failures:
        yield run(f"{MARKS['fail']} {row.home} · ") + body.linked(row) + run(": ") + rich(prose(row.message))
    for chapter in document.chapters:
        if chapter.lost:
            cause = prose(chapter.record.error or words["skipped_text"])
            yield run(f"{MARKS['fail']} {chapter.letter} · {chapter.title}: ") + rich(cause)
    if governing:
        margin = f", {words.say('reserve', margin=governing.margin)}" if governing.status == "pass" else ""
        home = run(f"{words['governing']}: {governing.home} · ")
        yield home + body.linked(governing) + run(f", {governing.used}{margin}")
    if document.sized:
        told = ", ".join(f"{row.home} · {row.title} ({row.utilisation})" for row in document.sized)
        yield run(f"{words['sized']}: {told}")
    yield from map(run, document.notes)


def _open(body: WordBody, document: ReportDocument) -> None:
    if document.open_groups:
        body.subheading(document.words["open_values"])
        rows = []
        for group in document.open_groups:
            for place, reason in enumerate(group.reasons):
                told = " · ".join(f"{name} {value}" for name, value in reason.values)
                rows.append([key("" if place else group.name), run(told), run(reason.why)])
        body.table([TableColumn("", 1), TableColumn("", 2), TableColumn("", 2)], rows, headed=False)


def _not_covered(body: WordBody, document: ReportDocument) -> None:
    words = document.words
    body.subheading(words["not_covered"])
    body.listed(
        rich(prose(each.text)) + run(" ") + small(words.say("owned_by", owner=each.owner or words["no_owner"]))
        for each in document.not_covered
    )


def _named(body: WordBody, row: CheckRow) -> Inline:
    kind = f" · {body.words[f'class_{row.check_class}']}" if row.check_class else ""
    return body.linked(row) + new_line() + small(f"{row.chapter} {row.mechanism}{kind}")


def _worst(body: WordBody, document: ReportDocument) -> None:
    columns = body.heads("mechanism:4 worst_strength:4 worst_function:4")
    columns += [*(TableColumn(run(MARKS[status]), 0.7, True) for status in STATUSES), *body.heads("verdict:2")]
    rows = []
    for part in document.judged_parts:
        worst = (part.worst_strength, part.worst_function)
        told = [
            body.linked(row) + run(f" {row.used or row.utilisation}") if row else run(document.words["none"])
            for row in worst
        ]
        title = link(body.anchor(part.anchor), rich(prose(part.title)))
        counts = [run(str(count or "–")) for count in part.counts]
        is_judged = any(part.counts) or part.face != "pass"
        rows.append([title, *told, *counts, body.status(part.face) if is_judged else run("–")])
    body.table(columns, rows)


def check_table(body: WordBody, rows: Sequence[CheckRow]) -> None:
    """Checks, a line for each: what is demanded, what is allowed, how far that is used."""

    def side(text: str, label: str) -> Inline:
        return run(text) + (new_line() + small(prose(label)) if label else "")

    made = [
        [_named(body, row) + (new_line() + small(prose(row.source)) if row.source else ""), side(row.demand, row.demand_label), run(row.operator),
         side(row.limit, row.limit_label), run(row.margin), run(row.utilisation), body.status(row.status)]
        for row in rows
    ]  # fmt: skip
    body.table(body.heads("check:5 demand:2.2> :0.6 limit:2.2 margin:2> utilisation:2.2> verdict:2"), made)


def changes(body: WordBody, document: ReportDocument, found: PrintedChanges) -> None:
    """What changed since the former revision."""
    words = document.words
    body.heading(1, "", former(found.old, found.new, words), "changes")
    if not found:
        body.tell(words["no_changes"])
    _pairs(body, "changed_mechanisms", "mechanism", found.mechanisms)
    _changed_checks(body, found.checks)
    _changed_rows(body, "changed_inputs", found.inputs)
    _changed_rows(body, "changed_outputs", found.outputs)
    _changed_rows(body, "following_inputs", found.following)
    _pairs(body, "changed_code", "program", found.code)


def _pairs(body: WordBody, title: str, what: str, rows: Sequence[tuple[str, str, str]]) -> None:
    cells = [[key(name), run(old), run(new)] for name, old, new in rows]
    body.titled_table(body.words[title], f"{what}:5 before:3 after:3", cells)


def _changed_checks(body: WordBody, rows: Sequence[ChangedCheck]) -> None:
    def side(status: str, used: str) -> Inline:
        return body.status(status) + run(f" {used}") if status else run("–")

    cells = [
        [rich(prose(row.title)) + new_line() + key(row.mechanism), side(row.old_status, row.old),
         side(row.new_status, row.new), run(row.change)]
        for row in rows
    ]  # fmt: skip
    body.titled_table(body.words["changed_checks"], "check:5 before:3 after:3 change:2", cells)


def _changed_rows(body: WordBody, title: str, rows: Sequence[ChangedRow]) -> None:
    cells = [
        [rich(prose(row.description)) + run(" ") + rich(row.symbol) + new_line() + key(row.path), run(row.old), run(row.new),
         run(row.change) + (new_line() + small(row.note) if row.note else "")]
        for row in rows
    ]  # fmt: skip
    body.titled_table(body.words[title], "quantity:5 before:3 after:3 change:2", cells)


HASH = 12  # letters of a hash


def key_results(body: WordBody, document: ReportDocument) -> None:
    """The key results of each mechanism with one sketch, for a brief report."""
    words = document.words
    body.heading(1, "2", words["key_results"], "key-results")
    for chapter in document.chapters:
        body.heading(2, chapter.letter, chapter.title, chapter.anchor)
        if chapter.lost:
            body.tell(chapter.record.error or words["skipped_text"])
            continue
        body.quantities(chapter.key_results, sourced=False)
        for number, figure in chapter.figures:
            body.figure(number, figure.title, "")
    body.tell(words["more_in"], "Why")


def press_data(body: WordBody, document: ReportDocument) -> None:
    """What is given of the press as a whole."""
    body.heading(1, "2", document.words["press_data"], "press")
    if document.press_rows:
        _inputs(body, document.press_rows)
    else:
        body.tell(document.words["no_press_data"])


def chapter(body: WordBody, part: PrintedChapter, document: ReportDocument) -> None:
    """The whole calculation of one mechanism."""
    words = document.words
    body.heading(1, part.letter, part.title, part.anchor)
    told = " ".join(filter(None, (part.record.kind, part.record.plugin_version)))
    body.say(key(part.name) + run(f" · {told} · ") + body.status(part.face))
    if part.lost:
        failed = "failed_comparison" if part.between else "failed_text"
        body.say(bold(words["skipped_text" if part.record.status == "skipped" else failed]))
        body.tell(part.record.error)
        return
    _given(body, part)
    for section in part.sections:
        _head(body, section.heading)
        body.tell(section.text)
        body.tell(section.shown, "Why")
        for item in section.items:
            body.item(item)
    for item in part.loose:
        body.item(item)
    _outcome(body, part)
    _checks(body, part, document)
    _rest(body, part)


def _head(body: WordBody, heading: Heading | None) -> None:
    if heading:
        body.heading(2, heading.number, heading.title, heading.anchor)


def _given(body: WordBody, part: PrintedChapter) -> None:
    if part.between:
        compared = body.words.listed([f"{other.letter} {other.title}" for other in part.between])
        body.tell(f"{body.words['comparison']} {compared}")
    _head(body, part.parts.get("purpose"))
    body.tell(part.record.summary)
    if part.assumptions:
        body.subheading(body.words["assumptions"])
        body.listed(rich(prose(text)) for text in part.assumptions)
    _head(body, part.parts.get("inputs"))
    _inputs(body, part.inputs)
    if part.partners:
        found = [(key(row.key) + run(": ") if row.key != row.value else "") + run(row.value) for row in part.partners]
        body.say(bold(body.words["partners"]) + run(": ") + run(" · ").join(found), "Why")
    for group in part.taken:
        basis = f" ({group.basis}): " if group.basis else ": "
        rows = run(" · ").join(map(_taken, group.rows))
        body.say(bold(body.words.say("taken_from", name=group.home)) + run(basis) + rows, "Why")
    if part.defaults or part.are_defaults_told:
        told = [run(body.words.say("defaults_told", letter=part.told_in))] * part.are_defaults_told
        told += map(_default, part.defaults)
        body.say(bold(body.words["defaults"]) + run(": ") + run(" · ").join(told), "Why")
    for table in part.input_parts:
        body.record_table(table) if isinstance(table, RecordTable) else body.parts_table(table)


def _default(row: QuantityRow) -> Inline:
    name = rich(prose(row.description)) + run(" ")
    if row.wordy:
        return name + key(row.key) + run(" ") + rich(own_words(row.value))
    sign = rich(row.symbol) + run(" = ") if row.symbol else ""
    return name + sign + run(joined(row.value, row.unit))


def _taken(row: QuantityRow) -> Inline:
    """An input that is taken from another mechanism, with its id there."""
    sign = rich(row.symbol) if row.symbol else run(row.value)
    value = sign if row.wordy else (sign + run(" = ") if row.symbol else "") + run(joined(row.value, row.unit))
    named = rich(prose(row.description)) + run(" ") + key(row.key) + run(" ")
    return named + value + run(f" ({row.origin})" if row.origin else "")


def _inputs(body: WordBody, rows: Sequence[QuantityRow]) -> None:
    typed = TableColumn(run(f"{body.words['typed']}, {body.words['origin'].lower()}"), 4)
    cells = []
    for row in rows:
        description = rich(prose(row.description)) + (new_line() + key(row.key) if row.key else "")
        value = rich(own_words(row.value)) if row.wordy else run(row.value)
        said = small(" ".join(filter(None, (row.typed, row.origin))))
        note = new_line() + small(own_words(row.note)) if row.note else ""
        cells.append([description, rich(row.symbol), value, run(row.unit), said + note])
    body.table([*body.heads("quantity:6 symbol:1.5 value:2.2> unit:1.5"), typed], cells)


def _outcome(body: WordBody, part: PrintedChapter) -> None:
    _head(body, part.parts.get("results"))
    body.quantities(part.outputs)
    for table in part.output_parts:
        body.parts_table(table)
    _head(body, part.parts.get("phases"))
    for phases in part.phases:
        body.data_table(phases)
    body.listed(rich(prose(text)) for text in part.phases_absent)


def _checks(body: WordBody, part: PrintedChapter, document: ReportDocument) -> None:
    """The checks of a mechanism; in a full report each with its words, else those that warn."""
    if "checks" not in part.parts:
        return
    _head(body, part.parts["checks"])
    rows = [row for row in part.checks if not row.is_self_test]
    made, left = ([row for row in rows if row.is_made is is_made] for is_made in (True, False))
    if not rows:
        body.tell(document.words["no_checks"])
    if made:
        check_table(body, made)
    for row in rows if document.detail == FULL else made:
        if document.detail == FULL or row.status == "warn":
            body.say(bold(f"{row.title}: ") + rich(prose(row.message)), "Why")
        if row.parts:
            body.parts_table(row.parts)
    if left:
        said = " · ".join(f"{row.title} ({document.words.say('needs', keys=', '.join(row.missing))})" for row in left)
        body.say(bold(document.words["not_checked"].capitalize()) + run(f": {said}"))


def _rest(body: WordBody, part: PrintedChapter) -> None:
    _head(body, part.parts.get("files"))
    files = [[key(each.name), rich(prose(each.content))] for each in part.files]
    body.table(body.heads("file:3 content:5"), files)
    _head(body, part.parts.get("absent"))
    body.listed(bold(str(each.title)) + run(": ") + rich(prose(each.text)) for each in part.absent)
    _head(body, part.parts.get("symbols"))
    rows = []
    for row in part.symbols:
        told = rich(Markup(f" ({body.words.say('in_source', symbol=row.in_source)})")) if row.in_source else ""
        meaning = rich(prose(row.meaning)) + told + (run(f" ({row.stands})") if row.stands else "")
        rows.append([rich(row.symbol), meaning, run(row.unit)])
    body.table(body.heads("symbol:1 quantity:6 unit:1"), rows)


def closing(body: WordBody, document: ReportDocument, digest: str) -> None:
    """Sources, and what calculated; ``digest`` is that of the results."""
    words, program = document.words, document.program
    body.heading(1, "3", words["sources"], "sources")
    if not document.sources:
        body.tell(words["no_sources"])
    body.table(body.heads("number:1 source:7"), [[run(number), run(text)] for number, text in document.sources])
    if document.errata:
        body.subheading(words["errata"])
    for source, text, touches in document.errata:
        touched = new_line() + small(f"{words['touches']}: {touches}") if touches else ""
        body.listed([bold(f"{source}: ") + rich(prose(text)) + touched])
    body.heading(1, "4", words["program"], "program")
    by = run(f"{program.name} {program.version}") + _hash(body, program.source_sha256)
    libraries = ", ".join(f"{name} {version}" for name, version in program.libraries.items())
    rows = [
        [run(words["calculated_by"]), by],
        *([run(words["extension"]), key(name) + _hash(body, sha256)] for name, sha256 in program.extensions.items()),
        *([[run(words["libraries"]), run(libraries)]] if libraries else ()),
        [run(words["config_file"]), run(document.config.file)],
        [run(words["sha256"]), key(document.config.sha256)],
        *([run(file.file), key(file.sha256)] for file in document.config.materials),
        [run(f"{words['carried_results']}, {words['sha256']}"), key(digest)],
    ]
    body.table([TableColumn("", 2), TableColumn("", 6)], rows, headed=False)
    cells = []
    for part in document.chapters:
        record = part.record
        version = run(record.plugin_version or "–") + (key(f" {record.plugin_file}") if record.plugin_file else "")
        version += run(f", {words[f'plugin_{record.plugin_check}']}") if record.plugin_check else ""
        named = run(f"{part.letter} {part.title} (") + key(part.name) + run(")")
        cells.append([named, key(record.kind), version + _hash(body, record.plugin_sha256), body.status(part.face)])
    body.table(body.heads("mechanism:4 kind:2.5 plugin_version:3 verdict:2"), cells)


def _hash(body: WordBody, digest: object) -> Inline:
    return new_line() + small(f"{body.words['source_hash']} {str(digest)[:HASH]}") if digest else ""


def appendix(body: WordBody, document: ReportDocument) -> None:
    """Self-tests, curves, and the configuration as given."""
    words = document.words
    body.heading(1, "5", words["appendix"], "appendix")
    body.heading(2, "5.1", words["self_test_list"], "self-tests")
    if document.self_tests:
        check_table(body, document.self_tests)
    else:
        body.tell(words["no_self_tests"])
    body.heading(2, "5.2", words["curves"], "curves")
    curved = [part for part in document.chapters if part.curves]
    body.tell(words["curves_note" if curved else "no_curves"])
    for part in curved:
        body.subheading(f"{part.letter} {part.title}")
        for table in part.curves:
            body.data_table(table)
    body.heading(2, "5.3", words["configuration"], "configuration")
    for line in document.config.source_text.splitlines():
        body.parts.append(f'<w:p><w:pPr><w:pStyle w:val="Listing"/></w:pPr>{run(line)}</w:p>')
