"""Chunks of a study on their way through an engine: what an engine is, what its workers do, and `results`."""

from __future__ import annotations

import ctypes
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import connection, parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Protocol, Self

from threadpoolctl import threadpool_limits

from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.text.phrases import Phrase

Chunk = Any
Function = Callable[[Any, Chunk], Any]  # (what the worker has loaded, chunk) -> result
TRIES = 3  # how often a chunk may lose its process
PATIENCE = 1.0  # seconds between looks whether the engine is still there


@dataclass(frozen=True)
class Warm:
    """Hold what each worker loads once before its first chunk: ``load(*args)``; ``key`` (a sha256) tells it from others.

    It is pickled: functions of modules, arguments of plain data. Each thread of a worker loads its own, so that
    work arrays in it are used by one chunk at a time.
    """

    key: str
    load: Callable[..., Any]
    args: tuple[Any, ...] = ()


class ChunkFailed(Exception):
    """Report that a chunk could not be calculated: which one, and the exception that came up in it (`cause`)."""

    def __init__(self, chunk: Chunk, cause: BaseException) -> None:
        super().__init__(chunk, cause)
        self.chunk, self.cause = chunk, cause

    def __str__(self) -> str:
        return f"{self.chunk}: {type(self.cause).__name__}: {self.cause}"


class Engine(Protocol):
    """Describe a place to calculate; to be entered before its first chunk and left after its last."""

    @property
    def lost(self) -> tuple[type[BaseException], ...]:
        """Return what a chunk raises when its process has ended, and the chunk is to be repeated."""

    @property
    def gave_up(self) -> tuple[type[BaseException], ...]:
        """Return what a chunk raises when the engine itself has repeated it and lost its process too often."""

    @property
    def limit(self) -> int:
        """Return how many chunks keep it busy."""

    def __enter__(self) -> Self: ...
    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: object) -> None: ...
    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        """Begin a chunk."""

    def restart(self) -> None:
        """Begin again after a process was lost; chunks begun before are gone."""

    def give_up(self, begun: Iterable[Future[Any]]) -> None:
        """Drop the chunks that were begun."""

    def look(self) -> None:
        """Raise UserError in words where the engine is gone."""


def results(
    engine: Engine, function: Function, chunks: Iterable[Chunk], limit: int | None = None
) -> Iterator[tuple[Chunk, Any]]:
    """Yield the chunks with their results, in the order in which they are ready; to be used within ``with engine:``.

    At most ``limit`` chunks are in flight (default: what keeps the engine busy), so memory stays flat however many there are.
    Ends with ChunkFailed where a chunk raises, with UserError where its process was lost three times. In-flight chunks
    are cancelled when it ends early, by an exception, Ctrl-C or the caller.
    """
    in_flight = _InFlightChunks(engine, function, iter(chunks), limit)
    try:
        while in_flight.fill():
            yield from in_flight.landed()
    finally:
        in_flight.cancel()


@dataclass
class _InFlightChunks:
    """The chunks that are being calculated, and those that lost their process and wait for another try."""

    engine: Engine
    function: Function
    source: Iterator[Chunk]
    limit: int | None
    waiting: dict[Future[Any], tuple[Chunk, int]] = field(default_factory=dict)  # with the processes lost so far
    again: deque[tuple[Chunk, int]] = field(default_factory=deque)

    def fill(self) -> bool:
        """Begin as many chunks as may be in flight; whether there are any.

        A chunk that lost its process twice runs alone: if it is lost again, it and no other is the cause.
        """
        while len(self.waiting) < (self.limit or self.engine.limit):
            alone = [lost for _, lost in (*self.waiting.values(), *tuple(self.again)[:1]) if lost == TRIES - 1]
            if (alone and self.waiting) or (following := self._next()) is None:
                break
            self._begin(*following)
        return bool(self.waiting)

    def _next(self) -> tuple[Chunk, int] | None:
        if self.again:
            return self.again.popleft()
        return next(((chunk, 0) for chunk in self.source), None)

    def _begin(self, chunk: Chunk, lost: int) -> None:
        try:
            self.waiting[self.engine.submit(self.function, chunk)] = chunk, lost
        except self.engine.lost:  # the pool broke since the last look, which this chunk had no part in
            self.again.append((chunk, lost))
            self._restart()

    def landed(self) -> Iterator[tuple[Chunk, Any]]:
        """Wait for chunks that are ready and give them; after a lost process, begin again."""
        done, _ = wait(self.waiting, PATIENCE, FIRST_COMPLETED)
        self.engine.look()
        lost = {future for future in done if self._is_lost(future)}
        for future in done - lost:
            chunk, _ = self.waiting.pop(future)
            yield chunk, self._result(future, chunk)
        if lost:
            self._restart()

    def _result(self, future: Future[Any], chunk: Chunk) -> Any:
        try:
            return future.result()
        except (PluginError, UserError):
            raise
        except self.engine.gave_up as error:
            raise _gave_up(chunk) from error
        except (Exception, CancelledError) as error:
            raise ChunkFailed(chunk, error) from error

    def _is_lost(self, future: Future[Any]) -> bool:
        return not future.cancelled() and isinstance(future.exception(), self.engine.lost)

    def _restart(self) -> None:
        """Begin all in-flight chunks again; one that has lost too many processes is reported."""
        for chunk, lost in self.waiting.values():
            if lost + 1 >= TRIES:
                raise _gave_up(chunk)
            self.again.append((chunk, lost + 1))
        self.waiting.clear()
        self.engine.restart()

    def cancel(self) -> None:
        """Give up the in-flight chunks."""
        if self.waiting:
            self.engine.give_up(self.waiting)


