"""Studies that are refused before anything is calculated: those without a variant, and those that are huge by mistake."""

from __future__ import annotations

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.conditions.constraints import why_dropped
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.dropped_variants import judged_rows, without_value

LARGEST = 10_000_000  # rows that are calculated without being asked for twice


def refuse_unsampled(study: Study) -> None:
    """Require a sample: a study that says only what is searched for has no variants of its own."""
    if not study.is_sampled:
        words = "is missing: this study says by optimise what is searched for. Run it with `diecut-report optimise`, or give a sample."
        raise UserError(Problem(phrase(words), str(study.file), path="sample"))


def refuse_huge(study: Study, agreed: bool) -> None:
    """Require a yes to a sample that is larger than one would calculate by mistake."""
    count = study.sample.count
    if count > LARGEST and not agreed:
        words = Phrase(
            "the sample has {count} variants, more than {largest}. Vary less, or give --yes to calculate them all.",
            count=format(count, ","),
            largest=format(LARGEST, ","),
        )
        raise UserError(Problem(words, str(study.file), path="sample"))


def refuse_empty(study: Study) -> None:
    """Require that the constraints leave at least one variant."""
    if not study.constraints or any(found.holds.any() for found in judged_rows(study)):
        return
    why = why_dropped({"without_value": without_value(study)})
    words = Phrase(
        "the constraints drop all {count} variants of the sample{why}. Loosen one of them, or vary other values.",
        count=format(study.sample.count, ","),
        why=why,
    )
    raise UserError(Problem(words, str(study.file), path="constraints"))
