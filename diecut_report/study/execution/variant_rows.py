"""Rows of a study: variants in, columns of outputs, verdicts and reasons out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.contract.inputs import POINTS
from diecut_report.expressions import Array
from diecut_report.results.press_run import Tell
from diecut_report.results.unchecked import NOT_CHECKED
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution import result_columns
from diecut_report.study.execution.press_batch import CalculatedVariants, Mixed, NotOnArrays, calculated, untold

TOGETHER = 1024  # variants that are calculated at a time: fewer cost more per variant, more take more memory
Given = Mapping[Input, Array | list[str]]
Further = Callable[
    [CalculatedVariants], dict[str, Array]
]  # what is kept beside outputs and checks, by column, shape (variants,)


@dataclass
class Rows:
    """Hold what was calculated of a number of variants: columns by name, and for each variant status, governing check and reason."""

    count: int
    curves: Sequence[str] = ()
    further: Further | None = None
    tell: Tell = untold
    columns: dict[str, Array] = field(default_factory=dict)
    status: Array = field(init=False)
    governing: Array = field(init=False)
    errors: Array = field(init=False)
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)  # plugins that broke for a variant alone, and why

    def __post_init__(self) -> None:
        self.status = np.full(self.count, "pass", dtype=object)
        self.governing = np.full(self.count, None, dtype=object)
        self.errors = np.full(self.count, None, dtype=object)


def calculate_rows(
    base: Config,
    given: Given,
    count: int,
    curves: Sequence[str] = (),
    further: Further | None = None,
    tell: Tell = untold,
) -> Rows:
    """Calculate all outputs and checks of the base, and these curves, with other values: arrays of shape (count,), SI, or texts.

    ``further`` gives more columns of variants that are calculated; ``tell`` is as in ``calculated``.

    A variant that cannot exist has the status ``error`` and its reason. Variants with unlike texts are calculated in groups;
    a plugin that cannot take arrays makes its variants be calculated one by one, which ``slow`` reports. One that breaks for
    a variant alone leaves it in error, and is in ``broken``.
    """
    rows = Rows(count, curves, further, tell)
    if not count:  # of a chunk that constraints have emptied
        return rows
    for alike, texts in _groups(given, count):
        for chosen in np.array_split(alike, -(-len(alike) // TOGETHER)):
            numbers = {asked: np.asarray(values)[chosen] for asked, values in given.items() if asked not in texts}
            _group(base, numbers, texts, rows, chosen)
    return rows


def _groups(given: Given, count: int) -> Iterator[tuple[Array, dict[Input, Any]]]:
    """The variants that have the same texts, and as many points of their curves, by index."""
    texts = {asked: np.asarray(values, dtype=object) for asked, values in given.items() if _is_common(asked)}
    if not texts:
        yield np.arange(count), {}
        return
    keys = list(zip(*texts.values(), strict=True))
    for key in dict.fromkeys(keys):
        yield np.flatnonzero([other == key for other in keys]), dict(zip(texts, key, strict=True))


def _is_common(asked: Input) -> bool:
    return asked.unit is None or asked.meta is POINTS


def _group(base: Config, numbers: Mapping[Input, Array], texts: Mapping[Input, Any], rows: Rows, chosen: Array) -> None:
    try:
        variants = calculated(base, {**numbers, **texts}, len(chosen), rows.tell)
        _kept(variants, rows, chosen)
        variants.release()
    except Mixed as mixed:
        for alike in (mixed.rows, ~mixed.rows):
            _group(base, {asked: values[alike] for asked, values in numbers.items()}, texts, rows, chosen[alike])
    except NotOnArrays as cause:
        if len(chosen) == 1:
            rows.errors[chosen] = str(cause)
            rows.status[chosen] = "error"
            rows.broken[cause.kind] = cause.words
            return
        rows.slow[cause.kind] = cause.words
        for index, row in enumerate(chosen):
            _group(base, {asked: values[[index]] for asked, values in numbers.items()}, texts, rows, np.array([row]))


def _kept(variants: CalculatedVariants, rows: Rows, chosen: Array) -> None:
    """Put what was calculated of some variants into their rows."""
    found = result_columns.verdicts(variants.calculations, variants.count)
    variants.reasons = {**found.faults, **variants.reasons}
    bad = np.array(sorted(variants.reasons), dtype=int)
    found.codes[:, bad], found.ratios[:, bad] = 0, np.nan
    further = rows.further(variants) if rows.further else {}
    for name, values in {**_all_columns(variants, found), **further}.items():
        column = rows.columns.setdefault(name, _empty(rows.count, values.dtype))
        values = values.copy()
        values[bad] = None if values.dtype == object else np.nan
        column[chosen] = values
    worst = np.maximum(found.codes.max(axis=0, initial=0), result_columns.PASS)
    worst[bad] = result_columns.ERROR
    for name, lists in result_columns.curve_values(variants.calculations, rows.curves).items():
        column = rows.columns.setdefault(name, _empty(rows.count, np.dtype(object)))
        for row, values in zip(chosen, lists, strict=True):
            column[row] = values
        column[chosen[bad]] = None
    rows.status[chosen] = result_columns.STATUS[worst]
    rows.governing[chosen] = result_columns.governing(found)
    rows.errors[chosen[bad]] = [variants.reasons[int(row)] for row in bad]


def _all_columns(variants: CalculatedVariants, found: result_columns.Verdicts) -> dict[str, Array]:
    outputs: dict[str, Array] = {}
    for name, calc in variants.calculations.items():
        for column, values in result_columns.output_values(name, calc).items():
            plain = values.astype(object) if values.dtype in (bool, object) else values.astype(float)
            outputs[column] = np.broadcast_to(plain, (variants.count,))
    for name, codes, ratios in zip(found.names, found.codes, found.ratios, strict=True):
        outputs |= {f"{name}.utilisation": ratios, f"{name}.status": result_columns.STATUS[codes]}
    for name in found.unchecked:
        statuses = np.full(variants.count, NOT_CHECKED, dtype=object)
        outputs |= {f"{name}.utilisation": np.full(variants.count, np.nan), f"{name}.status": statuses}
    return outputs


def _empty(count: int, kind: np.dtype[np.generic]) -> Array:
    return np.full(count, None, dtype=object) if kind.kind == "O" else np.full(count, np.nan)
