"""Chunks on a Dask cluster. Imports Dask, the optional extra ``cluster``."""

from __future__ import annotations

import logging
import socket
from collections.abc import Iterable
from concurrent.futures import Future
from contextlib import suppress
from typing import Any, Self

from distributed import Client, KilledWorker, WorkerPlugin
from distributed.comm.addressing import get_address_host_port

from diecut_report import __version__
from diecut_report.errors import Problem, UserError
from diecut_report.study.execution.pending import Chunk, Function, Warm, forget, make_known, work
from diecut_report.text.phrases import Phrase, phrase

AHEAD = 2  # chunks for each thread of a worker
PATIENCE = 10  # seconds to reach the scheduler and to find a worker
KEPT = phrase("What was finished is kept: continue with --resume.")


class Dask:
    """Calculate on the workers of a scheduler, those that join later too; Dask repeats the chunks of a worker that is lost."""

    lost: tuple[type[BaseException], ...] = ()
    gave_up: tuple[type[BaseException], ...] = (KilledWorker,)

    def __init__(self, address: str, warm: Warm) -> None:
        self._address = address if "://" in address else f"tcp://{address}"
        self._warm = warm
        self._client: Any = None  # Dask's client has no types
        self._executor: Any = None

    def __enter__(self) -> Self:
        logging.getLogger("distributed").setLevel(logging.CRITICAL)  # losses are reported in words, not by tracebacks
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        self._client = _connected(self._address)
        try:
            self._make_ready()
        except BaseException:
            self._client.close()
            raise
        self._executor = self._client.get_executor(pure=False)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        try:
            if self._client.status == "running":
                self._executor.shutdown(wait=kind is None)
                with suppress(OSError):  # a scheduler that has just ended has nothing left to forget
                    self._client.unregister_worker_plugin(self._warm.key)
        finally:
            self._client.close()

    def _make_ready(self) -> None:
        """Each worker, also one that joins later, is told what to load."""
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError as error:
            words = Phrase(
                "The Dask scheduler has no workers. Start some: PYTHONSAFEPATH=1 dask worker {address}",
                address=self._address,
            )
            raise UserError(Problem(words)) from error
        try:
            self._client.register_plugin(_Study(self._warm), name=self._warm.key)
        except ModuleNotFoundError as error:
            words = Phrase(
                "A worker of the Dask cluster has no module {name}: install the program there too.", name=error.name
            )
            raise UserError(Problem(words)) from error

    @property
    def limit(self) -> int:
        """Return how many chunks keep the workers busy that are there now."""
        try:
            return AHEAD * max(1, int(sum(self._client.nthreads().values())))
        except OSError as error:
            raise self._gone() from error

    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        """Send a chunk to the scheduler."""
        future: Future[Any] = self._executor.submit(_work, __version__, self._warm.key, function, chunk)
        return future

    def restart(self) -> None:
        """Do nothing: Dask itself repeats what was lost."""

    def give_up(self, begun: Iterable[Future[Any]]) -> None:
        """Take them from the scheduler."""
        for future in begun:
            future.cancel()

    def look(self) -> None:
        """Raise UserError where the scheduler is gone."""
        if self._client.status != "running":
            raise self._gone()

    def _gone(self) -> UserError:
        return UserError(
            Problem(
                Phrase(
                    "The Dask scheduler at {address} cannot be reached any more. {kept}",
                    address=self._address,
                    kept=KEPT,
                )
            )
        )


class _Study(WorkerPlugin):
    """Tells a worker what it is to load for this study; it loads before its first chunk."""

    def __init__(self, warm: Warm) -> None:
        self._warm = warm

    def setup(self, worker: object) -> None:
        """Called on each worker, and on those that join later."""
        make_known(self._warm)

    def teardown(self, worker: object) -> None:
        """Called when the study is done."""
        forget(self._warm.key)


def _work(version: str, key: str, function: Function, chunk: Chunk) -> Any:
    if version != __version__:
        words = Phrase(
            "A worker of the Dask cluster has version {theirs} of the program, this is {own}. Install the same.",
            theirs=__version__,
            own=version,
        )
        raise UserError(Problem(words))
    return work(key, function, chunk)


def _connected(address: str) -> Any:
    try:
        host, port = get_address_host_port(address, strict=True)
        if address.startswith(("tcp://", "tls://")):
            socket.getaddrinfo(host, port)  # Dask would wait long for a name that nobody knows
        client: Any = Client
        return client(address, timeout=PATIENCE, set_as_default=False)
    except ValueError as error:
        words = Phrase(
            "{address} is not an address of a Dask scheduler ({error}). Give it as tcp://HOST:PORT.",
            address=repr(address),
            error=error,
        )
        raise UserError(Problem(words)) from error
    except OSError as error:
        words = Phrase(
            "The Dask scheduler at {address} cannot be reached ({error}). Start it with `dask scheduler`, "
            "or correct the address.",
            address=address,
            error=error,
        )
        raise UserError(Problem(words)) from error
