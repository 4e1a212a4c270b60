"""The command line without the summary of a study: it takes seconds, and has tests of its own. ``python -m`` runs it."""

from __future__ import annotations

from diecut_report.batch import command
from diecut_report.cli import run

if __name__ == "__main__":
    command.summarise = lambda _: None
    run()
