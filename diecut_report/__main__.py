"""``python -m diecut_report`` is the command line."""

import sys

if __name__ == "__main__" and not sys.flags.safe_path:
    del sys.path[0]  # the current folder, which -m puts first: what lies beside a config is not imported

from diecut_report.cli.main import run

run()
