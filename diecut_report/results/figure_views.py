"""Figures as plain data: ids replaced by values, drawings built from the calculated machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from math import cos, sin
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from pydantic import ValidationError

from diecut_report.config.plugins import said
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, axis_unit
from diecut_report.machine.numerics.curves import CurveSampler
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.printing.substitution import printed
from diecut_report.machine.steps.run import varied, varied_curves
from diecut_report.mechanism.figures import (
    BarGroup,
    Bars,
    Chart,
    Drawing,
    Figure,
    Mark,
    Panel,
    Plot,
    Polar,
    Range,
    Shape,
    View,
    circle,
    level,
    mark,
    point,
    polyline,
)
from diecut_report.mechanism.steps import Reduction, place_name
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import unit
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.record import Record
from diecut_report.text.phrases import MessageError, Phrase, phrase

# What figures and exports may name, and what a fault in one of them costs: that one alone.


Data = dict[str, Any]
R = TypeVar("R", bound=Record)


class Undrawable(MessageError):
    """A figure or export that asks for what is not there; the text says what."""


def guarded(make: Callable[[], R], lost: Callable[[str], R], place: str) -> R:
    """Return what ``make`` makes, or what ``lost`` makes of the words for what went wrong, and where in the plugin."""
    place = Path(place).name
    try:
        return make()
    except Undrawable as unfit:
        return lost(f"{unfit} ({place})")
    except ValidationError as cause:  # what cannot stand in a results file
        fault = cause.errors(include_url=False)[0]
        template = "{where}: {fault}; a figure holds finite numbers, texts and lists of these, and None for an absent number in a line"
        message = Phrase(template, where=".".join(map(str, fault["loc"])), fault=fault["msg"])
        return lost(f"{message} ({place})")
    except Exception as cause:
        return lost(Phrase("{said}, asked for at {place}", said=said(cause), place=place))


def curve_named(calc: Calculation, name: str, abscissa: str | None = None) -> str:
    """Return a curve's abscissa; refused where the results have no such curve, or not over this abscissa."""
    known = {each: each for each in calc.domains} | {n: calc.axis[n] for n, step in calc.curves.items() if step.output}
    for spectrum in calc.mechanism.spectra:
        known |= {spectrum.id: spectrum.id} | {line.id: spectrum.id for line in spectrum.lines()}
    found = known.get(name)
    if found is None:
        is_number = name in calc.values or name in calc.inputs
        what = phrase("a number or a text, not a curve") if is_number else phrase("not a quantity of this machine")
        what = phrase("a curve that is not an output") if name in calc.curves else what
        raise Undrawable("{name} is {what}; it takes a curve that the results hold", name=repr(name), what=what)
    if abscissa is not None and found != abscissa:
        template = "{name} runs over {found}, not over {abscissa}; both must have one abscissa"
        raise Undrawable(template, name=repr(name), found=repr(found), abscissa=repr(abscissa))
    return found


# What moves in a drawing: each shape once, with the numbers that it has at each place of the abscissa.


FRAMES = 72  # places of a turn, beside the ends of its pieces; a screen draws straight on between them
BEFORE = 1e-9  # of the abscissa: so far before the end of a piece its curves are still those of the piece
MOVABLE = ("polyline", "circle", "point")
STANDING = ("label",)  # what may stand beside them


def frame_places(domain: Domain) -> tuple[float, ...]:
    """Return the places at which a drawing is made: evenly over the abscissa, and on both sides of where its curves jump or have a corner."""
    period, joints = float(domain.period[0, 0]), domain.joints[0]
    found = np.concatenate([np.linspace(0.0, period, FRAMES + 1), joints, joints[1:-1] - BEFORE * period])
    return tuple(float(place) for place in np.unique(found))


