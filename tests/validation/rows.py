"""What a validation row is: a number that a source prints, ours, and why they differ; test and documentation read it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Literal

from diecut_report.testing.values import rounds_to

Verdict = Literal["agrees", "mistake", "cannot be reproduced"]


@dataclass(frozen=True)
class Row:
    """A printed number.

    ``printed`` is its text, in ``unit``, as the source prints it (the last digit tells how it was rounded);
    ``ours`` computes it with the program (SI · ``scale``); ``by_source`` follows the source's own, mistaken arithmetic to
    the printed number, where that can be found out; ``why`` tells the reader the reason of a difference.
    """

    place: str
    quantity: str
    printed: str
    unit: str
    ours: Callable[[], float]
    verdict: Verdict = "agrees"
    by_source: Callable[[], float] | None = None
    why: str = ""

    def reproduces(self, value: float) -> bool:
        """Whether a value rounds to the printed number."""
        return rounds_to(value, self.printed)


def modules() -> Iterator[ModuleType]:
    """The modules beside this one whose ``ROWS`` hold rows: those of sources first, then those of kinds, by their names."""
    for pattern in ("source_*.py", "rows_*.py"):
        for file in sorted(Path(__file__).parent.glob(pattern)):
            yield import_module(f"{__package__}.{file.stem}")
