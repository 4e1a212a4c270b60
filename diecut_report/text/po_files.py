"""Catalogues on disk: gettext PO files, whose msgid is the English text."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Callable, Iterable
from datetime import UTC, datetime
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

from babel.messages.catalog import Catalog, Message
from babel.messages.pofile import PoFileParser, write_po

from diecut_report.text.phrases import Phrase, phrase

NEVER = datetime(2026, 1, 1, tzinfo=UTC)  # equal texts give equal files
WIDTH = 140
MAX_PLURAL_FORMS = 10  # Arabic has six
_FORMS = re.compile(rb"nplurals\s*=\s*(\d+)")
_HIDDEN = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufffe\uffff]")
_LINE = re.compile(r'(?:(?:msgctxt|msgid|msgid_plural|msgstr(?:\[\d+\])?)\s*)?"(?:[^"\\]|\\.)*"')
_FILLED = re.compile(r"\{[\w.]+(?::\w+)?\}")
_FORMER = re.compile(rb"^#~\|.*$", re.MULTILINE)
UNSAID = (b'"Generated-By', b'"Report-Msgid-Bugs-To', b'"Last-Translator', b'"Language-Team')  # lines of the head


def empty(language: str, project: str, holder: str = "the authors of diecut-report") -> Catalog:
    """Return a catalogue without messages."""
    return Catalog(locale=language, project=project, version="1", charset="utf-8", fuzzy=False, creation_date=NEVER, revision_date=NEVER,
                   copyright_holder=holder, header_comment=f"# Words of {project} in the language {language}.",)  # fmt: skip


def read(file: Path, language: str) -> Catalog:
    """Return the catalogue of a file; ValueError, or another exception of Babel's, where it is none."""
    return _parsed(file.read_bytes(), language)


def _parsed(content: bytes, language: str) -> Catalog:
    # what an obsolete text was before its last change, which gettext writes and Babel cannot read
    content = _FORMER.sub(b"", content.removeprefix(BOM_UTF8))
    if any(int(count[:9]) > MAX_PLURAL_FORMS for count in _FORMS.findall(content)):  # Babel makes a list of so many
        template = "a language has at most {most_forms} forms of a word for a number"
        raise ValueError(Phrase(template, most_forms=MAX_PLURAL_FORMS))
    lines = [line.strip() for line in content.decode("utf-8").split("\n")]
    _judge_words(lines)
    for number, line in enumerate(lines, 1):
        if line and not line.startswith("#") and not _LINE.fullmatch(line):
            template = (
                "line {number} is {line}; write msgid or msgstr, and a text that begins and ends with a quotation mark"
            )
            raise ValueError(Phrase(template, number=number, line=repr(line)))
    found = _EachOnce(locale=language, charset="utf-8")
    PoFileParser(found, abort_invalid=True).parse(BytesIO(content))
    return found


def _judge_words(lines: Iterable[str]) -> None:
    """Raise ValueError where a text has a word twice, as two translations: Babel keeps one, and says nothing of the other."""
    known: list[str] = []
    for number, line in enumerate(lines, 1):
        word = line.partition('"')[0].rstrip() if line.startswith("msg") else ""
        known = [] if word in ("msgctxt", "msgid") and any(each.startswith("msgstr") for each in known) else known
        if word in known:
            raise ValueError(
                Phrase("line {number} is a second {word} of one text; keep one of them", number=number, word=word)
            )
        known += [word] if word else []


class _EachOnce(Catalog):
    """A catalogue that has each text once: of two Babel keeps the first translation, and says nothing of the other."""

    def __setitem__(self, id: Any, message: Message) -> None:
        before = self.get(id, message.context) if id else None
        if before is not None:
            template = "line {line} translates {id}, as line {before} does; keep one of them"
            raise ValueError(Phrase(template, line=message.lineno, id=repr(id), before=before.lineno))
        super().__setitem__(id, message)


def judge(catalogue: Catalog, plural: Callable[[int], int]) -> None:
    """Raise ValueError where texts hold letters that act on a page or a terminal, are filled otherwise, or a number has no form of a word."""
    for message in catalogue:
        said = (message.string or "",) if isinstance(message.string, str | None) else message.string
        if letter := next(filter(None, map(_HIDDEN.search, said)), None):
            template = "the translation of {id} holds U+{code}"
            raise ValueError(Phrase(template, id=repr(message.id), code=format(ord(letter[0]), "04X")))
        if not message.fuzzy and all(said):
            _judge_filling(message, said)
    for count in range(200):
        if not 0 <= plural(count) < catalogue.num_plurals:
            raise ValueError(Phrase("its plural forms have none for {count}", count=count))


