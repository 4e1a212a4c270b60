"""The results that a file carries: a report as PDF or HTML, or a results file. What the file is, its content tells, not its name."""

from __future__ import annotations

import base64
import binascii
import json
import os
import re
import zlib
from base64 import b64decode
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any, Literal, NoReturn

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from diecut_report.config.own_tables import MAX_FILES as MOST_TABLES
from diecut_report.config.own_tables import logo_fault, name_fault, table_faults
from diecut_report.config.yaml import CONTROL
from diecut_report.errors import MAX_SHOWN, MAX_TEXT, Problem, UserError, refusal
from diecut_report.files import content, write_all
from diecut_report.pictures import MAX_BYTES as MOST_OF_PICTURE
from diecut_report.pictures import PictureFault, media_type
from diecut_report.results.model import CarriedConfigRecord, LogoRecord, ResultsRecord
from diecut_report.results.record import FORM_VERSION, SCHEMA_VERSION, WORDINGS
from diecut_report.results.results_file import source_content
from diecut_report.text.phrases import Phrase, message_of, phrase

# Reads the results that an HTML report carries, from the one link that the program writes; nothing of the page is run or fetched.


LINK = re.compile(rb'download="results\.json\.gz" href="data:application/gzip;base64,([A-Za-z0-9+/]*={0,2})"')
GZIP = 16 + zlib.MAX_WBITS
DAMAGED = phrase("The results that the page carries are damaged. Give the file as the program wrote it.")


def linked_results(content: bytes, most: int, file: str) -> bytes | None:
    """Return the results file in a page, None where it carries none; UserError where it carries two, or a damaged or too large one."""
    found = LINK.findall(content)
    if not found:
        return None
    if len(found) > 1:
        template = (
            "The page carries {count} results files, and a report has one. Give the file as the program wrote it."
        )
        raise refusal(template, file, count=len(found))
    unpacking = zlib.decompressobj(GZIP)
    try:
        content = unpacking.decompress(base64.b64decode(found[0], validate=True), most + 1)
    except (binascii.Error, zlib.error) as error:
        raise refusal(DAMAGED, file) from error
    if len(content) > most:
        template = "What the page carries is too large: it unpacks to more than {most} MB."
        raise refusal(template, file, most=f"{most / 1e6:g}")
    if not unpacking.eof or unpacking.unused_data:
        raise refusal(DAMAGED, file)
    return content


MOST = 200_000_000  # bytes of a report
MOST_RESULTS = 100_000_000  # bytes of the results in it
LONGEST_NAME = 255  # of a file, in bytes
BLANK = b" \t\r\n"
BOM = b"\xef\xbb\xbf"
Form = Literal["pdf", "html", "json"]
ENDINGS: Mapping[Form, tuple[str, ...]] = {"pdf": (".pdf",), "html": (".html", ".htm"), "json": (".json",)}


@dataclass(frozen=True)
class CarriedResults:
    """Hold the results of a file, and the bytes of their own file; ``content`` is the whole file.

    ``tables`` are the user's own that the configuration names, and its logo, by these names, which lead nowhere but beside it and below;
    ``former_tables`` those of the former revision, since which the report shows changes.
    """

    path: Path
    form: Form
    content: bytes
    results: ResultsRecord
    results_content: bytes
    tables: dict[str, bytes]
    former_tables: dict[str, bytes]

    def require_own_name(self) -> None:
        """Raise UserError where the file is named as another form: what opens it by its name would show what nobody has compared."""
        ending = PurePath(self.path.name.rstrip(". ")).suffix.lower()  # Windows drops dots and blanks at the end
        if ending and ending not in ENDINGS[self.form]:
            template = "It is named {ending}, but holds what {own} files hold: opened by its name it may show something else. Rename it."
            raise refusal(template, str(self.path), ending=ending, own=ENDINGS[self.form][0])


def carried_results(path: Path) -> CarriedResults:
    """Return what a report or a results file carries; UserError where it is neither, or cannot be read."""
    whole = content(path, MOST, phrase("a report (PDF, HTML) or a results file (JSON)"))
    form = form_of(whole)
    if form is None:
        template = "This is neither a report (PDF, HTML) nor a results file (JSON). Give a file that `diecut-report report` wrote."
        raise refusal(template, path)
    found = _results_content(whole, form, str(path))
    results = results_of(found, str(path))
    attached = _attached(whole, "config.yaml", str(path)) if form == "pdf" else None  # for a reader's convenience
    if attached not in (None, source_content(results.config)):
        template = "The configuration that is attached is not the one in the attached results. Somebody has exchanged one of the two."
        raise refusal(template, path)
    tables = _tables(results.config, str(path))
    former = _tables(results.former, str(path)) if results.former else {}
    return CarriedResults(path, form, whole, results, found, tables, former)


