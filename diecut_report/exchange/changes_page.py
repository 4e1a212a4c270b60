"""What changed between two calculations, as one HTML file without scripts or network."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markupsafe import Markup

from diecut_report import __version__
from diecut_report.languages.speech import spoken_language
from diecut_report.report import html
from diecut_report.report.changes import printed_changes
from diecut_report.report.i18n import Catalogue


def page(changes: Mapping[str, Any]) -> str:
    """Return the page of the changes of `results.changes`."""
    words = Catalogue(spoken_language())
    made = printed_changes(changes, words)
    faces = html._font_faces(tuple(html.FACES.items()))
    style = "\n".join([faces, *(html._read(f"{name}.css") for name in ("report", "screen", "changes"))])
    title = words.say("changes_of", old=made.names[0], new=made.names[1])
    return html._environment().get_template("diff.html.j2").render(
        c=made, t=words, language=words.language, title=title, style=Markup(style), policy=html.policy(), version=__version__,
    )  # fmt: skip
