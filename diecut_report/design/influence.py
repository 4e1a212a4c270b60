"""What matters: how far each input moves the governing checks, and how probable it is that the checks hold within tolerances."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal, NamedTuple, TypeVar

import numpy as np

from diecut_report import __version__
from diecut_report.config.loader import Config
from diecut_report.config.model import InfluenceSettings
from diecut_report.config.yaml import KeyPath
from diecut_report.design.answers import AskedNumber, quantity
from diecut_report.design.inputs import DesignInput, design_input, given_numbers, numbers_at_default
from diecut_report.design.machines import CHECKS, NO_RESERVE, UTILISATION, VariedMachines, impossible, varied
from diecut_report.errors import Problem, UserError
from diecut_report.formulas import Array
from diecut_report.quantities.units import UnitError, parse_quantity, pretty, unit
from diecut_report.results.conclusion import may_govern, weight
from diecut_report.text.phrases import Counted, Phrase, joined, phrase
from diecut_report.text.translation import decimal_sign, localised, said, say, spoken_language

Distribution = Literal["normal", "uniform"]
MOST_CHECKS = 5  # governing checks that are looked at where nothing is asked
IN_TOLERANCE = 3.0  # standard deviations that a tolerance is of a normal distribution
SURE = 0.95  # that the probability lies within its interval
STILL = 1e-9  # share of its size by which a number is moved by rounding alone


@dataclass(frozen=True)
class InputEffect:
    """Hold what an input does to a number: the number with the input lowered and raised, NaN where there is no machine."""

    design: DesignInput
    lowered: float
    raised: float
    low: float
    high: float

    def reach(self, present: float) -> float:
        """Return how far the number moves at most; infinite where a machine cannot be."""
        moved = np.abs(np.array([self.low, self.high]) - present)
        return float("inf") if np.isnan(moved).any() else float(moved.max())


@dataclass(frozen=True)
class Tornado:
    """Hold the inputs by what they do to a number, the greatest first.

    Those that do nothing are counted (``still``), and those that stand at their default and were not changed (``at_default``).
    """

    asked: AskedNumber
    present: float
    bars: tuple[InputEffect, ...]
    still: int
    at_default: int = 0


@dataclass(frozen=True)
class Chance:
    """Hold how probable it is that a check holds, with its interval (Clopper and Pearson), and how many of how many machines hold."""

    check: str
    held: int
    count: int
    probability: float
    low: float
    high: float


@dataclass(frozen=True)
class Tolerances:
    """Hold what was drawn: tolerances (SI) by input, their distribution, the seed, and what came out for each check and for all."""

    by_input: Mapping[DesignInput, float]
    distribution: Distribution
    seed: int
    count: int
    whole: Chance
    chances: tuple[Chance, ...]


def tornados(
    config: Config,
    names: Sequence[str],
    share: float,
    tolerances: Mapping[DesignInput, float],
    *,
    defaults: bool = False,
) -> list[Tornado]:
    """Return for each number that is asked for what each input does to it: changed by its tolerance, else by a share of its value.

    With ``defaults`` inputs that stand at their default are changed too. Without names these are the utilisations of the checks that
    govern. UserError where there is nothing to look at.
    """
    for each in tolerances:
        require_scatter(each)
    own = {each.asked.path for each in tolerances}
    standing = numbers_at_default(config)
    numbers = [*given_numbers(config), *(standing if defaults else ())]
    inputs = [*tolerances, *(each for each in numbers if each.present and each.asked.path not in own)]
    if not inputs:
        words = phrase("no input is given as a non-zero number, so none has an influence.")
        raise UserError(Problem(words, config.tree.file))
    ends = [_ends(each, tolerances.get(each) or _step(each, share)) for each in inputs]
    asked = list({each.column: each for each in (quantity(config, name) for name in names)}.values())
    made = _beside(config, inputs, ends, asked)
    if not made.exists[0]:
        raise impossible(config, made.reasons[0])
    asked = asked or [quantity(config, name) for name in _governing(made)]
    for number in asked:
        _require_value(config, made, number)
    left = 0 if defaults else sum(1 for each in standing if each.present and each.asked.path not in own)
    return [replace(_tornado(made, each, inputs, ends), at_default=left) for each in asked]


def by_input(sizes: Iterable[tuple[DesignInput, float]]) -> dict[DesignInput, float]:
    """Return tolerances by their inputs; UserError in words where one is given twice, maybe by another name that refers to it."""
    found: dict[str, tuple[DesignInput, float]] = {}
    for design, size in sizes:
        if design.asked.path in found:
            words = "{input} is given more than one tolerance; leave one of them."
            raise UserError(Problem(Phrase(words, input=design.name), path="--tolerance"))
        found[design.asked.path] = design, size
    return dict(found.values())


def require_scatter(design: DesignInput) -> None:
    """Refuse a tolerance of what does not scatter: a whole number, or one without a value today."""
    if design.is_whole or design.present is None:
        words = "{input} is a whole number or has no value at present, so it cannot have a tolerance."
        raise UserError(Problem(Phrase(words, input=design.name), path="--tolerance"))


def _require_value(config: Config, made: VariedMachines, asked: AskedNumber) -> None:
    if not np.isfinite(made.values(asked.column)[0]):
        words = "{asked} has no value at present: an input that it needs is not given, or the check is not performed."
        raise UserError(Problem(Phrase(words, asked=asked.name), config.tree.file, path="--of"))


def _step(design: DesignInput, share: float) -> float:
    size = abs(design.present or 0.0) * share
    return max(1.0, float(round(size))) if design.is_whole else size


def _ends(design: DesignInput, step: float) -> tuple[float, float]:
    """The input lowered and raised, not beyond the range that its declaration has: no machine there says anything of this one.

    Towards an end that does not belong to the range it goes half the way; of listed numbers the next ones are taken.
    """
    present = design.present or 0.0
    if listed := [design.meta.parsed_unit.to_si(value) for value in design.meta.listed]:
        near = STILL * abs(present)
        return (max((each for each in listed if each < present - near), default=present),
                min((each for each in listed if each > present + near), default=present))  # fmt: skip
    low, high = design.bounds
    found = np.array([max(present - step, low), min(present + step, high)])
    lowered, raised = np.where(design.allows(found), found, (found + present) / 2)
    return float(lowered), float(raised)


def _beside(
    config: Config, inputs: Sequence[DesignInput], ends: Sequence[tuple[float, float]], asked: Sequence[AskedNumber]
) -> VariedMachines:
    """Today's machine, then for each input the one with less and the one with more of it."""
    count = 1 + 2 * len(inputs)
    given = {}
    for index, (design, pair) in enumerate(zip(inputs, ends, strict=True)):
        column = np.full(count, design.present)
        column[1 + 2 * index : 3 + 2 * index] = pair
        given[design.asked] = column
    return varied(config, given, count, [each.asked for each in asked if each.asked is not None])


