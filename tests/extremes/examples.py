"""The same within the example configs, where what an input changes goes on by references into other mechanisms and comparisons."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from typing import Any

from diecut_report.config.model import PressBlock
from diecut_report.config.yaml import KeyPath
from diecut_report.mechanism.inputs import Quantity
from diecut_report.testing.extreme_inputs import with_value
from tests.extremes.harness import Extreme, judged, quantities, values
from tests.plugins.cases import CONFIGS, OF_KINDS

_LARGEST_FIRST = sorted(CONFIGS, key=lambda stem: -len(CONFIGS[stem].tree.data["mechanisms"]))
HOMES = [(stem, home) for stem in _LARGEST_FIRST for home in ("press", *CONFIGS[stem].tree.data["mechanisms"])]


def example_extremes(stem: str, home: str) -> Iterator[Extreme]:
    """Every single extreme of an example's press, or of one of its mechanisms, that is accepted.

    What is refused alone is refused here as well, before anything takes it over.
    """
    config = _data(stem)
    body = config["mechanisms"].get(home)
    of_it = (
        quantities(OF_KINDS[body["kind"]].inputs, body, ("mechanisms", home))
        if body
        else quantities(PressBlock, config["press"], ("press",))
    )
    for key, quantity in of_it:
        if key[-1] != "n_points":
            yield from (Extreme((stem,), key, value, quantity.unit) for value in accepted_ends(quantity))


def new_extremes(stem: str, home: str) -> Iterator[Extreme]:
    """Those of them that no example before has, for a mechanism of the same name and kind."""
    before = {
        case
        for earlier in HOMES[: HOMES.index((stem, home))]
        if _like(earlier, (stem, home))
        for case in _keyed(*earlier)
    }
    yield from (case for case in example_extremes(stem, home) if (case.key, case.value) not in before)


def accepted_ends(quantity: Quantity) -> list[float | int]:
    """The least and the greatest of the extremes that a key accepts, on either side of zero, and zero."""
    held = sorted(value for value in {float(each) for each in values(quantity)} if _is_accepted(quantity, value))
    above, below = [value for value in held if value > 0], [value for value in held if value < 0]
    ends = {*above[:1], *above[-1:], *below[:1], *below[-1:], *(value for value in held if value == 0)}
    return sorted(int(value) if quantity.integer else value for value in ends)


def _is_accepted(quantity: Quantity, value: float) -> bool:
    try:
        quantity.validate(value)
    except ValueError:
        return False
    return True


@cache
def _keyed(stem: str, home: str) -> frozenset[tuple[KeyPath, float | int]]:
    return frozenset((case.key, case.value) for case in example_extremes(stem, home))


def _like(one: tuple[str, str], other: tuple[str, str]) -> bool:
    """Whether two homes are of one name and, where they are mechanisms, of one kind."""
    kinds = [CONFIGS[stem].tree.data["mechanisms"].get(home, {}).get("kind") for stem, home in (one, other)]
    return one[1] == other[1] and kinds[0] == kinds[1]


def example_fault(case: Extreme) -> str | None:
    """What is wrong with the press, or None where all is numbers, or it is refused in words."""
    return judged(with_value(_data(*case.home), case.key, case.value, case.unit))


def _data(stem: str) -> dict[str, Any]:
    """An example's plain data, with few samples of its curves."""
    data: dict[str, Any] = json.loads(json.dumps(CONFIGS[stem].tree.data))
    for body in data["mechanisms"].values():
        if "n_points" in OF_KINDS[body["kind"]].inputs.model_fields:
            body["n_points"] = 36
    return data
