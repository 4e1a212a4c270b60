"""``python -m diecut_report`` is the command line."""

import sys

from diecut_report.cli import main

sys.exit(main())
