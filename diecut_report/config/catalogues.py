"""The catalogues of the plugins that a report is made with: found without running their code, and judged before they are used."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from pathlib import Path

from diecut_report.config.plugins import Discovery
from diecut_report.errors import Problem, UserError
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues, UnknownLanguage, built_in
from diecut_report.text.phrases import Phrase
from diecut_report.text.translation import spoken_language

MAX_LISTED = 3  # texts that are told of an incomplete catalogue


def catalogues_for(language: str, kinds: Iterable[str], discovery: Discovery, file: str = "") -> Catalogues:
    """Return the catalogues for mechanisms of these kinds; UserError where one of the program's own is not complete."""
    try:
        found = Catalogues(language, partial(_plugin, discovery))
    except UnknownLanguage as error:
        raise UserError(Problem(Phrase("The language {error}.", error=error), file, path="project.language")) from None
    if language != SOURCE_LANGUAGE:
        problems = (_incomplete(kind, found, file) for kind in dict.fromkeys(kinds) if built_in(kind))
        if told := list(filter(None, problems)):
            raise UserError(told)
    return found


def spoken_catalogues(discovery: Discovery | None) -> Catalogues:
    """Return those of the language that is spoken."""
    return Catalogues(spoken_language()) if discovery is None else catalogues_of(spoken_language(), discovery)


def catalogues_of(language: str, discovery: Discovery) -> Catalogues:
    """Return the catalogues of a language with those of all plugins; what plugins of others do not have stays English."""
    return Catalogues(language, partial(_plugin, discovery), discovery.origins)


def lacking(catalogues: Catalogues, kinds: Iterable[str]) -> list[str]:
    """Return in words which foreign plugins have no words in the language, or not all: these stay English."""
    if catalogues.language == SOURCE_LANGUAGE:
        return []
    none = "The plugin of {kind} has no catalogue locale/{language}.po; its texts remain in English."
    some = "The catalogue {language} of the plugin of {kind} lacks {count} texts, which remain in English."
    found: list[str] = []
    for kind in dict.fromkeys(kinds):
        own = catalogues.of(kind)
        if not built_in(kind) and (own is None or own.missing):
            count = len(own.missing) if own else 0
            found.append(Phrase(some if own else none, kind=repr(kind), language=catalogues.language, count=count))
    return found


def _incomplete(kind: str, catalogues: Catalogues, file: str) -> Problem | None:
    own = catalogues.of(kind)
    if own is not None and not own.missing:
        return None
    texts = [] if own is None else own.missing
    told = "; ".join(f"“{text}”" for text in texts[:MAX_LISTED])
    template = "Reports in {language} need a translation of {kind}: {count} texts are not translated ({told} …). "
    why = Phrase(template, language=catalogues.language, kind=kind, count=len(texts), told=told)
    advised = Phrase("{words}Give language: {source_language}.", words=why, source_language=SOURCE_LANGUAGE)
    return Problem(advised, file, path="project.language")


def _plugin(discovery: Discovery, kind: str) -> Path | None:
    origins = discovery.origins.get(kind, [])
    try:
        return origins[0].file() if len(origins) == 1 else None
    except KeyError:  # an installed package that was not loaded
        return None
