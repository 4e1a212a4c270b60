"""Catalogues on disk: gettext PO files, whose msgid is the English text."""

from __future__ import annotations

from datetime import UTC, datetime
from io import BytesIO
from pathlib import Path

from babel.messages.catalog import Catalog
from babel.messages.pofile import read_po, write_po

NEVER = datetime(2026, 1, 1, tzinfo=UTC)  # equal texts give equal files
WIDTH = 140
UNSAID = (b'"Generated-By', b'"Report-Msgid-Bugs-To', b'"Last-Translator', b'"Language-Team')  # lines of the head


def empty(language: str, project: str) -> Catalog:
    """Return a catalogue without messages."""
    return Catalog(locale=language, project=project, version="1", charset="utf-8", fuzzy=False, creation_date=NEVER, revision_date=NEVER,
                   copyright_holder="the authors of diecut-report", header_comment=f"# Words of {project} in the language {language}.",)  # fmt: skip


def read(file: Path, language: str) -> Catalog:
    """Return the catalogue of a file."""
    with file.open("rb") as stream:
        return read_po(stream, locale=language, charset="utf-8", abort_invalid=True)


def written(catalogue: Catalog) -> bytes:
    """Return the text of a catalogue's file."""
    stream = BytesIO()
    write_po(stream, catalogue, width=WIDTH, ignore_obsolete=True)
    lines = stream.getvalue().splitlines(keepends=True)
    return b"".join(line for line in lines if not line.startswith(UNSAID))
