"""Memory that one chunk of variants frees is kept for the next: taking it anew from the system costs a fifth of the time."""

from __future__ import annotations

import ctypes

TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # parameters of glibc's mallopt, as malloc.h numbers them
KEPT = 1 << 30  # bytes that may lie free at the end of the heap
LARGEST = 1 << 25  # bytes of the largest array on the heap; glibc allows no more


def keep_freed_memory() -> None:
    """Let this process keep memory that is freed; where the C library has no such setting, nothing changes."""
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):  # another C library than glibc, or a system without one to ask
        return
    mallopt(TRIM_THRESHOLD, KEPT)
    mallopt(MMAP_THRESHOLD, LARGEST)
