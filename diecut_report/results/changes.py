"""What changed between two results documents: inputs, outputs, checks, the code that calculated; what several have typed differently."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import Literal, TypeGuard, get_args

from diecut_report.config.model import PRESS
from diecut_report.config.validation import GIVEN
from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import UnitError, unit
from diecut_report.results.conclusion import COUNTED, RANK, SELF_TEST
from diecut_report.results.mechanism_record import CheckRecord, MechanismRecord, QuantityRecord, ShownRecord
from diecut_report.results.model import (
    CarriedConfigRecord,
    ChangedCheckRecord,
    ChangedCodeRecord,
    ChangedDocumentRecord,
    ChangedQuantityRecord,
    ChangedTextRecord,
    ChangesRecord,
    CheckSideRecord,
    QuantitySideRecord,
    ResultsRecord,
)

Mechanisms = Mapping[str, MechanismRecord]
SAME = 1e-9  # relative; below it is nothing but rounding
NOTHING = 1e-12  # in the display unit, which no quantity of a press has
MOST_DIGITS = 12
RANKS = {**RANK, "not_checked": 0.5}
"""A check that is not made is worse than one that passes, and better than one that warns."""
SEEN = 5e-4  # of a utilisation, which is printed in per cent with one decimal
Change = Literal["worse", "better", "added", "removed", "more used", "less used"]
ORDER: tuple[Change, ...] = get_args(Change)


def changes(old: ResultsRecord, new: ResultsRecord) -> ChangesRecord:
    """Return what changed from one results document to another."""
    return ChangesRecord(
        schema_version=1,
        old=_document(old),
        new=_document(new),
        mechanisms=list(_mechanisms(old.mechanisms, new.mechanisms)),
        checks=sorted(_checks(old, new), key=_check_order),
        inputs=sorted(_rows(old, new, is_input=True), key=lambda row: (bool(row.follows), -_size(row))),
        outputs=sorted(_rows(old, new, is_input=False), key=lambda row: (not row.key, -_size(row))),
        code=list(_code(old, new)),
    )


def compare_with(former: ResultsRecord, results: ResultsRecord) -> ResultsRecord:
    """Return the results with what changed since a former document, and the configuration of that, which the changes can be proved by."""
    kept = {key: getattr(former.config, key) for key in CarriedConfigRecord.model_fields}
    return results.with_(changes=changes(former, results), former=CarriedConfigRecord(**kept))


def _document(results: ResultsRecord) -> ChangedDocumentRecord:
    project, config, found = results.project, results.config, results.governing
    own = results.calculated[found.mechanism].checks if found else []
    return ChangedDocumentRecord(
        title=project.title,
        document_number=project.document_number,
        revision=project.revision,
        date=project.date or "",
        file=config.file,
        sha256=config.sha256,
        press=results.press.name,
        status=results.status,
        checks={status: results.summary.of(status) for status in COUNTED},
        governing=str(found) if found else "",
        governing_title=next(each.title for each in own if each.id == found.check) if found else "",
    )


def _mechanisms(old: Mechanisms, new: Mechanisms) -> Iterator[ChangedTextRecord]:
    """The mechanisms that came, went, are of another kind now, or could be calculated only once."""
    for name in dict.fromkeys([*old, *new]):
        sides = [_of_mechanism(side.get(name)) for side in (old, new)]
        if sides[0] != sides[1]:
            yield ChangedTextRecord(name=name, old=sides[0], new=sides[1])


def _of_mechanism(data: MechanismRecord | None) -> str:
    if data is None:
        return ""
    return f"{data.kind} ({data.status})" if data.status in ("error", "skipped") else data.kind


# --- checks ----------------------------------------------------------------------------------------------------------


def _checks(old: ResultsRecord, new: ResultsRecord) -> Iterator[ChangedCheckRecord]:
    """The checks that changed; those of a mechanism that went went with it."""
    sides = [
        {(name, check.id): check for name, data in side.mechanisms.items() for check in data.checks if check.check_class != SELF_TEST}
        for side in (old, new)
    ]  # fmt: skip
    for key in dict.fromkeys([*sides[0], *sides[1]]):
        before, after = (side.get(key) for side in sides)
        some = after or before
        if some and _is_other(before, after) and key[0] in new.mechanisms:
            yield ChangedCheckRecord(
                mechanism=key[0], id=key[1], title=some.title, check_class=some.check_class, old=_of_check(before),
                new=_of_check(after), change=_change(before, after),
            )  # fmt: skip


def _is_other(before: CheckRecord | None, after: CheckRecord | None) -> bool:
    if before is None or after is None or before.status != after.status:
        return True
    if before.utilisation is None or after.utilisation is None:
        return before.utilisation != after.utilisation
    return abs(after.utilisation - before.utilisation) >= SEEN


def _of_check(check: CheckRecord | None) -> CheckSideRecord | None:
    if check is None:
        return None
    return CheckSideRecord(status=check.status, utilisation=check.utilisation, message=check.message)


def _change(before: CheckRecord | None, after: CheckRecord | None) -> Change:
    """What happened to a check: worse, better, more or less used; added or removed."""
    if before is None or after is None:
        return "added" if before is None else "removed"
    ranks = [RANKS[check.status] for check in (before, after)]
    if ranks[0] != ranks[1]:
        return "worse" if ranks[1] > ranks[0] else "better"
    ratios = [math.inf if check.utilisation is None else check.utilisation for check in (before, after)]
    return "more used" if ratios[1] > ratios[0] else "less used"


def _check_order(row: ChangedCheckRecord) -> tuple[float, ...]:
    """What got worse comes first, then what fails among the new ones, what got better, the others; the worst of each first."""
    statuses = [side.status if side else "pass" for side in (row.old, row.new)]
    before, after = (side.utilisation if side else None for side in (row.old, row.new))
    first = 0 if row.change == "worse" or (row.change == "added" and statuses[1] == "fail") else 1
    step = 0.0 if before is None or after is None else abs(after - before)
    return first, ORDER.index(row.change), -max(RANKS[status] for status in statuses), -step


# --- quantities ------------------------------------------------------------------------------------------------------


def _quantities(results: ResultsRecord, other: ResultsRecord, *, is_input: bool) -> dict[str, QuantityRecord]:
    """The inputs or outputs of the mechanisms that both have, by their paths; of one that came or went that is reported by itself."""
    found = {row.path: row for row in results.press.fields} if is_input else {}
    for name in (name for name in results.mechanisms if name in other.mechanisms):
        own = results.mechanisms[name]
        found |= {f"{name}.{key}": row for key, row in (own.inputs if is_input else own.outputs).items()}
    return found


def _rows(old: ResultsRecord, new: ResultsRecord, *, is_input: bool) -> Iterator[ChangedQuantityRecord]:
    before, after = _quantities(old, new, is_input=is_input), _quantities(new, old, is_input=is_input)
    for path in dict.fromkeys([*before, *after]):
        pair = before.get(path), after.get(path)
        some = pair[1] or pair[0]
        if some and _has_changed(*pair):
            texts = _texts(*pair)
            yield ChangedQuantityRecord(
                path=path, symbol=some.symbol, description=some.description, old=_side(pair[0], texts[0]),
                new=_side(pair[1], texts[1]), relative=_relative(*pair), follows=_follows(*pair), key=some.key,
            )  # fmt: skip


def _has_changed(before: QuantityRecord | None, after: QuantityRecord | None) -> bool:
    return before is None or after is None or before.basis != after.basis or _has_other_value(before, after)


def _has_other_value(before: QuantityRecord, after: QuantityRecord) -> bool:
    """Whether a quantity has another value, rounding apart, and apart from what is shown as beyond a size of interest."""
    a, b = before.value, after.value
    if before.display == after.display and _is_beyond(before.display.text):
        return False
    if not (is_number(a) and is_number(b)):
        return a != b
    factor = _factor(after)
    return before.unit != after.unit or not math.isclose(a / factor, b / factor, rel_tol=SAME, abs_tol=NOTHING)


def _is_beyond(text: str) -> bool:
    """Whether a value is shown as "> 100": how much more it is does not matter."""
    return text.startswith(">")


def is_number(value: object) -> TypeGuard[float]:
    """Return whether a value is a number, which true and false are not here."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def _factor(row: QuantityRecord) -> float:
    """What a display unit is in SI; 1 for a unit that is not known, which only a file from outside has."""
    try:
        return unit(row.display.unit).factor
    except UnitError:
        return 1.0


