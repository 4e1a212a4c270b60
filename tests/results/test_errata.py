"""Errata of the sources in a machine's results: those that touch it, and no others."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

from diecut_report.api import Erratum, Source
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from tests.machines import inputs

ERRATA = (
    Erratum("002", "always", ("stress",)),
    Erratum("002", "with a drive", ("driven_stress",)),
    Erratum("002", "in part with a drive", ("driven_stress", "strain")),
    Erratum("002", "a limit of the drive", ("driven_free_length",)),
    Erratum("002", "an input", ("ring_width",)),
    Erratum("002", "the whole paper"),
)
BLOCK = {"kinetic_energy": 30, "shore_hardness": 70, "ring_width": "60 mm", "pad_height": "50 mm"}
LEFT_OUT = {"with a drive", "a limit of the drive"}


def errata(**more: Any) -> dict[str, list[str]]:
    """What the results of a damper with made-up errata tell of each."""
    mechanism = dataclasses.replace(MECHANISM, errata=ERRATA, sources=(Source("002", "A paper."),))
    found = mechanism_results(calculate(mechanism, inputs(mechanism, BLOCK | more)), {}).errata
    return {erratum.text: erratum.touches for erratum in found}


def test_an_erratum_stands_where_the_machine_has_a_quantity_that_it_touches() -> None:
    assert errata(drive={"force": 300}).keys() == {erratum.text for erratum in ERRATA}


def test_an_erratum_whose_quantities_are_all_absent_is_left_out() -> None:
    found = errata()
    assert found.keys() == {erratum.text for erratum in ERRATA} - LEFT_OUT
    assert found["in part with a drive"] == ["Maximum strain"]


@pytest.mark.parametrize("force", [2900, 3100])
def test_a_quantity_that_does_not_apply_is_absent(force: float) -> None:
    """From 3 kN on, half of what two pads of 3000 mm² bear at 1 MPa, no length bears the drive."""
    assert ("a limit of the drive" in errata(drive={"force": force})) is (force < 3000)
