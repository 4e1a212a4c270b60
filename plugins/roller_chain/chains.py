"""The chains of ISO 606, series B, one strand."""

from __future__ import annotations

from diecut_report.api import own_table, standard_table

CHAINS = standard_table("roller_chains")
BY_PITCH = own_table(
    title=f"{CHAINS.title}, by their pitch",
    columns={column.name: column.unit for column in CHAINS.columns},
    rows=tuple(zip(*(column.values for column in CHAINS.columns), strict=True)),
    sources=CHAINS.sources,
    left_out=CHAINS.left_out,
)
