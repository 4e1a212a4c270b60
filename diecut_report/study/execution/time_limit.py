"""How long a chunk may take: a plugin that never comes back costs its chunk, not the study."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path

from diecut_report.config.discovery import said
from diecut_report.config.loader import Config
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.time_limits import Overran

FIRST, EACH = 120.0, 5.0  # seconds for a chunk, and for each variant of it, before anything was measured
TIMES = 30.0  # as long as the slowest chunk that was finished, by variant


@dataclass
class ChunkClock:
    """Tell how long the next chunk may take, from those that were finished; ``fixed`` is what the user sets, 0 for no limit."""

    fixed: float | None = None
    slowest: float = 0.0  # seconds for each variant

    def measure(self, variants: int, seconds: float) -> None:
        """Note how long a chunk took."""
        self.slowest = max(self.slowest, seconds / max(variants, 1))

    def limit(self, variants: int) -> float | None:
        """Return the seconds that a chunk of so many variants may take; None for any time."""
        if self.fixed is not None:
            return self.fixed or None
        return FIRST + variants * (TIMES * self.slowest or EACH)


def blamed(overran: Overran, config: Config, seconds: float, variants: int) -> tuple[str, str]:
    """Return the kind in whose plugin a chunk was interrupted, and in words how long it took and where it was."""
    place = said(overran).removeprefix(Overran.__name__).lstrip(": ")
    words = Phrase("it took longer than {seconds} s for {variants} variants, and was ended {place}", seconds=f"{seconds:.3g}",
        variants=variants, place=place) + phrase("; --chunk-limit sets how long it may take")  # fmt: skip
    return _kind(overran, config), words


def _kind(overran: Overran, config: Config) -> str:
    """The kind whose code ran last; that of the last mechanism where no plugin's did."""
    homes = {
        name: Path(each.mechanism.at.rpartition(":")[0])
        for name, each in config.instances.items()
        if each and each.mechanism
    }
    for frame in reversed(traceback.extract_tb(overran.__traceback__)):
        for name, file in homes.items():
            home = file.parent if file.name == "__init__.py" else file
            if Path(frame.filename).is_relative_to(home):
                return config.kinds[name]
    return ", ".join(sorted({config.kinds[name] for name in homes}))
