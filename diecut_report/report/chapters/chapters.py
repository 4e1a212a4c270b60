"""One mechanism's chapter: its inputs, calculation, results and checks, numbered and with printed numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from diecut_report.report.chapters.printed_tables import PartsTable
from diecut_report.report.chapters.repetition import FEWEST_GIVEN, ToldBefore, counted, gathered, without_zero_diagrams
from diecut_report.report.chapters.steps import PrintedSteps, placed, row_item, rows_of, sketch, told_once
from diecut_report.report.chapters.tables import Tables, TakenGroup, is_partner, is_taken, taken_groups
from diecut_report.report.chapters.value_tables import RecordTable
from diecut_report.report.equations import Equations
from diecut_report.report.model import (
    CheckRow,
    File,
    Heading,
    PrintedChapter,
    QuantityRow,
    quantity_row,
    rested,
    under_heading,
    utilisation,
)
from diecut_report.report.scope import BRIEF, FULL, suffixes
from diecut_report.report.symbols import SymbolRow, symbol_rows, symbols_at
from diecut_report.report.text import Catalogue, given_names, quantity
from diecut_report.results.mechanism_record import (
    AbsentPhaseRecord,
    CheckRecord,
    ErratumRecord,
    MechanismRecord,
    PhaseRecord,
    QuantityRecord,
    ShownRecord,
)

# The inputs of a chapter: in lines, in tables of repeated parts, and those at their defaults or taken from others in paragraphs.


class ChapterInputs:
    """Prints inputs; without ``told`` each with all that is known of it. ``are_told``: some defaults are those of an earlier chapter."""

    def __init__(self, words: Catalogue, tables: Tables, told: ToldBefore | None) -> None:
        self.words, self.tables, self.told = words, tables, told
        self.is_full, self.decimal = told is None, words["decimal"]
        self.are_told = False
        self.partners: list[QuantityRow] = []
        self.taken: list[TakenGroup] = []

    def of(
        self, inputs: Mapping[str, QuantityRecord]
    ) -> tuple[list[QuantityRow], list[QuantityRow], list[PartsTable | RecordTable]]:
        """Return the inputs line by line, what is left at its default, and tables of those of repeated parts."""
        single, lists = gathered(inputs, FEWEST_GIVEN)
        left = set() if self.is_full else {key for key, row in single.items() if _is_left_alone(row)}
        for place, parts in enumerate([] if self.is_full else lists):
            alone = [
                name for name, rows in parts.columns.items() if all(_is_left_alone(row) for _, row in rows.values())
            ]
            left |= {key for name in alone for key, _ in parts.columns[name].values()}
            lists[place] = parts.without(alone)
        taken = set() if self.is_full else self._take(single)
        return (
            [self._input(key, row) for key, row in single.items() if key not in left | taken],
            self._defaults(_each_once(self._input(key, row) for key, row in inputs.items() if key in left)),
            [table for parts in lists if parts.columns for table in self.tables.of_records(parts)],
        )

    def _take(self, inputs: Mapping[str, QuantityRecord]) -> set[str]:
        """Gather what nobody typed: mechanisms that were found, and what is taken from them. Return their keys."""
        found = {key: row for key, row in inputs.items() if is_partner(row)}
        given = {key: row for key, row in inputs.items() if is_taken(row)}
        self.partners = [self._input(key, row) for key, row in found.items()]
        self.taken = taken_groups((row.path, self._input(key, row)) for key, row in given.items())
        return found.keys() | given.keys()

    def _defaults(self, rows: list[QuantityRow]) -> list[QuantityRow]:
        """Inputs that are left alone: those that an earlier chapter of the kind does not tell with the same value."""
        texts = [f"{row.description} {row.value} {row.unit}" for row in rows]
        new = set(texts if self.told is None else self.told.new(texts))
        self.are_told = len(new) < len(rows)
        return [row for row, text in zip(rows, texts, strict=True) if text in new]

    def _input(self, key: str, row: QuantityRecord) -> QuantityRow:
        shown, path = quantity_row(row, self.decimal), row.path
        typed = str(row.text or (path if row.origin == "reference" else ""))
        origin = self._origin(row.origin, path, typed)
        if not self.is_full and row.origin == "given":
            plain, origin = row.display.text + row.display.unit, ""
            typed = "" if typed.replace(" ", "") in (plain, row.display.text) else typed
        row_of = replace(shown, typed=typed, origin=origin, key=key)
        return rested(row_of, row, self.words)

    def _origin(self, origin: str, path: str, typed: str) -> str:
        """Where an input comes from; the path of a reference stands in what was typed."""
        is_seen = "${" in typed or (path and path in typed)
        if is_seen and not self.is_full:
            return ""  # what was typed says it
        if not path:
            return self.words[origin]
        if path in typed:
            return self.words["reference"]
        return self.words.say("refers" if origin == "reference" else "from_press", path=path)


def _each_once(rows: Iterator[QuantityRow]) -> list[QuantityRow]:
    """Inputs of which something is to be said: those of repeated parts that say the same once, and none that has no value."""
    found = {(row.description, row.value, row.unit): row for row in rows if row.value}
    return list(found.values())


def _is_left_alone(row: QuantityRecord) -> bool:
    """Whether an input is a default of the program's own, of which nothing is said."""
    return row.origin == "default" and not row.path and (row.basis or "given") == "given" and not row.note


