"""What advice names is changed where it begins: a key that follows from another one is not changed in one mechanism alone."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from diecut_report.languages.phrases import Phrase, joined

Data = dict[str, Any]
InputsOf = Callable[[str], Data]  # a mechanism's inputs as results hold them, by its name; nothing of what is not one
FOLLOWS = "{key} follows from {origin}: change it there, so that what else takes it keeps in step."
ADVISED = r"(?:\bset |\blower |\braise |\btake |\bmake |\baccept |\bchange |\ban? |\bno )({key})\b|\b({key})\b(?= of at (?:least|most)|: )"


def with_origins(mechanisms: Data) -> Data:
    """Return the mechanisms' results, in which each failing check says where a key that it names begins."""
    own = {name: data["checks"] for name, data in mechanisms.items()}
    told = told_checks(own, lambda name: mechanisms.get(name, {}).get("inputs", {}))
    return {name: data | _told(told[name]) if data["checks"] else data for name, data in mechanisms.items()}


def _told(checks: list[Data]) -> Data:
    return {"checks": checks, "warnings": [check["message"] for check in checks if check["status"] == "warn"]}


def told_checks(checks: Mapping[str, list[Data]], inputs_of: InputsOf) -> dict[str, list[Data]]:
    """Return the checks of all mechanisms, of which the failing ones say where a key that they name begins."""
    return {name: [_check(inputs_of, name, check) for check in own] for name, own in checks.items()}


def _check(inputs_of: InputsOf, name: str, check: Data) -> Data:
    if check["status"] not in ("warn", "fail"):
        return check
    words = dict.fromkeys(_origins(inputs_of, name, check["message"]))
    return check | ({"message": joined([check["message"], *words], " ")} if words else {})


def _origins(inputs_of: InputsOf, name: str, message: str) -> Iterator[str]:
    for key, data in inputs_of(name).items():
        if "path" in data and re.search(ADVISED.format(key=re.escape(key)), message):
            yield Phrase(FOLLOWS, key=key, origin=_beginning(inputs_of, data["path"]))


def _beginning(inputs_of: InputsOf, path: str) -> str:
    """Where a reference begins: a field of the press, a result, or the key that is given in words or numbers."""
    while True:  # references have an order, so none goes round
        name, _, key = path.partition(".")
        further = inputs_of(name).get(key, {}).get("path")
        if further is None:
            return path
        path = further
