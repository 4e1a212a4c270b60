"""Settings of the whole test suite."""

from __future__ import annotations

import os
import signal
import tempfile

from hypothesis import HealthCheck, settings

# No deadline: a first call may compile, import or wait for a busy machine, which says nothing about the code.
# In CI the examples are the same at each run, so that a change is judged by what it changes; elsewhere they are new.
# Many random machines cannot exist and are passed over, and a calculation takes some milliseconds: both are no fault.
settings.register_profile(
    "diecut-report",
    deadline=None,
    derandomize="CI" in os.environ,
    print_blob=True,
    suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow],
)
settings.load_profile("diecut-report")

# Where the suite runs in the background of a shell, Ctrl-C is ignored by all that it starts; some tests send it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# What is remembered of plugins belongs to the user, not to the suite: it has a folder of its own.
os.environ["XDG_CACHE_HOME"] = tempfile.mkdtemp(prefix="diecut-report-tests-")
