"""Formulas: each is one, can be read and printed, and has a value for each text that chooses; tables have a row for each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from inspect import signature
from itertools import combinations
from typing import Any

from diecut_report.declaration.names import DeclaredNames, Fault, When, kinds_told, short, told, unknown
from diecut_report.declaration.tables import rows_of
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.chapters import Chapter, taken
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Binding, Bound, ByText, bound
from diecut_report.mechanism.part_steps import (
    ComputedCurve,
    Fact,
    Lookup,
    Neighbour,
    Part,
    PartCurves,
    PartNames,
    PartTable,
    Pick,
    Running,
    Total,
)
from diecut_report.mechanism.steps import (
    SILENT,
    Abscissa,
    Accumulated,
    Breakpoints,
    Case,
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
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase, joined, named, phrase

# Ids: each is given once, and given before it is taken, whatever inputs are given.


def order_faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the ids that are doubled, never made, not given, or taken too early."""
    yield from _doubled(mechanism, names)
    yield from _in_two_chapters(mechanism, names)
    for number, (_, step) in enumerate(mechanism.steps):
        when = names.when(number)
        if names.world.example(when) is None:
            yield Fault(
                step.at,
                Phrase("step {id}", id=step.id),
                phrase("is never calculated: what it needs and lacks is never given together"),
            )
            continue
        if not isinstance(step, SILENT) and not (step.symbol and step.description):
            yield Fault(step.at, Phrase("step {id}", id=step.id), phrase("has no symbol or no description"))
        for name in sorted(asked(step)):
            late = name == getattr(step, "shown_at", "") or isinstance(step, Words)
            text = lacking(names, name, when_asked(step, when), None if late else number)
            if text:
                yield Fault(step.at, Phrase("step {id}", id=step.id), Phrase("takes {text}", text=text))


def asked(step: Step) -> set[str]:
    """Return the ids that a step takes from elsewhere."""
    own = (
        {step.unknown, step.id}
        if isinstance(step, Root)
        else {step.given}
        if isinstance(step, Lookup | Pick)
        else set()
    )
    return {name for name in taken(step) if name not in own}


def when_asked(step: Step, when: When) -> When:
    """Return when a step takes what it asks for: what may be given instead, where that is not given."""
    given = step.given.removeprefix("inputs.") if isinstance(step, Lookup | Pick) else ""
    return when.with_(When(frozenset(), frozenset((given,)))) if given else when


def lacking(names: DeclaredNames, name: str, when: When, before: int | None = None) -> str:
    """Return in words why a name is not known (before a step) where it is wanted; empty where it always is."""
    givers = names.givers(name)
    if not givers:
        return unknown(name, names.known)
    given = names.missing(name, when, before)
    if given is None:
        return ""
    later = [giver for giver in givers if before is not None and giver.number >= before]
    if later and names.missing(name, when) is None:
        step = later[0].step
        place = short(step.at) if step else ""
        return Phrase(
            "{name} before it is calculated (at {place}); move that step up, or this one down", name=name, place=place
        )
    key = names.world.keys.get(name.removeprefix("inputs."))
    home = names.world.keys.get(key.home) if key else None
    if home and home.may_be_absent and home.path not in when.needs:
        words = (
            '{name}, but {home} may have no parts, by its default; write needs=("{home}",), or take its default away'
        )
        return Phrase(words, name=name, home=home.path)
    tokens = set().union(*(part for each in (when, *(giver.when for giver in givers)) for part in each))
    where = told(given, tokens)
    words = (
        "{name}, which nothing gives {where}; give it there too, or leave this out by needs or lacks"
        if where
        else "{name}, which nothing gives; give it there too, or leave this out by needs or lacks"
    )
    return Phrase(words, name=name, where=where)


