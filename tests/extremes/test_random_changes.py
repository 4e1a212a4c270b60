"""Some given numbers of an example are changed at random: a machine comes out or words why it cannot be, and nothing is left unproved."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from diecut_report.config.loader import Config, load_config
from diecut_report.config.yaml_tree import load
from diecut_report.contract.inputs import SI
from diecut_report.design.design_inputs import DesignInput, given_numbers
from diecut_report.errors import UserError
from diecut_report.results.warm_press import WarmPress
from diecut_report.study.definition.base_inputs import with_values
from tests.configs import DISCOVERY, EXAMPLES

FEW, ALL = 6, 2000  # machines of each example
CHANGED = 3  # numbers of a machine, at most
FACTOR = 2.5  # by which each is changed, at most


def machines(base: Config, count: int, seed: int) -> Iterator[tuple[Config, dict[str, float]]]:
    """The example with some numbers changed, and these by their names."""
    random = np.random.default_rng(seed)
    numbers = [each for each in given_numbers(base) if each.today]
    for _ in range(count):
        chosen = random.choice(len(numbers), min(random.integers(1, CHANGED + 1), len(numbers)), replace=False)
        changed = {numbers[i]: value_of(numbers[i], random) for i in chosen}
        values = {each.asked: SI(value, each.meta.parsed_unit.si, each.name) for each, value in changed.items()}
        yield with_values(base, values)[0], {each.name: value for each, value in changed.items()}


def value_of(number: DesignInput, random: np.random.Generator) -> float:
    assert number.today is not None
    low, high = number.bounds
    value = float(np.clip(number.today * FACTOR ** random.uniform(-1, 1) ** 3, low, high))
    return float(round(value)) if number.is_whole else value


def faults(file: Path, count: int, seed: int) -> tuple[list[str], int]:
    """What breaks or is not proved, with the changes that do it; and how many machines there are."""
    base, press, found, made = load_config(file, DISCOVERY), WarmPress(), [], 0
    for config, changed in machines(base, count, seed):
        try:
            run = press.calculate(config)
        except UserError:
            continue  # it cannot exist, and words say why
        made += 1
        found += [f"{changed}: {error}" for error in run.errors.values()]
    return found, made


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: str(file.stem))
@pytest.mark.parametrize("count", [FEW, pytest.param(ALL, marks=pytest.mark.nightly)])
def test_no_machine_is_left_unproved(file: Path, count: int) -> None:
    found, made = faults(file, count, seed=count)
    assert not found and made > 0


def test_an_extreme_between_the_first_two_points_of_a_piece_is_found() -> None:
    """With this mass a torque is greatest just after a switch, half-way to the next point of its grid."""
    base = load(next(file for file in EXAMPLES if file.stem == "flat_cylinder_press_mended"))
    base.data["mechanisms"]["drive"]["cylinder_mass"] = "130 kg"
    run = WarmPress().calculate(load_config(base, DISCOVERY))
    assert run.errors == {} and run.skipped == {} and run.checks["timing"]
