"""The schemas of what is not a configuration, by the name that the command ``schema`` knows them by."""

from __future__ import annotations

from typing import Any

OF_FILES = ("study", "results")


def schema_of_file(name: str) -> dict[str, Any]:
    """Return the schema of a study, or of the results file."""
    if name == "study":
        from diecut_report.study.definition.schema import study_schema

        return study_schema()
    from diecut_report.results.form.schema import results_schema

    return results_schema()
