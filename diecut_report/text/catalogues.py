"""The catalogues of a language: that of the program, and those that plugins bring."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cache, cached_property
from gettext import c2py
from importlib import import_module
from pathlib import Path

from diecut_report.errors import Problem, UserError, refusal
from diecut_report.text.phrases import Phrase

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
        from diecut_report.text.po_files import judge, read  # with Babel, which English reports do not need

        try:
            found = read(file, language)
            self._plural = c2py(found.plural_expr)
            judge(found, self._plural)
        except Exception as error:  # of any kind: that of a plugin may hold anything
            template = (
                "This catalogue of texts cannot be read: {error}. Fix it, or remove it: its texts are then in English."
            )
            raise refusal(template, file, error=error) from error
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
        template = "is {language}, of which the program has no catalogue; allowed: {languages}"
        raise UnknownLanguage(Phrase(template, language=repr(language), languages=", ".join(languages())))
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
            code = built_in(kind) or self._find(kind)
            file = file_beside(code, self.language) if code else None
            self._kinds[kind] = catalogue(file, self.language) if file and file.is_file() else None
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

    def ahead(self, kind: str = "") -> Iterator[TextCatalogue]:
        """Yield catalogues in the order in which they are asked: that of the kind, the program's, all others that are known."""
        own = self.of(kind) if kind else None
        yield from (own,) if own else ()
        yield self.program
        yield from (other for other in self._kinds.values() if other and other is not own)
