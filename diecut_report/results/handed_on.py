"""Numbers that one mechanism hands to another: both tell them with the same digits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Data = dict[str, Any]
GROUPS = ("outputs", "values", "inputs")


def told_alike(results: Mapping[str, Data], mechanisms: Mapping[str, Data]) -> dict[str, Data]:
    """Return results, each input that refers to a number of one of the mechanisms told as that number is where it is given."""
    found = {}
    for name, data in results.items():
        changed = {
            key: row | {"display": told} for key, row in data["inputs"].items() if (told := _told(row, mechanisms))
        }
        found[name] = data | {"inputs": data["inputs"] | changed} if changed else data
    return found


def _told(row: Data, mechanisms: Mapping[str, Data]) -> Data | None:
    """How the number that an input refers to is told there; None where it is told so already, or in another unit."""
    home, _, name = row.get("path", "").partition(".")
    if row.get("origin") != "reference" or home not in mechanisms:
        return None
    given = next((mechanisms[home][group][name] for group in GROUPS if name in mechanisms[home][group]), None)
    own, there = row["display"], (given or {}).get("display", {})
    is_same = given is not None and given["value"] == row["value"] and there["unit"] == own["unit"]
    return dict(there) if is_same and there["text"] != own["text"] else None
