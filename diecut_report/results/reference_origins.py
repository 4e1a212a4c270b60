"""What advice names is changed where it begins: a key that follows from another one is not changed in one mechanism alone."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from diecut_report.languages.phrases import Phrase, joined

Data = dict[str, Any]
FOLLOWS = "{key} follows from {origin}: change it there, so that what else takes it keeps in step."
ADVISED = r"(?:\bset |\blower |\braise |\btake |\bmake |\baccept |\bchange |\ban? |\bno )({key})\b|\b({key})\b(?= of at (?:least|most)|: )"


def with_origins(mechanisms: Data) -> Data:
    """Return the mechanisms' results, in which each failing check says where a key that it names begins."""
    return {name: _mechanism(mechanisms, name) if data["checks"] else data for name, data in mechanisms.items()}


def _mechanism(mechanisms: Data, name: str) -> Data:
    checks = [_check(mechanisms, name, check) for check in mechanisms[name]["checks"]]
    told = {"checks": checks, "warnings": [check["message"] for check in checks if check["status"] == "warn"]}
    found: Data = mechanisms[name] | told
    return found


def _check(mechanisms: Data, name: str, check: Data) -> Data:
    if check["status"] not in ("warn", "fail"):
        return check
    words = dict.fromkeys(_origins(mechanisms, name, check["message"]))
    return check | ({"message": joined([check["message"], *words], " ")} if words else {})


def _origins(mechanisms: Data, name: str, message: str) -> Iterator[str]:
    for key, data in mechanisms[name]["inputs"].items():
        if "path" in data and re.search(ADVISED.format(key=re.escape(key)), message):
            origin = beginning(mechanisms, data["path"])
            yield Phrase(FOLLOWS, key=key, origin=origin)


def beginning(mechanisms: Data, path: str) -> str:
    """Return where a reference begins: a field of the press, a result, or the key that is given in words or numbers."""
    for _ in range(len(mechanisms) + 1):  # references have an order, so none goes round
        name, _, key = path.partition(".")
        further = mechanisms.get(name, {}).get("inputs", {}).get(key, {}).get("path")
        if further is None:
            return path
        path = further
    return path
