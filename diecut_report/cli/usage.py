"""What click says of wrong usage, in the language that is spoken: it has no catalogues of its own.

Its own way, ``gettext`` with the domain "messages", was looked at and is not taken. It reads compiled catalogues of the language
that ``os.environ`` names, for the whole process: argparse and all processes that are started would follow, while a language here
holds within ``speaking`` alone. It translates a sentence where it is raised, which may be before ``--language`` is read. And a
sentence that another version of click words otherwise stays English there too; here `tests/cli/test_usage.py` tells of it.
"""

from __future__ import annotations

import io
import re
from collections.abc import Mapping

import click

from diecut_report.languages.phrases import Phrase, phrase

SENTENCES: Mapping[re.Pattern[str], str] = {
    re.compile(pattern): template
    for pattern, template in (
        (r"Try '(?P<command>[^']*)' for help\.", phrase("Try '{command}' for help.")),
        (r"Missing argument '(?P<name>[^']*)'\.(?P<more>.*)", phrase("Missing argument '{name}'.{more}")),
        (r"Missing option '(?P<name>[^']*)'\.(?P<more>.*)", phrase("Missing option '{name}'.{more}")),
        (r"No such option '?(?P<name>[^'\s]+?)'?\.", phrase("No such option '{name}'.")),
        (r"No such option '?(?P<name>[^'\s]+?)'?\. (?:Did you mean|\(Possible options:) (?P<near>[^?)]*)[?)]\.?",
         phrase("No such option '{name}' (did you mean {near}?).")),
        (r"No such command '(?P<name>[^']*)'\.", phrase("No such command '{name}'.")),
        (r"No such command '(?P<name>[^']*)'\. (?:Did you mean|\(Possible commands:) (?P<near>[^?)]*)[?)]\.?",
         phrase("No such command '{name}' (did you mean {near}?).")),
        (r"Missing command\.", phrase("Missing command.")),
        (r"Invalid value for (?P<name>'[^']*'(?: / '[^']*')*|-[\w-]+): (?P<why>.*)", phrase("Invalid value for {name}: {why}")),
        (r"Option '(?P<name>[^']*)' requires an argument\.", phrase("Option '{name}' requires an argument.")),
        (r"Option '(?P<name>[^']*)' does not take a value\.", phrase("Option '{name}' does not take a value.")),
        (r"Got unexpected extra arguments? \((?P<given>.*)\)\.?", phrase("Got unexpected extra arguments ({given}).")),
        (r"'(?P<given>.*)' is not one of (?P<known>.*)\.", phrase("'{given}' is not one of {known}.")),
        (r"'(?P<given>.*)' is not a valid (?:integer|integer range)\.", phrase("'{given}' is not a whole number.")),
        (r"'(?P<given>.*)' is not a valid (?:float|float range|number)\.", phrase("'{given}' is not a number.")),
        (r"(?P<given>\S+) is not in the range (?P<range>.*)\.", phrase("{given} is not in the range {range}.")),
    )
}  # fmt: skip
"""The sentences of click, each with the words of a phrase."""


def usage(error: click.ClickException) -> list[str]:
    """Return what click says of wrong usage; of its last part, which repeats what was given, no line stands for itself."""
    shown = io.StringIO()
    error.show(shown)
    head, found, _ = f"\n{shown.getvalue()}".partition("\nError: ")
    told = [Phrase("Error: {message}", message=worded(error.format_message()))] if found else []
    return [*(worded(line) for line in head[1:].splitlines()), *told]


def worded(sentence: str) -> str:
    """Return a sentence of click as a phrase; another one as it is."""
    for pattern, template in SENTENCES.items():
        if found := pattern.fullmatch(sentence):
            parts = found.groupdict("")
            return Phrase(template, parts | ({"why": worded(parts["why"])} if "why" in parts else {}))
    return sentence