class _VariedCheck(NamedTuple):
    """A check of today's machine among others, as far as its weight follows from it."""

    id: str
    status: str
    utilisation: float
    presumed: bool
    check_class: str = ""
    sized_to_limit: bool = False


def _governing(made: VariedMachines) -> list[str]:
    """The check that governs each mechanism today, by the rules of the results; the one that governs the machine first."""
    checks: dict[str, list[_VariedCheck]] = {}
    for name in made.checks:
        home, _, own = name.partition(".")
        if np.isfinite(ratio := float(made.check(name, UTILISATION)[0])):
            no_reserve = bool(made.check(name, NO_RESERVE)[0])
            checks.setdefault(home, []).append(
                _VariedCheck(f"{home}{CHECKS}{own}", made.check(name)[0], ratio, no_reserve)
            )
    used = [max(filter(may_govern, own), key=weight, default=None) for own in checks.values()]
    return [found.id for found in sorted(filter(None, used), key=weight, reverse=True)[:MOST_CHECKS]]


def _tornado(
    made: VariedMachines, asked: AskedNumber, inputs: Sequence[DesignInput], ends: Sequence[tuple[float, float]]
) -> Tornado:
    values = made.values(asked.column)
    present = float(values[0])
    bars = [
        InputEffect(each, lowered, raised, float(values[1 + 2 * i]), float(values[2 + 2 * i]))
        for i, (each, (lowered, raised)) in enumerate(zip(inputs, ends, strict=True))
    ]
    moving = [each for each in bars if each.reach(present) > STILL * abs(present)]
    return Tornado(
        asked, present, tuple(sorted(moving, key=lambda each: -each.reach(present))), len(bars) - len(moving)
    )


