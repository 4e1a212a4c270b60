"""A row of a table by a number: exactly the one that has it, never what lies between two."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import pytest

from diecut_report.api import Block, Chapter, Inputs, Mechanism, Quantity, Text, own_table
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten

RODS = own_table(
    title="Cylinders",
    columns={"bore": "mm", "rod": "mm"},
    rows=((25, 12), (32, 14), (40, 20)),
    sources=("One list", "Another list"),
)
MOTORS = own_table(
    title="Motors",
    columns={"P": "kW", "m": "kg"},
    rows={"a90": (1.5, 14), "a80": (0.75, 9), "a100": (3, 30)},
    sources=("One list", "Another list"),
)


class Column(Block):
    bore: Annotated[float, Quantity("D_i", "mm", "Bore of a column", gt=0)]


class Lift(Inputs):
    needed: Annotated[float, Quantity("D_n", "mm", "Bore that is needed", gt=0)] = 30
    bore_given: Annotated[float | None, Quantity("D_g", "mm", "Bore of another cylinder", gt=0)] = None
    power: Annotated[float, Quantity("P_n", "kW", "Power that is needed", gt=0)] = 1
    columns: Annotated[list[Column], Text("Columns")] = []  # noqa: RUF012


sizes = Chapter("Sizes")
sizes.pick("bore", "D", "mm", "Bore", "above", of="needed", series=RODS.series("bore"))
sizes.lookup("rod", "d", "mm", "Rod", RODS, by="bore", column="rod")
sizes.lookup("own_rod", "d_o", "mm", "Rod of another", RODS, by="bore_given", column="rod", needs=("bore_given",))
sizes.pick("rating", "P", "kW", "Rating", "above", of="power", series=MOTORS.series("P"))
sizes.lookup("mass", "m", "kg", "Mass of the motor", MOTORS, by="rating", sought_in="P", column="m")
several = Chapter("Columns", needs=("columns",), absent="no columns")
several.lookup("rods", "d_i", "mm", "Rods of the columns", RODS, by="columns.bore", column="rod")

MECHANISM = Mechanism(kind="lift", version="1", title="Lift", summary="A lift.", inputs=Lift, chapters=(sizes, several))


def lift(**inputs: Any) -> Calculation:
    return calculate(MECHANISM, flatten(Lift(**inputs)))


def item(calc: Calculation, title: str) -> dict[str, Any]:
    items = [each for section in section_items(calc) for each in section["items"]]
    return next(each for each in items if title in (each.get("description"), each.get("title")))


def test_the_declaration_is_sound() -> None:
    assert faults(MECHANISM) == []
    check_mechanism(MECHANISM)


def test_a_picked_number_takes_its_own_row_and_prints_it() -> None:
    calc = lift(needed="30 mm")
    assert calc["rod"][0, 0] == pytest.approx(0.014, rel=1e-15)
    printed = item(calc, "Rod")
    assert (printed["type"], printed["by"], printed["key"]) == ("lookup", "Bore", "D = 32 mm")
    assert (printed["table"], printed["column"]) == ("Cylinders", "rod")
    assert printed["result"] == {"text": "14", "unit": "mm"} and printed["note"] == "Cylinders: One list; Another list"


def test_a_number_is_sought_in_the_column_that_is_named() -> None:
    calc = lift(power="1 kW")
    assert (calc["rating"][0, 0], calc["mass"][0, 0]) == (1500, 14)


def test_each_of_repeated_parts_has_its_row() -> None:
    calc = lift(columns=[{"bore": "40 mm"}, {"bore": "25 mm"}])
    assert calc["rods"][0] == pytest.approx([0.020, 0.012])
    assert item(calc, "Rods of the columns")["rows"] == [["1", "40", "20"], ["2", "25", "12"]]


@pytest.mark.parametrize(
    ("inputs", "key", "told"),
    [
        ({"bore_given": "33 mm"}, "bore_given", "is D_g = 33 mm, which no row of the table “Cylinders” has for Rod of another (d_o)"),
        ({"columns": [{"bore": "25 mm"}, {"bore": "26 mm"}]}, "columns.1.bore", "is D_i = 26 mm, which no row"),
    ],
)  # fmt: skip
def test_a_number_that_no_row_has_is_refused_at_its_input(inputs: dict[str, Any], key: str, told: str) -> None:
    with pytest.raises(Impossible) as refused:
        lift(**inputs)
    assert refused.value.key == key and refused.value.message.startswith(told)
    assert refused.value.message.endswith("the nearest have 25, 32, 40 mm")


def test_many_machines_have_each_its_row_and_those_without_one_are_marked() -> None:
    given = np.array([0.025, 0.033, 0.040, 0.032])
    calc = calculate(
        MECHANISM, flatten(Lift()) | {"needed": np.array([0.02, 0.03, 0.026, 0.04]), "bore_given": given}, 4
    )
    assert calc["rod"][:, 0] == pytest.approx([0.012, 0.014, 0.014, 0.020])
    assert list(calc.flaws) == [1] and calc.flaws[1][0] == "bore_given"
    assert calc["own_rod"][[0, 2, 3], 0] == pytest.approx([0.012, 0.020, 0.014])
