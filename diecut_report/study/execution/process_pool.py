"""Chunks in processes of this machine."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import connection, parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Self

from diecut_report.study.execution.in_flight import Chunk, Function, Warm, make_known, work

SAFE_PATH = "PYTHONSAFEPATH"
AHEAD = 2  # chunks for each process: one that it works on, one that waits


class Pool:
    """Calculate in ``jobs`` processes, each started anew (spawn), that end with this one; a process that dies is replaced."""

    lost: tuple[type[BaseException], ...] = (BrokenProcessPool,)
    gave_up: tuple[type[BaseException], ...] = ()

    def __init__(self, jobs: int, warm: Warm) -> None:
        self._jobs, self._warm = jobs, warm
        self._context = _Processes()
        self._executor: ProcessPoolExecutor | None = None

    @property
    def limit(self) -> int:
        """Return how many chunks keep it busy."""
        return AHEAD * self._jobs

    @property
    def processes(self) -> list[int]:
        """Return the numbers of the processes that are alive."""
        return [process.pid for process in self._context.started if process.is_alive() and process.pid is not None]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Wait for the processes, or end them where the run was ended early."""
        if kind is not None:
            self._end()
        elif self._executor is not None:
            self._executor.shutdown()

    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        """Begin a chunk in the next process that is free."""
        with _interrupt_held_back(), _current_folder_apart():
            if self._executor is None:
                self._executor = ProcessPoolExecutor(self._jobs, self._context, _begin, (self._warm,))
            return self._executor.submit(work, self._warm.key, function, chunk)

    def restart(self) -> None:
        """Start new processes; chunks of the old ones are gone."""
        self._end()
        self._executor = None

    def give_up(self, begun: Iterable[Future[Any]]) -> None:
        """End the processes: chunks that are cancelled while their processes end would be told of it, and fail."""
        self.restart()

    def look(self) -> None:
        """End all processes where one has died, so that the chunks of all report it."""
        if connection.wait([process.sentinel for process in self._context.started], 0):
            self._kill()

    def _end(self) -> None:
        self._kill()
        if self._executor is not None:
            self._executor.shutdown()
        self._context.started.clear()

    def _kill(self) -> None:
        """A process may have died in the middle of a result: its rest would be awaited as long as anybody could write it."""
        for process in self._context.started:
            process.kill()
        if self._executor is not None:
            self._executor._result_queue._writer.close()  # type: ignore[attr-defined]


@contextmanager
def _interrupt_held_back() -> Iterator[None]:
    """A Ctrl-C meanwhile counts afterwards: a process that has half begun could not be ended."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: held.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if held:
            signal.raise_signal(held[0])


@contextmanager
def _current_folder_apart() -> Iterator[None]:
    """Let processes that begin meanwhile import nothing of the current folder, which Python puts before its own modules."""
    before = os.environ.get(SAFE_PATH)
    os.environ[SAFE_PATH] = "1"
    try:
        yield
    finally:
        del os.environ[SAFE_PATH]
        if before is not None:
            os.environ[SAFE_PATH] = before


class _Process(SpawnProcess):
    """A process that no Ctrl-C reaches, from its beginning on: this one ends it."""

    def start(self) -> None:
        """Begin with the signal blocked, which the new process takes over."""
        before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        try:
            super().start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _Processes(SpawnContext):
    """Starts processes and knows them, so that they can be ended in the middle of a chunk."""

    def __init__(self) -> None:
        super().__init__()
        self.started: list[_Process] = []

    def Process(self, *args: Any, **kwargs: Any) -> _Process:  # type: ignore[override]  # noqa: N802  # the name of the base
        process = _Process(*args, **kwargs)
        self.started.append(process)
        return process


def _begin(warm: Warm) -> None:
    """A process does not outlive its parent."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    make_known(warm)


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
