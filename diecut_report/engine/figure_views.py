"""Figures as plain data: ids replaced by values, drawings built from the calculated machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

import numpy as np

from diecut_report.contract.figures import BarGroup, Bars, Chart, Drawing, Figure, Mark, Panel, Plot, Polar, plain
from diecut_report.contract.result_names import place_name
from diecut_report.contract.steps import Reduction
from diecut_report.engine import axis_range
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.curve_sampler import CurveSampler
from diecut_report.engine.drawable import Undrawable, curve_named, guarded
from diecut_report.engine.moving_shapes import frame_places, laid_out, moving_shapes
from diecut_report.engine.printing.substitution import printed
from diecut_report.engine.shown_units import axis_unit
from diecut_report.engine.steps.rerun import varied, varied_curves
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase


class MachineView:
    """Give a drawing what it may ask of the calculated machine (the first variant), and keep what was asked for.

    ``places`` are those of the abscissa at which curves will be asked for: they are taken at all of them at once.
    """

    def __init__(self, calc: Calculation, places: tuple[float, ...] = ()) -> None:
        self.calc = calc
        self.asked: dict[str, None] = {}
        self._places = dict.fromkeys(places)
        self._last: CurveSampler | None = None  # the places that were asked for last, mostly by several curves
        self._heights: dict[str, dict[float, float]] = {}
        self._made: dict[Callable[[Any], Any], Any] = {}

    def __getitem__(self, name: str) -> float:
        """A number by its id, SI."""
        if name not in self:
            raise Undrawable(Phrase("there is no number {name} in this machine", name=repr(name)))
        self.asked[name] = None
        return float(self.calc[name][0, 0])

    def __contains__(self, name: str) -> bool:
        """Whether there is a number of this id."""
        return name in self.calc.values or name in self.calc.inputs

    def get(self, name: str, default: float) -> float:
        """Return a number by its id, or the default where there is none."""
        known = name in self
        return self[name] if known else default

    def at(self, curve: str, place: float) -> float:
        """Return a curve's value at a place of its abscissa, SI."""
        self.asked[curve] = None
        known = self._heights.setdefault(curve, {})
        if place not in known:
            places = list(self._places) if place in self._places else [place]
            known |= zip(places, self._sampler(self.calc.axis[curve], places).over(curve)[0].tolist(), strict=True)
        return known[place]

    def _sampler(self, axis: str, places: list[float]) -> CurveSampler:
        if self._last is None or self._last.axis != axis or self._last.x[0].tolist() != places:
            x, rows = np.array([places]), np.zeros(1, dtype=int)
            self._last = self.calc.sampler_of(axis, x, self.calc.domains[axis].middle_of(x, rows), rows)
        return self._last

    def once(self, make: Callable[[Any], Any]) -> Any:
        """Return what a function of the view makes, made once."""
        if make not in self._made:
            self._made[make] = make(self)
        return self._made[make]

    def text(self, name: str) -> str:
        """Return a quantity as it is printed: ``h = 40 mm``."""
        self.asked[name] = None
        return f"{self.calc.step_or_input(name).symbol} = {printed(self.calc, name)}"

    def word(self, name: str) -> str:
        """Return a text by its id: an input, or what a choice gave."""
        return printed(self.calc, name)

    def row(self, name: str) -> list[float]:
        """Return the values of all repeated parts, SI."""
        self.asked[name] = None
        return [float(value) for value in self.calc[name][0]]

    def words(self, name: str) -> list[str]:
        """Return a text input of all repeated parts."""
        return [str(text) for text in self.calc.part_names.get(name) or self.calc.inputs[name]]

    def curve(self, name: str) -> list[float]:
        """Return a curve (or an abscissa) at the samples of the results, SI."""
        self.asked[name] = None
        samples = self.calc.domains[name].samples if name in self.calc.domains else self.calc.curve_samples(name)
        return [float(value) for value in samples[0]]

    def prepared(self, name: str) -> Any:
        """Return what plain code prepared, by its id."""
        return self.calc.inputs[name]

    def heights(self, name: str, abscissa: str) -> list[float]:
        """Return a curve of a plot at the places that are drawn, SI; of a spectrum the values of its line."""
        spectrum = next((each for each in self.calc.mechanism.spectra if each.id == abscissa), None)
        if spectrum is None:
            return self.curve(name)
        return next([float(v) for v in line.values] for line in spectrum.lines() if line.id == name)

    def varied(self, inputs: Mapping[str, Any], *names: str) -> dict[str, Array]:
        """Return numbers of the machine calculated again with other inputs; NaN where it is then impossible."""
        self.asked |= dict.fromkeys(names)
        return varied(self.calc, inputs, names)

    def varied_curves(
        self, inputs: Mapping[str, Any], *names: str, points: int = 361
    ) -> tuple[Array, dict[str, Array]]:
        """Return the abscissa and the values of curves of the machine calculated again with other inputs."""
        self.asked |= dict.fromkeys(names)
        return varied_curves(self.calc, inputs, names, points)


