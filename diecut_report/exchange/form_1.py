"""Results files of form 1 (up to 1.7), which kept how a text was made beside the texts, by the English sentence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from diecut_report.results.model import ResultsRecord
from diecut_report.results.record import WORDINGS
from diecut_report.text.phrases import Phrase, message_of

FIRST = "1.0"
LONGEST = 100_000  # letters of a text


def is_own(results: Mapping[str, Any]) -> bool:
    """Return whether results are of form 1; those before 1.3 do not report their form."""
    return str(results.get("form_version", FIRST)).startswith("1.")


def results_of(results: Mapping[str, Any]) -> ResultsRecord:
    """Return results of form 1; ValueError (of pydantic) with all that is wrong with them."""
    wordings = results.get("wordings", {})
    made = {text: _message(wording) for text, wording in wordings.items()} if isinstance(wordings, dict) else {}
    own = {key: part for key, part in results.items() if key != "wordings"}
    context = {WORDINGS: {text: each for text, each in made.items() if each == text}}
    return ResultsRecord.model_validate({"form_version": FIRST} | own, context=context)


def _message(wording: Any) -> Phrase | None:
    """A text with its template and values; None where it is not one."""
    try:
        return message_of(_data(wording))
    except (ValueError, RecursionError):
        return None


def _data(wording: Any) -> Any:
    """A text with its values as the form of today has it; None where it is not one, or longer than any."""
    if not isinstance(wording, dict):
        return wording
    given, template = wording.get("values") or {}, str(wording.get("text"))
    if not isinstance(given, dict):
        return None
    values = {name: _data(each) for name, each in given.items()}
    texts = {name: _text(each) for name, each in values.items()}
    if len(template) + template.count("{") * max(map(len, texts.values()), default=0) > LONGEST:
        return None
    counted = {key: wording[key] for key in ("one", "count") if key in wording}
    return {"template": wording.get("text"), "values": values, "text": str.__str__(Phrase(template, texts))} | counted


def _text(value: Any) -> str:
    return value["text"] if isinstance(value, dict) else str(value)
