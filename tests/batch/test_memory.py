"""Memory that is freed is kept: arrays of the next chunk take no new pages from the system."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

COUNT = """
import resource, sys
import numpy as np
from diecut_report.batch.memory import keep_freed_memory
if sys.argv[1] == "kept":
    keep_freed_memory()
def chunk():
    return [np.ones(1 << 17) for _ in range(20)]
chunk()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(10):
    chunk()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def faults(how: str) -> int:
    return int(subprocess.run([sys.executable, "-c", COUNT, how], check=True, capture_output=True, text=True).stdout)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc has this setting")
def test_the_next_chunk_takes_no_new_pages() -> None:
    assert faults("kept") < 200 < faults("as it was")
