"""A results file that comes from outside, judged before it is used: its size, its letters, and the form of what is read of it."""

from __future__ import annotations

import json
import re
from base64 import b64decode
from collections.abc import Mapping
from typing import Any, NoReturn

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from diecut_report.config.own_tables import MAX_FILES as MOST_TABLES
from diecut_report.config.yaml import CONTROL
from diecut_report.errors import MAX_SHOWN, MAX_TEXT, Problem, UserError, refusal
from diecut_report.pictures import MAX_BYTES as MOST_OF_PICTURE
from diecut_report.pictures import PictureFault, media_type
from diecut_report.results.model import LogoRecord, ResultsRecord
from diecut_report.results.record import FORM_VERSION, SCHEMA_VERSION, WORDINGS
from diecut_report.text.phrases import Phrase, message_of, phrase

# Results of another form than the program writes: which they are of, and what is told where they cannot be used.


MOST_LETTERS = 4 * MOST_OF_PICTURE // 3 + 4  # of a logo in base64
TOLD_SINCE = "1.3"  # the first form that tells itself
SHAPE = re.compile(r"\d{1,4}\.\d{1,4}")
VERSION = re.compile(r"\d[\w.+-]{0,40}", re.ASCII)  # of a program or a library


def refuse_other_form(results: Mapping[str, Any], file: str) -> None:
    """Raise UserError with both versions where the first number of the form is another one."""
    given = results.get("schema_version")
    if isinstance(given, bool) or not isinstance(given, int) or given == SCHEMA_VERSION:
        return
    told = results.get("form_version")
    what = (
        "Install a newer diecut-report." if given > SCHEMA_VERSION else "Calculate them anew from their configuration."
    )
    message = Phrase(
        "These results are of {theirs}{by}; this program reads form {own} and older ones that begin with {first}. {what}",
        theirs=Phrase("form {version}", version=told if _is_version(told) else str(given)[:20]),
        by=_by(results),
        own=FORM_VERSION,
        first="1.",
        what=phrase(what),
    )
    raise UserError(Problem(message, file, path="schema_version"))


def other_form(results: Mapping[str, Any]) -> str:
    """Return in words that results are of another form, with both versions; empty where they are of the program's own."""
    told = results.get("form_version")
    if told == FORM_VERSION:
        return ""
    former = Phrase("a form before {first}", first=TOLD_SINCE)
    theirs = Phrase("form {version}", version=told) if _is_version(told) else former
    template = "These results are of {theirs}{by}, this program has form {own}: they may lack what it needs."
    return Phrase(template, theirs=theirs, by=_by(results), own=FORM_VERSION)


def _by(results: Mapping[str, Any]) -> str:
    program = results.get("program")
    version = program.get("version") if isinstance(program, dict) else None
    is_known = isinstance(version, str) and VERSION.fullmatch(version)
    return Phrase(" (diecut-report {version})", version=version) if is_known else ""


def _is_version(told: object) -> bool:
    return isinstance(told, str) and SHAPE.fullmatch(told) is not None


MOST_VALUES = 10_000_000  # of a results file
LARGEST = 1e290  # of a number, which has a value in each unit then
ASK = phrase("Give a results file as the program wrote it.")


def results_of(content: bytes, file: str) -> ResultsRecord:
    """Return results from the bytes of their file; UserError with what is wrong with them."""
    found = parsed(content, file)
    refuse_other_form(found, file)
    _refuse_hidden(found, file)
    try:
        is_first = str(found.get("form_version", FIRST)).startswith("1.")  # those before 1.3 do not report their form
        results = _of_form_1(found) if is_first else ResultsRecord.model_validate(found)
    except ValidationError as error:
        faults = error.errors(include_url=False)[:MAX_SHOWN]
        problems = [Problem(_words(fault), file, path=_path(fault["loc"])) for fault in faults]
        why = other_form(found)
        raise UserError([*([Problem(why, file)] if why else []), *problems]) from None
    governing = results.governing
    known = results.calculated.get(governing.mechanism) if governing else None
    if governing and not (known and any(each.id == governing.check for each in known.checks)):
        raise UserError(Problem(_unlike(phrase("it names no check of these results")), file, path="governing"))
    config = results.config
    if len(config.materials) > MOST_TABLES or len(config.file) > MAX_TEXT:  # which a configuration could not name
        raise UserError(Problem(Phrase("is not what stands there in results. {ask}", ask=ASK), file, path="config"))
    if config.logo:
        _refuse_logo(config.logo, file)
    return results


def _refuse_logo(logo: LogoRecord, file: str) -> None:
    told: object = Phrase("the logo is not {media_type}", media_type=logo.media_type)
    try:
        if len(logo.base64) <= MOST_LETTERS and media_type(b64decode(logo.base64, validate=True)) == logo.media_type:
            return
    except PictureFault as fault:
        told = Phrase("the logo {fault}", fault=fault)
    except ValueError:  # an error of base64
        pass  # what is no picture is not of this type either
    raise UserError(Problem(_unlike(told), file, path="config.logo"))