def _judge_filling(message: Message, said: Iterable[str]) -> None:
    """Raise ValueError where a translation is filled with something else than its text: a number was lost, or {NAME} printed as it stands."""
    texts = [message.id] if isinstance(message.id, str) else message.id
    known = [set(_FILLED.findall(text)) for text in texts]
    may, must = set().union(*known), set.intersection(*known)  # what is counted may be left out where there is one
    for text in said:
        there = set(_FILLED.findall(text))
        if there - may or must - there:
            template = "line {line}: the translation of {id} is filled with {there}, the text itself with {wanted}; write the same names"
            told = [", ".join(sorted(names)) or phrase("nothing") for names in (there, may)]
            raise ValueError(Phrase(template, line=message.lineno, id=repr(texts[0]), there=told[0], wanted=told[1]))
        if set(_FILLED.sub("", text)) & set("{}") - set("".join(texts)):
            template = "line {line}: the translation of {id} holds a brace that its text has not; take it away"
            raise ValueError(Phrase(template, line=message.lineno, id=repr(texts[0])))


def written(catalogue: Catalog) -> bytes:
    """Return the text of a catalogue's file."""
    stream = BytesIO()
    write_po(stream, catalogue, width=WIDTH, ignore_obsolete=True)
    lines = stream.getvalue().splitlines(keepends=True)
    return b"".join(line for line in lines if not line.startswith(UNSAID))


class ChangedCatalogue(NamedTuple):
    """Hold a catalogue's file, and how many texts of it since wait to be translated, are obsolete, and have their translation again."""

    content: bytes
    added: int = 0
    obsolete: int = 0
    returned: int = 0


def changed(
    there: bytes | None, language: str, project: str, texts: Iterable[tuple[str, str]], unused: Iterable[str] = ()
) -> ChangedCatalogue:
    """Return a catalogue's file with untranslated messages of these texts, each with what it is of; unused ones are marked as obsolete.

    What it has already is left out and stays as it is; where it is not there yet (None) it begins with its head. A text that was obsolete
    has its translation again.
    """
    found = empty(language, project, holder=f"the authors of {project}")
    if there is None:
        _add(found, texts)
        return ChangedCatalogue(written(found), len(found))
    known = _parsed(there, language)
    lacking, idle = [(text, of) for text, of in texts if text not in known], list(unused)
    if idle or any(text in known.obsolete for text, _ in lacking):
        return _made_anew(there, known, lacking, idle)
    _add(found, lacking)
    stream = BytesIO()
    write_po(stream, found, width=WIDTH, omit_header=True)
    return ChangedCatalogue(there.rstrip(b"\n") + b"\n\n" + stream.getvalue(), len(found))


def _add(catalogue: Catalog, texts: Iterable[tuple[str, str]]) -> None:
    for text, of in texts:
        catalogue.add(text, auto_comments=[of])


def _made_anew(there: bytes, known: Catalog, lacking: list[tuple[str, str]], idle: list[str]) -> ChangedCatalogue:
    """A catalogue as gettext writes it: what is obsolete stands at its end behind #~, what was never translated is dropped."""
    returned = 0
    for text, of in lacking:
        before = known.obsolete.pop(text, None)
        said = (
            before.string if before and isinstance(before.string, str) else None
        )  # one for a number is of another text
        returned += said is not None
        known.add(text, said, auto_comments=[of], flags=before.flags if before and said else ())
    for text in idle:
        message = known.get(text)
        if message is not None:
            known.delete(text)
            known.obsolete |= {text: message} if message.string else {}
    head = there.replace(b"\r\n", b"\n").partition(b"\n\n")[0]  # as its author wrote it, where it stands by itself
    is_kept = head.count(b"msgid") == 1 and b'msgid ""\n' in head
    stream = BytesIO()
    write_po(stream, known, width=WIDTH, omit_header=is_kept)
    content = (head + b"\n\n") * is_kept + stream.getvalue()
    return ChangedCatalogue(content, len(lacking) - returned, len(idle), returned)