def within_tolerances(
    config: Config, tolerances: Mapping[DesignInput, float], distribution: Distribution, count: int, seed: int
) -> Tolerances:
    """Return how probable it is that each check holds where the inputs scatter within their tolerances, drawn with a fixed seed.

    A tolerance is half the width of a uniform distribution, or three standard deviations of a normal one. A machine that cannot be
    holds no check.
    """
    draws = np.random.default_rng(seed)
    given = {}
    for design, tolerance in tolerances.items():
        require_scatter(design)
        assert design.present is not None
        off = (
            draws.normal(0.0, tolerance / IN_TOLERANCE, count)
            if distribution == "normal"
            else draws.uniform(-tolerance, tolerance, count)
        )
        given[design.asked] = design.present + off
    made = varied(config, given, count)
    chances = [_chance(name, made.check(name) == "pass", _judged(made, name)) for name in made.checks]
    whole = _chance(
        phrase("all checks"), np.isin(made.status.astype(str), ["pass", "warn"]), np.ones(count, dtype=bool)
    )
    found = sorted((each for each in chances if each.count), key=lambda each: (each.probability, each.check))
    return Tolerances(tolerances, distribution, seed, count, whole, tuple(found))


def _judged(made: VariedMachines, name: str) -> Array:
    """The machines for which a check is made, or that cannot be."""
    return np.asarray(~made.exists | np.array([status is not None for status in made.check(name)]))


def _chance(name: str, held: Array, judged: Array) -> Chance:
    from scipy.stats import binomtest

    count, good = int(judged.sum()), int((held & judged).sum())
    if not count:
        return Chance(name, 0, 0, 0.0, 0.0, 1.0)
    interval = binomtest(good, count).proportion_ci(SURE, method="exact")
    return Chance(name, good, count, good / count, float(interval.low), float(interval.high))


# What matters, told: as text, as plain data, and as a page with its figures.


SHOWN = 10  # inputs of a tornado
PAGE = """<!doctype html>
<html lang="{language}"><head><meta charset="utf-8"><title>{title}</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; font-src data:">
<style>{faces}
body{{font:15px/1.5 sans-serif;max-width:52rem;margin:2rem auto;padding:0 1rem;color:#1d252c}}svg{{max-width:100%;height:auto}}
pre{{white-space:pre-wrap;background:#f3f5f7;padding:.7rem}}footer{{color:#5a6771;font-size:.85em}}</style></head><body>
<h1>{title}</h1>
{body}
<footer>diecut-report {version}</footer></body></html>
"""


def lines(found: Sequence[Tornado], tolerances: Tolerances | None, option: str = "--defaults") -> Iterator[str]:
    """Yield what moves each number most, and how probable it is that the checks hold; ``option`` is what changes defaults too."""
    for each in found:
        yield from _influence_text_tornado(each)
    yield from _left_out(found, option)
    if tolerances is not None:
        yield from _tolerances(tolerances)


def _influence_text_tornado(found: Tornado) -> Iterator[Phrase]:
    asked = found.asked
    yield Phrase("{asked}, at present {value}", asked=asked.name, value=localised(asked.told(found.present, 4)))
    bars = found.bars[:SHOWN]
    width = max((len(each.design.name) for each in bars), default=0)
    for each in bars:
        ends = {
            "low": localised(each.design.told(each.lowered, 4)),
            "high": localised(each.design.told(each.raised, 4)),
        }
        gives = {"first": _value(found, each.low), "second": _value(found, each.high)}
        yield Phrase(
            "  {input}  {low} … {high}: {first} … {second}", input=each.design.name.ljust(width), **ends, **gives
        )
    more = len(found.bars) - len(bars)
    rest = [Phrase("{n} more have a smaller effect", n=more)] if more else []
    rest += [Phrase("{n} have no effect", n=found.still)] if found.still else []
    yield Phrase("  {rest}", rest=joined(rest, ", ") or phrase("no other input has an effect"))


def _left_out(found: Sequence[Tornado], option: str) -> Iterator[Phrase]:
    """How many inputs nobody gave, so that they were not changed."""
    if left := max((each.at_default for each in found), default=0):
        one = "{n} input has its default value and is not varied; {option} includes it"
        many = "{n} inputs have their default values and are not varied; {option} includes them"
        yield Counted(left, one, many, option=option)


def _value(found: Tornado, value: float) -> str:
    return phrase("cannot exist") if math.isnan(value) else localised(found.asked.told(value, 4))


def _tolerances(found: Tolerances) -> Iterator[Phrase]:
    is_normal = found.distribution == "normal"
    way = Phrase("normal, {n} standard deviations", n=f"{IN_TOLERANCE:g}") if is_normal else phrase("uniform")
    given = ", ".join(
        f"{each.name} {localised(each.told(each.present or 0.0))} ± {localised(each.told(size))}"
        for each, size in found.by_input.items()
    )
    words = "within tolerances ({way}; {n} machines, seed {seed}): {inputs}"
    yield Phrase(words, way=way, n=found.count, seed=found.seed, inputs=given)
    yield Phrase("  no check fails: {chance}", chance=_influence_text_chance(found.whole))
    unsure = [each for each in found.chances if each.held < each.count]
    width = max((len(each.check) for each in unsure), default=0)
    yield from (
        Phrase("  {check}  {chance}", check=each.check.ljust(width), chance=_influence_text_chance(each))
        for each in unsure
    )
    yield Phrase("  {n} checks hold in all of them", n=len(found.chances) - len(unsure))


