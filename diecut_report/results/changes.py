"""What changed between two results documents: inputs, outputs, checks, the code that calculated; the most important first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import UnitError, unit
from diecut_report.results.conclusion import COUNTED, RANK, SELF_TEST

Data = Mapping[str, Any]
Row = dict[str, Any]
SAME = 1e-9  # relative; below it is nothing but rounding
NOTHING = 1e-12  # in the display unit, which no quantity of a press has
MOST_DIGITS = 12
LIKE_WARN = {"not_checked": 0.5}
"""A check that is not made is worse than one that passes, and better than one that warns."""
SEEN = 5e-4  # of a utilisation, which is printed in per cent with one decimal
OF_FORMER = ("file", "sha256", "source_text", "materials", "logo")
"""What of a former document's configuration it can be calculated from."""
ORDER = ("worse", "better", "added", "removed", "more used", "less used")


def changes(old: Data, new: Data) -> Row:
    """Return what changed from one results document to another, as plain data."""
    return {
        "schema_version": 1,
        "old": _document(old),
        "new": _document(new),
        "mechanisms": list(_mechanisms(old["mechanisms"], new["mechanisms"])),
        "checks": sorted(_checks(old, new), key=_check_order),
        "inputs": sorted(_rows(_inputs(old, new), _inputs(new, old)), key=_input_order),
        "outputs": sorted(_rows(_outputs(old, new), _outputs(new, old)), key=_output_order),
        "code": list(_code(old, new)),
    }


def compare_with(former: Data | None, results: Row) -> None:
    """Add to the results what changed since a former document, and the configuration of that, which the changes can be proved by."""
    if former is not None:
        results["changes"] = changes(former, results)
        results["former"] = {key: former["config"][key] for key in OF_FORMER if key in former["config"]}


def _document(results: Data) -> Row:
    named = {key: results["project"].get(key) or "" for key in ("title", "document_number", "revision", "date")}
    counts = {status: results["summary"][status] for status in COUNTED}
    found = results.get("governing")
    return named | {
        "file": results["config"]["file"],
        "sha256": results["config"]["sha256"],
        "press": results["press"]["name"],
        "status": results["status"],
        "checks": counts,
        "governing": f"{found['mechanism']}.{found['check']}" if found else "",
        "governing_title": _title(results, found) if found else "",
    }


def _title(results: Data, governing: Data) -> str:
    """The title of the check that governs."""
    data = results["mechanisms"].get(governing["mechanism"]) or results["comparisons"][governing["mechanism"]]
    return next(str(check["title"]) for check in data["checks"] if check["id"] == governing["check"])


def _mechanisms(old: Data, new: Data) -> Iterator[Row]:
    """The mechanisms that came, went, are of another kind now, or could be calculated only once."""
    for name in dict.fromkeys([*old, *new]):
        sides = [_of_mechanism(side.get(name)) for side in (old, new)]
        if sides[0] != sides[1]:
            yield {"name": name, "old": sides[0], "new": sides[1]}


def _of_mechanism(data: Data | None) -> str:
    if data is None:
        return ""
    return f"{data['kind']} ({data['status']})" if data["status"] in ("error", "skipped") else str(data["kind"])


# --- checks ----------------------------------------------------------------------------------------------------------


def _checks(old: Data, new: Data) -> Iterator[Row]:
    """The checks that changed; those of a mechanism that went went with it."""
    sides = [dict(_named_checks(side)) for side in (old, new)]
    for key in dict.fromkeys([*sides[0], *sides[1]]):
        before, after = (side.get(key) for side in sides)
        if _is_other(before, after) and key[0] in new["mechanisms"]:
            some = after or before or {}
            told = {"mechanism": key[0], "id": key[1], "title": some["title"], "class": some["class"]}
            yield told | {"old": _of_check(before), "new": _of_check(after), "change": _change(before, after)}


def _named_checks(results: Data) -> Iterator[tuple[tuple[str, str], Data]]:
    for name, mechanism in results["mechanisms"].items():
        yield from (((name, check["id"]), check) for check in mechanism["checks"] if check["class"] != SELF_TEST)


def _is_other(before: Data | None, after: Data | None) -> bool:
    if before is None or after is None or before["status"] != after["status"]:
        return True
    ratios = before["utilisation"], after["utilisation"]
    if None in ratios:
        return bool(ratios[0] != ratios[1])
    return bool(abs(ratios[1] - ratios[0]) >= SEEN)


def _of_check(check: Data | None) -> Row | None:
    if check is None:
        return None
    return {key: check[key] for key in ("status", "utilisation", "message")}


def _change(before: Data | None, after: Data | None) -> str:
    """What happened to a check: worse, better, more or less used; added or removed."""
    if before is None or after is None:
        return "added" if before is None else "removed"
    ranks = [_rank(check["status"]) for check in (before, after)]
    if ranks[0] != ranks[1]:
        return "worse" if ranks[1] > ranks[0] else "better"
    ratios = [math.inf if check["utilisation"] is None else check["utilisation"] for check in (before, after)]
    return ORDER[4] if ratios[1] > ratios[0] else ORDER[5]


def _rank(status: str) -> float:
    return {**RANK, **LIKE_WARN}[status]


