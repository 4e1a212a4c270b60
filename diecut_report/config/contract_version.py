"""Plugins that are written for another version of what the program offers to them."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from diecut_report import __version__
from diecut_report.contract.version import CONTRACT
from diecut_report.languages.phrases import Phrase, phrase

API = "diecut_report.api"
NEEDED = re.compile(r"^CONTRACT\s*(?::\s*\w+\s*)?=\s*(\d+)", re.MULTILINE)
NAME = re.compile(r"cannot import name '(\w+)'")


class OtherContract(ImportError):
    """Report a plugin that says that it is written for another contract."""


def refuse_other_contract(file: Callable[[], Path]) -> None:
    """Refuse a plugin that names another contract than this program has, before its code is run: it may not even load."""
    try:
        found = NEEDED.search(file().read_text("utf-8", "replace")) if file().is_file() else None
    except (
        KeyError,
        OSError,
    ):  # of an installed package, which tells its needs to the installer; or a file that loading will tell of
        return
    if found and int(found[1]) != CONTRACT:
        words = "it is written for contract {needed}, this program ({version}) has contract {own}; "
        newer = phrase("install a newer version of diecut-report")
        older = phrase("take a newer version of the plugin")
        told = Phrase(words, needed=found[1], version=__version__, own=str(CONTRACT))
        raise OtherContract(told + (newer if int(found[1]) > CONTRACT else older))


def other_program(cause: BaseException) -> str:
    """Return in words that a plugin takes a name of the program that this version does not have; empty for other causes."""
    if not isinstance(cause, ImportError) or cause.name != API:
        return ""
    found = NAME.search(str(cause))
    words = "{api} of this version ({version}) has no {name}; the plugin is written for another version"
    return Phrase(words, api=API, version=__version__, name=repr(found[1])) if found else ""
