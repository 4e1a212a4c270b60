"""What is written beside the report: profiles as tables and drawings."""

from __future__ import annotations

from typing import Any

from diecut_report.contract.mechanism import CurveTable, Profile
from diecut_report.engine import Calculation
from diecut_report.engine.drawable import curve_named, guarded

Data = dict[str, Any]


def exports(calc: Calculation) -> list[Data]:
    """Return the profiles that are written beside the report; one that fails is kept with what went wrong (``error``)."""
    return [_export(calc, p) for p in calc.mechanism.exports if calc.given.issuperset(p.needs)]


def _export(calc: Calculation, profile: Profile) -> Data:
    is_table = isinstance(profile, CurveTable)
    said = {"id": profile.id, "title": profile.title, "type": "table" if is_table else "profile"}
    columns = list(profile.columns)

    def made() -> Data:
        if is_table:
            own = [name for name, step in calc.curves.items() if step.output and calc.axis[name] == columns[0]]
            return said | {"abscissa": curve_named(calc, columns[0]), "columns": own}
        abscissa = curve_named(calc, columns[0])
        for name in columns:
            curve_named(calc, name, abscissa)
        return said | {"abscissa": abscissa, "columns": columns}

    return guarded(made, said | {"abscissa": "", "columns": columns}, profile.at)
