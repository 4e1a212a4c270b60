"""Geometry of the plane, as expressions of quantities: points, directions, and where circles and lines meet.

A point is a pair (x, y), or a quantity that is declared as one: ``chapter.pin = polar(m.radius, m.angle), "A", "mm", "Crank pin"`` declares
``pin_x`` and ``pin_y``, and ``m.pin`` stands for both wherever a point is taken. Angles count from x to y.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas.expression import Expression, m, node_of, refuse
from diecut_report.formulas.tree import Node
from diecut_report.text.phrases import Phrase, phrase


class PointPart(NamedTuple):
    """Hold a quantity by which a point is declared: its id behind the point's, its letter, what gives it, its description."""

    name: str
    letter: str
    gives: Any
    message: str
    output: bool = False


class Demand(NamedTuple):
    """Hold what must hold for a point to be there, and what is said of the key where it does not."""

    name: str
    condition: Any
    key: Any
    message: str


Own = Callable[[str], Any]  # gives the quantities by which a point is declared, by their names
Parts = Iterator[PointPart | Demand]


class PlanePoint(NamedTuple):
    """Hold the coordinates of a point."""

    x: Any
    y: Any

    def parts(self, own: Own) -> Parts:
        """Yield both coordinates."""
        yield PointPart("x", "x", self.x, phrase("{point}: x-coordinate"), output=True)
        yield PointPart("y", "y", self.y, phrase("{point}: y-coordinate"), output=True)


class Meeting(NamedTuple):
    """Hold the point where a circle meets another one, or a line: declared, it has quantities of its own beside its coordinates."""

    parts: Callable[[Own], Parts]


def point(given: Any) -> PlanePoint:
    """Return the point that a pair, or a quantity that is declared as a point, stands for."""
    match given:
        case Meeting():
            refuse(
                phrase("a meeting is declared before it is used: chapter.knee = meet(…), …; then m.knee is that point")
            )
        case (x, y):
            return PlanePoint(x, y)
        case Expression(id=id) if id:
            return PlanePoint(m[f"{id}_x"], m[f"{id}_y"])
    template = "{given} is not a point; write a quantity that is declared as one, m.pin, or a pair, (m.reach, 0)"
    refuse(Phrase(template, given=repr(given)))


def moved(start: Any, way: Any) -> PlanePoint:
    """Return a point moved by a way (x, y)."""
    return PlanePoint(*map(_plus, point(start), point(way)))


def polar(radius: Any, angle: Any, about: Any = (0, 0)) -> PlanePoint:
    """Return the point at a distance and in a direction from another one."""
    return _beside(about, _unit(angle), 1, radius)


def turned(start: Any, angle: Any, about: Any = (0, 0)) -> PlanePoint:
    """Return a point turned by an angle about another one."""
    return _beside(about, _unit(angle), 1, *_way(about, start))


def on_link(start: Any, end: Any, length: Any, along: Any, across: Any = 0) -> PlanePoint:
    """Return the point of a link of this length: so far from its start towards its end, and so far to the left of that."""
    return _beside(start, _way(start, end), length, along, across)


def distance(start: Any, end: Any) -> Any:
    """Return the distance of two points."""
    x, y = _way(start, end)
    return abs(_plus(x, y)) if _is(x, 0) or _is(y, 0) else np.sqrt(_square(x) + _square(y))


def direction(start: Any, end: Any, around: Any = 0) -> Any:
    """Return the direction from a point to another one, within half a turn of ``around``: where it goes further it jumps by a turn."""
    way, axis = _way(start, end), _unit(around)
    return _plus(around, np.arctan2(_cross(axis, way), _dot(axis, way)))


# Where circles meet each other, or a line.


class Circle(NamedTuple):
    """Hold the circle on which the end of a link lies that turns about a point."""

    center: Any
    radius: Any


class Line(NamedTuple):
    """Hold the line on which a joint slides: from a point on, at an angle or through another point."""

    start: Any
    angle: Any = 0
    through: Any = None


def meet(circle: Circle, other: Circle | Line, side: str, key: Any = None) -> Meeting:
    """Return the point where a circle meets another one, or a line; it is declared before it is used.

    Of two circles ``side`` is "left" or "right" of the line from the first centre to the second; on a line it is "ahead", the point further
    along the line, or "behind". ``key`` names the input to be changed where they do not meet: without it the first radius, which is one then.
    """
    if isinstance(other, Line):
        parts, sides = partial(_on_line, circle, other), ("ahead", "behind")
    else:
        parts, sides = partial(_of_circles, circle, other), ("left", "right")
    if side not in sides:
        refuse(Phrase("side is {given}, not {sides}", given=repr(side), sides=" or ".join(map(repr, sides))))
    key = circle.radius if key is None else key
    if not isinstance(key, str) and not getattr(key, "id", ""):
        refuse(phrase("the first radius is not an input; name the one to be changed here: meet(…, key=m.length)"))
    return Meeting(partial(parts, 1 if side == sides[0] else -1, key))