def _check_order(row: Row) -> tuple[float, ...]:
    """What got worse comes first, then what fails among the new ones, what got better, the others; the worst of each first."""
    before, after = (row[side] or {"status": "pass", "utilisation": None} for side in ("old", "new"))
    first = 0 if row["change"] == "worse" or (row["change"] == "added" and after["status"] == "fail") else 1
    known = before["utilisation"] is not None and after["utilisation"] is not None
    step = abs(after["utilisation"] - before["utilisation"]) if known else 0.0
    return first, ORDER.index(row["change"]), -max(_rank(before["status"]), _rank(after["status"])), -step


# --- quantities ------------------------------------------------------------------------------------------------------


def _inputs(results: Data, other: Data) -> Iterator[tuple[str, Data]]:
    yield from ((row["path"], row) for row in results["press"]["fields"])
    yield from _of_both("inputs", results, other)


def _outputs(results: Data, other: Data) -> Iterator[tuple[str, Data]]:
    yield from _of_both("outputs", results, other)


def _of_both(group: str, results: Data, other: Data) -> Iterator[tuple[str, Data]]:
    """The rows of the mechanisms that both have; of one that came or went that is told by itself."""
    for name, mechanism in results["mechanisms"].items():
        if name in other["mechanisms"]:
            yield from ((f"{name}.{key}", row) for key, row in mechanism[group].items())


def _rows(old: Iterator[tuple[str, Data]], new: Iterator[tuple[str, Data]]) -> Iterator[Row]:
    before, after = dict(old), dict(new)
    for path in dict.fromkeys([*before, *after]):
        pair = before.get(path), after.get(path)
        if _has_changed(*pair):
            some = pair[1] or pair[0] or {}
            texts = _texts(*pair)
            yield {
                "path": path,
                "symbol": some["symbol"],
                "description": some["description"],
                "old": _side(pair[0], texts[0]),
                "new": _side(pair[1], texts[1]),
                "relative": _relative(*pair),
                "follows": _follows(*pair),
                **({"key": True} if some.get("key") else {}),
            }


def _has_changed(before: Data | None, after: Data | None) -> bool:
    if before is None or after is None:
        return True
    if before.get("basis", "") != after.get("basis", ""):
        return True
    a, b = before["value"], after["value"]
    if not (_is_number(a) and _is_number(b)):
        return bool(a != b)
    factor = _factor(after)
    return before["unit"] != after["unit"] or _differ(a / factor, b / factor)


def _differ(a: float, b: float) -> bool:
    return not math.isclose(a, b, rel_tol=SAME, abs_tol=NOTHING)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _factor(row: Data) -> float:
    """What a display unit is in SI; 1 for a unit that is not known, which only a file from outside has."""
    try:
        return unit(row["display"]["unit"]).factor
    except UnitError:
        return 1.0


def _texts(before: Data | None, after: Data | None) -> list[str]:
    """Both values as neutral texts in their display unit, with so many digits that they can be told apart."""
    texts = [row["display"]["text"] if row else "" for row in (before, after)]
    if not (before and after and _is_number(before["value"]) and _is_number(after["value"])):
        return texts
    values = [row["value"] / _factor(row) for row in (before, after)]
    for digits in range(5, MOST_DIGITS):
        if float(texts[0]) != float(texts[1]):
            break
        texts = [number_text(value, digits) for value in values]
    return texts


def _side(row: Data | None, text: str) -> Row | None:
    if row is None:
        return None
    shown = {"value": row["value"], "unit": row["unit"], "display": {"text": text, "unit": row["display"]["unit"]}}
    return shown | ({"basis": row["basis"]} if "basis" in row else {})


def _relative(before: Data | None, after: Data | None) -> float | None:
    """The change as a share of the old value; None where there is none, as of a text or from zero."""
    if before is None or after is None or before["unit"] != after["unit"]:
        return None
    a, b = before["value"], after["value"]
    if not (_is_number(a) and _is_number(b)) or abs(a / _factor(before)) <= NOTHING:
        return None
    share = (b - a) / abs(a)
    return float(share) if math.isfinite(share) else None


def _follows(before: Data | None, after: Data | None) -> str:
    """The paths that an input follows by itself, so that its change is none of the user's; "" where the user has changed it."""
    if (
        before is None
        or after is None
        or "origin" not in after  # data of the press, whose path is their own
        or any(before.get(key) != after.get(key) for key in ("origin", "text", "path", "paths"))
    ):
        return ""
    return str(after["path"]) if after.get("path") else ", ".join(after.get("paths", ()))


def _size(row: Row) -> float:
    return math.inf if row["relative"] is None else abs(row["relative"])


def _input_order(row: Row) -> tuple[bool, float]:
    return bool(row["follows"]), -_size(row)


def _output_order(row: Row) -> tuple[bool, float]:
    return not row.get("key", False), -_size(row)


# --- code ------------------------------------------------------------------------------------------------------------


def _code(old: Data, new: Data) -> Iterator[Row]:
    """The program and the plugins whose version or source is another one."""
    sides = [_sources(side) for side in (old, new)]
    for name in dict.fromkeys([*sides[0], *sides[1]]):
        before, after = (side.get(name) for side in sides)
        if before and after and before != after:
            yield {"name": name, "old": list(before), "new": list(after)}


def _sources(results: Data) -> dict[str, tuple[str, str]]:
    program = results["program"]
    found = {"program": (str(program["version"]), str(program.get("source_sha256", "")))}
    plugins = results["mechanisms"].values()
    return found | {f"plugin {p['kind']}": (str(p["plugin_version"]), str(p.get("plugin_sha256", ""))) for p in plugins}
