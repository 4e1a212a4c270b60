"""The command line without the summary of a study: it takes seconds, and has tests of its own. ``python -m`` runs it.

Where ``DELAY`` is set each chunk takes so many seconds more: a run that is ended in its middle needs no large study.
"""

from __future__ import annotations

import os
import time
from typing import Any

from diecut_report.cli.main import run
from diecut_report.study import command
from diecut_report.study.execution import variant_rows, worker


def delayed(*given: Any) -> variant_rows.Rows:
    time.sleep(float(os.environ.get("DELAY", "0")))
    return variant_rows.calculate_rows(*given)


worker.calculate_rows = delayed  # also in the processes of a pool, which import this module again
if __name__ == "__main__":
    command.summarise = lambda *_, **__: None
    run()
