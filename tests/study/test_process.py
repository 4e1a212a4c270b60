"""A process that is settled: arrays of the next chunk take no new pages from the system, products of matrices one thread."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

COUNT = """
import resource, sys
import numpy as np
from diecut_report.study.execution.process_settings import settle
if sys.argv[1] == "settled":
    settle()
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
    assert faults("settled") < 200 < faults("as it was")


THREADS = """
import numpy as np
from diecut_report.study.execution.process_settings import settle
from threadpoolctl import threadpool_info
settle()
print({pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"})
"""


def test_linear_algebra_takes_one_thread() -> None:
    said = subprocess.run([sys.executable, "-c", THREADS], check=True, capture_output=True, text=True).stdout
    assert said == "{1}\n"
