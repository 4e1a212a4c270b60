"""A figure of the results: diagrams, bars and shapes, from which the report draws it. Numbers are SI."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Discriminator, Field, InstanceOf, PositiveFloat, Tag
from pydantic.json_schema import SkipJsonSchema

from diecut_report.mechanism.figures import Grip
from diecut_report.results.record import DrawnError, DrawnText, LabelText, Record, always, sometimes

Point = Annotated[list[float], Field(min_length=2, max_length=2)]
Numbers = list[float | None]
ENDS = "From where to where its axis is declared to reach, null for an end that follows from what is drawn."


def _by(key: str, there: str, absent: str) -> Discriminator:
    """Tell two kinds of blocks by a key that one of them has."""

    def kind(block: Any) -> str:
        keys = block if isinstance(block, dict) else getattr(type(block), "model_fields", ())
        return there if key in keys else absent

    return Discriminator(kind)


# Diagrams.


class SeriesRecord(Record):
    """A curve of the results in a diagram."""

    curve: str = always("Its id.")
    label: LabelText = always("What it is called there.")


class LineRecord(Record):
    """A line of a chart, or the edge of an area above zero; null breaks it."""

    x: Numbers = always("Its places.")
    y: Numbers = always("Its heights.")
    label: DrawnText = always("What it is called.")


class LevelRecord(Record):
    """A horizontal line."""

    value: float = always("Its height.")
    label: DrawnText = always("What it is called.")


class MarkRecord(Record):
    """A marked point."""

    x: float = always("Its place.")
    y: float = always("Its height.")
    label: DrawnText = always("What it is called.")


class SpanRecord(Record):
    """A marked range of the abscissa."""

    start: float = always("Where it begins.", "from")
    end: float = always("Where it ends.", "to")
    label: LabelText = always("What it is called.")


class VerticalRecord(Record):
    """A vertical line."""

    x: float = always("Its place.")
    label: DrawnText = always("What it is called.")


class AxisRecord(Record):
    """What the lines of a chart run over."""

    title: DrawnText = always("What it is.")
    symbol: str = always("Its symbol.")
    unit: str = always("The unit in which it is shown.")


class PlotPanelRecord(Record):
    """A diagram of curves over the abscissa of a plot."""

    title: LabelText = always("What stands upwards.")
    unit: str = always("The unit in which it is shown.")
    series: list[SeriesRecord] = always("Its curves.")
    levels: list[LevelRecord] = always("Its horizontal lines.")
    marks: list[MarkRecord] = always("Its marked points.")
    spans: list[SpanRecord] = always("Its marked ranges.")
    range: Numbers = sometimes(ENDS, [])

    lines: ClassVar[list[LineRecord]] = []  # these are parts of a chart's diagrams alone
    fills: ClassVar[list[LineRecord]] = []
    verticals: ClassVar[list[VerticalRecord]] = []
    over: ClassVar[str] = ""


class ChartPanelRecord(Record):
    """A diagram of lines of its own."""

    title: DrawnText = always("What stands upwards.")
    unit: str = always("The unit in which it is shown.")
    x: AxisRecord = always("What its lines run over.")
    lines: list[LineRecord] = always("Its lines.")
    fills: list[LineRecord] = always("Its areas.")
    marks: list[MarkRecord] = always("Its marked points.")
    levels: list[LevelRecord] = always("Its horizontal lines.")
    verticals: list[VerticalRecord] = always("Its vertical lines.")
    range: Numbers = sometimes(ENDS, [])
    over: str = sometimes("The abscissa of the machine's curves whose places these are.", "")

    series: ClassVar[list[SeriesRecord]] = []  # a part of a plot's diagrams alone


Panel = Annotated[
    Annotated[PlotPanelRecord, Tag("plot")] | Annotated[ChartPanelRecord, Tag("chart")],
    _by("series", "plot", "chart"),
]


class BarRecord(Record):
    """A bar."""

    label: DrawnText = always("What it shows.")
    value: float = always("Its length; below zero where it is subtracted.")


class BarGroupRecord(Record):
    """Bars of one unit."""

    label: DrawnText = always("What they are.")
    unit: str = always("The unit in which they are shown.")
    bars: list[BarRecord] = always("The bars, from top to bottom.")
    range: Numbers = sometimes(ENDS, [])


# Shapes of drawings. Lengths are metres, angles radians.

ROLE = "What it is, from which its look follows."
DURING = "Between which places of the abscissa it is filled."
During = Annotated[list[float], Field(strict=False, min_length=2, max_length=2)]  # an author may type a tuple


class PolylineRecord(Record):
    """Straight lines from point to point."""

    shape: Literal["polyline"] = always("Its kind.")
    points: list[Point] = always("The points.")
    closed: bool = always("true: the last point is joined to the first.")
    role: str = always(ROLE)
    during: During | None = sometimes(DURING)
    grip: SkipJsonSchema[InstanceOf[Grip] | None] = Field(
        default=None, exclude=True
    )  # for the live page: no file holds it


class RegionRecord(Record):
    """A cut area."""

    shape: Literal["region"] = always("Its kind.")
    outer: list[Point] = always("Its edge.")
    holes: list[list[Point]] = always("The edges of its holes.")
    role: str = always(ROLE)


class CircleRecord(Record):
    """A full circle."""

    shape: Literal["circle"] = always("Its kind.")
    center: Point = always("Its centre.")
    radius: float = always("Its radius.")
    role: str = always(ROLE)
    during: During | None = sometimes(DURING)


class ArcRecord(Record):
    """An arc, counter-clockwise."""

    shape: Literal["arc"] = always("Its kind.")
    center: Point = always("Its centre.")
    radius: float = always("Its radius.")
    start: float = always("The angle at which it begins.")
    end: float = always("The angle at which it ends.")
    role: str = always(ROLE)


class DimensionRecord(Record):
    """A dimension line between two points."""

    shape: Literal["dimension"] = always("Its kind.")
    start: Point = always("The first point.", "from")
    end: Point = always("The second one.", "to")
    offset: float = always("How far it stands to the left of the direction between them.")
    text: DrawnText = always("What is written at it.")


class RadiusDimensionRecord(Record):
    """A radius with its text."""

    shape: Literal["radius_dimension"] = always("Its kind.")
    center: Point = always("Its centre.")
    radius: float = always("The radius.")
    angle: float = always("At which angle it is drawn.")
    text: DrawnText = always("What is written at it.")


class LabelRecord(Record):
    """A text in a drawing."""

    shape: Literal["label"] = always("Its kind.")
    at: Point = always("Its place.")
    text: DrawnText = always("The text.")
    anchor: Literal["left", "center", "right"] = always("Which end of the text stands there.")


class ArrowRecord(Record):
    """A force or a direction."""

    shape: Literal["arrow"] = always("Its kind.")
    start: Point = always("Its tail.", "from")
    end: Point = always("Its tip.", "to")
    role: str = always(ROLE)
    text: DrawnText = sometimes("What is written at it.", "", "label")


class BoxRecord(Record):
    """A box of a schematic."""

    shape: Literal["box"] = always("Its kind.")
    center: Point = always("Its middle.")
    width: float = always("Its width.")
    height: float = always("Its height.")
    role: str = always(ROLE)
    lines: list[DrawnText] = always("The lines of its text.")


class PointRecord(Record):
    """A marked point or a pivot."""

    shape: Literal["point"] = always("Its kind.")
    at: Point = always("Its place.")
    role: str = always(ROLE)
    text: DrawnText = sometimes("What is written at it.", "", "label")


Part = Annotated[PolylineRecord | CircleRecord | PointRecord, Field(discriminator="shape")]


class RigidRecord(Record):
    """Shapes that move as one; here they stand still."""

    shape: Literal["rigid"] = always("Its kind.")
    shapes: list[Part] = always("The shapes, before they are turned and shifted.")
    at: Point = always("By how much they are shifted.")
    turned: float = always("By how much they are turned, counter-clockwise, before that.")


class MovedRecord(Record):
    """A shape that moves."""

    shape: Literal["polyline", "circle", "point", "rigid"] = always("Its kind.")
    shapes: list[Part] = sometimes("Of what moves as one the shapes, before they are turned and shifted.", [])
    closed: bool | None = sometimes("Of a polyline: whether the last point is joined to the first.")
    role: str = sometimes(ROLE, "")
    moves: list[list[float]] = always(
        "At each place its points, its centre and radius, or shift and angle: the numbers of what stands still, in a row."
    )


Shape = Annotated[
    PolylineRecord
    | RegionRecord
    | CircleRecord
    | ArcRecord
    | DimensionRecord
    | RadiusDimensionRecord
    | LabelRecord
    | ArrowRecord
    | BoxRecord
    | PointRecord,
    Field(discriminator="shape"),
]
StandingShape = Annotated[
    PolylineRecord | CircleRecord | PointRecord | LabelRecord | RigidRecord, Field(discriminator="shape")
]
MovingShape = Annotated[
    Annotated[MovedRecord, Tag("moving")] | Annotated[StandingShape, Tag("standing")],
    _by("moves", "moving", "standing"),
]


class DrivenRecord(Record):
    """A mechanism whose drawing moves with another's."""

    mechanism: str = always("Its name.")
    offset: Annotated[float, Field(ge=-1e9, le=1e9)] = always("Where the abscissa of that one is at its zero.")
    period: PositiveFloat = always("How far that abscissa goes in its period.")


