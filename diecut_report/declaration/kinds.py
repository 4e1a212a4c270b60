"""What steps take: a curve where a curve is wanted, a row where a row is, an abscissa, a text with allowed values."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.contract.binding import Binding, bound
from diecut_report.contract.code_steps import ComputedCurve, Fact, PartCurves, PartNames, PartTable
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import (
    Lookup,
    Neighbour,
    Part,
    Pick,
    Running,
    Total,
)
from diecut_report.contract.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Choice,
    Clash,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    MadeCurve,
    Phase,
    Prepared,
    Reduction,
    Require,
    Root,
    Step,
    Value,
    Words,
)
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault, kinds_told
from diecut_report.languages.phrases import Phrase, joined, phrase

NUMBER, ROW, CURVE = (
    frozenset({"number"}),
    frozenset({"number", "row"}),
    frozenset({"number", "row", "curve", "abscissa"}),
)
CURVE_INPUT = frozenset({"curve input"})
BY_NAME = phrase("a text, as the table's rows have names; for a number name the column that it is sought in, sought_in")
PARTS = frozenset({"list of parts", "block"})
PLAIN = ROW | {"text", "curve input", "phase", "mechanism", "prepared", "crossings", "varying"}
SAID = {
    NUMBER: phrase("a single number"), ROW: phrase("a number or a row over repeated parts"), CURVE: phrase("a number, a row or a curve"),
    CURVE_INPUT: phrase("an input declared as a CurveInput"), PARTS: phrase("the id of PartNames"),
}  # fmt: skip
Asked = tuple[str, str, frozenset[str], str]  # the field, the name in it, what it may be, and what is wanted in words


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps that take another kind of thing than they can, or mix what runs over unlike places."""
    for _, step in mechanism.steps:
        for field, name, allowed, wanted in _asked(step):
            kinds = names.kinds(name)
            if kinds and not kinds & allowed:
                text = Phrase(
                    "{field} is {name}, {said}; {wanted} is wanted",
                    field=field,
                    name=name,
                    said=kinds_told(kinds),
                    wanted=wanted or SAID[allowed],
                )
                yield Fault(step.at, Phrase("step {id}", id=step.id), text)
        yield from _mixed(step, names)
        if isinstance(step, Value | Choice) and step.per_piece and not _is_curve(step, names):
            text = Phrase(
                "has per_piece=True, which marks a flag of a curve's smooth pieces, but takes no curve and no abscissa; take it away"
            )
            yield Fault(step.at, Phrase("step {id}", id=step.id), text)


def _is_curve(step: Step, names: DeclaredNames) -> bool:
    return any(giver.step is step and giver.kind == "curve" for giver in names.known.get(step.id, ()))


def _asked(step: Step) -> Iterator[Asked]:
    """What a step takes, beside what it may be."""
    if step.exists is not None:
        yield from _of(step.exists, "exists", ROW)
    match step:
        case Value():
            yield from _of(step.formula, phrase("the formula"), CURVE)
        case Choice():
            for case in step.cases:
                yield from () if isinstance(case.value, str) else _of(case.value, phrase("the value of a case"), CURVE)
                yield from () if case.condition is None else _of(case.condition, phrase("a condition"), CURVE)
        case Root():
            for field in ("low", "high"):
                yield from _of(getattr(step, field), field, NUMBER)
        case Require() | Fact():
            yield from _of(step.condition, phrase("the condition"), ROW)
        case Reduction(of=of) | Crossings(of=of) | Accumulated(of=of) | Derivative(of=of):
            yield "of", of, frozenset({"curve"}), phrase("a curve over an abscissa")
        case Total(of=of) | Neighbour(of=of) | Running(of=of) | Part(of=of):
            for field, name in (("of", of), ("among", getattr(step, "among", ""))):
                yield from ((field, name, frozenset({"row"}), phrase("a row over repeated parts")),) if name else ()
        case Pick(of=of):
            yield "of", of, ROW, ""
        case Words():
            yield from (
                ("takes", name, ROW | {"text", "prepared"} | CURVE_INPUT, phrase("a number or a text"))
                for name in step.takes
            )
        case Computed() | MadeCurve() | PartNames():
            yield from (
                ("takes", name, PLAIN, phrase("a number, a text, or what is taken by reference")) for name in step.takes
            )
            yield from _over(step)
        case PartTable(parts=parts, columns=columns):
            yield "parts", parts, PARTS, ""
            yield from (("columns", name, frozenset({"row"}), phrase("a row over repeated parts")) for name in columns)
        case Clash():
            yield from (("takes", name, ROW, "") for name in step.takes)
        case _:
            yield from _over(step)


def _over(step: Step) -> Iterator[Asked]:
    axis = frozenset({"abscissa"}), phrase("the id of an Abscissa")
    match step:
        case Abscissa(period=period, points=points, speed=speed):
            yield from (("period", period, NUMBER, ""),) if isinstance(period, str) else ()
            yield "points", points, NUMBER, ""
            yield from (("speed", speed, NUMBER, ""),) if speed else ()
        case Breakpoints(abscissa=abscissa, places=places, every=every):
            yield "abscissa", abscissa, *axis
            yield from (
                ("places", place, NUMBER | {"crossings"}, phrase("a number or found crossings")) for place in places
            )
            yield from (("every", every, NUMBER, ""),) if every else ()
        case FromCurve(abscissa=abscissa, given=given):
            yield "abscissa", abscissa, *axis
            yield from (("given", given, CURVE_INPUT, ""),) if given else ()
            yield from ((f, getattr(step, f), NUMBER, "") for f in ("start", "lasts") if getattr(step, f))
        case ComputedCurve(abscissa=abscissa, of=of) | PartCurves(abscissa=abscissa, of=of):
            yield "abscissa", abscissa, *axis
            yield "of", of, frozenset({"prepared"}), phrase("what is prepared")
        case Prepared(holds=holds):
            yield from (("holds", name, PLAIN | {"block"}, phrase("an input or a number")) for name in holds)
        case Phase(abscissa=abscissa, spans=spans, period=period):
            yield "abscissa", abscissa, *axis
            yield from (("period", period, NUMBER, ""),) if period else ()
            yield from ((phrase("an end"), end, NUMBER, "") for span in spans for end in span if isinstance(end, str))
        case CurvePeriod(given=given):
            yield "given", given, CURVE_INPUT, ""
        case Lookup(by=by):
            yield ("by", by, ROW, "") if step.is_by_number else ("by", by, frozenset({"text"}), BY_NAME)


def _of(part: Binding, field: str, allowed: frozenset[str]) -> Iterator[Asked]:
    names = (name for name in bound(part).names.values() if isinstance(name, str))
    return ((field, name, allowed, "") for name in names)


def _mixed(step: Step, names: DeclaredNames) -> Iterator[Fault]:
    """A formula of curves over unlike abscissas, of rows over unlike lists, of rows and curves."""
    if not isinstance(step, Value | Choice):
        return
    own = {name: names.axes(name) for name in step.takes() if isinstance(name, str)}
    sole = {name: next(iter(axes)) for name, axes in own.items() if len(axes) == 1}
    if len(set(sole.values())) > 1:
        told = joined([Phrase("{name} runs over {axis}", name=name, axis=axis) for name, axis in sole.items()], ", ")
        text = Phrase(
            "mixes what runs over unlike places: {told}; take a single number of one of them first", told=told
        )
        yield Fault(step.at, Phrase("step {id}", id=step.id), text)
