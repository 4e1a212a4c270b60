"""How long a chunk may take: a plugin that never comes back costs its chunk, not the study."""

from __future__ import annotations

import ctypes
import os
import signal
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from diecut_report.config.discovery import said
from diecut_report.config.loader import Config
from diecut_report.languages.phrases import Phrase, phrase

FIRST, EACH = 120.0, 5.0  # seconds for a chunk, and for each variant of it, before anything was measured
TIMES = 30.0  # as long as the slowest chunk that was finished, by variant
AGAIN = 1.0  # seconds after which a plugin that holds the interruption back is interrupted again
HARD = 2.0  # times the limit: a process that was not interrupted until then is ended
STUCK = 75  # with what it ends


class Overran(BaseException):
    """Interrupt a chunk that takes too long, wherever it is; not an Exception, which a plugin may catch."""


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


@contextmanager
def limited(seconds: float | None, *, own_process: bool = False) -> Iterator[None]:
    """Raise Overran in what runs within, once it has taken so long.

    What computes in a library without coming back to Python cannot be interrupted; a process of its own is ended then.
    """
    if seconds is None:
        yield
        return
    hard = threading.Timer(HARD * seconds + AGAIN, os._exit, (STUCK,)) if own_process else None
    if hard is not None:
        hard.daemon = True
        hard.start()
    try:
        with _by_signal(seconds) if threading.current_thread() is threading.main_thread() else _by_thread(seconds):
            yield
    finally:
        if hard is not None:
            hard.cancel()


@contextmanager
def _by_signal(seconds: float) -> Iterator[None]:
    """The main thread is interrupted by the alarm clock, also while it sleeps."""

    def ring(number: int, frame: FrameType | None) -> None:
        raise Overran

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def _by_thread(seconds: float) -> Iterator[None]:
    """Another thread is interrupted between two of its steps; signals reach the main one alone."""
    own, is_done = threading.get_ident(), threading.Event()

    def watch() -> None:
        left = seconds
        while not is_done.wait(left):
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(own), ctypes.py_object(Overran))
            left = AGAIN

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        is_done.set()
        watcher.join()
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(own), None)  # what was asked for at the very end


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
