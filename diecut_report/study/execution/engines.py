"""Where chunks are calculated: in this process, in a pool of processes, or on a Dask cluster; `results` submits, awaits and retries them.

The same function on the same chunks gives the same results on each engine.
"""

from __future__ import annotations

import ctypes
import os
import signal
import threading
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import connection, parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Self

from threadpoolctl import threadpool_limits

from diecut_report.errors import PluginError, UserError, refusal

Chunk = Any
Function = Callable[[Any, Chunk], Any]  # (what the worker has loaded, chunk) -> result
MAX_TRIES = 3  # how often a chunk may lose its process
POLL_INTERVAL = 1.0  # seconds between looks whether the engine is still there
CHUNKS_AHEAD = 2  # chunks for each process: one that it works on, one that waits


@dataclass(frozen=True)
class WorkerSetup:
    """Hold what each worker loads once before its first chunk: ``load(*args)``; ``key`` (a sha256) tells it from others.

    It is pickled: functions of modules, arguments of plain data. Each thread of a worker loads its own, so that
    work arrays in it are used by one chunk at a time.
    """

    key: str
    load: Callable[..., Any]
    args: tuple[Any, ...] = ()


class Engine(ABC):
    """Calculate chunks; to be entered before the first and left after the last.

    ``lost``: what a chunk raises when its process has ended, and the chunk is to be repeated; ``gave_up``: what it raises when the
    engine itself has repeated it and lost its process too often.
    """

    lost: tuple[type[BaseException], ...] = ()
    gave_up: tuple[type[BaseException], ...] = ()

    def __init__(self, setup: WorkerSetup) -> None:
        self.setup = setup

    @property
    def limit(self) -> int:
        """Return how many chunks keep it busy."""
        return 1

    def __enter__(self) -> Self:
        return self

    @abstractmethod
    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None: ...

    @abstractmethod
    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        """Begin a chunk."""

    def restart(self) -> None:
        """Begin again after a process was lost; chunks begun before are gone."""
        return

    def cancel(self, begun: Iterable[Future[Any]]) -> None:
        """Drop the chunks that were begun."""
        return

    def check(self) -> None:
        """Raise UserError where the engine is gone."""
        return


def results(engine: Engine, function: Function, chunks: Iterable[Chunk]) -> Iterator[tuple[Chunk, Any]]:
    """Yield the chunks with their results, in the order in which they are ready; to be used within ``with engine:``.

    No more chunks are pending than keep the engine busy, so memory stays flat however many there are.
    Ends with what a chunk raises, with a note of which it was, and with UserError where its process was lost three times. Pending
    chunks are cancelled when it ends early, by an exception, Ctrl-C or the caller.
    """
    pending = _PendingChunks(engine, function, iter(chunks))
    try:
        while pending.fill():
            yield from pending.completed()
    finally:
        if pending.waiting:
            engine.cancel(pending.waiting)


@dataclass
class _PendingChunks:
    """The chunks that are being calculated, and those that lost their process and wait for another try."""

    engine: Engine
    function: Function
    source: Iterator[Chunk]
    waiting: dict[Future[Any], tuple[Chunk, int]] = field(default_factory=dict)  # with the processes lost so far
    retries: deque[tuple[Chunk, int]] = field(default_factory=deque)

    def fill(self) -> bool:
        """Begin as many chunks as may be pending; return whether there are any.

        A chunk that lost its process twice runs alone: if it is lost again, it and no other is the cause.
        """
        while len(self.waiting) < self.engine.limit:
            alone = [lost for _, lost in (*self.waiting.values(), *tuple(self.retries)[:1]) if lost == MAX_TRIES - 1]
            if alone and self.waiting:
                break
            following = self.retries.popleft() if self.retries else next(((chunk, 0) for chunk in self.source), None)
            if following is None:
                break
            try:
                self.waiting[self.engine.submit(self.function, following[0])] = following
            except self.engine.lost:  # the pool broke since the last look, which this chunk had no part in
                self.retries.append(following)
                self._restart()
        return bool(self.waiting)

    def completed(self) -> Iterator[tuple[Chunk, Any]]:
        """Wait for chunks that are ready and give them; after a lost process, begin again."""
        done, _ = wait(self.waiting, POLL_INTERVAL, FIRST_COMPLETED)
        self.engine.check()
        lost = {each for each in done if not each.cancelled() and isinstance(each.exception(), self.engine.lost)}
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
            raise _lost_too_often(chunk) from error
        except (Exception, CancelledError) as error:
            error.add_note(f"while calculating {chunk}")
            raise

    def _restart(self) -> None:
        """Begin all pending chunks again; one that has lost too many processes is reported."""
        for chunk, lost in self.waiting.values():
            if lost + 1 >= MAX_TRIES:
                raise _lost_too_often(chunk)
            self.retries.append((chunk, lost + 1))
        self.waiting.clear()
        self.engine.restart()


def _lost_too_often(chunk: Chunk) -> UserError:
    return refusal(
        "The process that calculates {chunk} ended by itself {tries} times or more; most often memory "
        "ran out, or a plugin computed far longer than --chunk-limit allows. What was finished is kept: "
        "continue with --resume, and with fewer --jobs or workers with more memory.",
        chunk=chunk,
        tries=MAX_TRIES,
    )


