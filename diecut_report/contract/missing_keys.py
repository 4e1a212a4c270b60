"""What a check still needs: the optional inputs without which it is not made, as far as the declarations tell."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import product

from diecut_report.contract.checks import Check
from diecut_report.contract.code_steps import Fact
from diecut_report.contract.inputs import Block, nested
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.placeholders import OneOf
from diecut_report.contract.result_names import read

Way = tuple[
    frozenset[str], frozenset[str]
]  # the tokens that must hold for a quantity to be calculated, and those that must not


@lru_cache(maxsize=4096)
def missing_keys(mechanism: Mechanism, check: Check, given: frozenset[str]) -> tuple[str, ...] | None:
    """Return the keys that must be given beside the given ones for a check to be made, of several ways the shortest.

    None where it does not apply to this machine: a text, a block, a list or an alternative that it needs was not chosen.
    Empty where nothing is missing. Keys stand in the order in which they are declared.
    """
    if not given.issuperset(check.only_with):
        return None
    found = [
        _completing(mechanism, _settling(mechanism, needs - given) - given, given, check.asks_for)
        for needs, lacks in _ways(mechanism, check)
        if not lacks & given
    ]
    shortest = min((keys for keys in found if keys is not None), key=len, default=None)
    if shortest is None:
        return None
    order = {path: number for number, path in enumerate(_paths(mechanism.inputs))}
    return tuple(sorted(shortest, key=lambda key: (order.get(key, len(order)), key)))


def _ways(mechanism: Mechanism, check: Check) -> Iterator[Way]:
    """The ways in which a check's sides can be calculated together."""
    for chosen in product(*(list(_givers(mechanism, name)) for name in check.named)):
        needs = frozenset(check.needs).union(*(way[0] for way in chosen))
        yield needs, frozenset().union(*(way[1] for way in chosen))


def _givers(mechanism: Mechanism, name: str) -> Iterator[Way]:
    """What must hold for an input to be there, or for each of the steps that give a quantity."""
    if name.removeprefix("inputs.") in _paths(mechanism.inputs):
        yield frozenset((name.removeprefix("inputs."),)), frozenset()
    for chapter, step in mechanism.steps:
        if read(name, step):
            yield frozenset(chapter.needs + step.needs), frozenset(step.lacks)


def _settling(mechanism: Mechanism, missing: frozenset[str]) -> frozenset[str]:
    """The missing tokens; in place of a fact that does not hold the first key with which nobody asks it, and those that go with that."""
    keys = {step.id: step.lacks[0] for _, step in mechanism.steps if isinstance(step, Fact) and step.lacks}
    groups = {group[0]: group for _, rule in _rules(mechanism.inputs) for group in rule.groups}
    return frozenset().union(*(groups.get(keys[each], (keys[each],)) if each in keys else (each,) for each in missing))


def _completing(
    mechanism: Mechanism, missing: frozenset[str], given: frozenset[str], blocks: tuple[str, ...]
) -> frozenset[str] | None:
    """The missing keys and ``blocks``, if they can be given beside the given ones; None where that would be another machine."""
    paths = _paths(mechanism.inputs)
    if any("=" in key or key not in paths or (paths[key] and key not in blocks) for key in missing):
        return None
    missing = frozenset(key for key in missing if key.rpartition(".")[0] not in missing)  # a block is missed as a whole
    if any(key.rpartition(".")[0] not in given for key in missing if "." in key):  # of a block that is not there
        return None
    known = {key for key in given if "=" not in key}
    rules = [each for each in _rules(mechanism.inputs) if not each[1].when or "".join((each[0], each[1].when)) in given]
    if any(_clashes(rule, home, known, missing) for home, rule in rules):
        return None
    return missing


def _clashes(rule: OneOf, home: str, known: set[str], missing: frozenset[str]) -> bool:
    """Whether a rule of alternatives that the given keys keep refuses the missing ones beside them."""
    own, more = ({key.removeprefix(home) for key in keys if key.startswith(home)} for keys in (known, known | missing))
    fault = rule.fault(more)
    return bool(fault) and rule.fault(own) != fault


@lru_cache(maxsize=256)
def _paths(model: type[Block], prefix: str = "") -> dict[str, bool]:
    """The inputs by their paths, in order, each with whether it is a block or a list of them."""
    found: dict[str, bool] = {}
    for name, field in model.model_fields.items():
        block = nested(field.annotation)
        found[prefix + name] = block is not None
        if block:
            found |= _paths(block[0], f"{prefix}{name}.")
    return found


def _rules(model: type[Block], prefix: str = "") -> Iterator[tuple[str, OneOf]]:
    yield from ((prefix, rule) for rule in model.one_of)
    for name, field in model.model_fields.items():
        block = nested(field.annotation)
        if block and not block[1]:
            yield from _rules(block[0], f"{prefix}{name}.")
