"""The calls that declare what plain code makes: curves, and what several steps ask."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Unpack

from diecut_report.contract.options import Options, StepCondition
from diecut_report.contract.phases import StepHolder
from diecut_report.contract.steps import MadeCurve, Prepared
from diecut_report.languages.phrases import Phrase


class MadeCurveForm:
    """Give chapters the calls that declare what plain code makes."""

    def made_curve(
        self: StepHolder, id: str, symbol: str, unit: str, description: str, function: Callable[..., Any], takes: tuple[str, ...],
        abscissa: str, method: str, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a curve that plain code makes: see ``MadeCurve``."""
        own: dict[str, Any] = {"function": function, "takes": takes, "abscissa": abscissa, "method": method, **options}
        self.add(MadeCurve(id=id, symbol=symbol, unit=unit, description=description, **own))

    def prepared(
        self: StepHolder, id: str, function: Callable[..., Any], holds: tuple[str, ...], *, for_many: bool = False,
        again: bool = False, **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare what plain code makes of inputs once, for steps that take it by its id: see ``Prepared``; ValueError for ``again`` alone."""
        if again and not for_many:
            raise ValueError(
                Phrase(
                    "{id} is prepared again=True, which calculates all machines at once: write it for many, with "
                    "for_many=True",
                    id=id,
                )
            )
        self.add(Prepared(id=id, function=function, holds=holds, for_many=for_many, again=again, **when))
