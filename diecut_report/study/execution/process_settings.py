"""What a process that calculates chunks of variants needs of its system: memory that it keeps, and one thread for linear algebra."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits

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
