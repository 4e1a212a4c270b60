"""``python -m diecut_report`` is the command line."""

from diecut_report.cli.main import run

run()
