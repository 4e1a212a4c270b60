"""Values for what a kind must have and its example does not give: of plugins without an example, to be replaced by one's own."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, Literal, get_args, get_origin

from diecut_report.config.validation import ModelKey, keys_of
from diecut_report.contract.inputs import Block, CurveInput, Quantity, Text

SIZES = (10, 100, 1, 0.5, 0.1, 20, 50, 1000, 0.01)  # in the key's display unit, which is one of handy numbers
WAVE = [0, 1, 0, -1]  # of a curve over one period


def completed(model: type[Block], data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of a block with guesses for the keys that it lacks; what cannot be guessed is left out."""
    wanted = [*_required(model), *_chosen(model, data)]
    guesses = {key: guess for key in wanted if key not in data and (guess := guessed(keys_of(model)[key])) is not None}
    return {**data, **guesses}


def unguessed(model: type[Block], data: Mapping[str, Any]) -> list[str]:
    """Return the keys that a block must have and that no value is known of."""
    return [key for key in _required(model) if key not in data]


def guessed(known: ModelKey) -> Any:
    """Return a value that a key may have by its declaration alone; None where it must be a reference."""
    if known.block:
        block = completed(known.block, {})
        return [block] if known.is_list else block
    match known.meta:
        case Quantity() as meta:
            return next((_with_unit(size, meta) for size in SIZES if _is_allowed(meta, size)), None)
        case CurveInput(referred=False):
            return list(WAVE)
        case Text() as meta:
            return next(iter(meta.options), None) or first_option(known)
    return None


def options(known: ModelKey) -> Collection[str]:
    """Return the texts that a key may have; nothing where it takes any."""
    if isinstance(known.meta, Text) and known.meta.options:
        return known.meta.options
    return [option for part in _parts(known.field.annotation) for option in get_args(part) if option is not None]


def first_option(known: ModelKey) -> Any:
    """Return the first of the texts that are allowed, "no" of yes and no, else a text that says that it is one's own."""
    found = options(known)
    if found:
        return next(iter(found))
    return False if bool in _parts(known.field.annotation) else "A"


def _parts(annotation: Any) -> list[Any]:
    """The types that an annotation allows."""
    if get_origin(annotation) is Literal or not get_args(annotation):
        return [annotation]
    return [each for part in get_args(annotation) for each in _parts(part)]


def _required(model: type[Block]) -> list[str]:
    return [name for name, known in keys_of(model).items() if known.field.is_required()]


def _chosen(model: type[Block], data: Mapping[str, Any]) -> list[str]:
    """The keys of the first alternative of each rule of which a block has no key."""
    texts = {name: data.get(name, known.field.default) for name, known in keys_of(model).items()}
    rules = [rule for rule in model.one_of if not rule.optional and rule.is_asked(texts)]
    return [
        key for rule in rules if not any(data.keys() & set(group) for group in rule.groups) for key in rule.groups[0]
    ]


def _with_unit(size: float, meta: Quantity) -> float | str:
    return size if meta.unit == "1" else f"{size} {meta.unit}"


def _is_allowed(meta: Quantity, size: float) -> bool:
    try:
        meta.validate(size)
    except ValueError:
        return False
    return True
