"""Single extreme values put into a machine's inputs: numbers come out, or an error in words, and nothing else."""

from __future__ import annotations

import json
import random
import re
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from diecut_report.config import yaml
from diecut_report.config.loader import Config
from diecut_report.config.own_tables import Find
from diecut_report.config.plugins import Discovery
from diecut_report.config.references import upstream
from diecut_report.config.yaml import KeyPath, dotted
from diecut_report.errors import UserError
from diecut_report.mechanism.chapters import in_unit
from diecut_report.mechanism.inputs import Block, Quantity, meta_of, nested
from diecut_report.press import Press
from diecut_report.results.document import document
from diecut_report.results.results_file import results_text
from diecut_report.results.warm_press import WarmPress
from diecut_report.text.phrases import Phrase

NOT_A_NUMBER = re.compile(r"(?<![\w.])[-+−]?(?:nan|inf|infinity)(?![\w])", re.IGNORECASE)
BEYOND = (1e-300, 1e-12, 1e12, 1e300)
BESIDE = 1e-6  # how far inside its bounds a value stands, as a share of it
EXTREMES, BUDGET, SEED = 120, 60.0, 3  # single extreme values that are tried at most, and the seconds for them


Extreme = float | int | list[Any]


def extreme_values(quantity: Quantity) -> Iterator[float | int]:
    """Yield the extremes of a quantity, in its display unit.

    They are its bounds and just beside them, its plausible sizes and just within them, and far beyond.
    """
    limits = [limit for limit in (quantity.gt, quantity.ge, quantity.lt, quantity.le) if limit is not None]
    least, most = (end / quantity.parsed_unit.factor for end in quantity.sizes.ends)
    sizes = [least, least * (1 + BESIDE), most * (1 - BESIDE), most]
    if quantity.integer:
        near = [limit + step for limit in limits for step in (-1, 1)]
        yield from sorted({round(each) for each in (*limits, *sizes, *near)})
        return
    beside = [limit + sign * BESIDE * (abs(limit) or 1) for limit in limits for sign in (-1, 1)]
    yield from (*limits, *beside, *sizes, *BEYOND, -0.0)
    yield from (-each for each in (*sizes, *BEYOND))


def numeric_inputs(model: type[Block], data: Mapping[str, Any], prefix: KeyPath) -> Iterator[tuple[KeyPath, Quantity]]:
    """Yield the numeric inputs of a block and of the blocks that are given in it, the first of each list of them."""
    for name in model.model_fields:
        meta, block = meta_of(model, name), nested(model.model_fields[name].annotation)
        given, key = data.get(name), (*prefix, name)
        if block and isinstance(given, list) and given:
            yield from numeric_inputs(block[0], given[0], (*key, 0))
        elif block and isinstance(given, dict):
            yield from numeric_inputs(block[0], given, key)
        elif isinstance(meta, Quantity):
            yield key, in_unit(meta, list(data))


def empty_lists(model: type[Block], data: Mapping[str, Any], prefix: KeyPath) -> Iterator[tuple[KeyPath, list[Any]]]:
    """Yield each list that is given in a block, in the blocks of it and in the first ones of its lists, as an empty one."""
    for name, own in model.model_fields.items():
        block, given, key = nested(own.annotation), data.get(name), (*prefix, name)
        if isinstance(given, list):
            yield key, []
        first, place = (given[0], (*key, 0)) if isinstance(given, list) and given else (given, key)
        if block and isinstance(first, dict):
            yield from empty_lists(block[0], first, place)


def input_of(path: KeyPath) -> str:
    """Return the id of a mechanism's input by its place in the configuration."""
    return dotted(path[2:])


def with_value(config: Mapping[str, Any], key: KeyPath, value: Any, unit: str = "1") -> str:
    """Return a configuration with another value as a text; a number with its unit, so that nobody asks which one is meant."""
    changed = json.loads(json.dumps(config))
    home: Any = changed
    for part in key[:-1]:
        home = home.setdefault(part, {}) if isinstance(home, dict) else home[part]
    home[key[-1]] = value if unit == "1" else f"{value!r} {unit}"
    return json.dumps(changed)