def moving_shapes(title: str, frames: Sequence[Sequence[Shape]]) -> list[Shape]:
    """Return the shapes of all frames once: as it is what stands still, others with their numbers in each frame (``moves``)."""
    forms = [[_form(shape) for shape in frame] for frame in frames]
    if any(form != forms[0] for form in forms) or not all(_is_movable(shape) for shape in frames[0]):
        template = "what moves in {title} must be the same {movable} at each place"
        raise Undrawable(template, title=repr(title), movable=f"{', '.join(MOVABLE)}, rigid")
    return [_moved(shapes) for shapes in zip(*frames, strict=True)]


def laid_out(shapes: Sequence[Shape]) -> list[Shape]:
    """Return shapes with what is rigid where it stands: plain shapes alone."""
    return [own for shape in shapes for own in (_placed(shape) if shape.get("shape") == "rigid" else [shape])]


def _form(shape: Shape) -> tuple[Any, ...]:
    """What must not change from place to place."""
    if shape["shape"] == "rigid":
        return "rigid", shape["shapes"]
    if shape["shape"] in STANDING:
        return shape["shape"], shape["text"], shape["anchor"], *shape["at"]
    return shape["shape"], shape.get("role"), shape.get("closed"), len(shape.get("points", ()))


def _is_movable(shape: Shape) -> bool:
    if shape["shape"] == "rigid":
        return all(own["shape"] in MOVABLE for own in shape["shapes"])
    return shape["shape"] in (*MOVABLE, *STANDING)


def _moved(shapes: Sequence[Shape]) -> Shape:
    """A shape with its numbers at each place; an angle goes on where it would begin anew."""
    rows = np.array([_numbers(shape) for shape in shapes])
    if (rows == rows[0]).all():
        return shapes[0]
    if shapes[0]["shape"] == "rigid":
        rows[:, 2] = np.unwrap(rows[:, 2])
    kept = {key: value for key, value in shapes[0].items() if key in ("shape", "role", "closed", "shapes")}
    return kept | {"moves": rows.tolist()}


def _numbers(shape: Shape) -> list[float]:
    match shape["shape"]:
        case "polyline":
            return [number for each in shape["points"] for number in each]
        case "circle":
            return [*shape["center"], shape["radius"]]
        case "rigid":
            return [*shape["at"], shape["turned"]]
    return list(shape["at"])


def _placed(rigid: Shape) -> list[Shape]:
    """What is rigid, turned and shifted."""
    (x, y), c, s = rigid["at"], cos(rigid["turned"]), sin(rigid["turned"])

    def of(at: Sequence[float]) -> tuple[float, float]:
        return x + c * at[0] - s * at[1], y + s * at[0] + c * at[1]

    placed = []
    for shape in rigid["shapes"]:
        match shape["shape"]:
            case "polyline":
                placed.append(polyline([of(each) for each in shape["points"]], shape["role"], closed=shape["closed"]))
            case "circle":
                placed.append(circle(of(shape["center"]), shape["radius"], shape["role"]))
            case "point":
                placed.append(point(of(shape["at"]), shape["role"], shape.get("label", "")))
            case kind:
                template = "{kind} cannot be part of what is rigid; it takes {movable}"
                raise Undrawable(template, kind=repr(kind), movable=", ".join(MOVABLE))
    return placed


# The range of a diagram's axis as it is declared: its ends, and that what is drawn lies between them.


Lines = Sequence[tuple[str, Sequence[float]]]  # how each is called, and its heights
SAME = 1e-12  # of the range: beyond its ends by no more is rounding


def declared(made: Data, limits: Range | None, view: View, lines: Lines) -> Data:
    """Return a panel (or a group, or a polar diagram) with the range that is declared for it, its ends in SI."""
    if limits is None:
        return made
    factor = unit(made["unit"]).factor
    ends = [view[end] if isinstance(end, str) else None if end is None else float(end) * factor for end in limits]
    return checked(made | {"range": ends}, lines)