def _gave_up(chunk: Chunk) -> UserError:
    words = Phrase(
        "The process that calculates {chunk} ended by itself {tries} times or more; most often memory "
        "ran out, or a plugin computed far longer than --chunk-limit allows. What was finished is kept: "
        "continue with --resume, and with fewer --jobs or workers with more memory.",
        chunk=chunk,
        tries=TRIES,
    )
    return UserError(Problem(words))


# what runs in a worker: what it is to load, by key, and for each thread what it has loaded last
_known: dict[str, Warm] = {}
_loaded = threading.local()


def make_known(warm: Warm) -> None:
    """Tell a worker what to load before its first chunk."""
    _known[warm.key] = warm


def forget(key: str) -> None:
    """Tell a worker that it is done with it."""
    _known.pop(key, None)
    if getattr(_loaded, "key", None) == key:
        _loaded.key, _loaded.value = None, None


def work(key: str, function: Function, chunk: Chunk) -> Any:
    """Calculate a chunk in a worker, with what this thread has loaded for it."""
    if getattr(_loaded, "key", None) != key:
        warm = _known[key]
        _loaded.key, _loaded.value = None, None  # frees the one before
        _loaded.value = warm.load(*warm.args)
        _loaded.key = key
    return function(_loaded.value, chunk)


class InProcess:
    """Calculate each chunk in this process, one after the other."""

    lost: tuple[type[BaseException], ...] = ()
    gave_up: tuple[type[BaseException], ...] = ()
    limit = 1

    def __init__(self, warm: Warm) -> None:
        self._warm = warm

    def __enter__(self) -> Self:
        make_known(self._warm)
        return self

    def __exit__(self, *_: object) -> None:
        forget(self._warm.key)

    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        """Calculate the chunk now."""
        future: Future[Any] = Future()
        try:
            future.set_result(work(self._warm.key, function, chunk))
        except Exception as error:
            future.set_exception(error)
        return future

    def restart(self) -> None:
        """Do nothing: no process can be lost here."""

    def give_up(self, begun: Iterable[Future[Any]]) -> None:
        """Do nothing: each chunk is done already."""

    def look(self) -> None:
        """Do nothing: this process is always there."""


# Chunks in processes of this machine.


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


# What a process that calculates chunks of variants needs of its system: memory that it keeps, and one thread for linear algebra.


TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # parameters of glibc's mallopt, as malloc.h numbers them
KEPT = 1 << 30  # bytes that may lie free at the end of the heap
LARGEST = 1 << 25  # bytes of the largest array on the heap; glibc allows no more


def settle() -> None:
    """Make this process ready, before its first chunk."""
    threadpool_limits(
        1, "blas"
    )  # small products gain nothing by threads, and threads of several processes wait for each other
    keep_freed_memory()


@contextmanager
def one_thread() -> Iterator[None]:
    """Let linear algebra take one thread meanwhile, as in the program's own processes: with more, sums may differ in their last digit."""
    with threadpool_limits(1, "blas"):
        yield


def keep_freed_memory() -> None:
    """Let this process keep memory that is freed, as taking it anew for each chunk costs a fifth of the time.

    Where the C library has no such setting, nothing changes.
    """
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):  # another C library than glibc, or a system without one to ask
        return
    mallopt(TRIM_THRESHOLD, KEPT)
    mallopt(MMAP_THRESHOLD, LARGEST)
