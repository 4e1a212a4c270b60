"""A limit of time for what was written by others: plugins, and templates of firms."""

from __future__ import annotations

import ctypes
import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from types import FrameType

from diecut_report.text.phrases import Phrase

MECHANISM_SECONDS = 120.0  # that a mechanism may be loaded, or calculated and printed
AGAIN = 1.0  # seconds after which a plugin that holds the interruption back is interrupted again
HARD = 2.0  # times the limit: a process that was not interrupted until then is ended
STUCK = 75  # with what it ends
SOON = 0.001  # seconds until an alarm that was due meanwhile
_limited = threading.local()  # whether something in this thread waits for the end already


class Overran(BaseException):
    """Interrupt what takes too long, wherever it is; not an Exception, which a plugin may catch."""


class TooLong(Exception):
    """Report code of a plugin that does not come back, as any other exception that it raises."""


class Escaped(Exception):
    """Report what a plugin raises to leave the program (SystemExit, BaseException), which it may not; that is its cause."""


@contextmanager
def contained() -> Iterator[None]:
    """Raise Escaped where what runs within would leave the program, so that whatever a plugin raises comes out as an Exception.

    KeyboardInterrupt is the user's, Overran belongs to who set the limit.
    """
    try:
        yield
    except (Exception, KeyboardInterrupt, Overran):
        raise
    except BaseException as cause:
        raise Escaped from cause


@contextmanager
def in_time() -> Iterator[None]:
    """Raise TooLong with the trace of where it was once what runs within took MECHANISM_SECONDS; who asked for a limit of his own keeps it.

    It is ``contained`` too.
    """
    is_limited = getattr(_limited, "is_so", False)
    try:
        with nullcontext() if is_limited else limited(MECHANISM_SECONDS), contained():
            yield
    except Overran as cause:
        if is_limited:
            raise
        message = Phrase("it did not come back within {seconds} s; let its loops end", seconds=f"{MECHANISM_SECONDS:g}")
        raise TooLong(message).with_traceback(cause.__traceback__) from cause


@contextmanager
def limited(seconds: float | None, *, own_process: bool = False) -> Iterator[None]:
    """Raise Overran in what runs within, once it has taken so long. What runs is called: a loop beside it in the frame of this ``with`` may escape.

    What computes in a library without coming back to Python cannot be interrupted; a process of its own is ended then.
    """
    if seconds is None:
        yield
        return
    before, _limited.is_so = getattr(_limited, "is_so", False), True
    hard = threading.Timer(HARD * seconds + AGAIN, os._exit, (STUCK,)) if own_process else None
    if hard is not None:
        hard.daemon = True
        hard.start()
    try:
        with _by_signal(seconds) if threading.current_thread() is threading.main_thread() else _by_thread(seconds):
            yield
    finally:
        _limited.is_so = before
        if hard is not None:
            hard.cancel()


@contextmanager
def _by_signal(seconds: float) -> Iterator[None]:
    """The main thread is interrupted by the alarm clock, also while it sleeps."""

    rung = []  # at each alarm: a library may have held the interruption for a fault of its own, and gone on without what took long

    def ring(number: int, frame: FrameType | None) -> None:
        rung.append(number)
        raise Overran

    began, before = time.monotonic(), signal.signal(signal.SIGALRM, ring)
    left, every = signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)
    try:
        yield
        if rung:
            raise Overran
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
        if left:  # the alarm of who uses the program as a library
            signal.setitimer(signal.ITIMER_REAL, max(left + began - time.monotonic(), SOON), every)


@contextmanager
def _by_thread(seconds: float) -> Iterator[None]:
    """Another thread is interrupted between two of its steps; signals reach the main one alone."""
    own, is_done, rung = threading.get_ident(), threading.Event(), list[bool]()

    def watch() -> None:
        left = seconds
        while not is_done.wait(left):
            rung.append(True)
            _interrupt(own)
            left = AGAIN

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        while watcher.is_alive():
            with suppress(Overran):
                is_done.set()
                watcher.join()
        if rung:
            _take_interruption(own)


def _interrupt(thread: int) -> None:
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(Overran))


def _take_interruption(own: int) -> None:
    """Take what may have been asked for at the very end.

    One more takes its place and is raised here. To withdraw it instead would leave Python 3.11 with a thread that looks for an
    interruption at each call for ever, and stands still for good as soon as anybody traces it: a debugger, or coverage.
    """
    with suppress(Overran):
        _interrupt(own)
        while True:
            time.sleep(0)
