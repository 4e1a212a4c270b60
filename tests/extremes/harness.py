"""Puts single extreme values into a machine's inputs and calculates it in this process: numbers, or an error in words, and nothing else."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from diecut_report.config import yaml_tree
from diecut_report.config.loader import load_config
from diecut_report.config.model import Press
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.inputs import Block, Quantity, meta_of, nested
from diecut_report.contract.unit_variants import in_unit
from diecut_report.errors import UserError
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.results.results_file import results_text
from tests.plugins.cases import DISCOVERY, FULL, OF_KINDS

ALONE = {
    kind: machines for kind, machines in FULL.items() if not OF_KINDS[kind].partners
}  # others take curves of a whole press
NOT_A_NUMBER = re.compile(r"(?<![\w.])[-+−]?(?:nan|inf|infinity)(?![\w])", re.IGNORECASE)
BEYOND = (1e-300, 1e-12, 1e12, 1e300)
BESIDE = 1e-6  # how far inside its bounds a value stands, as a share of it
SHEET = {"length": "700 mm", "width": "500 mm", "thickness": "0.6 mm"}


class Extreme(NamedTuple):
    """One input of a kind's machine, or of an example, and the extreme value that it gets, in its display unit."""

    home: tuple[str, ...]
    key: KeyPath
    value: float | int

    @property
    def name(self) -> str:
        """What a failure calls it."""
        return f"{'-'.join(self.home)} {'.'.join(map(str, self.key))} = {self.value!r}"


def extremes(kind: str, *, short: bool = False) -> Iterator[Extreme]:
    """Every single extreme of the machines of a kind (``short``: of one): each numeric input of it, of the press and its sheet."""
    for machine, keys in list(FULL[kind].items())[: 1 if short else None]:
        config = _config(kind, keys)
        for key, quantity in (*quantities(OF_KINDS[kind].inputs, config["mechanisms"]["a"], ("mechanisms", "a")),
                              *(quantities(Press, config["press"], ("press",)) if from_press(kind) else ())):  # fmt: skip
            for value in dict.fromkeys(map(repr, values(quantity))):
                yield Extreme((kind, machine), key, json.loads(value))


def values(quantity: Quantity) -> Iterator[float | int]:
    """The extremes of a quantity: its bounds and just beside them, its plausible sizes and just within them, and far beyond."""
    limits = [limit for limit in (quantity.gt, quantity.ge, quantity.lt, quantity.le) if limit is not None]
    least, most = (end / quantity.parsed_unit.factor for end in quantity.sizes.ends)
    sizes = [least, least * (1 + BESIDE), most * (1 - BESIDE), most]
    if quantity.integer:
        yield from sorted(
            {round(each) for each in (*limits, *sizes, *(limit + step for limit in limits for step in (-1, 1)))}
        )
        return
    beside = [limit + sign * BESIDE * (abs(limit) or 1) for limit in limits for sign in (-1, 1)]
    yield from (*limits, *beside, *sizes, *BEYOND, -0.0)
    yield from (-each for each in (*sizes, *BEYOND))


def quantities(model: type[Block], data: dict[str, Any], prefix: KeyPath) -> Iterator[tuple[KeyPath, Quantity]]:
    """The numeric inputs of a block and of the blocks that are given in it, the first of each list of them."""
    for name in model.model_fields:
        meta, block = meta_of(model, name), nested(model.model_fields[name].annotation)
        given, key = data.get(name), (*prefix, name)
        if block and isinstance(given, list) and given:
            yield from quantities(block[0], given[0], (*key, 0))
        elif block and isinstance(given, dict):
            yield from quantities(block[0], given, key)
        elif isinstance(meta, Quantity):
            yield key, in_unit(meta, list(data))


def _config(kind: str, keys: dict[str, Any]) -> dict[str, Any]:
    machine = json.loads(json.dumps(keys)) | {"kind": kind}
    if "n_points" in OF_KINDS[kind].inputs.model_fields:
        machine["n_points"] = 36
    press = {"name": "P", "productivity": "6000 1/h", "sheet": dict(SHEET)}
    return {"schema_version": 1, "project": {"title": "T"}, "press": press, "mechanisms": {"a": machine}}


def fault(case: Extreme) -> str | None:
    """What is wrong with the machine, or None where it is a machine with numbers, or is refused in words."""
    kind, machine = case.home
    config = _config(kind, FULL[kind][machine])
    home: Any = config
    for part in case.key[:-1]:
        home = home[part]
    home[case.key[-1]] = case.value
    for name in from_press(kind) if case.key[0] == "press" else ():
        config["mechanisms"]["a"].pop(name, None)
    return judged(json.dumps(config))


def from_press(kind: str) -> list[str]:
    """The inputs of a kind that the press stands in for."""
    own = OF_KINDS[kind].inputs
    metas = ((name, meta_of(own, name)) for name in own.model_fields)
    return [name for name, meta in metas if isinstance(meta, Quantity) and meta.press]


def judged(text: str) -> str | None:
    """What is wrong with the outcome of a config's text."""
    try:
        run = compute(load_config(yaml_tree.parse(text, "press.yaml"), DISCOVERY), lambda _: None)
        results = results_text(document(run))
    except UserError as refusal:
        return next((f"in words: {problem}" for problem in refusal.problems if _odd(str(problem.message))), None)
    except Exception as cause:
        return f"{type(cause).__name__}: {cause}"
    broken = [*run.errors.values()]
    if broken:
        return f"broken: {broken[0]}"
    found = NOT_A_NUMBER.search(results)
    return f"{found[0]!r} in {results[max(0, found.start() - 80) : found.end() + 40]}" if found else None


def _odd(words: str) -> bool:
    return bool(NOT_A_NUMBER.search(words)) or not words