def _unlike(told: object) -> Phrase:
    return Phrase("is not what stands there in results: {told}. {ask}", told=told, ask=ASK)


def _words(fault: ErrorDetails) -> Phrase:
    return Phrase("is missing. {ask}", ask=ASK) if fault["type"] == "missing" else _unlike(fault["msg"])


def parsed(content: bytes, file: str) -> dict[str, Any]:
    """Return the block of keys that a JSON file holds; UserError where it holds none, or too much."""
    if content.count(b",") + content.count(b"[") + content.count(b"{") > MOST_VALUES:
        template = "The file holds more than {most_values} values. {ask}"
        raise refusal(template, file, most_values=f"{MOST_VALUES:,}", ask=ASK)
    try:
        found = json.loads(
            content,
            parse_constant=_refuse_constant,
            parse_float=_finite,
            parse_int=_whole,
            object_pairs_hook=_without_doubles,
        )
    except (ValueError, RecursionError) as error:
        template = "This is not a JSON file that can be read: {told}. {ask}"
        raise refusal(template, file, told=_told(error), ask=ASK) from error
    if not isinstance(found, dict):
        raise refusal("This JSON file does not hold results. {ask}", file, ask=ASK)
    return found


class _Unfit(ValueError):
    """Report what JSON may hold and results cannot."""


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """The block of keys; a key that stands there twice would show one reader one value, and another reader the other."""
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        doubled = next(name for name in names if names.count(name) > 1)
        raise _Unfit(Phrase("the key {name} stands twice in one block", name=ascii(doubled[:80])))
    return found


def _told(error: ValueError | RecursionError) -> str:
    match error:
        case RecursionError():
            return phrase("it is nested too deeply")
        case UnicodeDecodeError():
            return phrase("it is not UTF-8 text")
        case json.JSONDecodeError() | _Unfit():
            return str(error)
    return phrase("a whole number in it has too many digits")


def _refuse_constant(name: str) -> NoReturn:
    raise _Unfit(Phrase("it holds {name}, which is not a number", name=name))


def _finite(text: str) -> float:
    value = float(text)
    if abs(value) > LARGEST:
        raise _Unfit(Phrase("it holds {text}, which is beyond the range of numbers", text=text[:20]))
    return value


def _whole(text: str) -> int:
    found = int(text)
    _finite(text)  # it is compared with others as a float
    return found


def _path(place: tuple[str | int, ...]) -> str:
    text = ".".join(map(str, place))
    return text if text.isprintable() and len(text) < 200 else ascii(text[:200])


def _refuse_hidden(data: Any, file: str) -> None:
    """Refuse letters that turn others around or act on a terminal, as configurations are refused that hold them."""
    waiting = [data]
    while waiting:
        part = waiting.pop()
        if isinstance(part, dict):
            waiting += [*part, *part.values()]
        elif isinstance(part, list):
            waiting += [each for each in part if not isinstance(each, float)]
        elif isinstance(part, str) and (found := CONTROL.search(part)):
            template = "The file holds the control character U+{code}. {ask}"
            raise refusal(template, file, code=f"{ord(found[0]):04X}", ask=ASK)


# Results files of form 1 (up to 1.7), which kept how a text was made beside the texts, by the English sentence.


FIRST = "1.0"
LONGEST = 100_000  # letters of a text


def _of_form_1(results: Mapping[str, Any]) -> ResultsRecord:
    wordings = results.get("wordings", {})
    made = {text: _message(wording) for text, wording in wordings.items()} if isinstance(wordings, dict) else {}
    own = {key: part for key, part in results.items() if key != "wordings"}
    context = {WORDINGS: {text: each for text, each in made.items() if each == text}}
    return ResultsRecord.model_validate({"form_version": FIRST} | own, context=context)


def _message(wording: Any) -> Phrase | None:
    """A text with its template and values; None where it is not one."""
    try:
        return message_of(_message_data(wording))
    except (ValueError, RecursionError):
        return None


def _message_data(wording: Any) -> Any:
    """A text with its values as the form of today has it; None where it is not one, or longer than any."""
    if not isinstance(wording, dict):
        return wording
    given, template = wording.get("values") or {}, str(wording.get("text"))
    if not isinstance(given, dict):
        return None
    values = {name: _message_data(each) for name, each in given.items()}
    texts = {name: each["text"] if isinstance(each, dict) else str(each) for name, each in values.items()}
    if len(template) + template.count("{") * max(map(len, texts.values()), default=0) > LONGEST:
        return None
    counted = {key: wording[key] for key in ("one", "count") if key in wording}
    return {"template": wording.get("text"), "values": values, "text": str.__str__(Phrase(template, texts))} | counted
