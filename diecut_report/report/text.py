"""All words of a report, in one place: in English here, in other languages in the program's catalogue, by key and English words."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import lru_cache
from typing import Any

from diecut_report.quantities.formatting import ABOVE, shown
from diecut_report.quantities.units import pretty
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import CurveRecord, MechanismRecord, QuantityRecord
from diecut_report.results.model import ChangesRecord, ResultsRecord
from diecut_report.results.record import TextRole
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues, built_in, program_catalogue
from diecut_report.text.phrases import worded
from diecut_report.text.translation import Translator

ENGLISH: dict[str, str] = {
    # numbers and formulas
    "decimal": ".", "if": "if", "otherwise": "otherwise", "and": "and", "or": "or", "not": "not", "at": "at", "from_nought": "from 0 to {end}",
    "mean": "mean", "rms": "rms", "range": "range", "first": "first", "last": "last",
    # title block
    "calculation": "Calculation", "document": "Document", "revision": "Revision", "date": "Date", "sheet": "Sheet", "of": "of",
    "organisation": "Organisation", "prepared": "Prepared", "checked": "Checked", "approved": "Approved", "name": "Name",
    "signature": "Signature", "revisions": "Revisions", "description": "Description", "by": "By", "press": "Press",
    "release": "Release", "status": "Status", "status_draft": "draft", "status_for check": "for check", "status_released": "released",
    "not_released": "not released", "across": "NOT RELEASED", "norm_checked": "Norm control", "department": "Department",
    "owner": "Legal owner", "title": "Title", "document_type": "Document type", "identification": "Identification number",
    "issued": "Date of issue", "language": "Language", "logo": "Logo",
    "dstu_change": "Ch.", "dstu_page": "Sheet", "dstu_document": "Doc. No.", "dstu_sign": "Sign.", "dstu_date": "Date",
    "dstu_prepared": "Developed", "dstu_checked": "Checked", "dstu_norm_checked": "Norm control", "dstu_approved": "Approved",
    "dstu_letter": "Stage", "dstu_sheet": "Sheet", "dstu_sheets": "Sheets",
    # verdicts
    "pass": "pass", "warn": "warning", "fail": "fail", "error": "error", "skipped": "skipped", "not_checked": "not checked",
    "conditional": "conditional",
    "doubtful_plugin": "The formulas of the plugin of {kind} have faults: do not rely on its results.",
    "count_pass": "{n} pass", "count_rated": "{rated} of {carrying} parts with a method of calculation are rated",
    "governing": "Governing", "no_checks": "There are no checks.",
    "reserve": "margin {margin}", "beyond": "{margin} beyond the limit", "missing": "Not given",
    "self_tests": "{n} self-tests of the calculation hold.",
    "sized": "Sized to its limit by the program; the only margin left is in the input factors", "sized_short": "sized to its limit",
    "class_safety": "safety",
    "class_function": "function", "class_strength": "strength", "class_practice": "practice", "class_numerical": "self-test",
    # chapters
    "contents": "Contents", "summary": "Summary", "checks": "Checks", "key_results": "Key results", "press_data": "Press data",
    "no_press_data": "The configuration gives only the name of the press.",
    "purpose": "Purpose and assumptions", "assumptions": "Assumptions and limits", "inputs": "Inputs", "results": "Results",
    "curves": "Curves", "symbols": "Symbols", "in_source": "{symbol} in the source", "absent": "Not calculated",
    "comparison": "Comparison of", "files": "Accompanying files",
    "errata": "Errata in the sources", "sources": "Sources", "no_sources": "The mechanisms cite no sources.",
    "program": "Program and configuration",
    "self_test_list": "Self-tests of the calculation", "no_self_tests": "The calculation has no self-tests.",
    "no_curves": "There are no curves.",
    "only_part": "This report shows {n} of the {total} mechanisms of the press; the verdict of the whole press is: {status}.",
    "missing_in_summary": "the missing keys are listed in chapter 1",
    "needs": "needs {keys}",
    "more_in": "The full calculation is given in the more detailed report.",
    "configuration": "Configuration as given", "appendix": "Appendix", "warnings": "Warnings",
    # tables
    "mechanism": "Mechanism", "check": "Check", "demand": "Demand", "limit": "Limit", "margin": "Margin",
    "utilisation": "Utilisation", "source": "Source", "number": "No.", "verdict": "Verdict", "quantity": "Quantity", "symbol": "Symbol",
    "value": "Value", "unit": "Unit", "origin": "Origin", "typed": "As entered", "place": "At", "path": "Key",
    "given": "given", "default": "default", "reference": "reference", "expression": "calculated",
    "refers": "from {path}", "from_press": "default, from {path}",
    "assumed": "assumed", "measured": "measured", "catalogue": "from a catalogue", "standard": "from a standard", "drawing": "from a drawing",
    "sheet_format": "Format", "board": "Board",
    "worst_strength": "Worst strength check", "worst_function": "Worst function check", "none": "none", "not_covered": "Not covered",
    "not_modelled": "Parts of the drive line are not modelled.",
    "no_load_cases": "Load cases engage, start and stop are not run for the parts of the drive line.",
    "beyond_methods": "Shock from backlash, torsional vibration of the drive line, heating of the machine, guards, and the room that cranks, "
    "rims, chains and sheets leave each other are beyond the methods.",
    "owned_by": "Owner: {owner}", "no_owner": "no owner", "open_values": "Open values",
    "required_rate": "Required rate",
    "unnamed_basis": "assumed, as no note names its standard or catalogue",
    "influence": "Influence of inputs",
    "influence_lead": "Each numerical input is decreased and increased by {by}, or by its tolerance; all other inputs are unchanged.",
    "influence_on": "Influence on {what}", "influence_today": "Now: {value}.", "influence_none": "cannot exist",
    "influence_utilisation": "utilisation",
    "influence_caption": "Blue: input increased; brown: input decreased; ×: cannot exist; line: present value.",
    "influence_lowered": "Decreased to", "influence_raised": "Increased to", "influence_gives": "Gives",
    "influence_more": "{n} further inputs have a smaller effect.", "influence_still": "{n} inputs have no effect.",
                           "influence_tolerances": "Tolerances",
    "influence_at_default": "{n} inputs have their default values and are not varied; report.influence.defaults includes them.",
    "influence_normal": "{n} random machines (seed {seed}), normally distributed with a tolerance of three standard deviations: {inputs}.",
    "influence_uniform": "{n} random machines (seed {seed}), uniformly distributed within the tolerance: {inputs}.",
    "influence_probability": "Probability of passing", "influence_interval": "95 % confidence interval "
                                                                                "(Clopper–Pearson)",
    "influence_held": "Passed in", "influence_of": "{n} of {total}", "influence_all": "No check fails",
    "influence_sure": "{n} checks pass in all of these machines.",
    "advice_passes": "Applying the advice of all failing checks together gives a pass: {changes}.",
    "advice_leaves": "Applying the advice of all failing checks together ({changes}) leaves other checks failing: {checks}.",
    "advice_impossible": "Applying the advice of all failing checks together ({changes}) gives a machine that cannot be built.",
    # the drive line
    "front_view": "Drive line, front view", "side_view": "Shafts of the drive line, side by side",
    "front_view_caption": "Axes, pitch circles, belts and chains are to scale. Cranks and rockers are drawn as they point at the axis that they work "
                          "with. A part has the colour of its governing check of strength, safety or function.",
    "side_view_caption": "Places, lengths and diameters of shafts, bearings and pins are to scale. Hubs are drawn 1.6 times as thick as their "
                         "shaft; what is farther from its axis than the row is high is broken off. Beside each shaft stands the part of it that is "
                         "used most.",
    "tone_low": "up to {low}", "tone_middle": "up to {middle}", "tone_high": "above {middle}, or a warning", "tone_fail": "fails",
    "part_rated": "rated", "part_not_rated": "not rated", "part_accepted": "accepted without a rating", "part_none": "nothing to rate",
    "touches": "Touches", "part": "No.", "nth": "{text}, no. {n}", "repeated_parts": "{n} repeated parts", "curves_over": "Curves over: {axis}",
    "file": "File", "content": "Content",
    "phases": "Phases", "phase": "Phase", "role": "Role", "from": "From", "to": "To", "length": "Length", "time": "Time",
    "role_working": "working", "role_rest": "at rest", "role_moving": "moving", "role_window": "clearance for another part",
    "phase_absent": "{description}: {text}.", "phase_of_parts": "{text}: {parts} combined.", "phase_same": "{text}: the same as “{parts}”.",
    # items
    "met": "{demand} {operator} {limit} is met", "not_met": "{demand} {operator} {limit} is not met",
    "since": "Branch taken", "method": "Method", "residual": "relation satisfied to {residual}", "checked_to": "verified to {residual}",
    "residual_rounded": "relation satisfied to machine precision", "checked_to_rounded": "verified to machine precision",
    "series": "Series", "looked_up": "From “{table}” for {choice}",
    "figure": "Figure", "fig": "Fig.", "table": "Table", "formula": "Formula",
    "as_formula": "as ({number})", "as_formula_with": "as ({number}) with {letters}", "letter_for": "{new} for {old}",
    "as_chapter": "Formulas, assumptions and symbols are as in chapter {letter}; numbers in brackets refer to its formulas.",
    "defaults": "Left at default", "defaults_told": "as in chapter {letter}", "partners": "Mechanisms found", "taken_from": "From {name}",
    "where": "where", "shown_at": "Curves are shown at {places}.",
    "not_drawn": "This figure could not be drawn.", "not_written": "{title} could not be written: {error}",
    "curves_note": "Selected rows of the curves; a position listed twice marks a jump, with the values before and after it. Extremes may lie "
                   "between the rows and are given with the results.",
    "dxf": "{title} in mm: polylines through {n} points each on the layers PROFILE and PITCH_CURVE, the axis on CENTER",
    "dxf_profile": "{title} in mm: a polyline through {n} points on the layer PROFILE, the axis on CENTER",
    "csv": "{title} as a table of {n} rows: {columns}",
    "zero_everywhere": "{names}: 0 everywhere.", "positive": "positive", "negative": "negative",
    # changes
    "changes_since": "Changes since {name}", "changes_since_revision": "Changes since revision {name}",
    "changes_of": "Changes from {old} to {new}", "before": "Before", "after": "Now",
    "change": "Change", "changed_checks": "Checks that changed", "changed_inputs": "Inputs that changed",
    "changed_outputs": "Results that changed", "changed_mechanisms": "Mechanisms that changed", "changed_code": "Calculation software",
    "following_inputs": "Dependent inputs", "no_changes": "Nothing changed.", "follows": "follows {path}",
    "checks_worse": "worse", "checks_better": "better", "checks_added": "new", "checks_removed": "no longer performed",
    "checks_more used": "utilisation increased", "checks_less used": "utilisation decreased",
    "changed_mark": "changed, before: {old}", "marked": "Changes are marked in the margin.",
    # the tools of a reader on a screen; what stands in braces is filled in by the page's script
    "search": "Search", "dark": "Dark", "hits": "{n} found", "all_checks": "All checks", "check_class": "Class", "all_classes": "all",
    "text_within": "Text", "shown_checks": "{n} of {total} checks", "copy_text": "Copy {text}", "copied": "Copied: {text}",
                           "play": "Animate one revolution",
    "copy_refused": "The browser does not allow copying {text}", "as_printed": "As printed",
    # programme
    "calculated_by": "Calculated by", "version": "version", "plugin": "Mechanism", "plugin_version": "Version", "kind": "Kind",
    "source_hash": "source", "libraries": "With", "extension": "Extension",
    "plugin_passed": "declarations and formulas checked", "plugin_failed": "declarations checked, formulas with faults",
    "carried": "Embedded in this report", "carried_results": "Results", "attached": "attached to this PDF",
    "verified": "diecut-report verify recalculates it and reports any differences.",
    "config_file": "Configuration file", "sha256": "SHA-256",
    "failed_text": "This mechanism could not be calculated.", "failed_comparison": "This comparison could not be calculated.",
    "skipped_text": "This mechanism was not calculated because a mechanism it refers to was not.",
    # office files
    "si_value": "Value, SI", "si_unit": "Unit, SI", "basis": "Basis", "note": "Note", "allowed": "Allowed", "class": "Class", "message": "Message",
    "key_result": "Key result", "yes": "yes", "time_ms": "Time, ms",
}  # fmt: skip
COUNTED = {  # what is said of a number ``n`` of things, with its form for one where English has another
    "count_pass": "1 passes", "self_tests": "1 self-test of the calculation holds.",
    "influence_more": "1 further input has a smaller effect.", "influence_still": "1 input has no effect.",
    "influence_at_default": "1 input has its default value and is not varied; report.influence.defaults includes it.",
    "influence_sure": "1 check passes in all of these machines.", "repeated_parts": "", "dxf": "", "dxf_profile": "", "csv": "",
}  # fmt: skip


def one(key: str) -> str:
    """The English words of a key, of what is counted those for one: by them catalogues know it."""
    return COUNTED.get(key) or ENGLISH[key]


class Catalogue(dict[str, str]):
    """The words of one language; in templates ``t.summary``. A missing key is an error, one that is not translated is English."""

    def __init__(self, language: str) -> None:
        self.language = language
        self._own = own = program_catalogue(language) if language != "en" else None
        super().__init__({key: (own and own.text(one(key), key)) or text for key, text in ENGLISH.items()})

    def say(self, key: str, **parts: object) -> str:
        """A sentence with its parts filled in, in the form that goes with their number ``n``."""
        text, count = self[key], parts.get("n")
        if key in COUNTED and isinstance(count, int):
            own = self._own.plural(one(key), count, key) if self._own else ""
            text = own or (one(key) if count == 1 else ENGLISH[key])
        return text.format(**parts)

    def listed(self, parts: Sequence[str]) -> str:
        """Several things in a sentence."""
        return f" {self['and']} ".join(filter(None, (", ".join(parts[:-1]), *parts[-1:])))


# Numbers and units for print: the one place that gives the neutral texts of the results their printed form.


MINUS = "\u2212"
THIN = "\u202f"  # narrow, and never broken
RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_RAISED = str.maketrans("0123456789-", f"{RAISED}⁻")
_NUMBER = re.compile(r"([+-]?)(\d+)(?:\.(\d+))?(?:[eE]([+-]?\d+))?")
_SPACED_FROM = 5  # digits: 10 000, but 1200
# A long whole number of a sentence with its unit, and none that is a name: EN 10083.
_LONG = re.compile(
    r"(?<![\w.,])\d{5,}(?=(?:[.,]\d+)?[ \u00a0](?:[kMG]?N|[kMG]?Pa|k?W|k?J|[mµ]?m|kg|s|h|r/min|1/h|1/s|K)(?!\w))"
)


def parts(text: str) -> tuple[str, str, str, int] | None:
    """Sign, whole digits, decimals and power of ten of a number as results hold it ("-1.2e-05"); None of other texts."""
    found = _NUMBER.fullmatch(text)
    return (found[1], found[2], found[3] or "", int(found[4] or 0)) if found else None


def is_words(text: str) -> bool:
    """Whether the text of a value is not a number."""
    return parts(text) is None


def grouped(whole: str, separator: str = THIN) -> str:
    """Whole digits in threes from 10 000 up."""
    if len(whole) < _SPACED_FROM:
        return whole
    first = len(whole) % 3
    groups = [whole[:first]] if first else []
    return separator.join(groups + [whole[i : i + 3] for i in range(first, len(whole), 3)])


def number(text: str, decimal: str = ".") -> str:
    """A number of the results as it is printed: ``-1.2e-05`` → ``−1.2 × 10⁻⁵``; a text that is not a number stands as it is."""
    if text.startswith(ABOVE):
        return ABOVE + number(text.removeprefix(ABOVE), decimal)
    found = parts(text)
    if found is None:
        return text
    sign, whole, decimals, power = found
    body = grouped(whole) + (decimal + decimals if decimals else "")
    return (MINUS if sign == "-" else "") + body + (power_of_ten(power) if power else "")


def power_of_ten(exponent: int) -> str:
    """A power of ten behind a number."""
    return f"\u2009×\u200910{str(exponent).translate(_RAISED)}"


def quantity(text: str, unit: str, decimal: str = ".") -> str:
    """A number with its unit: ``21000``, ``N*m`` → ``21 000 N·m``; degrees stand close to the number."""
    return joined(number(text, decimal), pretty(unit))


def joined(printed: str, unit: str) -> str:
    """A printed number and a printed unit, not to be broken apart."""
    space = "" if not unit or unit.startswith(("°", "′", "″")) else "\u00a0"
    if not space and unit and printed.endswith(tuple(RAISED)):  # 10⁻⁶ °, whose sign is no part of the power
        space = THIN
    return f"{printed}{space}{unit}"


def significant(value: float, digits: int = 4) -> str:
    """A value as a neutral text with so many significant digits."""
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}"))))
    if -4 <= exponent < 6:
        return f"{value:.{max(digits - 1 - exponent, 0)}f}"
    return f"{value:.{digits - 1}e}"


def displayed(value: float, unit: str, decimal: str = ".") -> str:
    """An SI value as it is printed in a display unit, without the unit: with those of its digits that mean something."""
    return number(shown(value, unit)["text"], decimal)


def tidy(text: str) -> str:
    """A sentence with real minus signs, powers of ten written out, long numbers in threes, and degrees close to their number."""
    return _tidied(text)


@lru_cache(maxsize=8192)
def _tidied(text: str) -> str:
    powers = re.sub(r"(?<=\d)[eE]([+-]?\d+)(?!\w)", lambda found: power_of_ten(int(found[1])), text.replace(" °", "°"))
    powers = re.sub(f"(?<=[{RAISED}])°", f"{THIN}°", _LONG.sub(lambda found: grouped(found[0]), powers))
    return re.sub(r"(?<![\w.)])-(?=\d)", MINUS, powers)


def sentence(text: str) -> str:
    """A text as the beginning of a sentence."""
    return text[:1].upper() + text[1:]


# Names that a configuration gives: of mechanisms and of the parts of a list. They are printed as they are typed, in any language.


def given_names(mechanism: MechanismRecord, mechanisms: Collection[str]) -> frozenset[str]:
    """Return the names among the inputs of a mechanism: those of its parts, and of the ``mechanisms`` that it takes."""
    given = [(row, text) for row in mechanism.inputs.values() for text in _texts(row.value)]
    # a word that was typed, such as a role, is no mechanism, though one may be called so
    return frozenset(
        text for row, text in given
        if is_name(row) or (text in mechanisms and not (row.origin == "given" and row.text == text))
    )  # fmt: skip


def is_name(row: QuantityRecord) -> bool:
    """Return whether an input is what a part of a list is called."""
    return row.part is not None and row.part.quantity == "name"


def value_in_words(row: QuantityRecord, names: Collection[str] = ()) -> str:
    """Return the shown text of a quantity: a choice as words, a name, or what stands in the configuration elsewhere, as it is."""
    text = row.display.text
    is_taken = text == row.path or (row.origin == "given" and not row.text)  # a mechanism
    return text if is_name(row) or is_taken else in_words(text, names)


def in_words(text: str, names: Collection[str]) -> str:
    """Return a found text as words, unless it is one of the names: bearing main_b is called so wherever it stands."""
    return text if text in names else worded(text)


def _texts(value: Any) -> list[str]:
    return [each for each in (value if isinstance(value, list) else [value]) if isinstance(each, str)]


# Results in another language: the same numbers and keys, with the texts translated for print.


DATE = re.compile(r"(\d{4})-(\d\d)-(\d\d)")


def translated(results: ResultsRecord, catalogues: Catalogues) -> ResultsRecord:
    """Return the results as they are printed in the language of the catalogues; English ones as they are."""
    if catalogues.language == SOURCE_LANGUAGE:
        return results
    for data in results.calculated.values():
        catalogues.of(data.kind)
    words, project = _translator(catalogues), results.project
    rest, changes = _texts_of(words), results.changes
    lines = [line.with_(date=_date(line.date)) for line in project.revisions]
    left = [each.with_texts(rest) for each in results.summary.open]
    return results.with_(
        summary=results.summary.with_(open=left),
        project=project.with_(date=_date(project.date), revisions=lines),
        press=results.press.with_texts(rest),
        mechanisms={name: _mechanism(words, data, results) for name, data in results.mechanisms.items()},
        comparisons={name: _mechanism(words, data, results) for name, data in results.comparisons.items()},
        comparisons_left_out=results.comparisons_left_out and results.comparisons_left_out.with_texts(rest),
        changes=changes and translated_changes(changes, catalogues),
    )


def translated_changes(changes: ChangesRecord, catalogues: Catalogues) -> ChangesRecord:
    """Return the changes as they are printed in the language of the catalogues, which know the kinds of both sides."""
    if catalogues.language == SOURCE_LANGUAGE:
        return changes
    found = changes.with_texts(_texts_of(_translator(catalogues)))
    old, new = (side.with_(date=_date(side.date)) for side in (found.old, found.new))
    return found.with_(old=old, new=new)


def figure_translated(
    figure: FigureRecord, curves: Mapping[str, CurveRecord], kind: str, catalogues: Catalogues
) -> tuple[FigureRecord, dict[str, CurveRecord]]:
    """Return a figure of a mechanism of this kind with the curves that it shows, in the language of the catalogues."""
    texts = _texts_of(_translator(catalogues), kind)
    return figure.with_texts(texts), {name: curve.with_texts(texts) for name, curve in curves.items()}


def _translator(catalogues: Catalogues) -> Translator:
    return Translator(catalogues, Catalogue(catalogues.language)["decimal"])


def _date(given: str | None) -> str | None:
    """A date as it is written in documents: 22.11.2026."""
    found = DATE.fullmatch(given) if given else None
    return ".".join(reversed(found.groups())) if found else given


def _mechanism(words: Translator, data: MechanismRecord, results: ResultsRecord) -> MechanismRecord:
    kinds = [results.mechanisms[name].kind for name in data.between]
    home = kinds[-1] if kinds and all(map(built_in, kinds)) else data.kind
    return data.with_texts(_texts_of(words, data.kind, given_names(data, results.mechanisms), home))


def _texts_of(
    words: Translator, kind: str = "", names: frozenset[str] = frozenset(), home: str = ""
) -> Callable[[TextRole, str], str]:
    """Return what translates the texts of one mechanism, but the names that its configuration gives; ``home`` is the kind of its sources."""

    def translate(role: TextRole, text: str) -> str:
        if role is TextRole.SOURCE:
            return words.source(text, home or kind)
        if role is TextRole.PAPER:
            return words.paper(text, home or kind)
        if role is TextRole.TEXT:
            return words.said(text, kind)
        if text in names and role is not TextRole.LABEL:
            return text
        if role in (
            TextRole.DRAWN,
            TextRole.LABEL,
        ):  # what is not translated has at least its numbers in the language's form
            return words.numbers(words.said(text, kind))
        return words.known(worded(text), kind) or words.said(text, kind)

    return translate


# Papers that plugins call by a number of their own, by their place in the report's list of sources: 002 eq. 6 as [2] eq. 6.


PAPER = re.compile(r"\d{3}")
BRACKETS = re.compile(r"\((\[\d+\])\)")  # about the brackets of a number
CITING = (TextRole.TEXT, TextRole.DRAWN, TextRole.LABEL, TextRole.SOURCE)


def numbered(results: ResultsRecord) -> ResultsRecord:
    """Return the results with each paper named by its number in the list of sources, in brackets."""
    ids = {source.id for data in results.calculated.values() for source in data.sources}
    papers = {id: f"[{number}]" for number, id in enumerate(sorted(filter(PAPER.fullmatch, ids)), 1)}
    if not papers:
        return results
    named = re.compile(rf"(?<![\w.,\u202f\u2009\u00a0−-])(?<!\d )(?:{'|'.join(papers)})(?![\w\u202f\u2009\u00a0]|\.\d)")

    def text(role: TextRole, text: str) -> str:
        """Name papers by their numbers; what follows digits is no paper: 10 000 h. A text that names none stays, so that it can be translated."""
        made = named.sub(lambda found: papers[found[0]], text) if role in CITING else text
        return text if made == text else BRACKETS.sub(r"\1", made)

    return results.with_(
        mechanisms={name: data.with_texts(text) for name, data in results.mechanisms.items()},
        comparisons={name: data.with_texts(text) for name, data in results.comparisons.items()},
        changes=results.changes and results.changes.with_texts(text),
    )


# Columns of numbers aligned on their decimal sign: how much room a number leaves behind itself.


_ALIGNMENT_NUMBER = re.compile(r"[−-]?[\d\u202f]+(?:[.,](\d+))?")
_POWER = re.compile(r"[−-]?\d(?:[.,]\d+)?\u2009×\u200910[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")
MOST = 8  # digits for which there is a class


def decimals(text: str) -> int | None:
    """How many digits a printed number has behind its decimal sign; None of words, of a dash, of a power of ten."""
    found = _ALIGNMENT_NUMBER.fullmatch(text)
    return len(found[1] or "") if found else None


def is_power(text: str) -> bool:
    """Whether a text is a printed number with a power of ten."""
    return _POWER.fullmatch(text) is not None


def rooms(texts: Sequence[str]) -> list[str]:
    """The class of each text of a column: ``f2`` leaves room for two digits, ``w2`` for these and the decimal sign."""
    found = [decimals(text) for text in texts]
    most = max((count for count in found if count is not None), default=0)
    return ["" if n in (None, most) else f"{'f' if n else 'w'}{min(most - (n or 0), MOST)}" for n in found]
