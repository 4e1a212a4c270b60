"""All words of a report, in one place: in English here, in other languages in the program's catalogue, by key and English words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from diecut_report.languages.catalogues import program_catalogue

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
    "incomplete": "conditional",
    "doubtful_plugin": "The formulas of the plugin of {kind} have faults: do not rely on its results.",
    "count_pass": "{n} pass", "governing": "Governing", "no_checks": "There are no checks.",
    "reserve": "margin {margin}", "beyond": "{margin} beyond the limit", "self_test": "self-test", "missing": "Not given",
    "self_tests": "{n} self-tests of the calculation hold.",
    "sized": "Sized to its limit by the program, so that the only reserve is in the factors of the inputs", "sized_short": "sized to its limit",
    "class_function": "function", "class_strength": "strength", "class_practice": "practice", "class_numerical": "self-test",
    # chapters
    "contents": "Contents", "summary": "Summary", "checks": "Checks", "key_results": "Key results", "press_data": "Press data",
    "no_press_data": "The configuration gives no data of the press but its name.",
    "purpose": "Purpose and assumptions", "assumptions": "Assumptions and limits", "inputs": "Inputs", "results": "Results",
    "curves": "Curves", "symbols": "Symbols", "in_source": "in the source {symbol}", "absent": "Not calculated",
    "comparison": "Comparison of", "files": "Files beside this report",
    "errata": "Errata of the sources", "sources": "Sources", "no_sources": "The mechanisms name no source.",
    "program": "Program and configuration",
    "self_test_list": "Self-tests of the calculation", "no_self_tests": "The calculation has no self-tests.",
    "no_curves": "There are no curves.",
    "only_part": "This report shows {n} of the {total} mechanisms of the press; the verdict of the whole press is: {status}.",
    "missing_in_summary": "the keys that are missing stand in chapter 1",
    "governing_check": "Governing check", "needs": "needs {keys}", "assumed_values": "Assumed values",
    "more_in": "The calculation itself stands in the report with more detail.",
    "configuration": "Configuration as given", "appendix": "Appendix", "warnings": "Warnings",
    # tables
    "mechanism": "Mechanism", "check": "Check", "demand": "Demand", "limit": "Limit", "margin": "Margin",
    "utilisation": "Utilisation", "source": "Source", "number": "No.", "verdict": "Verdict", "quantity": "Quantity", "symbol": "Symbol",
    "value": "Value", "unit": "Unit", "origin": "Origin", "typed": "As typed", "place": "At", "path": "Key",
    "given": "given", "default": "default", "reference": "reference", "expression": "calculated",
    "refers": "from {path}", "from_press": "default, from {path}",
    "assumed": "assumed", "measured": "measured", "catalogue": "from a catalogue", "standard": "by a standard", "drawing": "from a drawing",
    "rests_on": "Rests on {n} assumed values", "moving_first": ", those first that move a governing check",
    "moves": "moves “{check}”", "move_each": "each moves “{check}”", "more_assumed": " and {n} more",
    "influence": "Influence of inputs",
    "influence_lead": "Each input that is given as a number is lowered and raised by {by}, or by its tolerance; all else stays as it is.",
    "influence_on": "Influence on {what}", "influence_today": "Now: {value}.", "influence_none": "no machine",
    "influence_utilisation": "utilisation",
    "influence_caption": "Blue: with the input raised, brown: lowered; ×: there is no such machine; the line: now.",
    "influence_lowered": "Lowered to", "influence_raised": "Raised to", "influence_gives": "Gives",
    "influence_more": "{n} more move it less.", "influence_still": "{n} do not move it.", "influence_tolerances": "Tolerances",
    "influence_at_default": "{n} inputs stand at their default and are not changed; report.influence.defaults changes them too.",
    "influence_normal": "{n} machines drawn with the seed {seed}, normally distributed, the tolerance being three standard deviations: {inputs}.",
    "influence_uniform": "{n} machines drawn with the seed {seed}, uniformly distributed within the tolerance: {inputs}.",
    "influence_probability": "Probability that it holds", "influence_interval": "95 % interval (Clopper and Pearson)",
    "influence_held": "Holds in", "influence_of": "{n} of {total}", "influence_all": "No check fails",
    "influence_sure": "{n} checks hold in all of these machines.",
    "advice_passes": "Followed together, the advice of the failing checks gives a pass: {changes}.",
    "advice_leaves": "Followed together, the advice of the failing checks ({changes}) leaves others that fail: {checks}.",
    "advice_impossible": "Followed together, the advice of the failing checks ({changes}) gives no machine that can be built.",
    "touches": "Touches", "part": "No.", "nth": "{text}, no. {n}", "repeated_parts": "{n} repeated parts", "curves_over": "Curves over: {axis}",
    "file": "File", "content": "Content",
    "phases": "Phases", "phase": "Phase", "role": "Role", "from": "From", "to": "To", "length": "Length", "time": "Time",
    "role_working": "working", "role_rest": "at rest", "role_moving": "moving", "role_window": "room for another part",
    "phase_absent": "{description}: {text}.", "phase_of_parts": "{text}: {parts}, taken together.", "phase_same": "{text}: the same as “{parts}”.",
    # items
    "met": "{demand} {operator} {limit} is met", "not_met": "{demand} {operator} {limit} is not met",
    "since": "Branch taken", "method": "Method", "residual": "relation met to {residual}", "checked_to": "verified to {residual}",
    "residual_rounded": "relation met up to the rounding of the computer", "checked_to_rounded": "verified up to the rounding of the computer",
    "of_curve": "of {curve}", "series": "Series", "looked_up": "From “{table}” for {choice}",
    "figure": "Figure", "fig": "Fig.", "table": "Table", "formula": "Formula",
    "as_formula": "as ({number})", "as_formula_with": "as ({number}) with {letters}", "letter_for": "{new} for {old}",
    "as_chapter": "Formulas, assumptions and symbols are those of chapter {letter}: a number in brackets tells where a formula stands.",
    "defaults": "Left at its default", "defaults_told": "as in chapter {letter}", "partners": "Mechanisms that it found", "taken_from": "From {name}",
    "where": "where", "shown_at": "Curves are shown at {places}.",
    "not_drawn": "This figure could not be drawn.", "not_written": "{title} could not be written: {error}",
    "curves_note": "Some rows of the curves; a place that stands twice is a jump, before and after it. Extremes lie between the rows and "
    "are given with the results.",
    "dxf": "{title} in mm: polylines through {n} points each on the layers PROFILE and PITCH_CURVE, the axis on CENTER",
    "dxf_profile": "{title} in mm: a polyline through {n} points on the layer PROFILE, the axis on CENTER",
    "csv": "{title} as a table of {n} rows: {columns}",
    "zero_everywhere": "{names}: 0 everywhere.", "drawing_scale": "scale bar", "positive": "positive", "negative": "negative",
    # changes
    "changes_since": "Changes since {name}", "changes_since_revision": "Changes since revision {name}",
    "changes_of": "Changes from {old} to {new}", "before": "Before", "after": "Now",
    "change": "Change", "changed_checks": "Checks that changed", "changed_inputs": "Inputs that changed",
    "changed_outputs": "Results that changed", "changed_mechanisms": "Mechanisms that changed", "changed_code": "What calculated",
    "following_inputs": "Inputs that follow from these", "no_changes": "Nothing changed.", "follows": "follows {path}",
    "checks_worse": "worse", "checks_better": "better", "checks_added": "new", "checks_removed": "no longer made",
    "checks_more used": "more used", "checks_less used": "less used",
    "changed_mark": "changed, before: {old}", "marked": "What changed is marked in the margin.",
    # the tools of a reader on a screen; what stands in braces is filled in by the page's script
    "search": "Search", "dark": "Dark", "hits": "{n} found", "all_checks": "All checks", "check_class": "Class", "all_classes": "all",
    "text_within": "Text", "shown_checks": "{n} of {total} checks", "copy_text": "Copy {text}", "copied": "Copied: {text}", "play": "Play a turn",
    "copy_refused": "The browser does not let the page copy {text}", "as_printed": "As printed",
    # programme
    "calculated_by": "Calculated by", "version": "version", "plugin": "Mechanism", "plugin_version": "Version", "kind": "Kind",
    "source_hash": "source", "libraries": "With", "extension": "Extension",
    "plugin_passed": "declarations and formulas checked", "plugin_failed": "declarations checked, formulas with faults",
    "carried": "Carried with this report", "carried_results": "Results", "attached": "attached to this PDF",
    "verified": "diecut-report verify calculates it again and tells what differs.",
    "config_file": "Configuration file", "sha256": "SHA-256",
    "failed_text": "This mechanism could not be calculated.", "failed_comparison": "This comparison could not be calculated.",
    "skipped_text": "This mechanism was not calculated, since what it refers to was not.",
    # office files
    "si_value": "Value, SI", "si_unit": "Unit, SI", "basis": "Basis", "note": "Note", "allowed": "Allowed", "class": "Class", "message": "Message",
    "key_result": "Key result", "yes": "yes", "time_ms": "Time, ms",
}  # fmt: skip
COUNTED = {  # what is said of a number ``n`` of things, with its form for one where English has another
    "count_pass": "1 passes", "self_tests": "1 self-test of the calculation holds.", "rests_on": "Rests on 1 assumed value", "more_assumed": "",
    "influence_more": "1 more moves it less.", "influence_still": "1 does not move it.",
    "influence_at_default": "1 input stands at its default and is not changed; report.influence.defaults changes it too.",
    "influence_sure": "1 check holds in all of these machines.", "repeated_parts": "", "dxf": "", "dxf_profile": "", "csv": "",
}  # fmt: skip


def one(key: str) -> str:
    """The English words of a key, of what is counted those for one: by them catalogues know it."""
    return COUNTED.get(key) or ENGLISH[key]


class Catalogue(Mapping[str, str]):
    """The words of one language; in templates ``t.summary``. A missing key is an error, one that is not translated is English."""

    def __init__(self, language: str) -> None:
        self.language = language
        self._own = program_catalogue(language) if language != "en" else None
        self._texts = {key: self._said(key) for key in ENGLISH}

    def _said(self, key: str) -> str:
        return (self._own and self._own.text(one(key), key)) or ENGLISH[key]

    def __getitem__(self, key: str) -> str:
        return self._texts[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def __len__(self) -> int:
        return len(self._texts)

    def say(self, key: str, **parts: object) -> str:
        """A sentence with its parts filled in, in the form that goes with their number ``n``."""
        return self._form(key, parts.get("n")).format(**parts)

    def _form(self, key: str, count: object) -> str:
        if key not in COUNTED or not isinstance(count, int):
            return self[key]
        if self._own and (found := self._own.plural(one(key), count, key)):
            return found
        return one(key) if count == 1 else ENGLISH[key]

    def listed(self, parts: Sequence[str]) -> str:
        """Several things in a sentence."""
        return f" {self['and']} ".join(filter(None, (", ".join(parts[:-1]), *parts[-1:])))
