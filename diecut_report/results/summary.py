"""The verdict as numbers: how many checks pass, fail and are not made, which one governs, and what the whole rests on."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

Data = dict[str, Any]
RANK = {"pass": 0, "warn": 1, "fail": 2, "error": 3, "skipped": 3}
COUNTED = ("pass", "warn", "fail", "not_checked")
SELF_TEST = "numerical"


def counts(checks: Sequence[Mapping[str, Any]]) -> Data:
    """Return how many checks there are of each status; the self-tests of the calculation stand apart."""
    of_machine = [check["status"] for check in checks if check["class"] != SELF_TEST]
    own = [check["status"] == "pass" for check in checks if check["class"] == SELF_TEST]
    return {status: of_machine.count(status) for status in COUNTED} | {
        "numerical": {"pass": own.count(True), "fail": own.count(False)}
    }


def failed_self_tests(checks: Iterable[Data]) -> list[Data]:
    """Return the self-tests of the calculation that do not hold."""
    return [check for check in checks if check["class"] == SELF_TEST and check["status"] != "pass"]


def summary(mechanisms: Data) -> Data:
    """Return the whole's verdict: counts, and the governing check."""
    named = governing(mechanisms)
    return counts([check for data in mechanisms.values() for check in data["checks"]]) | {
        "governing": f"{named['mechanism']}.{named['check']}" if named else None,
    }


def governing(mechanisms: Data) -> Data | None:
    """Return the check that governs: fail before warn before pass, then the greatest utilisation; a failing null is the greatest.

    Self-tests do not govern, nor, unless it fails, what the program sized to its limit or what the calculation presumes.
    """
    checks = [(name, check) for name, data in mechanisms.items() for check in data["checks"] if may_govern(check)]
    if not checks:
        return None
    name, check = max(checks, key=lambda pair: weight(pair[1]))
    return {"mechanism": name, "check": check["id"]}


def may_govern(check: Data) -> bool:
    """Return whether a check may govern, see ``governing``."""
    shows_reserve = not (check.get("sized_to_limit", False) or check.get("presumed", False))
    return check["status"] in RANK and check["class"] != SELF_TEST and (shows_reserve or check["status"] != "pass")


def weight(check: Data) -> tuple[int, float]:
    """Return by what checks are ordered: the status, then the utilisation."""
    unknown = math.inf if check["status"] != "pass" else -math.inf
    return RANK[check["status"]], unknown if check["utilisation"] is None else check["utilisation"]
