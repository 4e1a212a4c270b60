"""How long a firm's templates may take, and how much memory: what strangers wrote need not end."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.report.house_style import HouseStyle
from diecut_report.time_limit import Overran, limited

SECONDS = 600.0  # for a page to be filled, judged and set; the longest report of the program's own takes a tenth of it
MEMORY = 4 * 2**30  # bytes for a page to be filled, beyond those that the program has


@contextmanager
def bounded(house: HouseStyle | None) -> Iterator[None]:
    """Tell in words that a page of a firm's templates was given up."""
    try:
        with limited(SECONDS if house else None):
            yield
    except Overran:
        words = Phrase(
            "With these templates the report was not made within {seconds} s, and was given up. "
            "Look for a loop without an end, and for a style or a picture that the page engine cannot cope with.",
            seconds=f"{SECONDS:g}",
        )
        raise UserError(Problem(words, house.folder if house else "")) from None


@contextmanager
def bounded_memory() -> Iterator[None]:
    """Let what asks for more than a page needs end in MemoryError, where the system can tell; not in its ending other programs."""
    if sys.platform != "linux":
        yield
        return
    import resource

    before = resource.getrlimit(resource.RLIMIT_AS)
    has = int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    most = min([has + MEMORY, *(each for each in before if each != resource.RLIM_INFINITY)])
    resource.setrlimit(resource.RLIMIT_AS, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)
