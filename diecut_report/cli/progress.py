"""What is being done, shown on a terminal that wants moving signs once it has taken longer than a second."""

from __future__ import annotations

import os
import sys
from threading import Lock, Timer
from typing import TYPE_CHECKING

from diecut_report.languages.speech import said

if TYPE_CHECKING:
    from rich.status import Status

PATIENCE = 1.0  # seconds until it is shown


def is_styled() -> bool:
    """Return whether standard error is a terminal that wants colours and moving signs (NO_COLOR, TERM=dumb)."""
    return sys.stderr.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


class Progress:
    """Shows on a terminal what is being done, once it has taken longer than a second."""

    def __init__(self, quiet: bool) -> None:
        self.doing, self.status, self.done = "", None, quiet or not is_styled()
        self.lock = Lock()
        self.timer = Timer(PATIENCE, self._show)
        self.timer.daemon = True

    status: Status | None

    def __call__(self, doing: str) -> None:
        self.doing = said(doing)
        if self.status is not None:
            self.status.update(self.doing)

    def __enter__(self) -> Progress:
        if not self.done:
            self.timer.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.timer.cancel()
        with self.lock:
            self.done = True
            if self.status is not None:
                self.status.stop()

    def _show(self) -> None:
        from rich.console import Console

        with self.lock:
            if not self.done:
                self.status = Console(stderr=True).status(self.doing)
                self.status.start()