def checked(panel: Data, lines: Lines) -> Data:
    """Return a panel with its range; Undrawable where that is empty, or where something drawn lies outside of it."""
    low, high = panel["range"]
    name = repr(panel.get("title") or panel["label"])
    ends = ["…" if end is None else told(end, panel["unit"]) for end in (low, high)]
    if low is not None and high is not None and not low < high:
        template = "the range of {name} goes from {low} to {high}, which is none"
        raise Undrawable(template, name=name, low=ends[0], high=ends[1])
    room = SAME * max(abs(end) for end in (low, high, 0.0) if end is not None)
    for label, value in _heights(panel, lines):
        if (low is not None and value < low - room) or (high is not None and value > high + room):
            template = "{label} reaches {value}, outside of the range of {name}, {limits}; widen it"
            raise Undrawable(
                template, label=label, value=told(value, panel["unit"]), name=name, limits=" to ".join(ends)
            )
    return panel


def _heights(panel: Data, lines: Lines) -> Iterator[tuple[str, float]]:
    """What is drawn, with how it is called."""
    for label, values in lines:
        if values:
            yield from ((label, min(values)), (label, max(values)))
    yield from ((mark["label"], mark["y"]) for mark in panel.get("marks", ()))
    yield from ((level["label"], level["value"]) for level in panel.get("levels", ()))


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
            raise Undrawable("there is no number {name} in this machine", name=repr(name))
        self.asked[name] = None
        return float(self.calc[name][0, 0])

    def __contains__(self, name: str) -> bool:
        """Whether there is a number of this id."""
        return name in self.calc.values or name in self.calc.inputs

    def get(self, name: str, default: float) -> float:
        """Return a number by its id, or the default where there is none."""
        return self[name] if name in self else default  # noqa: SIM401

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


def figures(calc: Calculation) -> list[FigureRecord]:
    """Return the figures whose needs are given; one that fails is kept with what went wrong (``error``).

    A chart to which this machine gives no panel is left out.
    """
    found = [_guarded(calc, figure) for figure in shown_figures(calc)]
    return [made for made in found if made.type != "chart" or made.panels]


def shown_figures(calc: Calculation) -> list[Figure]:
    """Return the declarations of the figures whose needs are given; nothing is drawn for it."""
    return [figure for figure in calc.mechanism.figures if calc.given.issuperset(figure.needs)]


def _guarded(calc: Calculation, figure: Figure) -> FigureRecord:
    head: Data = {"id": figure.id, "title": figure.title, "caption": figure.caption}

    def made() -> FigureRecord:
        view = MachineView(calc)
        found = _made(calc, figure, head, view)
        return FigureRecord(**found, shows=_curves(figure)[1:] or list(view.asked))

    return guarded(made, lambda error: FigureRecord(**head, type="failed", error=error), figure.at)


def _made(calc: Calculation, figure: Figure, head: Data, view: MachineView) -> Data:
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
            own = [_of_lines(panel) for panel in _listed(build, view)]
            for over in (panel["over"] for panel in own if "over" in panel):
                curve_named(calc, over, over)
            return head | {"type": "chart", "panels": own}
    raise TypeError(Phrase("{id} is not a known figure", id=figure.id))


def _of_lines(panel: Data) -> Data:
    """A chart's panel in a unit of its size; Undrawable where its lines leave the range that it declares."""
    heights = (height for line in panel["lines"] for height in line["y"] if height is not None)
    panel = panel | {"unit": axis_unit(panel["unit"], heights)}
    if "range" not in panel:
        return panel
    return checked(
        panel, [(each["label"], [y for y in each["y"] if y is not None]) for each in (*panel["lines"], *panel["fills"])]
    )


def _moving(calc: Calculation, drawing: Drawing) -> Data:
    """What moves in a drawing at places of its abscissa; what it asks for is told by the drawing itself."""
    if drawing.moving is None:
        return {}
    if drawing.over not in calc.domains and any(step.id == drawing.over for _, step in calc.mechanism.steps):
        return {}  # this machine is without what it moves over
    curve_named(calc, drawing.over, drawing.over)
    places = frame_places(calc.domains[drawing.over])
    view = MachineView(calc, places)
    moving = drawing.moving
    frames = [_listed(partial(lambda place, view: moving(view, place), place), view) for place in places]
    made = {"over": drawing.over, "places": list(places), "shapes": moving_shapes(drawing.title, frames)}
    return {"moving": made | ({"drives": [vars(each) for each in drawing.drives(view)]} if drawing.drives else {})}


