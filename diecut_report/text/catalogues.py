"""The catalogues of a language: that of the program, and those that plugins bring."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from datetime import UTC, datetime
from functools import cache, cached_property
from gettext import c2py
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

from babel.messages.catalog import Catalog, Message
from babel.messages.pofile import PoFileParser, read_po, write_po

from diecut_report.errors import Problem, UserError
from diecut_report.text.phrases import Phrase, phrase

SOURCE_LANGUAGE = "en"
OWN = Path(__file__).parents[1] / "__init__.py"
PLUGINS = "diecut_report.plugins"
Find = Callable[[str], Path | None]  # the file of a kind's plugin


def file_beside(code: Path, language: str) -> Path:
    """Return where the catalogue of a plugin lies: ``locale/uk.po`` in its folder, ``NAME.uk.po`` beside a plugin of one file."""
    if code.name == "__init__.py":
        return code.parent / "locale" / f"{language}.po"
    return code.with_suffix(f".{language}.po")


class UnknownLanguage(ValueError):
    """Report a language of which the program has no words; the text tells those that it has."""


class TextCatalogue:
    """The texts of one file in another language, by their English form; what is not translated, or only guessed, is not in it."""

    def __init__(self, file: Path, language: str) -> None:
        pass  # REMOVE  # with Babel, which English reports do not need

        try:
            found = read(file, language)
            self._plural = c2py(found.plural_expr)
            judge(found, self._plural)
        except Exception as error:  # of any kind: that of a plugin may hold anything
            words = Phrase(
                "This catalogue of texts cannot be read: {error}. Fix it, or remove it: its texts are then in English.",
                error=error,
            )
            raise UserError(Problem(words, str(file))) from error
        self._texts: dict[tuple[str | None, str], tuple[str, ...]] = {}
        self.missing: list[str] = []
        for message in found:
            said = (message.string or "",) if isinstance(message.string, str | None) else tuple(message.string)
            name = message.id if isinstance(message.id, str) else message.id[0]
            if name and all(said) and not message.fuzzy:
                self._texts[message.context, name] = said
            elif name:
                self.missing.append(name)

    def text(self, english: str, context: str | None = None) -> str | None:
        """Return a text; None where it is not translated."""
        found = self._texts.get((context, english))
        return found[0] if found else None

    @cached_property
    def english(self) -> frozenset[str]:
        """The English forms of all its texts, translated or not."""
        return frozenset(self.missing) | {english for _, english in self._texts}

    def of_context(self, context: str) -> dict[str, str]:
        """Return all texts of a context, by their English form."""
        return {english: said[0] for (own, english), said in self._texts.items() if own == context}

    def plural(self, english: str, count: int, context: str | None = None) -> str | None:
        """Return the form of a text that goes with a count; ``english`` is that of one."""
        found = self._texts.get((context, english))
        return found[min(self._plural(count), len(found) - 1)] if found else None


@cache
def catalogue(file: Path, language: str) -> TextCatalogue:
    """Return the catalogue of a file, read once."""
    return TextCatalogue(file, language)


def program_catalogue(language: str) -> TextCatalogue:
    """Return the program's own catalogue; UnknownLanguage where it has none."""
    known(language)
    return catalogue(file_beside(OWN, language), language)


@cache
def languages() -> tuple[str, ...]:
    """Return the languages of reports: English, and those that the program has a catalogue of."""
    return SOURCE_LANGUAGE, *sorted(file.stem for file in (OWN.parent / "locale").glob("*.po"))


def known(language: str) -> str:
    """Return the language, if the program has its words; UnknownLanguage if not."""
    if language not in languages():
        raise UnknownLanguage(
            Phrase(
                "is {language}, of which the program has no catalogue; allowed: {languages}",
                language=repr(language),
                languages=", ".join(languages()),
            )
        )
    return language


def built_in_kinds() -> list[str]:
    """Return the kinds of the program's own plugins."""
    return sorted(folder.name for folder in Path(import_module(PLUGINS).__path__[0]).iterdir())


def built_in(kind: str) -> Path | None:
    """Return the file of a plugin of the program; None for other kinds."""
    file = Path(import_module(PLUGINS).__path__[0]) / kind / "__init__.py"
    return file if kind.isidentifier() and file.is_file() else None


def of_all_plugins(language: str) -> Catalogues:
    """Return the catalogues of the program and of all its plugins."""
    found = Catalogues(language)
    found.know(built_in_kinds())
    return found


class Catalogues:
    """All catalogues that a report needs; ``find`` gives the file of a plugin that is not the program's own, one of ``others``."""

    def __init__(self, language: str, find: Find = built_in, others: Iterable[str] = ()) -> None:
        self.language, self._find, self._others = known(language), find, tuple(others)
        self._kinds: dict[str, TextCatalogue | None] = {}

    @cached_property
    def program(self) -> TextCatalogue:
        """The program's own."""
        return program_catalogue(self.language)

    def of(self, kind: str) -> TextCatalogue | None:
        """Return the catalogue of a plugin; None where it brings none."""
        if kind not in self._kinds:
            self._kinds[kind] = self._read(kind)
        return self._kinds[kind]

    def know(self, kinds: Iterable[str]) -> None:
        """Let the texts of these plugins be known wherever a text is said; UserError where one cannot be read."""
        for kind in kinds:
            self.of(kind)

    def know_all(self) -> list[Problem]:
        """Let the texts of all plugins be known; return what is wrong with catalogues of others that cannot be read."""
        self.know(built_in_kinds())
        faults: list[Problem] = []
        for kind in self._others:
            try:
                self.of(kind)
            except UserError as error:
                faults += error.problems
        return faults

    def _read(self, kind: str) -> TextCatalogue | None:
        code = built_in(kind) or self._find(kind)
        file = file_beside(code, self.language) if code else None
        return catalogue(file, self.language) if file and file.is_file() else None

    def ahead(self, kind: str = "") -> Iterator[TextCatalogue]:
        """Yield catalogues in the order in which they are asked: that of the kind, the program's, all others that are known."""
        own = self.of(kind) if kind else None
        yield from (own,) if own else ()
        yield self.program
        yield from (other for other in self._kinds.values() if other and other is not own)