def _influence_text_chance(found: Chance) -> Phrase:
    shares = {"share": found.probability, "low": found.low, "high": found.high}
    percents = {name: localised(f"{100 * value:.4g}") for name, value in shares.items()}
    return Phrase("{share} % (95 %: {low} … {high} %), {n} of {total}", n=found.held, total=found.count, **percents)


def data(found: Sequence[Tornado], tolerances: Tolerances | None) -> dict[str, Any]:
    """Return the same as plain data, SI."""
    return {
        "schema_version": 1,
        "tornados": [
            {"name": each.asked.name, "unit": each.asked.si, "today": each.present, "bars": [_bar(bar) for bar in each.bars], "still": each.still,
             "at_default": each.at_default}
            for each in found
        ],
        "tolerances": None if tolerances is None else {
            "inputs": {each.asked.path: size for each, size in tolerances.by_input.items()},
            "distribution": tolerances.distribution, "seed": tolerances.seed, "count": tolerances.count,
            "no_check_fails": _plain(tolerances.whole), "checks": [_plain(each) for each in tolerances.chances],
        },
    }  # fmt: skip


def _bar(bar: InputEffect) -> dict[str, Any]:
    numbers = {"low": bar.low, "high": bar.high}
    ends = {
        "path": bar.design.asked.path,
        "unit": bar.design.meta.parsed_unit.si,
        "lowered": bar.lowered,
        "raised": bar.raised,
    }
    return ends | {name: None if math.isnan(value) else value for name, value in numbers.items()}


def _plain(found: Chance) -> dict[str, Any]:
    return {
        "check": found.check,
        "held": found.held,
        "count": found.count,
        "probability": found.probability,
        "interval": [found.low, found.high],
    }


def page(found: Sequence[Tornado], tolerances: Tolerances | None, name: str) -> str:
    """Return the same as one HTML file without scripts or network, with a figure for each number."""
    from diecut_report.report.figures.charts import tornado
    from diecut_report.report.pages import html as report_html

    faces = report_html._font_faces(tuple(report_html.FACES.items()))
    parts = []
    for index, each in enumerate(found):
        factor = unit(each.asked.unit).factor
        bars = [
            {"label": bar.design.name}
            | {
                side: None if math.isnan(value) else value / factor
                for side, value in (("low", bar.low), ("high", bar.high))
            }
            for bar in each.bars[:SHOWN]
        ]
        text = "\n".join(map(said, _influence_text_tornado(each)))
        figure = (
            tornado(
                each.present / factor,
                bars,
                say("Influence of inputs on {asked}", asked=each.asked.name),
                f"tornado-{index}",
                decimal_sign(),
            ).text
            if bars
            else ""
        )
        words = "In {unit}; blue: input increased; brown: input decreased; ×: cannot exist; line: present value."
        caption = say(words, unit=pretty(each.asked.unit) or phrase("a fraction"))
        below = f"<p>{html.escape(caption)}</p>\n<pre>{html.escape(text)}</pre>"
        parts.append(f"<h2>{html.escape(each.asked.name)}</h2>\n{figure}\n{below}")
    parts += [f"<p>{html.escape(said(each))}</p>" for each in _left_out(found, "--defaults")]
    if tolerances is not None:
        parts.append(
            f"<h2>{say('Tolerances')}</h2>\n<pre>"
            + html.escape("\n".join(map(said, _tolerances(tolerances))))
            + "</pre>"
        )
    title = html.escape(say("What matters: {file}", file=name))
    return PAGE.format(title=title, body="\n".join(parts), faces=faces, version=__version__, language=spoken_language())


# What matters, for a chapter of the report: asked for in its configuration, calculated, and put as plain data among the results.


PLACE = ("report", "influence")
Data = dict[str, Any]
Found = TypeVar("Found")


def influenced(config: Config) -> Data | None:
    """Return what the chapter tells, numbers in the units that they are read in; None where the configuration asks for none.

    UserError with the line where something is named there that this machine does not have.
    """
    asked = config.report.influence
    if asked is None:
        return None
    sizes = _sizes(config, asked)
    for index, name in enumerate(asked.of):
        _asked(config, index, name)
    found = _placed(config, ("of",), lambda: tornados(config, asked.of, asked.by, sizes, defaults=asked.defaults))
    drawn = _drawn(config, asked, sizes) if sizes else None
    return {"by": asked.by, "tornados": [_report_influence_tornado(each) for each in found]} | (
        {"tolerances": drawn} if drawn else {}
    )


