"""The figures of a live machine: curves as numbers that the page draws itself, drawings as SVG; each made when it is looked at."""

from __future__ import annotations

from typing import Any

from diecut_report.engine.figure_views import shown_figures
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.speech import catalogues_spoken, spoken_language
from diecut_report.live.session import LiveMachine
from diecut_report.report.i18n import Catalogue
from diecut_report.report.reader_data import figure_readings
from diecut_report.report.translated import figure_translated

Data = dict[str, Any]


class Pictures:
    """Draw the figures of machines; what was drawn of an unchanged mechanism is kept."""

    def __init__(self) -> None:
        self._drawn: dict[tuple[str, int], tuple[Any, Data]] = {}

    def figure(self, machine: LiveMachine, mechanism: str, index: int) -> Data:
        """Return a figure: ``plot`` with its panels and rows of numbers, or ``svg``; UserError where there is none, or it cannot be drawn."""
        if mechanism not in machine.run.calculations or not 0 <= index < len(machine.run.figure_titles(mechanism)):
            raise UserError(Problem(Phrase("There is no figure {n} of {name}.", n=index, name=repr(mechanism))))
        figure = _shown(machine, mechanism, index)
        known = self._drawn.get((mechanism, index))
        if known is None or known[0] is not figure:
            known = figure, _drawn(*_in_words(machine, mechanism, figure), mechanism, index)
            self._drawn[mechanism, index] = known
        return known[1]


def _shown(machine: LiveMachine, mechanism: str, index: int) -> Data:
    """The figure as data; a chart to which this machine gives no panel is not among them, though its title is told."""
    declared = shown_figures(machine.run.calculations[mechanism])[index]
    found = next((figure for figure in machine.run.figures(mechanism) if figure["id"] == declared.id), None)
    if found is None:
        raise UserError(Problem(Phrase("{title}: there is nothing of this machine to show.", title=declared.title)))
    return found


def _in_words(machine: LiveMachine, mechanism: str, figure: Data) -> tuple[Data, Data]:
    """The figure and the curves of its mechanism, in the language that is spoken."""
    curves, catalogues = machine.run.curves(mechanism), catalogues_spoken()
    if catalogues is None:
        return figure, curves
    return figure_translated(figure, curves, machine.run.calculations[mechanism].mechanism.kind, catalogues)


def _drawn(figure: Data, curves: Data, mechanism: str, index: int) -> Data:
    from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second

    words = Catalogue(spoken_language())
    try:
        if figure["type"] in ("plot", "chart") and (readings := figure_readings(mechanism, figure, curves, words)):
            return {"plot": readings}
        return {"svg": render(figure, curves, words, f"{mechanism}-{index}").text}
    except Exception as cause:  # of any kind: what a plugin gives to be drawn is its own
        raise UserError(
            Problem(Phrase("This figure cannot be drawn: {reason}", reason=f"{type(cause).__name__}: {cause}"))
        ) from cause
