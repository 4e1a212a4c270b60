"""Where chunks of a study are calculated: in this process, in a pool of processes, or on a Dask cluster.

One interface, `results`; the same function on the same chunks gives the same results on each engine.
"""

from __future__ import annotations

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import phrase
from diecut_report.study.execution.in_flight import ChunkFailed, Engine, InProcess, Warm, results
from diecut_report.study.execution.process_pool import Pool

__all__ = ["ChunkFailed", "Engine", "InProcess", "Pool", "Warm", "dask_cluster", "results"]


def dask_cluster(address: str, warm: Warm) -> Engine:
    """Return the workers of the Dask scheduler at this address; UserError where Dask is not installed."""
    try:
        from diecut_report.study.execution.dask_cluster import Dask
    except ModuleNotFoundError as error:
        if error.name not in ("dask", "distributed"):
            raise
        words = phrase(
            "Dask is not installed. Install it with: pip install --require-hashes -r requirements-cluster.lock"
        )
        raise UserError(Problem(words)) from error
    return Dask(address, warm)