def _texts(before: QuantityRecord | None, after: QuantityRecord | None) -> list[str]:
    """Both values as neutral texts in their display unit, with so many digits that they can be told apart."""
    texts = [row.display.text if row else "" for row in (before, after)]
    if not (before and after and is_number(before.value) and is_number(after.value)):
        return texts
    if any(map(_is_beyond, texts)):
        return texts
    values = [before.value / _factor(before), after.value / _factor(after)]
    for digits in range(5, MOST_DIGITS):
        if float(texts[0]) != float(texts[1]):
            break
        texts = [number_text(value, digits) for value in values]
    return texts


def _side(row: QuantityRecord | None, text: str) -> QuantitySideRecord | None:
    if row is None:
        return None
    shown = ShownRecord(text=text, unit=row.display.unit)
    return QuantitySideRecord(value=row.value, unit=row.unit, display=shown, basis=row.basis)


def _relative(before: QuantityRecord | None, after: QuantityRecord | None) -> float | None:
    """The change as a share of the old value; None where there is none, as of a text or from zero."""
    if before is None or after is None or before.unit != after.unit:
        return None
    a, b = before.value, after.value
    if not (is_number(a) and is_number(b)) or abs(a / _factor(before)) <= NOTHING:
        return None
    share = (b - a) / abs(a)
    return share if math.isfinite(share) else None