def figures(calc: Calculation) -> list[dict[str, Any]]:
    """Return the figures whose needs are given; one that fails is kept with what went wrong (``error``).

    A chart to which this machine gives no panel is left out.
    """
    found = [_guarded(calc, figure) for figure in shown_figures(calc)]
    return [made for made in found if made["type"] != "chart" or made["panels"]]


def shown_figures(calc: Calculation) -> list[Figure]:
    """Return the declarations of the figures whose needs are given; nothing is drawn for it."""
    return [figure for figure in calc.mechanism.figures if calc.given.issuperset(figure.needs)]


def _guarded(calc: Calculation, figure: Figure) -> dict[str, Any]:
    head = {"id": figure.id, "title": figure.title, "caption": figure.caption}
    return guarded(lambda: _figure(calc, figure, head), head | {"type": "failed"}, figure.at)


def _figure(calc: Calculation, figure: Figure, head: dict[str, Any]) -> dict[str, Any]:
    """Return a figure as data, with the quantities that it shows: of a plot its curves, of others what was asked for."""
    view = MachineView(calc)
    made = _made(calc, figure, head, view)
    return made | {"shows": _curves(figure)[1:] or list(view.asked)}


def _made(calc: Calculation, figure: Figure, head: dict[str, Any], view: MachineView) -> dict[str, Any]:
    for curve in _curves(figure):
        curve_named(calc, curve, figure.abscissa)  # type: ignore[attr-defined]
    match figure:
        case Plot(abscissa=abscissa, panels=panels):
            made = [_panel(panel, view, abscissa) for panel in panels]
            return head | {"type": "plot", "abscissa": abscissa, "panels": made}
        case Polar():
            return _polar(figure, view, head)
        case Bars(groups=groups):
            return head | {"type": "bars", "groups": [_group(g, view) for g in groups]}
        case Drawing(build=build, unit=unit, scaled_by=scale, schematic=schematic):
            relative = schematic or (scale and scale not in calc.given)
            drawn = {"type": "drawing", "unit": "1" if relative else unit, "shapes": laid_out(_listed(build, view))}
            return head | drawn | ({"schematic": True} if schematic else {}) | _moving(calc, figure)
        case Chart(build=build):
            own = [axis_range.of_lines(_of_its_size(panel)) for panel in _listed(build, view)]
            for over in (panel["over"] for panel in own if "over" in panel):
                curve_named(calc, over, over)
            return head | {"type": "chart", "panels": own}
    raise TypeError(Phrase("{id} is not a known figure", id=figure.id))


def _of_its_size(panel: dict[str, Any]) -> dict[str, Any]:
    """A chart's panel in the unit of its size."""
    heights = (height for line in panel["lines"] for height in line["y"] if height is not None)
    return panel | {"unit": axis_unit(panel["unit"], heights)}


def _moving(calc: Calculation, drawing: Drawing) -> dict[str, Any]:
    """What moves in a drawing at places of its abscissa; what it asks for is told by the drawing itself."""
    if drawing.moving is None:
        return {}
    if drawing.over not in calc.domains and any(step.id == drawing.over for _, step in calc.mechanism.steps):
        return {}  # this machine is without what it moves over
    curve_named(calc, drawing.over, drawing.over)
    places = frame_places(calc.domains[drawing.over])
    view = MachineView(calc, places)
    frames = [_listed(partial(_at_place, drawing.moving, place), view) for place in places]
    return {"moving": {"over": drawing.over, "places": list(places), "shapes": moving_shapes(drawing.title, frames)}}


def _at_place(moving: Callable[[MachineView, float], Any], place: float, view: MachineView) -> Any:
    return moving(view, place)


