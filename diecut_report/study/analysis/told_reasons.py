"""Why variants cannot be calculated, in the language that is spoken: what is stored of it is English."""

from __future__ import annotations

from dataclasses import replace

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.errors import PluginError, UserError
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.speech import localised, said, spoken_language
from diecut_report.study.analysis.stored_variants import Stored
from diecut_report.study.analysis.variant_config import variant_of


def told_reason(stored: Stored, variant: int, reason: str, discovery: Discovery) -> str:
    """Return the stored reason of a variant in the language that is spoken.

    The variant is judged once more by itself, so that the words know what they were made of. Where that says something else, or
    the base is not kept any more, the reason stands as it is stored.
    """
    if spoken_language() == SOURCE_LANGUAGE or stored.description.base.content is None:
        return reason
    try:
        pipeline.validate(variant_of(stored, variant, discovery, str(variant), in_error=True), discovery)
    except UserError as error:
        for problem in (replace(each, file="", line=None, column=None) for each in error.problems):
            if str(problem) == reason:
                return localised(said(str(problem)))
    except PluginError:  # it is told where it broke
        return reason
    return reason
