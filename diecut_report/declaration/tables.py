"""Tables and series: the column is there, its unit is that of what is taken, what is given in its place may be left out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.declaration.names import DeclaredNames, Fault
from diecut_report.errors import nearest
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.part_steps import Interpolated, Lookup, Pick
from diecut_report.mechanism.steps import Abscissa, Step
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import StandardFault, StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase, phrase


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with what steps take from tables and series."""
    for _, step in mechanism.steps:
        for text in _wrong(step, names):
            yield Fault(step.at, Phrase("step {id}", id=step.id), text)


def _wrong(step: Step, names: DeclaredNames) -> Iterator[str]:
    match step:
        case Lookup():
            yield from _column(step)
            yield from _sought(step, names)
            yield from _idle(step, names)
            yield from _given(step, names)
        case Interpolated():
            across, upwards = step.between.columns
            yield from _unlike(
                Phrase("the column {name} of the table", name=upwards.name),
                upwards.unit,
                _units(step),
                phrase("the step"),
            )
            yield from _unlike(
                Phrase("the column {name} of the table", name=across.name), across.unit, _taken(names, step.of), step.of
            )
            yield from _key(step, step.of, names, is_covered=_covered(step, names))
        case Pick(series=series):
            yield from _given(step, names)
            if step.key:
                yield from _key(step, step.of, names, is_covered=True)
            for own in series.values() if isinstance(series, Mapping) else (series,):
                if isinstance(own, StandardTable):
                    yield phrase("takes from a table; name its column, table.series(…)")
                elif isinstance(own, StandardSeries):
                    yield from _unlike(
                        Phrase("the series “{title}”", title=own.title), own.unit, _units(step), phrase("the step")
                    )
                    yield from _unlike(
                        Phrase("the series “{title}”", title=own.title), own.unit, _taken(names, step.of), step.of
                    )


def rows_of(step: Lookup) -> Mapping[str, Any]:
    """Return the rows of a table by their names; none where that cannot be told."""
    try:
        return step.rows()[0]
    except StandardFault:
        return {}


def _column(step: Lookup) -> Iterator[str]:
    if not isinstance(step.table, StandardTable):
        if step.column:
            yield Phrase(
                "names the column {column}, but its table has none; write it with own_table(…, columns=…)",
                column=step.column,
            )
        return
    try:
        own = step.table.column(step.column)
    except StandardFault as fault:
        yield str(fault).removesuffix(".")
        return
    yield from _unlike(
        phrase("the table") if not own.name else Phrase("the column {name} of the table", name=own.name),
        own.unit,
        _units(step),
        phrase("the step"),
    )


def _sought(step: Lookup, names: DeclaredNames) -> Iterator[str]:
    """What is wrong with the number by which a row is sought."""
    if not step.is_by_number:
        if step.key:
            yield Phrase(
                "names the key {key}, but its row is that of a text, which is always there; take key away", key=step.key
            )
        return
    assert isinstance(step.table, StandardTable)
    try:
        own = step.sought
    except StandardFault as fault:
        yield str(fault).removesuffix(".")
        return
    if len(set(own.values)) < len(own.values):
        yield Phrase(
            "seeks the row by the column {name} of the table “{title}”, which has a number twice; take another column",
            name=own.name,
            title=step.table.title,
        )
    title = Phrase("the column {name} of the table", name=own.name) if own.name else phrase("the table")
    yield from _unlike(title, own.unit, _taken(names, step.by), step.by)
    yield from _key(step, step.by, names, is_covered=_is_picked(step, names))


def _is_picked(step: Lookup, names: DeclaredNames) -> bool:
    """Whether the number is always one that was picked from a series of numbers that the table has."""
    own = set(step.sought.values)
    given = [giver.step for giver in names.givers(step.by)]
    return all(isinstance(each, Pick) and not each.given and _series_of(each) <= own for each in given)


