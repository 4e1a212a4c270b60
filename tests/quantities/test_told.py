"""Numbers in advice: rounded so that they are enough, and where only some are allowed one of these."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.quantities.formatting import told

BORES = (25.0, 32.0, 40.0, 50.0)


@pytest.mark.parametrize(
    ("value", "up", "words"),
    [
        (0.0333, True, "40 mm"),
        (0.0333, False, "32 mm"),
        (0.0333, None, "32 mm"),
        (0.032, True, "32 mm"),
        (0.032, False, "32 mm"),
        (np.float64(0.0411), True, "50 mm"),
        (0.0612, True, "61.2 mm"),
        (0.02, False, "20 mm"),
    ],
)
def test_of_listed_numbers_the_next_one_is_told(value: float, up: bool | None, words: str) -> None:
    assert told(value, "mm", up=up, listed=BORES) == words


def test_without_a_list_the_number_is_rounded_outwards() -> None:
    assert (told(0.0333333, "mm", up=True), told(0.0333333, "mm", up=False)) == ("33.34 mm", "33.33 mm")