# Catalogues on disk: gettext PO files, whose msgid is the English text.


NEVER = datetime(2026, 1, 1, tzinfo=UTC)  # equal texts give equal files
WIDTH = 140
MOST_FORMS = 10  # Arabic has six
_FORMS = re.compile(rb"nplurals\s*=\s*(\d+)")
_HIDDEN = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufffe\uffff]")
_LINE = re.compile(r'(?:(?:msgctxt|msgid|msgid_plural|msgstr(?:\[\d+\])?)\s*)?"(?:[^"\\]|\\.)*"')
_FILLED = re.compile(r"\{[\w.]+(?::\w+)?\}")
UNSAID = (b'"Generated-By', b'"Report-Msgid-Bugs-To', b'"Last-Translator', b'"Language-Team')  # lines of the head


def empty(language: str, project: str, holder: str = "the authors of diecut-report") -> Catalog:
    """Return a catalogue without messages."""
    return Catalog(locale=language, project=project, version="1", charset="utf-8", fuzzy=False, creation_date=NEVER, revision_date=NEVER,
                   copyright_holder=holder, header_comment=f"# Words of {project} in the language {language}.",)  # fmt: skip


def read(file: Path, language: str) -> Catalog:
    """Return the catalogue of a file; ValueError, or another exception of Babel's, where it is none."""
    content = file.read_bytes()
    if any(int(count[:9]) > MOST_FORMS for count in _FORMS.findall(content)):  # Babel makes a list of so many
        raise ValueError(
            Phrase("a language has at most {most_forms} forms of a word for a number", most_forms=MOST_FORMS)
        )
    for number, line in enumerate(map(str.strip, content.decode("utf-8").split("\n")), 1):
        if line and not line.startswith("#") and not _LINE.fullmatch(line):
            words = (
                "line {number} is {line}; write msgid or msgstr, and a text that begins and ends with a quotation mark"
            )
            raise ValueError(Phrase(words, number=number, line=repr(line)))
    found = _EachOnce(locale=language, charset="utf-8")
    PoFileParser(found, abort_invalid=True).parse(BytesIO(content))
    return found


class _EachOnce(Catalog):
    """A catalogue that has each text once: of two Babel keeps the first translation, and says nothing of the other."""

    def __setitem__(self, id: Any, message: Message) -> None:
        before = self.get(id, message.context) if id else None
        if before is not None:
            words = "line {line} translates {id}, as line {before} does; keep one of them"
            raise ValueError(Phrase(words, line=message.lineno, id=repr(id), before=before.lineno))
        super().__setitem__(id, message)


def judge(catalogue: Catalog, plural: Callable[[int], int]) -> None:
    """Raise ValueError where texts hold letters that act on a page or a terminal, are filled otherwise, or a number has no form of a word."""
    for message in catalogue:
        said = (message.string or "",) if isinstance(message.string, str | None) else message.string
        if letter := next(filter(None, map(_HIDDEN.search, said)), None):
            raise ValueError(
                Phrase(
                    "the translation of {id} holds U+{code}", id=repr(message.id), code=format(ord(letter[0]), "04X")
                )
            )
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
            words = "line {line}: the translation of {id} is filled with {there}, the text itself with {wanted}; write the same names"
            told = [", ".join(sorted(names)) or phrase("nothing") for names in (there, may)]
            raise ValueError(Phrase(words, line=message.lineno, id=repr(texts[0]), there=told[0], wanted=told[1]))


def written(catalogue: Catalog) -> bytes:
    """Return the text of a catalogue's file."""
    stream = BytesIO()
    write_po(stream, catalogue, width=WIDTH, ignore_obsolete=True)
    lines = stream.getvalue().splitlines(keepends=True)
    return b"".join(line for line in lines if not line.startswith(UNSAID))


class ChangedCatalogue(NamedTuple):
    """Hold a catalogue's file, how many texts of it wait to be translated since, and how many are obsolete since."""

    content: bytes
    added: int = 0
    obsolete: int = 0


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
    known = read_po(BytesIO(there), locale=language, charset="utf-8", abort_invalid=True)
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
    waiting = len(lacking)
    for text, of in lacking:
        before = known.obsolete.pop(text, None)
        waiting -= before is not None
        known.add(text, before.string if before else None, auto_comments=[of], flags=before.flags if before else ())
    for text in idle:
        message = known.get(text)
        if message is not None:
            known.delete(text)
            known.obsolete |= {text: message} if message.string else {}
    head = there.replace(b"\r\n", b"\n").partition(b"\n\n")[0]  # as its author wrote it, where it stands by itself
    is_kept = head.count(b"msgid") == 1 and b'msgid ""\n' in head
    stream = BytesIO()
    write_po(stream, known, width=WIDTH, omit_header=is_kept)
    return ChangedCatalogue((head + b"\n\n") * is_kept + stream.getvalue(), waiting, len(idle))
