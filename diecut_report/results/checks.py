"""Checks: demand against limit, margin, utilisation and verdict, for one machine or an array of them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from decimal import Decimal
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from diecut_report.config.yaml import KeyPath, dotted
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, declared_unit, unit_for
from diecut_report.machine.printing.substitution import filled
from diecut_report.machine.steps.soundness import is_made
from diecut_report.mechanism.checks import Check, by_part
from diecut_report.mechanism.inputs import list_inputs
from diecut_report.mechanism.mechanism import missing_keys
from diecut_report.mechanism.names import Misdeclared, listed
from diecut_report.quantities.formatting import place_shown, shown, with_unit
from diecut_report.quantities.units import unit
from diecut_report.results.advice import AdvisedCheck, Advisor, Way
from diecut_report.results.mechanism_record import CheckRecord, ShownRecord
from diecut_report.text.phrases import Phrase, joined, named, phrase

# Checks that are not made because an optional input is not given: what each needs, and its demand where that is known.


NOT_CHECKED = "not_checked"
MISSING = {  # whether several keys are missing, whether a side is known
    (False, False): "Not checked: {keys} is not given.",
    (True, False): "Not checked: {keys} are not given.",
    (False, True): "Not checked: {known}, but {keys} is not given.",
    (True, True): "Not checked: {known}, but {keys} are not given.",
}


def is_of_machine(check: Check) -> bool:
    """Return whether a check judges the machine, and not the calculation itself."""
    return check.check_class != "numerical"


def missing_checks(calc: Calculation, check: Check) -> tuple[str, ...]:
    """Return the keys without which a check is not made; none where it is made, does not apply, or tests the calculation itself."""
    if not is_of_machine(check) or any(_does_not_exist(calc, side) for side in (check.demand, check.limit)):
        return ()
    if keys := missing_keys(calc.mechanism, check, calc.given):
        return keys
    # the optional keys of a list that the part which it judges leaves out, though others give them
    rows = {key: calc.inputs[key] for key in check.named if key in calc.inputs and check.index is not None}
    return tuple(key for key, row in rows.items() if isinstance(row, tuple) and row[check.index or 0] is None)


def _does_not_exist(calc: Calculation, side: str | float) -> bool:
    """Whether a side is a quantity that this machine (none of many) does not have, as a shaft without a torque has no twist."""
    if not isinstance(side, str) or side not in calc.values or calc.steps[side].exists is None:
        return False
    return bool(np.isnan(calc.values[side].astype(float)).all())


def not_made(calc: Calculation, check: Check, keys: tuple[str, ...]) -> CheckRecord:
    """Return a check that is not made, in the form of those that are."""
    demand = _known(calc, check, check.demand)
    display = None if demand is None else ShownRecord(**shown(demand, check_unit(calc, check, [demand])))
    return CheckRecord(
        **_head(check), status="not_checked", demand=demand, limit=None, utilisation=None, message=_message(calc, check, keys),
        demand_label=check.demand_label, limit_label=check.limit_label, demand_display=display, limit_display=None,
        margin_display=None, missing=list(keys),
    )  # fmt: skip


def _head(check: Check) -> dict[str, Any]:
    """What a check is called, whatever comes of it."""
    return {"id": check.id, "title": check.title, "check_class": check.check_class, "operator": check.operator,
            "unit": unit(check.unit).si, "source": check.source}  # fmt: skip


def without_basis(calc: Calculation, check: Check) -> tuple[str, ...]:
    """Return the inputs by which a check would hold because they were typed."""
    own = set(map(dotted, _unfounded_keys(calc, check)))
    return tuple(name for name in check.founded if name in own)


def rests_on_typing(calc: Calculation, check: Check) -> Array:
    """Return of which machines a check would hold because something was typed, shape (variants,)."""
    found = np.zeros(calc.count, dtype=bool)
    for key in _unfounded_keys(calc, check):
        found |= calc.unfounded[key]
    return found


def _unfounded_keys(calc: Calculation, check: Check) -> list[KeyPath]:
    """The inputs of a check that lack the basis which it asks for, of the part that it judges."""
    keys = [key for key in calc.unfounded if dotted(key) in check.founded]
    index = check.index
    return [key for key in keys if index is None or index in key or all(isinstance(part, str) for part in key)]


def left_out(calc: Calculation, check: Check, found: JudgedCheck) -> tuple[str, ...]:
    """Return the keys by which a check that holds may still fail: without them its demand is the least that it can be, or parts of a row lack them.

    Such a row is judged by its other parts; named parts have checks of their own.
    """
    if lacking := tuple(key for key in check.at_best if key not in calc.given):
        return lacking
    rows = {key: calc.inputs.get(key) for key in (check.named if check.index is None else ())}
    optional = {key: row for key, row in rows.items() if isinstance(row, tuple) and any(part is None for part in row)}
    if not optional:
        return ()
    one_side = (np.isfinite(found.demand) != np.isfinite(found.limit)).any(axis=(0, 1))
    homes = list_inputs(calc.mechanism.inputs)
    return tuple(
        f"{homes[key]}.{index}.{key.removeprefix(homes[key] + '.')}"
        for key, row in optional.items()
        for index, (part, lacks) in enumerate(zip(row, one_side, strict=True))
        if part is None and lacks
    )


def unfounded(calc: Calculation, check: Check, keys: tuple[str, ...]) -> CheckRecord:
    """Return a check that would hold by what was typed alone, in the form of those that are not made."""
    template = (
        "Not checked: it would pass only because of {keys}, not yet substantiated; give the basis there, as in "
        "{value: 1.2, basis: standard, note: …}: measured, drawing, or the standard or catalogue that the note names."
    )
    return not_made(calc, check, keys).with_(message=Phrase(template, keys=listed(keys)))


def check_unit(calc: Calculation, check: Check, sides: list[float]) -> str:
    """Return the one unit in which the sides of a check are shown."""
    named = [side for side in (check.demand, check.limit) if isinstance(side, str) and side in calc.chosen_units.by_id]
    return unit_for(calc, named[0] if named else "", check.unit, sides)


def _message(calc: Calculation, check: Check, keys: tuple[str, ...]) -> str:
    """What is known of either side, and what is not given."""
    known: list[Phrase] = []
    for label, side in ((check.demand_label, check.demand), (check.limit_label, check.limit)):
        if (value := _known(calc, check, side)) is not None:
            text = with_unit(*shown(value, check_unit(calc, check, [value])).values())
            known.append(Phrase("{label} {value}", label=phrase(label), value=text))
    told: str = Phrase(MISSING[len(keys) > 1, bool(known)], keys=listed(keys), known=known[0] if known else "")
    return joined([told, *dict.fromkeys(_of_partners(calc, keys))], " ")


def _of_partners(calc: Calculation, keys: tuple[str, ...]) -> Iterator[str]:
    """Where the missing keys would come from by themselves."""
    for partner in calc.mechanism.partners:
        wanted = [key for key in keys if key in partner.takes]
        if wanted and partner.key in calc.given:
            homes = listed([f"{calc.inputs[partner.key]}.{partner.takes[key]}" for key in wanted])
            yield Phrase("{keys} are not there." if len(wanted) > 1 else "{keys} is not there.", keys=homes)
        elif wanted:
            none = "There is no {kinds}, or there are several: select one with {key}."
            yield Phrase(none, kinds=named(partner.kinds, " or "), key=partner.key)


def _known(calc: Calculation, check: Check, side: str | float) -> float | None:
    """One side of a check as a number in SI, of repeated parts the one that is judged or the greatest; None where it is not known, or a curve."""
    if not isinstance(side, str) or not (side in calc.values or side in calc.inputs):
        return None
    row = _side(calc, check, side)[0]
    row = (
        row if check.index is None or len(row) == 1 else row[[check.index]]
    )  # what has one number has it for all parts
    return float(np.nanmax(row)) if np.isfinite(row).any() else None


ROUNDING = 1e-9  # of the limit: a demand below this share is the rounding of a difference that is none
COMPUTER = 1e-12  # of the limit: a margin below this share is the rounding of equal sides
MARGIN_DIGITS = (4, 3, 2)
NOTHING_BESIDE = 1e-6  # of the limit: a demand below this share takes nothing visible of it


class JudgedCheck(NamedTuple):
    """Hold a check of all machines, each array of shape (variants, pairs of sides, parts); ``worst`` is the place of the governing one.

    ``there`` says where both sides have a value; ``worst`` has shape (variants,) and counts through pairs and parts.
    """

    demand: Array
    limit: Array
    held: Array
    ratio: Array
    there: Array
    worst: Array

    @property
    def all_hold(self) -> bool:
        """Return whether the check holds on all machines."""
        return bool(self.governing(self.held).all())

    def governing(self, values: Array) -> Array:
        """Return what governs, shape (variants,)."""
        flat = values.reshape(len(values), -1)
        found: Array = flat[np.arange(len(flat)), self.worst]
        return found


def verdicts(calc: Calculation) -> list[CheckRecord]:
    """Return each check as ``check_results``, but without advice: to find that takes longer than all the rest."""
    return check_results(calc, is_advised=False)


def check_results(calc: Calculation, *, is_advised: bool = True) -> list[CheckRecord]:
    """Return each check with demand, limit, margin, utilisation and verdict; one that needs more keys as not checked."""
    sides = [(check, _there(calc, check)) for check in checks_of(calc)]
    checks = [(check, None if pair is None else _judged(check, *pair)) for check, pair in sides]
    ids = {check.id for check, found in checks if found is not None}
    held = [check for check, found in checks if found is not None and found.all_hold and is_of_machine(check)]
    failing = [check for check, found in checks if found is not None and not found.all_hold]
    advisor = Advisor(calc, held, failing, holds) if is_advised else None
    made = []
    for check, found in checks:
        if found is not None:
            own = _check(calc, check, found, advisor)
            keys = without_basis(calc, check) if own.status == "pass" else ()
            parts = left_out(calc, check, found) if own.status == "pass" else ()
            made.append(unfounded(calc, check, keys) if keys else not_made(calc, check, parts) if parts else own)
        elif check.id not in ids and (missing := missing_checks(calc, check)):
            ids.add(check.id)
            made.append(not_made(calc, check, missing))
    return made


def checks_of(calc: Calculation) -> list[Check]:
    """Return the checks of a machine, those of named parts one by one."""
    return [*by_part(calc.mechanism.checks, calc.inputs.get), *calc.further_checks]


def applies(calc: Calculation, check: Check) -> bool:
    """Return whether a check is made. It is left out where an optional input of it is not given, or what it judges is absent."""
    return _there(calc, check) is not None


def _there(calc: Calculation, check: Check) -> Array | None:
    """What a check that is made compares, as in ``_compared``."""
    if not is_made(calc, check):
        return None
    sides = _compared(calc, check)
    return None if np.isnan(sides[:, 0]).any(axis=0).all() else sides


def judged(calc: Calculation, check: Check) -> JudgedCheck:
    """Judge a check of all machines: each pair of its sides, for each part of a row."""
    return _judged(check, *_compared(calc, check))


def _judged(check: Check, demand: Array, limit: Array) -> JudgedCheck:
    held, ratio = verdict(check, demand, limit)
    there = np.isfinite(demand) & np.isfinite(limit)
    flat = (part.reshape(len(demand), -1) for part in (demand, limit, held, ratio, there))
    return JudgedCheck(demand, limit, held, ratio, there, worst(*flat))


def verdict(check: Check, demand: Any, limit: Any) -> tuple[Any, Any]:
    """Return whether the check holds, and its utilisation (NaN where the limit is not above zero), for arrays of variants."""
    with np.errstate(all="ignore"):
        allowed = check.reach(limit)
        held = demand < allowed if check.operator == "<" else demand <= allowed
        return held, np.where(limit > 0, np.divide(demand, limit), np.nan)


def worst(demand: Array, limit: Array, held: Array, ratio: Array, there: Array) -> Array:
    """Return along the last axis which one governs: one that fails, then the greatest utilisation, then what is furthest beyond."""
    if held.shape[-1] == 1:
        return np.zeros(held.shape[:-1], dtype=int)
    with np.errstate(all="ignore"):
        beyond = np.where(there, demand - limit, -np.inf)
    unknown = np.where(held, -np.inf, np.inf)
    ratios = np.where(np.isnan(ratio), unknown, ratio)
    first = np.broadcast_to(-np.arange(held.shape[-1]), held.shape)
    found: Array = np.lexsort((first, beyond, ratios, ~held, there), axis=-1)[..., -1]
    return found


def _compared(calc: Calculation, check: Check) -> Array:
    """Demands and limits of all machines, SI, shape (2, variants, pairs of sides, parts)."""
    pairs = [
        calc.judged[check.id, number][:2]
        if (check.id, number) in calc.judged
        else [_side(calc, check, each) for each in pair]
        for number, pair in enumerate(check.pairs)
    ]
    sides = [side for pair in pairs for side in pair]
    if any(side.shape != (calc.count, 1) for side in sides):
        sides = list(np.broadcast_arrays(*sides, np.empty((calc.count, 1)))[:-1])
    found = np.array(sides).reshape(len(pairs), 2, calc.count, -1).transpose(1, 2, 0, 3)
    if check.index is None:
        return found
    if not -found.shape[-1] <= check.index < found.shape[-1]:
        template = "check {id} is of part index={index} alone, counted from 0, but there are {count} parts"
        raise Misdeclared(Phrase(template, id=check.id, index=str(check.index), count=str(found.shape[-1])), check.at)
    return found[..., [check.index]]


def _side(calc: Calculation, check: Check, side: str | float) -> Array:
    """A side of a check, of shape (variants, 1) or (variants, parts); NaN for a part that does not have it."""
    if not isinstance(side, str):
        return np.full((calc.count, 1), side * unit(check.unit).factor)
    found: Any = calc[side]
    if isinstance(found, tuple):  # an optional input of repeated parts, which some do not have
        columns = [np.broadcast_to(np.nan if part is None else part, (calc.count,)) for part in found]
        return np.stack(columns, axis=1)
    return np.asarray(found, dtype=float)


def holds(calc: Calculation, check: Check) -> tuple[Array, Array]:
    """Return where a check is made, and where it holds, each of shape (variants,)."""
    if not is_made(calc, check):
        return np.zeros(calc.count, dtype=bool), np.zeros(calc.count, dtype=bool)
    found = judged(calc, check)
    return found.governing(found.there), found.governing(found.held)


def _check(calc: Calculation, check: Check, found: JudgedCheck, advisor: Advisor | None) -> CheckRecord:
    if np.isinf([found.demand[0], found.limit[0]]).any():
        raise ValueError(f"check {check.id} compares {found.demand[0].ravel()} with {found.limit[0].ravel()}")
    pair, part = divmod(int(found.worst[0]), found.demand.shape[2])
    display = check_unit(calc, check, [found.demand[0, pair, part], found.limit[0, pair, part]])
    told = _told(check, display, found, pair, part)
    where, places = _where(calc, check, pair, part, found.demand.shape[2])
    sides = ("limit", "demand") if pair else ("demand", "limit")  # the lower bound may govern
    sentence = _bounds(told, *sides) + _beside(calc, check, display, found, pair, part) + where
    message, ways = Phrase("{bounds:capital}.", {"bounds:capital": sentence}), list[Way]()
    if told["status"] != "pass":
        consequence = filled(calc, check.consequence, places=places)
        message = Phrase("{bounds:capital}: {consequence}", {"bounds:capital": sentence, "consequence": consequence})
        ways = advisor.ways(check) if advisor else []
        if advisor:
            calc.advised[check.id] = AdvisedCheck(message, ways, partial(advisor.ways, check))
    return CheckRecord(
        **_head(check),
        **told,
        **AdvisedCheck(message, ways).fields,
        **_further(calc, check, display, found, pair, part),
        sized_to_limit=is_sized(calc.given, check),
        presumed=check.presumed,
    )


def is_sized(given: frozenset[str], check: Check) -> bool:
    """Return whether the program sized what a check compares to its limit, so that the check shows no reserve."""
    return check.sized_unless is not None and given.isdisjoint(check.sized_unless)


def _told(check: Check, display: str, found: JudgedCheck, pair: int, part: int) -> dict[str, Any]:
    """What is reported of one pair of sides (0: demand and limit, 1: lower bound and demand), of one part."""
    demand, limit, ratio = (float(side[0, pair, part]) for side in (found.demand, found.limit, found.ratio))
    labels = (check.at_least_label, check.demand_label) if pair else (check.demand_label, check.limit_label)
    status = "pass" if found.held[0, pair, part] else "fail" if check.is_failure(np.array(ratio)) else "warn"
    return {"status": status, "demand": demand, "limit": limit, "utilisation": None if math.isnan(ratio) else ratio,
            "demand_label": labels[0], "limit_label": labels[1], **_texts(demand, limit, display)}  # fmt: skip


def _bounds(told: dict[str, Any], *sides: str) -> Phrase:
    """What is compared, the one beside the other."""
    labels = [phrase(told[f"{side}_label"]) for side in sides]
    first, next = (with_unit(*told[f"{side}_display"].values()) for side in sides)
    return Phrase("{label} {first}, {next_label} {next}", first=first, next=next, label=labels[0], next_label=labels[1])


def _beside(calc: Calculation, check: Check, display: str, found: JudgedCheck, pair: int, part: int) -> str:
    """The other bound of a two-sided check, in brackets; none of a curve, which has that at another place."""
    if check.at_least is None or (check.id, pair) in calc.judged:
        return ""
    side, label = (found.limit, check.limit_label) if pair else (found.demand, check.at_least_label)
    value = with_unit(*shown(float(side[0, 1 - pair, part]), display).values())
    return Phrase(" ({label} {value})", label=phrase(label), value=value)


def _where(calc: Calculation, check: Check, pair: int, part: int, count: int) -> tuple[str, dict[str, int | str]]:
    """Where a check governs, in words: a place of the abscissa, a part of a row; and what a message may name of that."""
    if (check.id, pair) in calc.judged:
        at = _at(calc, check, pair)
        return Phrase(" at {symbol} = {value}", symbol=at["symbol"], value=with_unit(at["text"], at["unit"])), {}
    if check.index is not None:
        return "", {"part": check.part_name, "index": check.index}
    if _is_row(calc, check):
        places: dict[str, int | str] = {"part": part + 1, "next": (part + 1) % count + 1, "index": part}
        names = _part_names(calc, check)
        if names:
            return Phrase(" at {name}", name=names[part]), places
        return Phrase(" at part {part} of {count}", part=part + 1, count=count), places
    return "", {}


def _is_row(calc: Calculation, check: Check) -> bool:
    return any(name in calc.axis and calc.axis[name] not in calc.domains for name in check.named)


def _part_names(calc: Calculation, check: Check) -> tuple[str, ...]:
    """The names of the parts that a check runs over, where they have some."""
    found: Iterator[Any] = (
        calc.part_names.get(calc.axis.get(name, ""))
        or calc.inputs.get(calc.steps[name].named_by if name in calc.steps else "")
        for name in check.named
    )
    return next((names for names in found if names), ())


def _at(calc: Calculation, check: Check, pair: int) -> dict[str, str]:
    side = calc.judged[check.id, pair]
    axis = calc.steps[side.axis]
    place = place_shown(float(side.place[0, 0]), declared_unit(calc, axis.id, axis.unit))
    return {"symbol": axis.symbol} | place


def _further(calc: Calculation, check: Check, display: str, found: JudgedCheck, pair: int, part: int) -> dict[str, Any]:
    """Of a curve the place where it governs; of a row the part that governs, and all parts."""
    if (check.id, pair) in calc.judged:
        return {"at": _at(calc, check, pair)}
    if check.index is not None or not _is_row(calc, check):
        return {}
    there = found.there[0].T
    pairs = worst(found.demand[0].T, found.limit[0].T, found.held[0].T, found.ratio[0].T, there)
    parts = [
        _told(check, display, found, int(p), i) if there[i].any() else {"status": None} for i, p in enumerate(pairs)
    ]
    names = _part_names(calc, check)
    told = [one | {"name": name} for one, name in zip(parts, names, strict=True)] if names else parts
    return {"part": part + 1, "parts": told} | ({"part_name": names[part]} if names else {})


def _texts(demand: float, limit: float, display: str) -> dict[str, dict[str, str]]:
    """Demand, limit and margin as texts, with so many digits that the margin can be seen in the two others.

    A demand that is nothing but rounding beside its limit is reported as zero.
    """
    demand = 0.0 if abs(demand) < ROUNDING * abs(limit) else demand
    margin = 0.0 if abs(limit - demand) < COMPUTER * abs(limit) else limit - demand
    for digits in range(4, 10):
        texts = [shown(value, display, digits) for value in (demand, limit)]
        seen = (float(texts[1]["text"]) - float(texts[0]["text"])) * unit(display).factor
        if abs(seen - margin) <= 0.05 * abs(margin):
            break
    return {"demand_display": texts[0], "limit_display": texts[1], "margin_display": _margin(margin, display, texts)}


def _margin(margin: float, display: str, texts: list[dict[str, str]]) -> dict[str, str]:
    """A margin with as many digits as the printed demand and limit show of it: who subtracts them finds no other one."""
    if abs(float(texts[0]["text"])) < NOTHING_BESIDE * abs(float(texts[1]["text"])):
        return texts[1]
    seen = Decimal(texts[1]["text"]) - Decimal(texts[0]["text"])
    for digits in MARGIN_DIGITS:
        found = shown(margin, display, digits)
        if seen.quantize(number := Decimal(found["text"])) == number:
            break
    return found | {"text": _no_finer(found["text"], seen)}


def _no_finer(text: str, seen: Decimal) -> str:
    """A number's text without zeros beyond the last place of what is seen: 9.27 for 9.270 between 20.73 and 30."""
    number, is_plain = Decimal(text), "e" not in text
    return str(number.quantize(seen)) if is_plain and number == seen and len(text) > len(str(seen)) else text
