"""Full reports of some variants of a study."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report import pipeline
from diecut_report.batch.store import Store
from diecut_report.batch.study import Study
from diecut_report.batch.variant import variant_config
from diecut_report.discovery import Discovery
from diecut_report.expressions import Array

FOLDER = "reports"
FORMATS = ("html", "pdf", "json")


def write_reports(study: Study, store: Store, plugins: Sequence[str]) -> list[int]:
    """The full reports that the study asks for, as ``reports/ID.html`` and so on; those that are there already are kept."""
    chosen = [int(variant) for variant in wanted(study, store)]
    folder = store.directory / FOLDER
    for variant in chosen:
        if not all((folder / f"{variant}.{ending}").exists() for ending in FORMATS):
            _write(store.directory, variant, folder, plugins)
    return chosen


def _write(directory: Path, variant: int, folder: Path, plugins: Sequence[str]) -> None:
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / f"{variant}.yaml"
        file.write_text(variant_config(directory, variant), encoding="utf-8")
        discovery = Discovery([Path(plugin) for plugin in plugins])
        pipeline.report(file, discovery, lambda _: None, folder, list(FORMATS), None)


def wanted(study: Study, store: Store) -> Array:
    """The numbers of the variants that get a full report, ascending; those that cannot exist get none."""
    asked = study.reports
    if asked.which == "none":
        return np.array([], dtype=int)
    if asked.which == "ids":
        return np.array(sorted(asked.ids), dtype=int)
    objectives = [(each.output, each.minimise) for each in study.objectives] if asked.which == "best" else []
    columns = _columns(store, ["variant", "status", *(name for name, _ in objectives)])
    status, variant = columns["status"], columns["variant"].astype(int)
    if asked.which == "failed":
        return variant[status == "fail"]
    if asked.which == "all":
        return variant[status != "error"]
    return np.sort(variant[best(columns, objectives, asked.best)])


def best(columns: dict[str, Array], objectives: Sequence[tuple[str, bool]], count: int) -> Array:
    """Rows of the best variants: of those that pass (of all that exist where none does) the least sums of ranks."""
    status = columns["status"]
    sound = np.isin(status, ("pass", "warn"))
    among = np.flatnonzero(sound if sound.any() else status != "error")
    total = np.zeros(len(among))
    for name, minimise in objectives:
        values = columns[name][among].astype(float) * (1 if minimise else -1)
        total += np.argsort(np.argsort(np.nan_to_num(values, nan=np.inf), kind="stable"), kind="stable")
    return among[np.argsort(total, kind="stable")[:count]]


def _columns(store: Store, names: Sequence[str]) -> dict[str, Array]:
    table: Any = store.read(list(dict.fromkeys(names))).to_table()
    return {name: table.column(name).to_numpy(zero_copy_only=False) for name in names}
