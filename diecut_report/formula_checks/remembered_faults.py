"""What is wrong with the formulas of a plugin, remembered by the content of its files in the user's folder for what can be made again."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration import remembered
from diecut_report.files import cache_folder
from diecut_report.formula_checks import forms, quantities
from diecut_report.formula_checks.fault_places import by_id

FOLDER = "formulas"


def faults_of_formulas(mechanism: Mechanism) -> tuple[str, ...]:
    """Return dimensions that do not balance, and formulas that print something else than they compute, each with file and line.

    What was found is judged again where one of the plugin's files, or the program, has changed. The declarations are sound.
    """
    home = cache_folder(FOLDER)
    file = home / remembered.content(mechanism) if home else None
    if file is not None and (known := _known(file)) is not None:
        return known
    found = _judged(mechanism)
    if file is not None:
        with suppress(OSError):  # it is judged again the next time
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(found), "utf-8")
    return found


def _known(file: Path) -> tuple[str, ...] | None:
    try:
        found = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        return None
    return tuple(found) if isinstance(found, list) and all(isinstance(each, str) for each in found) else None


def _judged(mechanism: Mechanism) -> tuple[str, ...]:
    try:
        found = [by_id(mechanism, text) for form in forms(mechanism) for text in quantities(form)]
    except Exception as cause:  # a formula that cannot be gone through alone
        return (f"{type(cause).__name__}: {cause}",)
    return tuple(dict.fromkeys(map(str, found)))