def _of_circles(first: Circle, second: Circle, sign: int, key: Any, own: Own) -> Parts:
    span, foot, height = own("span"), own("foot"), own("height")
    apart = phrase("is too short: the circles that meet in “{point}” lie farther apart than both radii together")
    within = phrase("is too unlike the other radius: of the circles that meet in “{point}” one lies within the other")
    yield PointPart("span", "d", distance(first.center, second.center), phrase("{point}: distance of the centres"))
    yield Demand("in_reach", span < first.radius + second.radius, key, apart)
    yield Demand("not_within", span > abs(first.radius - second.radius), key, within)
    along = phrase("{point}: distance from the first centre, along the line of centres")
    yield PointPart("foot", "a", (span**2 + first.radius**2 - second.radius**2) / (2 * span), along)
    yield PointPart("height", "h", np.sqrt(first.radius**2 - foot**2), phrase("{point}: distance from that line"))
    yield from on_link(first.center, second.center, span, foot, _times(sign, height)).parts(own)


def _on_line(circle: Circle, line: Line, sign: int, key: Any, own: Own) -> Parts:
    way, vector, length = _way(line.start, circle.center), _unit(line.angle), 1
    if line.through is not None:
        apart = phrase("{point}: distance of the line's points")
        yield PointPart("length", "l", distance(line.start, line.through), apart)
        vector, length = _way(line.start, line.through), own("length")
    beside = _square(_over(_cross(vector, way), length))
    missed = phrase("is too short: the circle and the line that meet in “{point}” do not reach each other")
    yield Demand("in_reach", beside < circle.radius**2, key, missed)
    along = phrase("{point}: distance of the centre, along the line")
    yield PointPart("foot", "a", _over(_dot(vector, way), length), along)
    yield PointPart("height", "h", np.sqrt(circle.radius**2 - beside), phrase("{point}: half the chord of the circle"))
    yield from _beside(line.start, vector, length, own("foot") + _times(sign, own("height"))).parts(own)


# Vectors; zeros, ones and double signs are left out of what is printed.


def _beside(start: Any, vector: Any, length: Any, along: Any, across: Any = 0) -> PlanePoint:
    """The point so far along a vector of a length from a start, and so far to the left of that."""
    ways, turned = (along, across), vector[::-1]
    return moved(start, tuple(_over(each, length) for each in (_cross(ways, turned), _dot(ways, turned))))


def _way(start: Any, end: Any) -> tuple[Any, ...]:
    return tuple(map(_minus, point(end), point(start)))


def _unit(angle: Any) -> tuple[Any, ...]:
    """The vector of length one at an angle, exact where it is along an axis."""
    if not isinstance(angle, Expression) and (quarters := float(angle) / (math.pi / 2)) % 1 == 0:
        return ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarters) % 4]
    return np.cos(angle), np.sin(angle)


def _dot(one: Any, other: Any) -> Any:
    return _plus(_times(one[0], other[0]), _times(one[1], other[1]))


def _cross(one: Any, other: Any) -> Any:
    return _minus(_times(one[0], other[1]), _times(one[1], other[0]))


def _plus(one: Any, other: Any) -> Any:
    sign, size = _signed(other)
    return _minus(one, size) if sign < 0 else other if _is(one, 0) else one if _is(other, 0) else one + other


def _minus(one: Any, other: Any) -> Any:
    sign, size = _signed(other)
    return _plus(one, size) if sign < 0 else one if _is(other, 0) else _negated(other) if _is(one, 0) else one - other


def _times(one: Any, other: Any) -> Any:
    (sign, left), (other_sign, right) = _signed(one), _signed(other)
    if _is(left, 0) or _is(right, 0):
        return 0
    size = right if _is(left, 1) else left if _is(right, 1) else left * right
    return size if sign == other_sign else _negated(size)


def _negated(one: Any) -> Any:
    node = node_of(one)
    return Expression(Node("-", node.args[::-1])) if node.op == "-" else -one


def _over(one: Any, other: Any) -> Any:
    return one if _is(one, 0) or _is(other, 1) else one / other


def _square(one: Any) -> Any:
    return _signed(one)[1] ** 2


def _is(value: Any, number: float) -> bool:
    return not isinstance(value, Expression) and bool(value == number)


def _signed(value: Any) -> tuple[int, Any]:
    """The sign that a value is written with, and the value without it."""
    if not isinstance(value, Expression):
        return (-1, -value) if value < 0 else (1, value)
    node = node_of(value)
    return (-1, Expression(node.args[0])) if node.op == "neg" else (1, value)
