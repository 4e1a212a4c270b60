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
from diecut_report.errors import UserError, refusal
from diecut_report.study.execution.engines import (
    CHUNKS_AHEAD,
    Chunk,
    Engine,
    Function,
    WorkerSetup,
    forget,
    prepare,
    work,
)
from diecut_report.text.phrases import phrase

TIMEOUT = 10  # seconds to reach the scheduler and to find a worker


class Dask(Engine):
    """Calculate on the workers of a scheduler, those that join later too; Dask repeats the chunks of a worker that is lost."""

    gave_up = (KilledWorker,)

    def __init__(self, address: str, setup: WorkerSetup) -> None:
        super().__init__(setup)
        self._address = address if "://" in address else f"tcp://{address}"
        self._client: Any = None  # Dask's client has no types
        self._executor: Any = None

    def __enter__(self) -> Self:
        for name in ("distributed", "distributed.client"):  # losses are reported as errors, not by tracebacks
            logging.getLogger(name).setLevel(logging.CRITICAL)
        self._client = _connected(self._address)
        try:
            self._prepare_workers()
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
                    self._client.unregister_worker_plugin(self.setup.key)
        finally:
            self._client.close()

    def _prepare_workers(self) -> None:
        try:
            self._client.wait_for_workers(1, timeout=TIMEOUT)
        except TimeoutError as error:
            template = "The Dask scheduler has no workers. Start some: PYTHONSAFEPATH=1 dask worker {address}"
            raise refusal(template, address=self._address) from error
        try:
            self._client.register_plugin(_Study(self.setup), name=self.setup.key)
        except ModuleNotFoundError as error:
            template = "A worker of the Dask cluster has no module {name}: install the program there too."
            raise refusal(template, name=error.name) from error

    @property
    def limit(self) -> int:
        """Return how many chunks keep the workers busy that are there now."""
        try:
            return CHUNKS_AHEAD * max(1, int(sum(self._client.nthreads().values())))
        except OSError as error:
            raise self._gone() from error

    def submit(self, function: Function, chunk: Chunk) -> Future[Any]:
        future: Future[Any] = self._executor.submit(_work, __version__, self.setup.key, function, chunk)
        return future

    def cancel(self, begun: Iterable[Future[Any]]) -> None:
        for future in begun:
            future.cancel()

    def check(self) -> None:
        if self._client.status != "running":
            raise self._gone()

    def _gone(self) -> UserError:
        template = "The Dask scheduler at {address} cannot be reached any more. {kept}"
        kept = phrase("What was finished is kept: continue with --resume.")
        return refusal(template, address=self._address, kept=kept)


class _Study(WorkerPlugin):
    """Tells a worker what it is to load for this study; it loads before its first chunk."""

    def __init__(self, setup: WorkerSetup) -> None:
        self._setup = setup

    def setup(self, worker: object) -> None:
        """Called on each worker, and on those that join later."""
        prepare(self._setup)

    def teardown(self, worker: object) -> None:
        """Called when the study is done."""
        forget(self._setup.key)


def _work(version: str, key: str, function: Function, chunk: Chunk) -> Any:
    if version != __version__:
        template = "A worker of the Dask cluster has version {theirs} of the program, this is {own}. Install the same."
        raise refusal(template, theirs=__version__, own=version)
    return work(key, function, chunk)


def _connected(address: str) -> Any:
    try:
        host, port = get_address_host_port(address, strict=True)
        if address.startswith(("tcp://", "tls://")):
            socket.getaddrinfo(host, port)  # Dask would wait long for a name that nobody knows
        client: Any = Client
        return client(address, timeout=TIMEOUT, set_as_default=False)
    except ValueError as error:
        template = "{address} is not an address of a Dask scheduler ({error}). Give it as tcp://HOST:PORT."
        raise refusal(template, address=repr(address), error=error) from error
    except OSError as error:
        template = (
            "The Dask scheduler at {address} cannot be reached ({error}). Start it with `dask scheduler`, "
            "or correct the address."
        )
        raise refusal(template, address=address, error=error) from error
