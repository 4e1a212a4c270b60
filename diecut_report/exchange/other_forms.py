"""Results of another form than the program writes: which they are of, and what is told where they cannot be used."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.results.form.version import FORM_VERSION, SCHEMA_VERSION

TOLD_SINCE = "1.3"  # the first form that tells itself
SHAPE = re.compile(r"\d{1,4}\.\d{1,4}")
PROGRAM = re.compile(r"\d[\w.+-]{0,40}", re.ASCII)


def refuse_other_form(results: Mapping[str, Any], file: str) -> None:
    """Raise UserError with both versions where the first number of the form is another one."""
    given = results.get("schema_version")
    if isinstance(given, bool) or not isinstance(given, int) or given == SCHEMA_VERSION:
        return
    told = results.get("form_version")
    what = (
        "Install a newer diecut-report." if given > SCHEMA_VERSION else "Calculate them anew from their configuration."
    )
    words = Phrase(
        "These results are of {theirs}{by}; this program reads form {own} and older ones that begin with {first}. {what}",
        theirs=Phrase("form {version}", version=told if _is_version(told) else str(given)[:20]),
        by=_by(results),
        own=FORM_VERSION,
        first=f"{SCHEMA_VERSION}.",
        what=phrase(what),
    )
    raise UserError(Problem(words, file, path="schema_version"))


def other_form(results: Mapping[str, Any]) -> str:
    """Return in words that results are of another form, with both versions; empty where they are of the program's own."""
    told = results.get("form_version")
    if told == FORM_VERSION:
        return ""
    theirs = (
        Phrase("form {version}", version=told)
        if _is_version(told)
        else Phrase("a form before {first}", first=TOLD_SINCE)
    )
    words = "These results are of {theirs}{by}, this program has form {own}: they may lack what it needs."
    return Phrase(words, theirs=theirs, by=_by(results), own=FORM_VERSION)


def _by(results: Mapping[str, Any]) -> str:
    program = results.get("program")
    version = program.get("version") if isinstance(program, dict) else None
    is_known = isinstance(version, str) and PROGRAM.fullmatch(version)
    return Phrase(" (diecut-report {version})", version=version) if is_known else ""


def _is_version(told: object) -> bool:
    return isinstance(told, str) and SHAPE.fullmatch(told) is not None