def form_of(whole: bytes) -> Form | None:
    """Return what a file is by its first letters; None where it is neither a report nor JSON."""
    start = whole[:1024].removeprefix(BOM).lstrip(BLANK)
    forms: dict[bytes, Form] = {b"%PDF-": "pdf", b"<": "html", b"{": "json"}
    return next((form for letters, form in forms.items() if start.startswith(letters)), None)


def _results_content(whole: bytes, form: Form, file: str) -> bytes:
    if form == "json":
        found: bytes | None = whole
        if len(whole) > MOST_RESULTS:
            template = "The file is too large: {count} MB; results have at most {most_results} MB."
            raise refusal(template, file, count=f"{len(whole) / 1e6:.1f}", most_results=f"{MOST_RESULTS / 1e6:g}")
    elif form == "html":
        found = linked_results(whole, MOST_RESULTS, file)
    else:
        found = _attached(whole, "results.json", file)
    if found is None:
        template = "This file carries no results: another program made it, or an earlier version of diecut-report, or it was printed anew."
        raise refusal(template, file)
    return found


def _attached(whole: bytes, name: str, file: str) -> bytes | None:
    from diecut_report.exchange.pdf_attachments import attachments  # with the library, which others do not need

    return attachments(whole, MOST_RESULTS, file)[name]


def _tables(config: CarriedConfigRecord, file: str) -> dict[str, bytes]:
    found = {table.file: source_content(table) for table in config.materials}
    logo = {config.logo.file: base64.b64decode(config.logo.base64)} if config.logo else {}
    faults = [Phrase("The name of a table {fault}.", fault=fault) for name in found if (fault := name_fault(name))]
    faults += [Phrase("The name of the logo {fault}.", fault=fault) for name in logo if (fault := logo_fault(name))]
    found |= logo
    template = "The name of a file is longer than {longest_name} bytes: {name}…."
    long = [name for name in found if any(len(part.encode()) > LONGEST_NAME for part in Path(name).parts)]
    faults += [Phrase(template, longest_name=LONGEST_NAME, name=name[:80]) for name in long]
    if faults:
        raise UserError([Problem(fault, file) for fault in faults])
    return found


# The configuration and the results of a report as files again. Their names are the report's own, whatever stands in it.


def extract(report: Path, folder: Path) -> list[Path]:
    """Write ``STEM.yaml`` and ``STEM.json`` of a report into a folder, and the tables and the logo that the configuration names; the files.

    One that is there already stays as it is. UserError where it has another content, or where the report carries nothing that can
    be read.
    """
    found = carried_results(report)
    config = source_content(found.results.config)
    contents = {f"{report.stem}.yaml": config, f"{report.stem}.json": found.results_content}
    if doubled := [name for name, times in Counter(map(PurePath, (*contents, *found.tables))).items() if times > 1]:
        template = "The configuration names a file {doubled}, and would be called so itself. Rename the report."
        raise refusal(template, report, doubled=doubled[0])
    tables = (table.file for table in found.results.config.materials)
    if faults := [fault for name in tables for fault in table_faults(found.tables[name], name)]:
        raise UserError(faults)
    files = {folder / name: each for name, each in (contents | found.tables).items()}
    if problems := list(_refused(files, folder)):
        raise UserError(problems)
    write_all({path: each for path, each in files.items() if not os.path.lexists(path)}, keep=report)
    return list(files)


def _refused(files: Mapping[Path, bytes], folder: Path) -> Iterator[Problem]:
    for path, wanted in files.items():
        if os.path.lexists(path) and not _is_same(path, wanted):
            message = phrase("Another file of this name exists and is not overwritten: choose another folder with -o.")
            yield Problem(message, str(path))
        elif not Path(os.path.realpath(path.parent)).is_relative_to(os.path.realpath(folder)):
            message = phrase("A link leads out of the folder here, and is not followed: choose another folder with -o.")
            yield Problem(message, str(path))


def _is_same(path: Path, wanted: bytes) -> bool:
    is_alike = path.is_file() and path.stat().st_size == len(wanted)
    return is_alike and content(path, len(wanted), phrase("a file")) == wanted


# A results file that comes from outside, judged before it is used: its size, its letters, and the form of what is read of it.
#
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
