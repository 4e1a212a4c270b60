"""A process that is settled: arrays of the next chunk take no new pages from the system, products of matrices one thread."""

from __future__ import annotations

import os
import platform
import subprocess
import sys

import pytest

COUNT = """
import resource, sys
import numpy as np
from diecut_report.study.execution.engines import settle
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
@pytest.mark.nightly
def test_the_next_chunk_takes_no_new_pages() -> None:
    assert faults("settled") < 200 < faults("as it was")


THREADS = """
import numpy as np
from diecut_report.study.execution.engines import settle
from threadpoolctl import threadpool_info
settle()
print({pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"})
"""


def test_linear_algebra_takes_one_thread() -> None:
    around = os.environ | {"OPENBLAS_NUM_THREADS": "2"}
    said = subprocess.run(
        [sys.executable, "-c", THREADS], check=True, capture_output=True, text=True, env=around
    ).stdout
    assert said == "{1}\n"


STARTED = """
import os, sys
from diecut_report.__main__ import run
sys.argv = ["diecut-report", "--version"]
def told(code):
    from threadpoolctl import threadpool_info
    print(code, *(library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"))
os._exit = told
run()
"""


@pytest.mark.parametrize(("given", "expected"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "2"}, "2")])
def test_the_program_takes_one_thread_for_products_unless_the_user_says_otherwise(
    given: dict[str, str], expected: str
) -> None:
    around = {name: value for name, value in os.environ.items() if "_NUM_THREADS" not in name}
    command = [sys.executable, "-c", STARTED]
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=around | given)
    code, *threads = done.stdout.splitlines()[-1].split()
    assert code == "0"
    if os.cpu_count() != 1 and threads:
        assert set(threads) == {expected}