def _follows(before: QuantityRecord | None, after: QuantityRecord | None) -> str:
    """The paths that an input follows by itself, so that its change is none of the user's; "" where the user has changed it."""
    if before is None or after is None or not after.origin:  # data of the press, whose path is their own
        return ""
    if any(getattr(before, key) != getattr(after, key) for key in ("origin", "text", "path", "paths")):
        return ""
    return after.path or ", ".join(after.paths)


def _size(row: ChangedQuantityRecord) -> float:
    return math.inf if row.relative is None else abs(row.relative)


# --- several documents side by side ----------------------------------------------------------------------------------


Side = ResultsRecord | None  # None: nothing was calculated
OwnChange = tuple[str, list[QuantityRecord | None]]  # the path of an input, and what each document has there


def differing_kinds(sides: Sequence[Side]) -> dict[str, list[str]]:
    """Return the mechanisms that not all documents have, or not of the same kind: the kind in each, "" where it is not there."""
    kinds = [{name: each.kind for name, each in side.mechanisms.items()} if side else {} for side in sides]
    found = {name: [each.get(name, "") for each in kinds] for name in dict.fromkeys(chain(*kinds))}
    return {
        name: own
        for name, own in found.items()
        if len({each for each, side in zip(own, sides, strict=True) if side}) > 1
    }


def own_changes(sides: Sequence[Side]) -> list[OwnChange]:
    """Return the inputs that were typed differently, not what follows from them; what all have first, the greatest differences before others.

    Inputs of a mechanism are compared among the documents that have it, of the same kind.
    """
    homes = [{"": "", **{name: each.kind for name, each in side.mechanisms.items()}} if side else {} for side in sides]
    inputs = [dict(_of_kinds(side)) if side else {} for side in sides]
    found = []
    for name, kind, path in dict.fromkeys(chain(*inputs)):
        rows = [each.get((name, kind, path)) for each in inputs]
        compared = [row for row, home in zip(rows, homes, strict=True) if home.get(name) == kind]
        if any(_is_own(compared[0], other) for other in compared[1:]):
            found.append((path, rows))
    return sorted(found, key=lambda each: (not each[0].startswith(f"{PRESS}."), *_spread(each[1])))


def _of_kinds(results: ResultsRecord) -> Iterator[tuple[tuple[str, str, str], QuantityRecord]]:
    yield from ((("", "", row.path), row) for row in results.press.fields)
    for name, mechanism in results.mechanisms.items():
        yield from (((name, mechanism.kind, f"{name}.{key}"), row) for key, row in mechanism.inputs.items())


def _is_own(before: QuantityRecord | None, after: QuantityRecord | None) -> bool:
    """Whether an input differs because somebody typed it: a default that comes or goes with another input is not."""
    if before is None or after is None:
        return any(row and row.origin != "default" for row in (before, after))
    is_typed = not before.origin == after.origin == "default" and not _follows(before, after)
    bases = {row.basis or GIVEN for row in (before, after)}  # a default has none
    return is_typed and (_has_other_value(before, after) or len(bases) > 1)


def _spread(rows: Sequence[QuantityRecord | None]) -> tuple[bool, float]:
    values = [row.value for row in rows if row]
    numbers = [value for value in values if is_number(value)]
    greatest = max(map(abs, numbers), default=0.0)
    spread = (max(numbers) - min(numbers)) / greatest if greatest and len(numbers) == len(values) else math.inf
    return len(values) < len(rows), -spread


# --- code ------------------------------------------------------------------------------------------------------------


def _code(old: ResultsRecord, new: ResultsRecord) -> Iterator[ChangedCodeRecord]:
    """The program and the plugins whose version or source is another one."""
    sides = [_sources(side) for side in (old, new)]
    for name in dict.fromkeys([*sides[0], *sides[1]]):
        before, after = (side.get(name) for side in sides)
        if before and after and before != after:
            yield ChangedCodeRecord(name=name, old=before, new=after)


def _sources(results: ResultsRecord) -> dict[str, list[str]]:
    program = results.program
    plugins = results.mechanisms.values()
    return {"program": [program.version, program.source_sha256]} | {
        f"plugin {each.kind}": [each.plugin_version, each.plugin_sha256] for each in plugins
    }
