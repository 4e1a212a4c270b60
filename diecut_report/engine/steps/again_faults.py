"""What plain code asks of machines that are calculated again, and that cannot be: told at the step that asks for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache, lru_cache
from itertools import chain
from typing import Any

import numpy as np

from diecut_report.contract.inputs import Block, Quantity
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.place import Misdeclared
from diecut_report.contract.result_names import named
from diecut_report.contract.steps import Step
from diecut_report.declaration.world import Key, world
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.units import pretty


def is_text(value: Any) -> bool:
    """Return whether what is tried are texts, or yes and no; a tuple of others is what the parts of a list have."""
    if isinstance(value, tuple):
        return bool(value) and all(isinstance(each, str) for each in value)
    return np.asarray(value).dtype.kind in "UOb"


def judge(mechanism: Mechanism, step: Step, changed: Mapping[str, Any], count: int, names: Sequence[str]) -> None:
    """Raise Misdeclared with the first thing that cannot be calculated so."""
    wrong = next(chain(_inputs(mechanism, changed, count), _asked(mechanism, names)), None)
    if wrong:
        raise _told(step, wrong)


def endless(step: Step) -> Misdeclared:
    """Return what is told where the machines that are tried would be sought themselves."""
    words = "tries machines that seek again: let the step lack the input that is tried (lacks=…), and try nothing without it"
    return _told(step, phrase(words))


def _told(step: Step, wrong: str) -> Misdeclared:
    return Misdeclared(Phrase("step {id}: {call} {wrong}", id=step.id, call='known["again"]', wrong=wrong), step.at)


@cache
def _keys(model: type[Block]) -> dict[str, Key]:
    return world(model).keys


@lru_cache(maxsize=64)
def _steps(mechanism: Mechanism) -> dict[str, Step]:
    return {step.id: step for _, step in mechanism.steps}


def _inputs(mechanism: Mechanism, changed: Mapping[str, Any], count: int) -> Iterator[str]:
    keys = _keys(mechanism.inputs)
    for name, value in changed.items():
        if name not in keys:
            yield Phrase("changes {name}, which is not an input{near}", name=name, near=nearest(name, keys))
        elif not isinstance(value, tuple) and np.ndim(value) and len(value) != count:
            words = "gets {n} values of {name} for {count} trials; give one for each"
            yield Phrase(words, n=len(value), name=name, count=count)
        elif is_text(value):
            yield from _text(keys[name], value)
        elif keys[name].texts:
            words = "tries numbers for {name}, which is a text: {texts}"
            yield Phrase(words, name=name, texts=", ".join(keys[name].texts))


def _text(key: Key, value: Any) -> Iterator[str]:
    """What is wrong with texts in the place of an input."""
    tried = dict.fromkeys(np.ravel(np.asarray(value, dtype=object)))
    if isinstance(key.meta, Quantity):
        shown = pretty(key.meta.unit) or "1"
        words = "tries {value} for {name}, which is a number: give it in SI, si(…, {unit})"
        yield Phrase(words, value=repr(next(iter(tried))), name=key.path, unit=repr(shown))
    elif key.home or key.is_block:
        words = "tries texts for {name}, a key of a list's parts, of which numbers alone can be tried"
        yield Phrase(words, name=key.path)
    for text in tried if key.texts and not isinstance(key.meta, Quantity) else ():
        if (str(text).lower() if isinstance(text, bool) else text) not in key.texts:
            words = "tries {text} for {name}; allowed: {texts}"
            yield Phrase(words, text=repr(text), name=key.path, texts=", ".join(key.texts))


def _asked(mechanism: Mechanism, names: Sequence[str]) -> Iterator[str]:
    """Quantities that no step gives."""
    steps, keys = _steps(mechanism), _keys(mechanism.inputs)
    for name in names:
        if name not in steps and name not in keys and named(name, steps) is None:
            yield Phrase("asks for {name}, which nothing gives{near}", name=name, near=nearest(name, {*steps, *keys}))
