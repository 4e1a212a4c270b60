"""How commands end, as their help tells it."""

from __future__ import annotations

from diecut_report.languages.phrases import phrase

HEAD = "Exit codes"
OF_PROGRAM = phrase(
    "Exit codes: 0 no check fails, 1 a check fails (with --strict also where one warns or is not made), 2 bad input, 3 a plugin broke, "
    "74 what was asked for cannot be written, 130 Ctrl-C, 70 a fault of the program. The help of a command tells what they mean there."
)
OF_CHECKS = phrase(
    "Exit codes: 0 no check fails, 1 a check fails (with --strict also where one warns or is not made), 2 bad input, 3 a plugin broke."
)
OF_FILES = phrase("Exit codes: 0 all are valid, 2 one is not, 3 a plugin broke.")
OF_STUDY = phrase(
    "Exit codes: 0 no check of a variant fails, 1 one fails (with --strict also where one warns or is not made) or no variant can exist, "
    "2 bad input, 3 a plugin broke, 130 stopped: what is finished is kept."
)
OF_PLUGIN = phrase("Exit codes: 0 the rules are kept, 1 one is broken, 2 bad input, 3 the plugin broke.")
DONE = phrase("Exit codes: 0 done, 2 bad input, 3 a plugin broke.")