def _listed(build: Callable[[MachineView], Any], view: MachineView) -> Any:
    """What an author's function draws, which must be a list of shapes; a function without a return gives none."""
    drawn = build(view)
    if not isinstance(drawn, list) or not all(isinstance(shape, dict) for shape in drawn):
        name, kind = getattr(build, "__name__", phrase("its function")), type(drawn).__name__
        given = "nothing" if drawn is None else f"a {kind}" if kind != "list" else phrase("other things in its list")
        template = "{name} gives {given}; return a list of what circle, polyline, chart_panel and the like give"
        raise Undrawable(template, name=name, given=given)
    return drawn


def _curves(figure: Figure) -> list[str]:
    """The curves that a figure names."""
    match figure:
        case Plot(panels=panels):
            return [figure.abscissa, *(series.curve for panel in panels for series in panel.series)]
        case Polar(series=several):
            return [figure.abscissa, *(series.curve for series in several)]
    return []


def _panel(panel: Panel, view: MachineView, abscissa: str) -> Data:
    made: Data = {
        "title": panel.title, "unit": panel.unit, "series": [vars(each) for each in panel.series],
        "levels": [level(view[each.value], each.label) for each in panel.levels],
        "marks": [mark(view[each.x], _marked(each, panel, view), each.label) for each in panel.marks],
        "spans": [{"from": view[each.start], "to": view[each.end], "label": each.label} for each in panel.spans],
    }  # fmt: skip
    curves = [(one.label, view.heights(one.curve, abscissa)) for one in panel.series]
    ranged, first = declared(made, panel.range, view, curves), panel.series[0].curve if panel.series else ""
    unit = view.calc.chosen_units.of(first, panel.unit) or axis_unit(panel.unit, (y for _, own in curves for y in own))
    return ranged | {"unit": unit}


def _marked(mark: Mark, panel: Panel, view: MachineView) -> float:
    """The height of a mark with the sign of the curve: the greatest size of a curve says nothing of the side on which it stands."""
    step, height = view.calc.step_or_input(mark.y), view[mark.y]
    if not isinstance(step, Reduction) or step.operation != "abs_max" or mark.x != place_name(step.id):
        return height
    if step.of not in [one.curve for one in panel.series]:
        return height
    calc, place = view.calc, place_name(step.id)
    x, rows = calc[place][:1], np.zeros(1, dtype=int)
    sampler = calc.sampler_of(calc.axis[step.of], x, calc.middle[place][:1], rows)
    return math.copysign(height, float(sampler.over(step.of)[0, 0]))


def _polar(figure: Polar, view: MachineView, head: Data) -> Data:
    made = {
        "type": "polar",
        "abscissa": figure.abscissa,
        "unit": figure.unit,
        "series": [vars(s) for s in figure.series],
    }
    distances = [(one.label, [abs(value) for value in view.curve(one.curve)]) for one in figure.series if figure.range]
    ranged = declared(head | made, figure.range, view, distances)
    if (ranged.get("range", [None])[0] or 0) < 0:
        template = "the range of {title} begins below zero, where no distance from the pole is"
        raise Undrawable(template, title=repr(figure.title))
    return ranged


def _group(group: BarGroup, view: MachineView) -> Data:
    values = [(label, -view[name[1:]] if name[0] == "-" else view[name]) for label, name in group.bars]
    bars = [{"label": label, "value": value} for label, value in values]
    shown = axis_unit(group.unit, (value for _, value in values))
    made = {"label": group.label, "unit": shown, "bars": bars}
    return declared(made, group.range, view, [(label, [value]) for label, value in values])
