"""Which part files have been verified, remembered by their size and times, so that a second command need not read them all.

The memory is the user's own, outside the folder of results: asking writes nothing there, and a copy of a folder is verified anew.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Mapping
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

from diecut_report.errors import UserError
from diecut_report.files import cache_folder, write

LARGE = 4_000_000  # bytes of parts up to which they are verified at each command: it takes some hundredths of a second
SETTLED = 2_000_000_000  # ns after which a change of a file shows in its times
FOLDERS = 100  # studies that are remembered

Mark = list[int]
MARK = ("st_size", "st_mtime_ns", "st_ctime_ns", "st_ino")


def mark(path: Path) -> Mark:
    """Return what changes with a file's content: its size, its times, and its place on the disk."""
    found = path.stat()
    return [getattr(found, name) for name in MARK]


class Verified:
    """What is known of the parts of one folder: for each the hash of its bytes, its mark, and its counts by status."""

    def __init__(self, directory: Path) -> None:
        self._file = _memory(directory)
        self._known: dict[str, dict[str, Any]] = _read(self._file)
        self._is_new = False

    def counts(self, path: Path, digest: str, seen: Mark) -> dict[str, int] | None:
        """Return the counts of a part that was verified to have this hash and has not changed since, None for another."""
        known = self._known.get(path.name)
        return dict(known["counts"]) if known and (known["sha256"], known["mark"]) == (digest, seen) else None

    def keep(self, path: Path, digest: str, seen: Mark, counts: Mapping[str, int]) -> None:
        """Remember a part as it was when ``seen``; one that has just been written may change again within its times."""
        if time.time_ns() - max(seen[1], seen[2]) > SETTLED:
            self._known[path.name] = {"sha256": digest, "mark": seen, "counts": dict(counts)}
            self._is_new = True

    def write(self) -> None:
        """Keep what is known of a large study for the next command; where that is not possible it is verified again."""
        if self._file is None or not self._is_new or sum(known["mark"][0] for known in self._known.values()) < LARGE:
            return
        with suppress(OSError, UserError):  # costs the next command some time, and nothing else
            self._file.parent.mkdir(parents=True, exist_ok=True)
            write(self._file, json.dumps(self._known).encode())
            for old in sorted(self._file.parent.glob("*.json"), key=lambda path: -path.stat().st_mtime)[FOLDERS:]:
                old.unlink(missing_ok=True)


def _memory(directory: Path) -> Path | None:
    """Return the file of the user's cache for this folder, nothing where the user has no home."""
    folder = cache_folder("verified")
    return folder / f"{sha256(os.fsencode(directory.resolve())).hexdigest()[:32]}.json" if folder else None


def _read(file: Path | None) -> dict[str, dict[str, Any]]:
    """Return what is remembered; a memory that cannot be read, or is none, remembers nothing."""
    try:
        found = json.loads(file.read_text("utf-8")) if file else {}
        return {name: known for name, known in found.items() if _is_known(known)}
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}


def _is_known(known: Any) -> bool:
    if not isinstance(known, dict) or known.keys() != {"sha256", "mark", "counts"}:
        return False
    if not isinstance(known["mark"], list) or not isinstance(known["counts"], dict):
        return False
    return len(known["mark"]) == len(MARK) and all(
        isinstance(n, int) for n in (*known["mark"], *known["counts"].values())
    )