class Outcome(NamedTuple):
    """Hold what came of a configuration: what is wrong with it, None where it is numbers, or is refused in words."""

    fault: str | None
    is_refused: bool = False


def outcome_of(text: str, discovery: Discovery, press: WarmPress, find: Find | None = None) -> Outcome:
    """Return what comes of a configuration; ``press`` remembers what those that are tried one after another have in common."""
    try:
        run = press.printed(Press.read(yaml.parse(text, "press.yaml"), discovery, find=find).config)
        results = results_text(document(run))
    except UserError as refusal:
        told = {str(problem): str(problem.message) for problem in refusal.problems}
        odd = next((problem for problem, words in told.items() if NOT_A_NUMBER.search(words) or not words), None)
        return Outcome(odd and Phrase("refused without a message: {problem}", problem=odd), is_refused=True)
    except Exception as cause:
        return Outcome(f"{type(cause).__name__}: {cause}")
    if broken := [*run.errors.values()]:
        return Outcome(Phrase("the plugin breaks: {error}", error=broken[0].message))
    found = NOT_A_NUMBER.search(results)
    if found is None:
        return Outcome(None)
    around = results[max(0, found.start() - 80) : found.end() + 40]
    return Outcome(Phrase("{value} in the results: {text}", value=repr(found[0]), text=around))


@dataclass
class TriedExtremes:
    """Put single extreme values into a machine of a configuration, and tell what came of them."""

    config: Config
    name: str
    discovery: Discovery
    numbers: int = field(default=0, init=False)
    refused: int = field(default=0, init=False)

    @cached_property
    def data(self) -> dict[str, Any]:
        """Return the plain data of the configuration with the machine alone, and the mechanisms that it refers to."""
        data, needed = (
            json.loads(json.dumps(self.config.tree.data, default=str)),
            upstream(self.config.links, [self.name]),
        )
        own = {name: block for name, block in data["mechanisms"].items() if name in needed}
        return {**data, "mechanisms": own}

    @cached_property
    def cases(self) -> tuple[list[tuple[KeyPath, Extreme, str]], int]:
        """Return the values that are tried, each with its input and unit, and how many there are."""
        kind = self.config.kinds[self.name]
        of_it = self.discovery.mechanism(kind).inputs, self.data["mechanisms"][self.name], ("mechanisms", self.name)
        inputs = [(path, quantity) for path, quantity in numeric_inputs(*of_it) if path[-1] != "n_points"]
        numbers = [
            (path, each, quantity.unit) for path, quantity in inputs for each in dict.fromkeys(extreme_values(quantity))
        ]
        lists = [(path, each, "1") for path, each in empty_lists(*of_it)]
        some = numbers if len(numbers) <= EXTREMES else random.Random(SEED).sample(numbers, EXTREMES)
        return [*lists, *some], len(lists) + len(numbers)

    def faults(self) -> Iterator[tuple[KeyPath, str]]:
        """Try the values, as many as there is time for; yield what is wrong with what comes of them."""
        folder, press, ends = Path(self.config.tree.file).parent, WarmPress(), time.process_time() + BUDGET
        for path, value, unit in self.cases[0]:
            if time.process_time() > ends:
                return
            text = with_value(self.data, path, value, unit)
            found = outcome_of(text, self.discovery, press, lambda name: folder / name)
            if found.fault:
                given = str(value) if isinstance(value, list) else f"{value:g}"
                yield path, Phrase("with {value}: {fault}", value=given, fault=found.fault)
            elif found.is_refused:
                self.refused += 1
            else:
                self.numbers += 1

    @property
    def summary(self) -> str:
        """Return what was tried, and what came of it where nothing is wrong."""
        template = (
            "one input at a time set to an extreme value: {numbers} gave numbers, {refused} were refused with a message"
        )
        message = Phrase(template, numbers=self.numbers, refused=self.refused)
        chosen, all = len(self.cases[0]), self.cases[1]
        return message + Phrase("; they are a sample of {all}", all=all) if chosen < all else message
