"""The chapters of a DOCX, and what follows them: press data, calculations, sources, program, appendix."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from markupsafe import Markup

from diecut_report.report.document import ReportDocument
from diecut_report.report.model import Heading, PrintedChapter, QuantityRow
from diecut_report.report.number_format import joined
from diecut_report.report.office.word_body import WordBody
from diecut_report.report.office.word_front import check_table
from diecut_report.report.office.wordml import Inline, TableColumn, bold, key, new_line, rich, run, small
from diecut_report.report.record_tables import RecordTable
from diecut_report.report.scope import FULL
from diecut_report.report.symbol_list import SymbolRow
from diecut_report.report.symbols import own_words, prose

HASH = 12  # letters of a hash


def key_results(body: WordBody, document: ReportDocument) -> None:
    """The key results of each mechanism with one sketch, for a brief report."""
    words = document.words
    body.heading(1, "2", words["key_results"], "key-results")
    for chapter in document.chapters:
        body.heading(2, chapter.letter, chapter.title, chapter.anchor)
        if chapter.lost:
            body.tell(chapter.error or words["skipped_text"])
            continue
        body.quantities(chapter.key_results, sourced=False)
        for number, figure in chapter.figures:
            body.figure(number, figure["title"], "")
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
    version = f" {part.version}" if part.version else ""
    body.say(key(part.name) + run(f" · {part.kind}{version} · ") + body.status(part.face))
    if part.lost:
        lost = "skipped_text" if part.status == "skipped" else "failed_comparison" if part.between else "failed_text"
        body.say(bold(words[lost]))
        body.tell(part.error)
        return
    _given(body, part)
    _calculation(body, part)
    _outcome(body, part)
    _checks(body, part, document)
    _rest(body, part)


def _head(body: WordBody, heading: Heading | None) -> None:
    if heading:
        body.heading(2, heading.number, heading.title, heading.anchor)


def _given(body: WordBody, part: PrintedChapter) -> None:
    """Purpose, assumptions, inputs."""
    if part.between:
        body.tell(
            f"{body.words['comparison']} {body.words.listed([f'{other.letter} {other.title}' for other in part.between])}"
        )
    _head(body, part.parts.get("purpose"))
    body.tell(part.summary)
    if part.assumptions:
        body.subheading(body.words["assumptions"])
        body.listed(rich(prose(text)) for text in part.assumptions)
    _head(body, part.parts.get("inputs"))
    _inputs(body, part.inputs)
    if part.partners:
        found = run(" · ").join(
            (key(row.key) + run(": ") if row.key != row.value else run("")) + run(row.value) for row in part.partners
        )
        body.say(bold(body.words["partners"]) + run(": ") + found, "Why")
    for group in part.taken:
        basis = f" ({group.basis}): " if group.basis else ": "
        rows = run(" · ").join(map(_taken, group.rows))
        body.say(bold(body.words.say("taken_from", name=group.home)) + run(basis) + rows, "Why")
    if part.defaults or part.are_defaults_told:
        told = [run(body.words.say("defaults_told", letter=part.told_in))] if part.are_defaults_told else []
        told += map(_default, part.defaults)
        body.say(bold(body.words["defaults"]) + run(": ") + run(" · ").join(told), "Why")
    for table in part.input_parts:
        body.record_table(table) if isinstance(table, RecordTable) else body.parts_table(table)


def _default(row: QuantityRow) -> Inline:
    """An input that is left alone: its key where it is a choice, else its symbol."""
    name = rich(prose(row.description)) + run(" ")
    if row.wordy:
        return name + key(row.key) + run(" ") + rich(own_words(row.value))
    sign = rich(row.symbol) + run(" = ") if row.symbol else ""
    return name + sign + run(joined(row.value, row.unit))


def _taken(row: QuantityRow) -> Inline:
    """An input that is taken from another mechanism, with its id there."""
    sign = rich(row.symbol) if row.symbol else run(row.value)
    value = sign if row.wordy else (sign + run(" = ") if row.symbol else run("")) + run(joined(row.value, row.unit))
    return (
        rich(prose(row.description))
        + run(" ")
        + key(row.key)
        + run(" ")
        + value
        + run(f" ({row.origin})" if row.origin else "")
    )


def _inputs(body: WordBody, rows: Sequence[QuantityRow]) -> None:
    typed = TableColumn(run(f"{body.words['typed']}, {body.words['origin'].lower()}"), 4)
    columns = [
        body.head("quantity", 6),
        body.head("symbol", 1.5),
        body.head("value", 2.2, right=True),
        body.head("unit", 1.5),
        typed,
    ]

    def cells(row: QuantityRow) -> list[Inline]:
        description = rich(prose(row.description)) + (new_line() + key(row.key) if row.key else "")
        said = " ".join(filter(None, (row.typed, row.origin)))
        told = small(said) + (new_line() + small(own_words(row.note)) if row.note else "")
        return [
            description,
            rich(row.symbol),
            rich(own_words(row.value)) if row.wordy else run(row.value),
            run(row.unit),
            told,
        ]

    body.table(columns, [cells(row) for row in rows])


def _calculation(body: WordBody, part: PrintedChapter) -> None:
    for section in part.sections:
        _head(body, section.heading)
        body.tell(section.text)
        body.tell(section.shown, "Why")
        for item in section.items:
            body.item(item)
    for item in part.loose:
        body.item(item)


def _outcome(body: WordBody, part: PrintedChapter) -> None:
    """Results and phases."""
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
    """Files beside the report, and what is not calculated."""
    _head(body, part.parts.get("files"))
    body.table(
        [body.head("file", 3), body.head("content", 5)],
        [[key(each.name), rich(prose(each.content))] for each in part.files],
    )
    _head(body, part.parts.get("absent"))
    body.listed(bold(str(each["title"])) + run(": ") + rich(prose(each["text"])) for each in part.absent)
    _head(body, part.parts.get("symbols"))
    columns = [body.head("symbol", 1), body.head("quantity", 6), body.head("unit", 1)]
    body.table(columns, [[rich(row.symbol), _meaning(body, row), run(row.unit)] for row in part.symbols])


def _meaning(body: WordBody, row: SymbolRow) -> Inline:
    """What a symbol stands for, and how the source writes it where that is another letter."""
    told = rich(Markup(f" ({body.words.say('in_source', symbol=row.in_source)})")) if row.in_source else ""
    return rich(prose(row.meaning)) + told + (run(f" ({row.stands})") if row.stands else "")


def closing(body: WordBody, document: ReportDocument, digest: str) -> None:
    """Sources, and what calculated; ``digest`` is that of the results."""
    words, program = document.words, document.program
    body.heading(1, "3", words["sources"], "sources")
    if not document.sources:
        body.tell(words["no_sources"])
    body.table(
        [body.head("number", 1), body.head("source", 7)],
        [[run(number), run(text)] for number, text in document.sources],
    )
    errata(body, document)
    body.heading(1, "4", words["program"], "program")
    rows = [
        [
            run(words["calculated_by"]),
            run(f"{program['name']} {program['version']}") + _hash(body, program.get("source_sha256")),
        ],
        *([run(words["extension"]), key(name) + _hash(body, digest)] for name, digest in _extensions(program).items()),
        *([[run(words["libraries"]), run(_versions(program))]] if program.get("libraries") else ()),
        [run(words["config_file"]), run(document.config["file"])],
        [run(words["sha256"]), key(document.config["sha256"])],
        *([run(file["file"]), key(file["sha256"])] for file in document.config.get("materials", ())),
        [run(f"{words['carried_results']}, {words['sha256']}"), key(digest)],
    ]
    body.table([TableColumn("", 2), TableColumn("", 6)], rows, headed=False)
    columns = [
        body.head("mechanism", 4),
        body.head("kind", 2.5),
        body.head("plugin_version", 3),
        body.head("verdict", 2),
    ]
    body.table(columns, [
        [run(f"{part.letter} {part.title} (") + key(part.name) + run(")"), key(part.kind),
         run(part.version or "–") + _foreign(body, part) + _hash(body, part.source_sha256), body.status(part.face)]
        for part in document.chapters
    ])  # fmt: skip


def _foreign(body: WordBody, part: PrintedChapter) -> Inline:
    """The file of a plugin that is not the program's own, and what was found of it."""
    told = key(f" {part.source_file}") if part.source_file else ""
    return told + (run(f", {body.words[f'plugin_{part.source_check}']}") if part.source_check else "")


def _versions(program: Mapping[str, Any]) -> str:
    return ", ".join(f"{name} {version}" for name, version in program["libraries"].items())


def _extensions(program: Mapping[str, object]) -> Mapping[str, str]:
    found = program.get("extensions")
    return found if isinstance(found, Mapping) else {}


def _hash(body: WordBody, digest: object) -> Inline:
    return new_line() + small(f"{body.words['source_hash']} {str(digest)[:HASH]}") if digest else ""


def errata(body: WordBody, document: ReportDocument) -> None:
    """What was found wrong in the sources."""
    if document.errata:
        body.subheading(document.words["errata"])
    for source, text, touches in document.errata:
        touched = new_line() + small(f"{document.words['touches']}: {touches}") if touches else ""
        body.listed([bold(f"{source}: ") + rich(prose(text)) + touched])


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
    for line in document.config["source_text"].splitlines():
        body.parts.append(f'<w:p><w:pPr><w:pStyle w:val="Listing"/></w:pPr>{run(line)}</w:p>')
