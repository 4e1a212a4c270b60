"""Each number that a source prints or a worked example has: reproduced, or its mistake shown by following the source."""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest

from tests.validation.rows import Row, modules

CASES = {module.__name__.rpartition(".")[2]: module for module in modules()}


def every_row() -> Iterator[Any]:
    """The rows of all modules, each told by its module, place and quantity."""
    for name, module in CASES.items():
        for row in module.ROWS:
            marks = [pytest.mark.wheel] if name == "rows_damper" else []  # one kind there is enough
            yield pytest.param(row, id=f"{name}: {row.place}: {row.quantity}", marks=marks)


@pytest.mark.parametrize("row", list(every_row()))
def test_the_number_is_ours_or_its_mistake_is_known(row: Row) -> None:
    if row.verdict == "agrees":
        assert row.reproduces(row.ours())
        return
    assert not row.reproduces(row.ours())
    assert row.by_source is not None and row.reproduces(row.by_source())
    assert row.why


@pytest.mark.parametrize("module", CASES.values(), ids=CASES)
def test_a_module_has_rows_and_each_worked_example_is_met(module: ModuleType) -> None:
    assert module.ROWS
    assert {row.verdict for row in module.ROWS if "worked example" in row.place} <= {"agrees"}