def _series_of(step: Pick) -> set[float]:
    several = step.series.values() if isinstance(step.series, Mapping) else (step.series,)
    return {value for one in several for value in (one.values if isinstance(one, StandardSeries) else one)}


def _idle(step: Lookup, names: DeclaredNames) -> Iterator[str]:
    """Rows of a step's own table that no text asks for; a published table may have more rows than a mechanism allows."""
    key = names.world.keys.get(step.by)
    if key is None or not key.texts or isinstance(step.table, StandardTable):
        return
    for row in step.table:
        if row not in key.texts:
            yield (
                Phrase(
                    "has a row for {row}{nearest}, which {by} can never be; allowed: {texts}; take the row away, or allow its text",
                    row=repr(row),
                    nearest=nearest(row, key.texts),
                    by=step.by,
                    texts=", ".join(key.texts),
                )
            )


def _given(step: Lookup | Pick, names: DeclaredNames) -> Iterator[str]:
    """What is wrong with the input that may stand in the table's place."""
    path = step.given.removeprefix("inputs.")
    if not path:
        return
    key = names.world.keys.get(path)
    if key is None or not isinstance(key.meta, Quantity):
        known = [name for name, other in names.world.keys.items() if isinstance(other.meta, Quantity)]
        yield Phrase(
            "given is {path}, which is not an input that is a number{nearest}", path=path, nearest=nearest(path, known)
        )
        return
    by = names.world.keys.get(step.by if isinstance(step, Lookup) else step.of)
    if not key.may_be_absent or key.has_default:
        yield Phrase("given is {path}, which is always there; let it be float | None with the default None", path=path)
    if by is not None and by.home != key.home:
        other = "by" if isinstance(step, Lookup) else "of"
        yield Phrase(
            "given is {path}, {other} is {second}; both must be inputs of one list, or of none",
            path=path,
            other=other,
            second=by.path,
        )
    yield from _unlike(Phrase("given, {path},", path=path), key.meta.unit, _units(step), phrase("the step"))


def _key(step: Interpolated | Lookup | Pick, taken: str, names: DeclaredNames, *, is_covered: bool) -> Iterator[str]:
    """An impossible machine is told at an input."""
    inputs = [name for name in names.world.keys if "=" not in name]
    if step.key and step.key not in inputs:
        yield Phrase("key is {key}, which is not an input{nearest}", key=step.key, nearest=nearest(step.key, inputs))
    elif not step.key and taken.removeprefix("inputs.") not in inputs and not is_covered:
        where = (
            phrase("lie outside of the table")
            if isinstance(step, Interpolated)
            else phrase("be a number that the table does not have")
        )
        yield Phrase(
            'takes {taken}, which may {where}; name the input that is then to be changed, key="…"',
            taken=taken,
            where=where,
        )


def _covered(step: Interpolated, names: DeclaredNames) -> bool:
    """Whether a table goes over an abscissa of a period that is always the same."""
    low, high = step.between.x[[0, -1]]
    given = [giver.step for giver in names.givers(step.of)]
    return all(
        isinstance(each, Abscissa)
        and not isinstance(each.period, str)
        and low <= 0
        and each.period <= high * (1 + 1e-12)
        for each in given
    )


def _units(step: Step) -> set[str]:
    return {step.unit, *(text for _, text in step.units)}


def _taken(names: DeclaredNames, name: str) -> set[str]:
    """The units that a quantity may have."""
    return {each for giver in names.givers(name) for each in giver.units_when(())}


def _unlike(what: str, own: str, wanted: set[str], whose: str) -> Iterator[str]:
    """The unit of a table beside that of the quantity it is for; unknown units are told where they are declared."""
    try:
        is_alike = not wanted or any(unit(each).kind == unit(own).kind for each in wanted)
    except ValueError:
        return
    if not is_alike:
        yield Phrase(
            "{what} is in {own}, {whose} in {units}", what=what, own=own, whose=whose, units=", ".join(sorted(wanted))
        )
