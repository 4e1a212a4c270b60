"""Numbers without a unit in conditions: only beside what is a pure number for the reader too."""

from __future__ import annotations

import pytest

from diecut_report.errors import UserError
from diecut_report.study.analysis.query import condition
from diecut_report.study.analysis.variants import StoredColumn

COLUMNS = {
    column.name: column
    for column in (
        StoredColumn("a.error", "float", "1", "%"),
        StoredColumn("a.ratio", "float"),
        StoredColumn("a.gap", "float", "m", "mm"),
    )
}


def test_a_percentage_wants_its_sign() -> None:
    with pytest.raises(UserError, match=r"a number beside a\.error.*needs %, for example '-?0\.1 %'"):
        condition("a.error < 0.1", COLUMNS)
    assert condition("a.error < '0.1 %'", COLUMNS).parameters == (0.001,)
    assert condition("a.ratio < 0.1", COLUMNS).parameters == (0.1,)


def test_what_is_not_defined_is_neither_more_nor_less() -> None:
    duckdb = pytest.importorskip("duckdb")
    for asked in ("a.ratio / 0 > 1", "a.ratio / 0 < 1", "sqrt(-a.ratio) > 0"):
        found = condition(asked, COLUMNS)
        sql = f'SELECT count(*) FROM (SELECT 2.0::DOUBLE AS "a.ratio") WHERE {found.sql}'
        assert duckdb.execute(sql, found.parameters).fetchone() == (0,)