class MovingRecord(Record):
    """What moves in a drawing with the cursor of the curves."""

    over: str = always("The abscissa.")
    places: list[float] = always("The places of it at which it is drawn.")
    shapes: list[MovingShape] = always("The shapes, back to front.")
    drives: list[DrivenRecord] = sometimes("The mechanisms whose drawings move with it.", [])


class FigureRecord(Record):
    """A figure, as data; what its type does not have is left out. Values are SI."""

    type: Literal["plot", "chart", "polar", "bars", "drawing", "failed"] = always(
        "`plot`: curves over their abscissa; `chart`: other lines; `polar`: curves about a pole; `bars`: numbers side by side; "
        "`drawing`: of the machine; `failed`: it could not be made."
    )
    id: str = always("Its id.")
    title: LabelText = always("Its title.")
    caption: LabelText = always("What is to be seen in it.")
    shows: list[str] = sometimes("The ids of the quantities that it shows.", [])
    abscissa: str = sometimes("The abscissa of a plot or a polar plot.", "")
    panels: list[Panel] = sometimes("Its diagrams, from top to bottom.", [])
    unit: str = sometimes("The unit of distances and dimensions; `1` where a drawing is not to scale.", "")
    series: list[SeriesRecord] = sometimes("The curves of a polar plot.", [])
    range: Numbers = sometimes("From which distance to which a polar plot reaches.", [])
    groups: list[BarGroupRecord] = sometimes("The groups of bars.", [])
    shapes: list[Shape] = sometimes("What is drawn, back to front.", [])
    schematic: bool = sometimes("true: it is not drawn to scale.", False)
    moving: MovingRecord | None = sometimes("What moves in it.")
    error: DrawnError = sometimes("Why it could not be made.", "")

    @property
    def texts(self) -> list[str]:
        """Return the texts of a drawing, but those in boxes."""
        return [text for shape in self.shapes if (text := getattr(shape, "text", ""))]