def chapter(
    letter: str, name: str, mechanism: MechanismRecord, equations: Equations, words: Catalogue, stem: str = "", detail: str = FULL,
    told: ToldBefore | None = None,
) -> PrintedChapter:  # fmt: skip
    """The chapter of one mechanism's results; ``stem`` is what the names of the report's files begin with.

    What is ``told`` already, a standard report does not repeat.
    """
    part = PrintedChapter(
        letter=letter,
        name=name,
        anchor=f"m-{letter}",
        title=mechanism.title or name,
        kind=mechanism.kind,
        version=mechanism.plugin_version,
        source_sha256=mechanism.plugin_sha256,
        source_file=mechanism.plugin_file,
        source_check=mechanism.plugin_check,
        is_doubtful=mechanism.is_doubtful,
        status=mechanism.status,
        error=mechanism.error,
    )
    if not part.lost:
        told = None if detail == FULL else told or ToldBefore()
        filler = _Filler(part, mechanism, equations, words, stem, told)
        filler.fill_brief() if detail == BRIEF else filler.fill()
    return part


class _Filler:
    """Fills a chapter in the order of the printed page, so that all numbers count up."""

    def __init__(
        self, part: PrintedChapter, mechanism: MechanismRecord, equations: Equations, words: Catalogue, stem: str, told: ToldBefore | None,
    ) -> None:  # fmt: skip
        self.stem, self.told, self.is_full = stem, told, told is None
        mechanism = without_zero_diagrams(mechanism, words)
        figures = placed(part.letter, mechanism)
        self.placed = figures if self.is_full else [*told_once(figures)]
        self.rows = rows_of(self.placed, paired=not self.is_full)
        self.part, self.mechanism, self.words = part, mechanism, words
        self.decimal = words["decimal"]
        self.tables = Tables(part.letter, words, mechanism.lists, given_names(mechanism, ()))
        self.steps = PrintedSteps(part.letter, equations, words, self.tables, self.rows, told)

    def fill_brief(self) -> None:
        """The purpose, key results, checks and one sketch."""
        part = self.part
        part.summary = self.mechanism.summary
        part.key_results = self._key_results(self._rows(self.mechanism.outputs))
        part.checks = [self._check(check) for check in self.mechanism.checks]
        part.figures = [(each.number, each.figure) for each in sketch(self.placed)]

    def fill(self) -> None:
        """All that a chapter holds; what only the appendix shows comes last."""
        part, mechanism = self.part, self.mechanism
        part.told_in = self.told.letter if self.told else ""
        part.summary, part.assumptions = mechanism.summary, self._new(mechanism.assumptions)
        self._head("purpose")
        self._head("inputs")
        given = ChapterInputs(self.words, self.tables, self.told)
        part.inputs, part.defaults, part.input_parts = given.of(mechanism.inputs)
        part.are_defaults_told = given.are_told
        part.partners, part.taken = given.partners, given.taken
        part.figures = [(each.number, each.figure) for each in self.placed]
        part.pairs = tuple(tuple(each.number for each in row.figures) for row in self.rows if len(row.figures) > 1)
        part.sections = [
            self.steps.section(index, section, self._head("", section.title))
            for index, section in enumerate(mechanism.sections)
        ]
        part.loose = [] if part.sections else [row_item(row) for row in self.rows]
        self._results(mechanism.outputs)
        self._phases(mechanism.phases, _told_here(mechanism))
        if mechanism.checks or not mechanism.between:
            self._head("checks")
        part.warnings = mechanism.warnings
        part.checks = [self._check(check) for check in mechanism.checks]
        part.files = list(self._files())
        if part.files:
            self._head("files")
        part.absent = under_heading(mechanism.absent, self.words["absent"])
        if part.absent:
            self._head("absent")
        part.symbols = self._symbols()
        if part.symbols:
            self._head("symbols")
        if self.is_full:
            part.curves = self.tables.of_curves(mechanism.curves)
        part.errata = [(e.source, e.text, self._touched(e)) for e in mechanism.errata]

    def _new(self, texts: list[str]) -> list[str]:
        """Those of the texts that an earlier chapter has not told."""
        return texts if self.told is None else self.told.new(texts)

    def _symbols(self) -> list[SymbolRow]:
        """The symbols that no earlier chapter of the kind lists: of a standard report with the places where each is explained."""
        rows = symbol_rows(self.mechanism)
        if self.told is None:
            return rows
        inputs = {row.symbol: self.part.parts["inputs"].number for row in self.mechanism.inputs.values()}
        listed = set(self.told.new([f"symbol {row.name} {row.meaning}" for row in rows]))
        new = [row for row in rows if f"symbol {row.name} {row.meaning}" in listed]
        return symbols_at(new, self.steps.given, inputs)

    def _head(self, key: str, title: str = "") -> Heading:
        number = f"{self.part.letter}.{len(self.part.headings) + 1}"
        heading = Heading(number, title or self.words[key], f"s-{number}")
        self.part.headings.append(heading)
        self.part.parts |= {key: heading} if key else {}
        return heading

    def _results(self, outputs: Mapping[str, QuantityRecord]) -> None:
        """Outputs line by line, those of repeated parts as tables: all, or those that no step has printed; the key ones."""
        part, rows = self.part, self._rows(outputs)
        printed = set() if self.is_full else set(self._printed())
        counted_in_tables = set() if self.is_full else set(self._listed())
        told = {
            name: row
            for name, row in outputs.items()
            if not {(key, row.display.text) for key in (name, row.symbol)} & printed and name not in counted_in_tables
        }
        single, lists = gathered(told)
        part.outputs = [rows[name] for name in single]
        part.output_parts = [table for parts in lists for table in self.tables.of_parts(parts, given=False)]
        part.key_results = self._key_results(rows)
        if told or (self.is_full and not outputs):
            self._head("results")

    def _rows(self, outputs: Mapping[str, QuantityRecord]) -> dict[str, QuantityRow]:
        """All outputs as lines, those of repeated parts counted."""
        nth = counted(outputs)
        return {
            name: quantity_row(row, self.decimal, self._nth(row.description, nth.get(name)), self.tables.names)
            for name, row in outputs.items()
        }

    def _key_results(self, rows: dict[str, QuantityRow]) -> list[QuantityRow]:
        return [rows[name] for name, row in self.mechanism.outputs.items() if row.key] or list(rows.values())

    def _printed(self) -> Iterator[tuple[str, str]]:
        """The results that the steps print, by their ids, and those of repeated parts in tables, by their symbols."""
        for item in (item for section in self.mechanism.sections for item in section.items):
            if item.result and item.id:
                yield item.id, item.result.text
            for place, column in enumerate(item.columns):
                if column.symbol:
                    yield from ((column.symbol, row[place]) for row in item.rows)

    def _listed(self) -> Iterator[str]:
        """The results that a table of the calculation lists by itself, and those that say how many lines it has."""
        items = (item for section in self.mechanism.sections for item in section.items)
        tables = {item.id for item in items if item.type == "table" and item.id}
        yield from (f"{table}_count" for table in tables)
        for name, row in self.mechanism.outputs.items():
            if row.part and not row.part.quantity and row.part.family in tables:
                yield name

    def _phases(self, phases: Mapping[str, PhaseRecord], absent: Mapping[str, AbsentPhaseRecord]) -> None:
        """When the mechanism does what, a table for each abscissa; and what is not known of it."""
        self.part.phases = self.tables.of_phases(phases)
        wholes = [(each.description, each.parts) for each in phases.values() if each.parts]
        self.part.phases_absent = [
            self.words.say(
                "phase_of_parts" if len(parts) > 1 else "phase_same",
                text=text,
                parts=self.words.listed([phases[name].description for name in parts]),
            )
            for text, parts in wholes
        ]
        self.part.phases_absent += [
            self.words.say("phase_absent", description=each.description, text=each.text) for each in absent.values()
        ]
        if phases or absent:
            self._head("phases")

    def _nth(self, description: str, number: int | None) -> str:
        return description if number is None else self.words.say("nth", text=description, n=number)

    def _of_part(self, check: CheckRecord) -> str:
        """The title of a check, with the part of a row that governs."""
        if check.part_name:
            return f"{check.title}, {check.part_name}"
        return self._nth(check.title, check.part)

    def _files(self) -> Iterator[File]:
        """The files beside the report."""
        mechanism = self.mechanism
        for export in mechanism.exports:
            if export.error:
                words = self.words.say("not_written", title=export.title, error=export.error)
                yield File(f"{self.stem}.{self.part.name}.{export.id}", words)
                continue
            count = len(mechanism.curves[export.abscissa].values)
            columns = ", ".join([export.abscissa, *export.columns])
            told = {"dxf": "dxf" if len(export.columns) > 2 else "dxf_profile", "csv": "csv"}
            for ending, suffix in suffixes(self.part.name, export).items():
                content = self.words.say(told[ending], title=export.title, n=count, columns=columns)
                yield File(f"{self.stem}.{suffix}", content)

    def _check(self, check: CheckRecord) -> CheckRow:
        return CheckRow(
            id=check.id,
            mechanism=self.part.name,
            chapter=self.part.letter,
            chapter_title=self.part.title,
            anchor=f"c-{self.part.letter}-{check.id}",
            title=self._of_part(check),
            status=check.status,
            demand=self._side(check.demand_display),
            demand_label=check.demand_label,
            operator={"<": "<", "<=": "≤", ">": ">", ">=": "≥"}[check.operator],
            limit=self._side(check.limit_display),
            limit_label=check.limit_label,
            margin=self._side(check.margin_display),
            utilisation=utilisation(check.utilisation, check.status, self.decimal),
            used=self._used(check),
            source=check.source,
            message=check.message,
            check_class=check.check_class,
            ratio=check.utilisation,
            is_sized=check.sized_to_limit and check.status == "pass",
            is_presumed=check.presumed and check.status == "pass",
            missing=tuple(check.missing),
            parts=self.tables.of_check(check) if check.parts and self._is_told_by_part(check) else None,
            changed=check.before,
        )

    def _is_told_by_part(self, check: CheckRecord) -> bool:
        """Whether it is said how each part fares: in a report with all, and where parts do not pass."""
        return self.is_full or any(part.status not in (None, "pass") for part in check.parts)

    def _side(self, display: ShownRecord | None) -> str:
        """One side of a check; a dash where it is not known."""
        return "–" if display is None else quantity(display.text, display.unit, self.decimal)

    def _used(self, check: CheckRecord) -> str:
        """How far a limit is used, in words; by how much it is missed where no share of it tells that."""
        if check.utilisation is None and check.status in ("warn", "fail") and check.margin_display:
            missed = check.margin_display.with_(text=check.margin_display.text.removeprefix("-"))
            return self.words.say("beyond", margin=self._side(missed))
        return utilisation(check.utilisation, check.status, self.decimal)

    def _touched(self, erratum: ErratumRecord) -> str:
        rows = self.mechanism.outputs | self.mechanism.values | self.mechanism.curves
        return ", ".join(rows[key].description if key in rows else key for key in erratum.touches)


def _told_here(mechanism: MechanismRecord) -> dict[str, AbsentPhaseRecord]:
    """The phases that there are not, but those whose chapter says so under the same title."""
    titles = {part.title for part in mechanism.absent}
    phases = mechanism.phases_absent
    return {name: phase for name, phase in phases.items() if phase.description not in titles}
