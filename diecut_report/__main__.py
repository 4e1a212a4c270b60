"""``python -m diecut_report`` is the command line; so is the installed program ``diecut-report``."""

from __future__ import annotations

import sys

if __name__ == "__main__" and not sys.flags.safe_path:
    del sys.path[0]  # the current folder, which -m puts first: what lies beside a config is not imported

import gc
import os
import signal
from typing import NoReturn

INTERRUPTED = 130  # as shells have it
THREADS = "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"  # read when linear algebra is loaded; what the user sets stays

# Objects made before garbage is looked for: to load the program makes many lasting ones, and to look among them takes a quarter of its time.
COLLECTED = 1_000_000


def run() -> NoReturn:
    """Run the command line. While its modules are loaded Ctrl-C ends it at once: there is nothing yet to be put in order."""
    for name in THREADS:  # small products gain nothing by threads, which only wait for each other
        os.environ.setdefault(name, "1")
    gc.set_threshold(COLLECTED)
    is_usual = (
        signal.getsignal(signal.SIGINT) is signal.default_int_handler
    )  # in the background of a shell it is ignored
    if is_usual:
        signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    from diecut_report.cli import main

    if is_usual:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    main.run()


if __name__ == "__main__":
    run()