# what runs in a worker: its setups by key, and for each thread what it has loaded last
_setups: dict[str, WorkerSetup] = {}
_loaded = threading.local()


def prepare(setup: WorkerSetup) -> None:
    """Note in a worker what it is to load before its first chunk."""
    _setups[setup.key] = setup


def forget(key: str) -> None:
    """Free in a worker what it has loaded."""
    _setups.pop(key, None)
    if getattr(_loaded, "key", None) == key:
        _loaded.key, _loaded.value = None, None


def work(key: str, function: Function, chunk: Chunk) -> Any:
    """Calculate a chunk in a worker, with what this thread has loaded for it."""
    if getattr(_loaded, "key", None) != key:
        setup = _setups[key]
        _loaded.key, _loaded.value = None, None  # frees the one before
        _loaded.value = setup.load(*setup.args)
        _loaded.key = key
    return function(_loaded.value, chunk)


class InProcess(Engine):
    """Calculate each chunk in this process, one after the other."""

    def __enter__(self) -> Self:
        prepare(self.setup)
        return self

    def __exit__(self, *_: object) -> None:
        forget(self.setup.key)

    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(work(self.setup.key, function, chunk))
        except Exception as error:
            future.set_exception(error)
        return future


# --- processes of this machine ---------------------------------------------------------------------------------------

SAFE_PATH = "PYTHONSAFEPATH"


def local_engine(jobs: int | None, chunks: int, setup: WorkerSetup) -> Engine:
    """Return so many processes (default: one for each core), or this process where one is enough."""
    count = min(jobs or os.cpu_count() or 1, chunks)
    return Pool(count, setup) if count > 1 else InProcess(setup)


class Pool(Engine):
    """Calculate in ``jobs`` processes, each started anew (spawn), that end with this one; a process that dies is replaced."""

    lost = (BrokenProcessPool,)

    def __init__(self, jobs: int, setup: WorkerSetup) -> None:
        super().__init__(setup)
        self._jobs = jobs
        self._context = _Processes()
        self._executor: ProcessPoolExecutor | None = None

    @property
    def limit(self) -> int:
        return CHUNKS_AHEAD * self._jobs

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Wait for the processes, or end them where the run was ended early."""
        if kind is not None:
            self.restart()
        elif self._executor is not None:
            self._executor.shutdown()

    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        with _interrupt_held_back(), _current_folder_apart():
            if self._executor is None:
                self._executor = ProcessPoolExecutor(self._jobs, self._context, _begin, (self.setup,))
            return self._executor.submit(work, self.setup.key, function, chunk)

    def restart(self) -> None:
        """End all processes; new ones are started for the next chunk."""
        self._kill()
        if self._executor is not None:
            self._executor.shutdown()
        self._context.started.clear()
        self._executor = None

    def cancel(self, begun: Iterable[Future[Any]]) -> None:
        """End the processes: chunks that are cancelled while their processes end would be told of it, and fail."""
        self.restart()

    def check(self) -> None:
        """End all processes where one has died, so that the chunks of all report it."""
        if connection.wait([process.sentinel for process in self._context.started], 0):
            self._kill()

    def _kill(self) -> None:
        """End the processes. One may have died in the middle of a result: its rest would be awaited as long as anybody could write it."""
        for process in self._context.started:
            process.kill()
        if self._executor is not None:
            self._executor._result_queue._writer.close()  # type: ignore[attr-defined]


@contextmanager
def _interrupt_held_back() -> Iterator[None]:
    """Let a Ctrl-C meanwhile count afterwards: a process that has half begun could not be ended."""
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
        """Begin with the signal blocked, which the new process inherits."""
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


def _begin(setup: WorkerSetup) -> None:
    """Prepare a process, which is not to outlive its parent."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    prepare(setup)


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


# What a process that calculates chunks of variants needs of its system: memory that it keeps, and one thread for linear algebra.


TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # parameters of glibc's mallopt, as malloc.h numbers them
MAX_FREE_HEAP = 1 << 30  # bytes that may lie free at the end of the heap
MAX_HEAP_ARRAY = 1 << 25  # bytes of the largest array on the heap; glibc allows no more


def settle() -> None:
    """Make this process ready, before its first chunk.

    Small products gain nothing by threads, and threads of several processes wait for each other. Memory that is freed is kept,
    as taking it anew for each chunk costs a fifth of the time; where the C library has no such setting, nothing changes.
    """
    threadpool_limits(1, "blas")
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):  # another C library than glibc, or a system without one to ask
        return
    mallopt(TRIM_THRESHOLD, MAX_FREE_HEAP)
    mallopt(MMAP_THRESHOLD, MAX_HEAP_ARRAY)


@contextmanager
def one_thread() -> Iterator[None]:
    """Let linear algebra take one thread meanwhile, as in the program's own processes: with more, sums may differ in their last digit."""
    with threadpool_limits(1, "blas"):
        yield