def _doubled(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Steps, figures and exports with one id that can be made together."""
    steps = [(step, names.when(number)) for number, (_, step) in enumerate(mechanism.steps)]
    yield from pairs(names, "step", steps)
    yield from pairs(names, "figure", [(figure, When(frozenset(figure.needs))) for figure in mechanism.figures])
    yield from pairs(names, "export", [(profile, When(frozenset(profile.needs))) for profile in mechanism.exports])


def _in_two_chapters(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Steps that stand in two chapters which are both calculated."""
    for first, second in combinations(mechanism.chapters, 2):
        shared = (
            [step for step in second.steps if any(step is other for other in first.steps)]
            if first is not second
            else []
        )
        doubled = [step.id for step in shared if names.world.example(_together(first, second, step)) is not None]
        if doubled:
            text = Phrase(
                "has {doubled} of another chapter too, {title} (at {place}), so that they are calculated twice; "
                "add them to one of the two, or let their needs exclude each other",
                doubled=", ".join(doubled),
                title=repr(first.title),
                place=short(first.at),
            )
            yield Fault(second.at, Phrase("chapter {title}", title=repr(second.title)), text)


def _together(first: Chapter, second: Chapter, step: Step) -> When:
    return When(frozenset(first.needs + second.needs + step.needs), frozenset(step.lacks))


def pairs(names: DeclaredNames, what: str, declared: list[tuple[Any, When]]) -> Iterator[Fault]:
    """Yield the second of two that have one id and can be made together."""
    by_id: dict[str, list[tuple[Any, When]]] = {}
    for part, when in declared:
        by_id.setdefault(part.id, []).append((part, when))
    for name, alike in by_id.items():
        for (first, one), (second, other) in combinations(alike, 2):
            both = one.with_(other)
            given = names.world.example(both) if first is not second else None
            if given is not None:
                where = told(given, both.needs | both.lacks)
                yield Fault(second.at, _subject(what, name), _doubled_id(what, short(first.at), where))
                break


def _subject(what: str, name: str) -> Phrase:
    return {
        "step": Phrase("step {id}", id=name),
        "check": Phrase("check {id}", id=name),
        "figure": Phrase("figure {id}", id=name),
        "export": Phrase("export {id}", id=name),
    }[what]


ANOTHER = {
    "step": phrase("another step"),
    "check": phrase("another check"),
    "figure": phrase("another figure"),
    "export": phrase("another export"),
}


def _doubled_id(what: str, place: str, where: str) -> Phrase:
    words = (
        "has the id of {another} (at {place}), and both are made {where}; name one of them otherwise, or let their needs exclude each other"
        if where
        else "has the id of {another} (at {place}), and both are made; name one of them otherwise, or let their needs exclude each other"
    )
    return Phrase(words, another=ANOTHER[what], place=place, where=where)


PARTS = (phrase("formula"), "exists", phrase("condition"), phrase("equation"), "low", "high", "left", "right")


def unmarked(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield what stands where a formula is wanted and is none: the first thing to be mended, as nothing can be asked of it."""
    for _, step in mechanism.steps:
        for part, declared in _declared(step):
            if declared is not None and not isinstance(declared, Binding):
                name = getattr(declared, "__name__", repr(declared))
                what = (
                    phrase("a plain function; write @formula above it")
                    if callable(declared)
                    else phrase("no formula; write one with @formula")
                )
                yield Fault(
                    _place(declared, step.at),
                    Phrase("step {id}", id=step.id),
                    Phrase("the {part} {name} is {what}", part=part, name=name, what=what),
                )
        if isinstance(step, Choice) and not step.cases:
            yield Fault(step.at, Phrase("step {id}", id=step.id), phrase("has no cases; give at least one Case"))


def _declared(step: Step) -> Iterator[tuple[str, Any]]:
    for part in PARTS:
        if hasattr(step, part):
            yield part, getattr(step, part)
    for case in getattr(step, "cases", ()):
        if isinstance(case, Case):
            yield phrase("condition of a case"), case.condition
            yield phrase("value of a case"), None if isinstance(case.value, str) else case.value


def _place(function: Any, otherwise: str) -> str:
    code = getattr(function, "__code__", None)
    return f"{code.co_filename}:{code.co_firstlineno}" if code else otherwise


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the formulas that cannot be printed, and texts without a formula or a row."""
    seen: set[Formula] = set()
    for number, (_, step) in enumerate(mechanism.steps):
        for part, declared in _declared(step):
            options = (
                declared.options() if isinstance(declared, ByText) else (declared,) if declared is not None else ()
            )
            for link in map(bound, options):
                if link.formula not in seen:
                    seen.add(link.formula)
                    yield from _unreadable(step, part, link)
        for text in _choices(step, names, names.when(number)):
            yield Fault(step.at, Phrase("step {id}", id=step.id), text)


def _unreadable(step: Step, part: str, link: Bound) -> Iterator[Fault]:
    """A formula whose body cannot be read: whatever reading it raises is the author's to mend."""
    try:
        _ = link.formula.tree
    except RecursionError:
        text = Phrase(
            "the {part} {formula} calls itself; name it otherwise than what it calls",
            part=part,
            formula=link.formula.__name__,
        )
        yield Fault(_place(link.formula.function, step.at), Phrase("step {id}", id=step.id), text)
    except Exception as why:
        yield Fault(
            _place(link.formula.function, step.at),
            Phrase("step {id}", id=step.id),
            Phrase("the {part} cannot be printed: {why}", part=part, why=why),
        )


def _choices(step: Step, names: DeclaredNames, when: When) -> Iterator[str]:
    for _, declared in _declared(step):
        if isinstance(declared, ByText):
            yield from _complete(names, declared.key, declared.formulas, when, phrase("no formula"))
    match step:
        case Lookup(by=by) if not step.is_by_number:
            yield from _complete(names, by, rows_of(step), when_asked(step, when), phrase("no row in the table"))
            yield from _of_steps(names, by, rows_of(step))
        case Pick(by=by, series=Mapping() as series):
            yield from _complete(names, by, series, when, phrase("no series"))
        case Root(unknown=unknown):
            takes = bound(step.equation).names.values()
            if unknown not in takes:
                asked = ", ".join(str(name) for name in takes)
                yield Phrase(
                    "the unknown {unknown} is nothing that the equation takes; it takes {asked}",
                    unknown=unknown,
                    asked=asked,
                )
    function: object = getattr(step, "function", None)
    if hasattr(step, "function") and not callable(function):
        yield Phrase(
            "the function is {function}, which cannot be called; name one without brackets", function=repr(function)
        )
    elif callable(function):
        if isinstance(step, ComputedCurve):
            first = phrase("the part's index, ") if step.named_by else ""
            told = Phrase("it is called with {first}the object, x, the middles of the pieces and the rows", first=first)
            yield from _signature(function, OF_CURVE + bool(step.named_by), told)
        elif isinstance(step, PartCurves):
            words = phrase("it is called with the object, the part's number, x, the middles of the pieces and the rows")
            yield from _signature(function, OF_CURVE + 1, words)
        else:
            yield from _signature(function, 1 if isinstance(step, Prepared) else len(getattr(step, "takes", ())))


OF_CURVE = 4  # what the function of a computed curve takes


def _signature(function: Callable[..., object], given: int, called: str = "") -> Iterator[str]:
    """A function that cannot be called with so many things by position."""
    try:
        parameters = signature(function)
    except ValueError:  # of the interpreter itself, which says nothing of what it takes
        return
    try:
        parameters.bind(*range(given))
    except TypeError:
        asked = [p for p in parameters.parameters.values() if p.default is p.empty and p.kind is not p.VAR_POSITIONAL]
        named = called or Phrase("takes names {given}: each is given by its position", given=given)
        yield Phrase("its function takes {count}, and {named}", count=len(asked), named=named)


def _of_steps(names: DeclaredNames, by: str, rows: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with a row that is taken by a text of a step: one that a message makes, or a text of a choice without a row."""
    for step in (giver.step for giver in names.givers(by)):
        if isinstance(step, Words):
            words = "by is {by}, words that are made where a message asks for them; let choice or computed(…, is_text=True) give the row's name"
            yield Phrase(words, by=by)
        elif isinstance(step, Choice):
            missing = [case.value for case in step.cases if isinstance(case.value, str) and case.value not in rows]
            if missing:
                words = "has no row in the table for {by}={missing}; the rows are {rows}"
                yield Phrase(words, by=by, missing=", ".join(map(str, missing)), rows=", ".join(rows))


def _complete(names: DeclaredNames, by: str, rows: Mapping[str, Any], when: When, none: str) -> Iterator[str]:
    """What is wrong with a choice by a text: each text that may be given there has its row."""
    key = names.world.keys.get(by)
    if key is None:
        return  # told where ids are
    if not key.texts:
        allowed = ", ".join(map(repr, rows))
        yield Phrase(
            "is chosen by {by}, which may be any text; give it allowed ones: Annotated[Literal[{allowed}], Text(…)]",
            by=by,
            allowed=allowed,
        )
        return
    possible = [
        text for text in key.texts if key.home or names.world.example(when.with_(When(frozenset((f"{by}={text}",)))))
    ]
    missing = [text for text in possible if text not in rows]
    if missing:
        yield Phrase(
            "has {none} for {by}={missing}; add {them}, or forbid the text",
            none=none,
            by=by,
            missing=", ".join(missing),
            them=phrase("it" if len(missing) == 1 else "them"),
        )


# What steps take: a curve where a curve is wanted, a row where a row is, an abscissa, a text with allowed values.


NUMBER, ROW, CURVE = (
    frozenset({"number"}),
    frozenset({"number", "row"}),
    frozenset({"number", "row", "curve", "abscissa"}),
)
CURVE_INPUT = frozenset({"curve input"})
BY_NAME = phrase("a text, as the table's rows have names; for a number name the column that it is sought in, sought_in")
KINDS_PARTS = frozenset({"list of parts", "block"})
PLAIN = ROW | {"text", "curve input", "phase", "mechanism", "prepared", "crossings", "varying"}
SAID = {
    NUMBER: phrase("a single number"), ROW: phrase("a number or a row over repeated parts"), CURVE: phrase("a number, a row or a curve"),
    CURVE_INPUT: phrase("an input declared as a CurveInput"), KINDS_PARTS: phrase("the id of PartNames"),
}  # fmt: skip
Asked = tuple[str, str, frozenset[str], str]  # the field, the name in it, what it may be, and what is wanted in words


def kinds_faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
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
            yield "parts", parts, KINDS_PARTS, ""
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


# Units: what a step takes over as it is has the step's kind of unit.


AS_IT_IS = ("max", "min", "abs_max", "range", "mean", "rms", "sum")  # operations that leave the unit as it is


def units_faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps in another kind of unit than what they take over."""
    for number, (_, step) in enumerate(mechanism.steps):
        own = [step.unit, *(other for _, other in step.units)]
        for what, units in _taken(step, names, number):
            if units and not any(kind_of(one) == kind_of(other) for one in own for other in units):
                text = Phrase(
                    "is in {own}, {what} in {units}; give it the unit of what it takes over",
                    own=named(own, " or "),
                    what=what,
                    units=named(sorted(units), " or "),
                )
                yield Fault(step.at, Phrase("step {id}", id=step.id), text)


def _taken(step: Step, names: DeclaredNames, number: int) -> Iterator[tuple[str, set[str]]]:
    """What a step takes over as it is, with the units that it may have."""
    match step:
        case Total(of=of, operation="product") | Running(of=of, operation="product"):
            yield phrase("a product of any number of parts"), {"1"}
            yield of, _units(names, of, step, number)
        case Total(of=of, operation=operation) | Running(of=of, operation=operation) if operation in AS_IT_IS:
            yield of, _units(names, of, step, number)
        case Reduction(of=of, operation=operation) if operation in AS_IT_IS:
            yield of, _units(names, of, step, number)
        case Neighbour(of=of) | Part(of=of):
            yield of, _units(names, of, step, number)
        case Crossings(of=of):
            for axis in sorted(names.axes(of)):
                yield axis, _units(names, axis, step, number)
        case Pick(of=of, series=series):
            yield of, _units(names, of, step, number)
            several = series.values() if isinstance(series, Mapping) else (series,)
            yield from (
                (Phrase("the series {title}", title=one.title), {one.unit})
                for one in several
                if isinstance(one, StandardSeries)
            )
        case Lookup(table=StandardTable() as table, column=column):
            yield (
                Phrase("the table {title}", title=table.title),
                {one.unit for one in table.of_values if len(table.of_values) == 1 or one.name == column},
            )


def kind_of(text: str) -> object:
    """Return the kind of a unit; of one that is unknown, which is told where formulas are, its text."""
    try:
        return unit(text).kind
    except ValueError:
        return text


def _units(names: DeclaredNames, name: str, step: Step, number: int) -> set[str]:
    """The units of what is given before a step."""
    givers = [giver for giver in names.givers(name) if giver.number < number]
    return {each for giver in givers for each in giver.units_when(step.needs)}
