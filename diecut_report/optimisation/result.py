"""All that an optimisation has to tell, before it is put into words, tables and figures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from diecut_report.optimisation.bounds import InputPlace, places
from diecut_report.optimisation.conflicts import Conflict, conflict
from diecut_report.optimisation.front import FoundFront, TriedMachines, found_front, known
from diecut_report.optimisation.generation import asked_of
from diecut_report.optimisation.progress import SearchProgress, progress
from diecut_report.optimisation.recheck import Recheck, rechecked
from diecut_report.study.analysis.stored_variants import Stored
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.study_run import Where
from diecut_report.study.storage.store import Store


@dataclass(frozen=True)
class OptimisationResult:
    """Hold what was found: ``conflict`` stands in place of a front where no machine is allowed."""

    study: Study
    stored: Stored
    known: TriedMachines
    front: FoundFront
    bounds: Sequence[InputPlace]
    progress: SearchProgress
    rechecks: Sequence[Recheck]
    conflict: Conflict | None

    @property
    def tried(self) -> int:
        """Return how many machines the search proposed."""
        return self.stored.description.rows

    @property
    def calculated(self) -> int:
        """Return how many of them were calculated: those that can exist and break no constraint between inputs."""
        return int((self.known.status != "error").sum())

    @property
    def errors(self) -> int:
        """Return how many of them cannot exist."""
        return int((self.known.status == "error").sum())

    @property
    def dropped(self) -> int:
        """Return how many of them break a constraint between inputs."""
        return self.tried - len(self.known.status)

    @property
    def differing(self) -> list[Recheck]:
        """Return the listed machines that are not by themselves what they were among many."""
        return [each for each in self.rechecks if not each.is_same]

    @property
    def is_all(self) -> bool:
        """Return whether every machine there is was tried."""
        return asked_of(self.study).is_exhaustive


def result(study: Study, store: Store, stored: Stored, where: Where) -> OptimisationResult:
    """Return what the stored machines say, and what the listed ones are by themselves."""
    there = known(stored)
    front = found_front(study, stored, there)
    is_found = bool(len(front.variants))
    return OptimisationResult(
        study, stored, there, front, places(study, front) if is_found else [],
        progress(there, stored.description.rows, stored.description.chunk),
        rechecked(store, stored, front.numbers(), where) if is_found else [],
        None if is_found else conflict(study, stored, there),
    )  # fmt: skip