def misnamed(config: Config) -> list[Problem]:
    """Return what is wrong with what a configuration asks the chapter for, without calculating."""
    asked, problems = config.report.influence, list[Problem]()
    if asked is None:
        return problems
    finds: list[Callable[[], object]] = [
        partial(_tolerance, config, name, str(size)) for name, size in (asked.tolerances or {}).items()
    ]
    finds += [partial(_asked, config, index, name) for index, name in enumerate(asked.of)]
    for find in finds:
        try:
            find()
        except UserError as fault:
            problems += fault.problems
    if not problems:
        try:
            _sizes(config, asked)
        except UserError as fault:
            problems += fault.problems
    return problems


def _sizes(config: Config, asked: InfluenceSettings) -> dict[DesignInput, float]:
    """All inputs that scatter, and how far."""
    sizes = [_tolerance(config, name, str(size)) for name, size in (asked.tolerances or {}).items()]
    return _placed(config, ("tolerances",), lambda: by_input(sizes))


def _asked(config: Config, index: int, name: str) -> object:
    return _placed(config, ("of", index), partial(quantity, config, name))


def _drawn(config: Config, asked: InfluenceSettings, sizes: dict[DesignInput, float]) -> Data:
    return _report_influence_tolerances(within_tolerances(config, sizes, asked.distribution, asked.count, asked.seed))


def _tolerance(config: Config, name: str, typed: str) -> tuple[DesignInput, float]:
    """An input and how far it scatters."""
    own = ("tolerances", name)
    design = _placed(config, own, lambda: design_input(config, name))
    try:
        size = parse_quantity(typed, design.meta.unit)
    except UnitError as fault:
        raise UserError(_problem(config, own, str(fault))) from None
    if not 0 < size < math.inf:
        raise UserError(_problem(config, own, Phrase("{name}: {size} is not above zero", name=name, size=typed)))
    _placed(config, own, lambda: require_scatter(design))
    return design, size


def _placed(config: Config, key: KeyPath, find: Callable[[], Found]) -> Found:
    """What is found; a UserError of it with the place in the file that asked for it."""
    try:
        return find()
    except UserError as fault:
        raise UserError([_problem(config, key, each.message, is_name=True) for each in fault.problems]) from None


def _problem(config: Config, key: KeyPath, words: str, *, is_name: bool = False) -> Problem:
    """What is wrong with a value there, or with the name that is its key."""
    place = (*PLACE, *key)
    line, column = config.tree.key_position(place) if is_name else config.tree.position(place)
    return Problem(words, config.tree.file, line, column, ".".join(map(str, place)))


def _report_influence_tornado(found: Tornado) -> Data:
    own = found.asked.unit
    bars = [
        {"name": bar.design.name, "unit": bar.design.unit, "lowered": _in(bar.design.unit, bar.lowered),
         "raised": _in(bar.design.unit, bar.raised), "low": _known(own, bar.low), "high": _known(own, bar.high)}
        for bar in found.bars[:SHOWN]
    ]  # fmt: skip
    more = len(found.bars) - len(bars)
    return {"name": found.asked.name, "unit": found.asked.unit, "today": _in(own, found.present), "bars": bars, "more": more,
            "still": found.still, "at_default": found.at_default}  # fmt: skip


def _report_influence_tolerances(found: Tolerances) -> Data:
    inputs = [
        {
            "name": each.name,
            "unit": each.unit,
            "value": _in(each.unit, each.present or 0.0),
            "tolerance": _size(each, size),
        }
        for each, size in found.by_input.items()
    ]
    return {"distribution": found.distribution, "seed": found.seed, "count": found.count, "inputs": inputs, "whole": _chance_data(found.whole),
            "checks": [_chance_data(each) for each in found.chances]}  # fmt: skip


def _chance_data(found: Chance) -> Data:
    return {
        "check": str.__str__(found.check),  # the results hold no message there
        "held": found.held,
        "count": found.count,
        "probability": found.probability,
        "low": found.low,
        "high": found.high,
    }


def _known(name: str, value: float) -> float | None:
    return None if math.isnan(value) else _in(name, value)


def _in(name: str, value: float) -> float:
    return float(unit(name).from_si(value))


def _size(design: DesignInput, size: float) -> float:
    """A tolerance in the unit of its input: of a difference, so that a unit with a zero of its own takes nothing away."""
    return _in(design.unit, size) - _in(design.unit, 0.0)