def _listed(build: Callable[[MachineView], Any], view: MachineView) -> Any:
    """What an author's function draws, which must be a list of shapes; a function without a return gives none."""
    drawn = build(view)
    if not isinstance(drawn, list) or not all(isinstance(shape, dict) for shape in drawn):
        name = getattr(build, "__name__", phrase("its function"))
        given = (
            "nothing"
            if drawn is None
            else f"a {type(drawn).__name__}"
            if not isinstance(drawn, list)
            else phrase("other things in its list")
        )
        raise Undrawable(
            Phrase(
                "{name} gives {given}; return a list of what circle, polyline, chart_panel and the like give",
                name=name,
                given=given,
            )
        )
    return drawn


def _curves(figure: Figure) -> list[str]:
    """The curves that a figure names."""
    match figure:
        case Plot(panels=panels):
            return [figure.abscissa, *(series.curve for panel in panels for series in panel.series)]
        case Polar(series=several):
            return [figure.abscissa, *(series.curve for series in several)]
    return []


def _panel(panel: Panel, view: MachineView, abscissa: str) -> dict[str, Any]:
    named: dict[str, tuple[Any, ...]] = {"levels": panel.levels, "marks": panel.marks, "spans": panel.spans}
    made: dict[str, Any] = {"title": panel.title, "unit": panel.unit, "series": [vars(s) for s in panel.series]} | {
        key: [plain(part, view) for part in parts] for key, parts in named.items()
    }
    made["marks"] = [
        _on_curve(mark, shown, panel, view) for mark, shown in zip(panel.marks, made["marks"], strict=True)
    ]
    curves = [(one.label, view.heights(one.curve, abscissa)) for one in panel.series if panel.range]
    heights = (height for one in panel.series for height in view.heights(one.curve, abscissa))
    return _in_chosen_unit(view, axis_range.declared(made, panel.range, view, curves), heights)


def _on_curve(mark: Mark, shown: dict[str, Any], panel: Panel, view: MachineView) -> dict[str, Any]:
    """A mark with the sign of the curve: the greatest size of a curve says nothing of the side on which it stands."""
    step = view.calc.step_or_input(mark.y)
    if not isinstance(step, Reduction) or step.operation != "abs_max" or mark.x != place_name(step.id):
        return shown
    if step.of not in [one.curve for one in panel.series]:
        return shown
    return shown | {"y": math.copysign(shown["y"], _height(step.id, step.of, view))}


def _height(size: str, curve: str, view: MachineView) -> float:
    """The value of a curve where its size is greatest; at a jump on the side that was found there."""
    calc, place = view.calc, place_name(size)
    x, rows = calc[place][:1], np.zeros(1, dtype=int)
    return float(calc.sampler_of(calc.axis[curve], x, calc.middle[place][:1], rows).over(curve)[0, 0])


def _in_chosen_unit(view: MachineView, made: dict[str, Any], heights: Iterable[float]) -> dict[str, Any]:
    """A panel, all of whose values are in SI, in the unit that the report chose for its first curve or its dimension."""
    first = made["series"][0]["curve"] if made["series"] else ""
    return made | {"unit": view.calc.chosen_units.of(first, made["unit"]) or axis_unit(made["unit"], heights)}


def _polar(figure: Polar, view: MachineView, head: dict[str, Any]) -> dict[str, Any]:
    made = {
        "type": "polar",
        "abscissa": figure.abscissa,
        "unit": figure.unit,
        "series": [vars(s) for s in figure.series],
    }
    distances = [
        (one.label, [abs(float(value)) for value in view.curve(one.curve)]) for one in figure.series if figure.range
    ]
    ranged = axis_range.declared(head | made, figure.range, view, distances)
    if (ranged.get("range", [None])[0] or 0) < 0:
        raise Undrawable(
            Phrase(
                "the range of {title} begins below zero, where no distance from the pole is", title=repr(figure.title)
            )
        )
    return ranged


def _group(group: BarGroup, view: MachineView) -> dict[str, Any]:
    values = [(label, -view[name[1:]] if name[0] == "-" else view[name]) for label, name in group.bars]
    bars = [{"label": label, "value": value} for label, value in values]
    shown = axis_unit(group.unit, (value for _, value in values))
    made = {"label": group.label, "unit": shown, "bars": bars}
    return axis_range.declared(made, group.range, view, [(label, [value]) for label, value in values])
