"""What tests of mechanisms share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from diecut_report.quantities.plausible import Plausible
from diecut_report.results import usual


@pytest.fixture(scope="module", autouse=True)
def sizes_beyond_the_plausible() -> Iterator[None]:
    """Let the equations be tried far beyond what a user may give; what is plausible is tried in tests/extremes, quantities and results."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Plausible, "holds", lambda self, value, *, calculated=False: True)
        patch.setattr(usual, "ranges_of", lambda kind: {})
        yield
