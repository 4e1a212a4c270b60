"""One mechanism's chapter: its inputs, calculation, results and checks, numbered and with printed numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from diecut_report.report.chapters.repetition import FEWEST_GIVEN, ToldBefore, counted, gathered, without_zero_diagrams
from diecut_report.report.chapters.steps import PrintedSteps, placed, row_item, rows_of, sketch, told_once
from diecut_report.report.chapters.tables import Tables, is_partner, is_taken, taken_groups
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
from diecut_report.results.mechanism_record import CheckRecord, MechanismRecord, QuantityRecord, ShownRecord


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
    part = PrintedChapter(letter, name, f"m-{letter}", mechanism.title or name, mechanism)
    if not part.lost:
        told = ToldBefore(is_full=True) if detail == FULL else told or ToldBefore()
        filler = _Filler(part, equations, words, stem, told)
        filler.fill_brief() if detail == BRIEF else filler.fill()
    return part


class _Filler:
    def __init__(
        self, part: PrintedChapter, equations: Equations, words: Catalogue, stem: str, told: ToldBefore
    ) -> None:  # fmt: skip
        self.part, self.words, self.stem, self.told = part, words, stem, told
        self.is_full, self.decimal = told.is_full, words["decimal"]
        self.mechanism = without_zero_diagrams(part.record, words)
        figures = placed(part.letter, self.mechanism)
        self.placed = figures if self.is_full else [*told_once(figures)]
        self.rows = rows_of(self.placed, paired=not self.is_full)
        self.tables = Tables(part.letter, words, part.record.lists, given_names(part.record, ()))
        self.steps = PrintedSteps(part.letter, equations, words, self.tables, self.rows, told)

    def fill_brief(self) -> None:
        """The purpose, key results, checks and one sketch."""
        part = self.part
        part.key_results = self._key_results(self._rows(self.mechanism.outputs))
        part.checks = [self._check(check) for check in self.mechanism.checks]
        part.figures = [(each.number, each.figure) for each in sketch(self.placed)]

    def fill(self) -> None:
        """All that a chapter holds; what only the appendix shows comes last."""
        part, mechanism = self.part, self.mechanism
        part.told_in, part.assumptions = self.told.letter, self.told.new(mechanism.assumptions)
        self._head("purpose")
        self._head("inputs")
        self._inputs(mechanism.inputs)
        part.figures = [(each.number, each.figure) for each in self.placed]
        part.pairs = tuple(tuple(each.number for each in row) for row in self.rows if len(row) > 1)
        part.sections = [
            self.steps.section(index, section, self._head("", section.title))
            for index, section in enumerate(mechanism.sections)
        ]
        part.loose = [] if part.sections else [row_item(row) for row in self.rows]
        self._results(mechanism.outputs)
        self._phases(mechanism)
        if mechanism.checks or not mechanism.between:
            self._head("checks")
        part.checks = [self._check(check) for check in mechanism.checks]
        part.files = list(self._files())
        part.absent = under_heading(mechanism.absent, self.words["absent"])
        part.symbols = self._symbols()
        for key, found in (("files", part.files), ("absent", part.absent), ("symbols", part.symbols)):
            if found:
                self._head(key)
        if self.is_full:
            part.curves = self.tables.of_curves(mechanism.curves)
        rows = mechanism.outputs | mechanism.values | mechanism.curves
        for each in mechanism.errata:
            touched = ", ".join(rows[key].description if key in rows else key for key in each.touches)
            part.errata.append((each.source, each.text, touched))

    def _inputs(self, inputs: Mapping[str, QuantityRecord]) -> None:
        """The inputs: in lines, in tables of repeated parts, and those at their defaults or taken from others in paragraphs.

        In a report with all each stands with all that is known of it.
        """
        single, lists = gathered(inputs, FEWEST_GIVEN)
        left = {key for key, row in single.items() if not self.is_full and _is_left_alone(row)}
        for place, parts in enumerate([] if self.is_full else lists):
            columns = parts.columns.items()
            alone = [name for name, rows in columns if all(_is_left_alone(row) for _, row in rows.values())]
            left |= {key for name in alone for key, _ in parts.columns[name].values()}
            lists[place] = parts.without(alone)
        taken = set() if self.is_full else self._take(single)
        self.part.inputs = [self._input(key, row) for key, row in single.items() if key not in left | taken]
        self._leave({key: row for key, row in inputs.items() if key in left})
        self.part.input_parts = [table for parts in lists if parts.columns for table in self.tables.of_records(parts)]

    def _take(self, inputs: Mapping[str, QuantityRecord]) -> set[str]:
        """Gather what nobody typed: mechanisms that were found, and what is taken from them. Return their keys."""
        found = {key: row for key, row in inputs.items() if is_partner(row)}
        given = {key: row for key, row in inputs.items() if is_taken(row)}
        self.part.partners = [self._input(key, row) for key, row in found.items()]
        self.part.taken = taken_groups((row.path, self._input(key, row)) for key, row in given.items())
        return found.keys() | given.keys()

    def _leave(self, inputs: Mapping[str, QuantityRecord]) -> None:
        """Inputs that are left alone: each once, none without a value, and none that an earlier chapter of the kind tells."""
        rows = [self._input(key, row) for key, row in inputs.items()]
        told = {f"{row.description} {row.value} {row.unit}": row for row in rows if row.value}
        new = self.told.new([*told])
        self.part.defaults = [told[text] for text in new]
        self.part.are_defaults_told = len(new) < len(told)

    def _input(self, key: str, row: QuantityRecord) -> QuantityRow:
        shown, path = quantity_row(row, self.decimal), row.path
        typed = str(row.text or (path if row.origin == "reference" else ""))
        origin = self._origin(row.origin, path, typed)
        if not self.is_full and row.origin == "given":
            plain, origin = row.display.text + row.display.unit, ""
            typed = "" if typed.replace(" ", "") in (plain, row.display.text) else typed
        return rested(replace(shown, typed=typed, origin=origin, key=key), row, self.words)

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

    def _symbols(self) -> list[SymbolRow]:
        """The symbols that no earlier chapter of the kind lists: of a standard report with the places where each is explained."""
        rows = {f"symbol {row.name} {row.meaning}": row for row in symbol_rows(self.mechanism)}
        new = [rows[text] for text in self.told.new([*rows])]
        inputs = {row.symbol: self.part.parts["inputs"].number for row in self.mechanism.inputs.values()}
        return new if self.is_full else symbols_at(new, self.steps.given, inputs)

    def _head(self, key: str, title: str = "") -> Heading:
        number = f"{self.part.letter}.{len(self.part.headings) + 1}"
        heading = Heading(number, title or self.words[key], f"s-{number}")
        self.part.headings.append(heading)
        self.part.parts |= {key: heading} if key else {}
        return heading

    def _results(self, outputs: Mapping[str, QuantityRecord]) -> None:
        part, rows = self.part, self._rows(outputs)
        printed = set() if self.is_full else {*self._printed()}
        told = {
            name: row for name, row in outputs.items()
            if printed.isdisjoint([(name, row.display.text), (row.symbol, row.display.text), name])
        }  # fmt: skip
        single, lists = gathered(told)
        part.outputs = [rows[name] for name in single]
        part.output_parts = [table for parts in lists for table in self.tables.of_parts(parts, given=False)]
        part.key_results = self._key_results(rows)
        if told or (self.is_full and not outputs):
            self._head("results")

    def _rows(self, outputs: Mapping[str, QuantityRecord]) -> dict[str, QuantityRow]:
        nth = counted(outputs)
        return {
            name: quantity_row(row, self.decimal, self._nth(row.description, nth.get(name)), self.tables.names)
            for name, row in outputs.items()
        }

    def _key_results(self, rows: dict[str, QuantityRow]) -> list[QuantityRow]:
        return [rows[name] for name, row in self.mechanism.outputs.items() if row.key] or list(rows.values())

    def _printed(self) -> Iterator[tuple[str, str] | str]:
        """The results that the steps print, by their ids, and those of repeated parts in tables, by their symbols.

        Also the names of those that a table lists by itself, and that say how many lines it has.
        """
        items = [item for section in self.mechanism.sections for item in section.items]
        for item in items:
            if item.result and item.id:
                yield item.id, item.result.text
            columns = [(k, column.symbol) for k, column in enumerate(item.columns) if column.symbol]
            yield from ((name, row[k]) for k, name in columns for row in item.rows)
        tables = {item.id for item in items if item.type == "table" and item.id}
        yield from (f"{table}_count" for table in tables)
        rows = self.mechanism.outputs.items()
        yield from (name for name, row in rows if row.part and not row.part.quantity and row.part.family in tables)

    def _phases(self, mechanism: MechanismRecord) -> None:
        """When the mechanism does what, a table for each abscissa; and what is not known of it, but what the chapter says under the same title."""
        phases, titles = mechanism.phases, {part.title for part in mechanism.absent}
        absent = [each for each in mechanism.phases_absent.values() if each.description not in titles]
        self.part.phases = self.tables.of_phases(phases)
        for each in phases.values():
            if each.parts:
                key = "phase_of_parts" if len(each.parts) > 1 else "phase_same"
                parts = self.words.listed([phases[name].description for name in each.parts])
                self.part.phases_absent.append(self.words.say(key, text=each.description, parts=parts))
        self.part.phases_absent += [
            self.words.say("phase_absent", description=each.description, text=each.text) for each in absent
        ]
        if phases or absent:
            self._head("phases")

    def _nth(self, description: str, number: int | None) -> str:
        return description if number is None else self.words.say("nth", text=description, n=number)

    def _files(self) -> Iterator[File]:
        mechanism = self.mechanism
        for export in mechanism.exports:
            if export.error:
                words = self.words.say("not_written", title=export.title, error=export.error)
                yield File(f"{self.stem}.{self.part.name}.{export.id}", words)
                continue
            count = len(mechanism.curves[export.abscissa].values)
            columns = ", ".join([export.abscissa, *export.columns])
            for ending, suffix in suffixes(self.part.name, export).items():
                key = "dxf_profile" if ending == "dxf" and len(export.columns) <= 2 else ending
                yield File(f"{self.stem}.{suffix}", self.words.say(key, title=export.title, n=count, columns=columns))

    def _check(self, check: CheckRecord) -> CheckRow:
        governing = f"{check.title}, {check.part_name}" if check.part_name else self._nth(check.title, check.part)
        is_told_by_part = self.is_full or any(part.status not in (None, "pass") for part in check.parts)
        return CheckRow(
            id=check.id,
            mechanism=self.part.name,
            chapter=self.part.letter,
            anchor=f"c-{self.part.letter}-{check.id}",
            title=governing,
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
            parts=self.tables.of_check(check) if check.parts and is_told_by_part else None,
            changed=check.before,
            part=self.part.record.part,
        )

    def _side(self, display: ShownRecord | None) -> str:
        return "–" if display is None else quantity(display.text, display.unit, self.decimal)

    def _used(self, check: CheckRecord) -> str:
        """How far a limit is used, in words; by how much it is missed where no share of it tells that."""
        if check.utilisation is None and check.status in ("warn", "fail") and check.margin_display:
            missed = check.margin_display.with_(text=check.margin_display.text.removeprefix("-"))
            return self.words.say("beyond", margin=self._side(missed))
        return utilisation(check.utilisation, check.status, self.decimal)
