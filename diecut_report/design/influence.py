"""What matters: how far each input moves the governing checks, and how probable it is that the checks hold within tolerances."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from types import MappingProxyType
from typing import Any, Literal, TypeVar

import numpy as np

from diecut_report import __version__
from diecut_report.config.loader import Config
from diecut_report.config.model import InfluenceSettings
from diecut_report.config.yaml import KeyPath
from diecut_report.design.answers import AskedNumber, quantity
from diecut_report.design.inputs import DesignInput, free_input, numbers_at_default, numbers_to_vary, untied
from diecut_report.design.machines import CHECKS, VariedMachines, impossible, varied
from diecut_report.errors import Problem, UserError, refusal
from diecut_report.formulas import Array
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import UnitError, parse_quantity, pretty, unit
from diecut_report.results.conclusion import may_govern, weight
from diecut_report.results.model import (
    ChanceRecord,
    InfluenceRecord,
    MovedBarRecord,
    ScatterRecord,
    TolerancesRecord,
    TornadoRecord,
)
from diecut_report.results.warm_press import WarmPress
from diecut_report.text.phrases import Counted, Phrase, joined, phrase
from diecut_report.text.translation import localised, said, say, spoken_language

Distribution = Literal["normal", "uniform"]
MOST_CHECKS = 5  # governing checks that are looked at where nothing is asked
IN_TOLERANCE = 3.0  # standard deviations that a tolerance is of a normal distribution
SHOWN = 10  # inputs of a tornado
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
        """Return how far the number moves at most, on a side where there is a machine; 0 where there is none on either."""
        return float(np.nanmax(np.abs([self.low - present, self.high - present, 0.0])))


@dataclass(frozen=True)
class Tornado:
    """Hold the inputs by what they do to a number, the greatest first.

    ``impossible`` are those of which a change makes no machine and that do nothing else, each with the reason.
    Those that do nothing are counted (``still``), and those that were not changed, as they stand at their default (``at_default``).
    """

    asked: AskedNumber
    present: float
    bars: tuple[InputEffect, ...]
    still: int
    impossible: Mapping[InputEffect, str] = field(default_factory=dict)
    at_default: int = 0

    @property
    def record(self) -> TornadoRecord:
        """Return it as it is read: its greatest bars, in the units of the inputs and the number."""
        own, shown = self.asked.unit, [*self.bars, *self.impossible][:SHOWN]
        bars = [
            MovedBarRecord(
                name=bar.design.name, unit=bar.design.unit, lowered=_in(bar.design.unit, bar.lowered),
                raised=_in(bar.design.unit, bar.raised), low=_known(_in(own, bar.low)), high=_known(_in(own, bar.high)),
            )
            for bar in shown
        ]  # fmt: skip
        return TornadoRecord(
            name=self.asked.name, unit=own, today=_in(own, self.present), bars=bars, more=max(len(self.bars) - SHOWN, 0), still=self.still,
            at_default=self.at_default,
        )  # fmt: skip


def _known(value: float) -> float | None:
    return None if math.isnan(value) else value


def _in(name: str, value: float) -> float:
    return float(unit(name).from_si(value))


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
    own = {each.asked.path for each in tolerances}
    standing = untied(config, numbers_at_default(config))
    numbers = [*numbers_to_vary(config), *(standing if defaults else ())]
    inputs = [*tolerances, *(each for each in numbers if each.present and each.asked.path not in own)]
    if not inputs:
        raise refusal("no input is given as a non-zero number, so none has an influence.", config.tree.file)
    steps = [tolerances.get(each) or abs(each.present or 0.0) * share for each in inputs]
    ends = [_ends(each, step) for each, step in zip(inputs, steps, strict=True)]
    asked = list({each.column: each for each in (quantity(config, name) for name in names)}.values())
    made = _beside(config, inputs, ends, asked)
    if not made.exists[0]:
        raise impossible(config, made.errors[0])
    asked = asked or [quantity(config, name) for name in _governing(config)]
    for number in asked:
        if not np.isfinite(made.values(number.column)[0]):
            template = (
                "{asked} has no value at present: an input that it needs is not given, or the check is not performed."
            )
            raise UserError(Problem(Phrase(template, asked=number.name), config.tree.file, path="--of"))
    left = 0 if defaults else sum(1 for each in standing if each.present and each.asked.path not in own)
    return [replace(_tornado(made, each, inputs, ends), at_default=left) for each in asked]


def by_input(sizes: Iterable[tuple[DesignInput, float]]) -> dict[DesignInput, float]:
    """Return tolerances by their inputs; UserError in words of what does not scatter, or is given twice, maybe by a name that refers to it."""
    found: dict[str, tuple[DesignInput, float]] = {}
    for design, size in sizes:
        if design.is_whole or design.present is None:
            template = "{input} is a whole number or has no value at present, so it cannot have a tolerance."
            raise UserError(Problem(Phrase(template, input=design.name), path="--tolerance"))
        if design.asked.path in found:
            template = "{input} is given more than one tolerance; leave one of them."
            raise UserError(Problem(Phrase(template, input=design.name), path="--tolerance"))
        found[design.asked.path] = design, size
    return dict(found.values())


def _ends(design: DesignInput, step: float) -> tuple[float, float]:
    """The input lowered and raised, not beyond the range that its declaration has: no machine there says anything of this one.

    Towards an end that does not belong to the range it goes half the way; of listed numbers the next ones are taken.
    """
    present = design.present or 0.0
    if len(listed := design.listed):
        near = STILL * abs(present)
        below, above = listed[listed < present - near], listed[listed > present + near]
        return float(below[-1]) if len(below) else present, float(above[0]) if len(above) else present
    low, high = design.bounds
    step = max(1.0, float(round(step))) if design.is_whole else step
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


def _governing(config: Config) -> list[str]:
    """The check that governs each mechanism today, by the rules of the results; the one that governs the machine first."""
    known = []
    for name, own in WarmPress(is_advised=False).calculate(config).checks.items():
        used = max(
            (each for each in own if each.utilisation is not None and may_govern(each)), key=weight, default=None
        )
        known += [] if used is None else [(name, used)]
    known.sort(key=lambda each: weight(each[1]), reverse=True)
    return [f"{name}{CHECKS}{used.id}" for name, used in known[:MOST_CHECKS]]


def _tornado(
    made: VariedMachines,
    asked: AskedNumber,
    inputs: Sequence[DesignInput],
    ends: Sequence[tuple[float, float]],
) -> Tornado:
    values = made.values(asked.column)
    present, sides = float(values[0]), np.reshape(values[1:], (-1, 2)).tolist()
    bars = [InputEffect(each, *pair, *beside) for each, pair, beside in zip(inputs, ends, sides, strict=True)]
    moving = [each for each in bars if each.reach(present) > STILL * abs(present)]
    moving.sort(key=lambda each: -each.reach(present))
    pairs = zip(
        bars, zip(made.errors[1::2], made.errors[2::2], strict=True), strict=True
    )  # of the machines with less of each, and with more
    reasons = {each: next(filter(None, errors), "") for each, errors in pairs}
    impossible = {
        each: why for each, why in reasons.items() if each not in moving and np.isnan([each.low, each.high]).any()
    }
    return Tornado(asked, present, tuple(moving), len(bars) - len(moving) - len(impossible), impossible)


def within_tolerances(
    config: Config, tolerances: Mapping[DesignInput, float], distribution: Distribution, count: int, seed: int
) -> TolerancesRecord:
    """Return how probable it is that each check holds where the inputs scatter within their tolerances, drawn with a fixed seed.

    A tolerance is half the width of a uniform distribution, or three standard deviations of a normal one. A machine that cannot be
    holds no check.
    """
    draws, given, inputs = np.random.default_rng(seed), {}, []
    for design, size in tolerances.items():
        present, is_normal = design.present or 0.0, distribution == "normal"
        off = draws.normal(0.0, size / IN_TOLERANCE, count) if is_normal else draws.uniform(-size, size, count)
        given[design.asked] = present + off
        # of a difference: a unit with a zero of its own takes nothing away
        wide = _in(design.unit, size) - _in(design.unit, 0.0)
        value = _in(design.unit, present)
        inputs.append(ScatterRecord(name=design.name, unit=design.unit, value=value, tolerance=wide))
    made = varied(config, given, count)
    chances = []
    for name in made.checks:  # each is judged where it is made, or where the machine cannot be
        own = made.check(name)
        chances.append(_chance(name, own == "pass", ~made.exists | np.array([each is not None for each in own])))
    found = sorted((each for each in chances if each.count), key=lambda each: (each.probability, each.check))
    whole = _chance("all checks", made.passes, np.ones(count, dtype=bool))
    return TolerancesRecord(distribution=distribution, seed=seed, count=count, inputs=inputs, whole=whole, checks=found)


def _chance(name: str, held: Array, judged: Array) -> ChanceRecord:
    from scipy.stats import binomtest

    count, good = int(judged.sum()), int((held & judged).sum())
    if not count:
        return ChanceRecord(check=name, held=0, count=0, probability=0.0, low=0.0, high=1.0)
    low, high = binomtest(good, count).proportion_ci(SURE, method="exact")
    return ChanceRecord(check=name, held=good, count=count, probability=good / count, low=float(low), high=float(high))


# What matters, told: as text, as plain data, and as a page with its figures.


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


def lines(found: Sequence[Tornado], drawn: TolerancesRecord | None, option: str = "--defaults") -> Iterator[str]:
    """Yield what moves each number most, and how probable it is that the checks hold; ``option`` is what changes defaults too."""
    for each in found:
        yield from _tornado_lines(each)
    yield from _left_out(found, option)
    if drawn is not None:
        yield from _tolerances(drawn)


def _tornado_lines(tornado: Tornado) -> Iterator[Phrase]:
    found = tornado.record
    yield Phrase("{asked}, at present {value}", asked=found.name, value=_told(found.today, found.unit))
    moving = found.bars[: len(tornado.bars)]
    width = max((len(bar.name) for bar in moving), default=0)
    for bar in moving:
        ends = {"low": _told(bar.lowered, bar.unit), "high": _told(bar.raised, bar.unit)}
        gives = {"first": _told(bar.low, found.unit), "second": _told(bar.high, found.unit)}
        yield Phrase("  {input}  {low} … {high}: {first} … {second}", input=bar.name.ljust(width), **ends, **gives)
    rest = [Phrase("{n} more have a smaller effect", n=found.more)] if found.more else []
    rest += [Phrase("{n} have no effect", n=found.still)] if found.still else []
    yield Phrase("  {rest}", rest=joined(rest, ", ") or phrase("no other input has an effect"))


def _impossible(found: Sequence[Tornado]) -> Iterator[Phrase]:
    """Name the inputs of which a change makes no machine, those of one reason together with it: of all numbers that are asked for at once."""
    reasons = {bar.design.name: why for each in found for bar, why in each.impossible.items()}
    told = list(dict.fromkeys(reasons.values()))
    if told:
        yield phrase("changed one way or both, no machine exists:")
    for reason in told[:SHOWN]:
        names = ", ".join(name for name, why in reasons.items() if why == reason)
        yield Phrase("  {names} ({reason})", names=names, reason=reason)
    if len(told) > SHOWN:
        yield Phrase("  {n} more reasons; --format json gives each input its own", n=len(told) - SHOWN)


def _told(value: float | None, unit: str, digits: int = 4) -> str:
    return phrase("cannot exist") if value is None else localised(with_unit(number_text(value, digits), unit))


def _left_out(found: Sequence[Tornado], option: str) -> Iterator[Phrase]:
    """Which inputs make no machine, and how many nobody gave, so that they were not changed."""
    yield from _impossible(found)
    if left := max((each.at_default for each in found), default=0):
        one = "{n} input has its default value and is not varied; {option} includes it"
        many = "{n} inputs have their default values and are not varied; {option} includes them"
        yield Counted(left, one, many, option=option)


def _tolerances(found: TolerancesRecord) -> Iterator[Phrase]:
    is_normal = found.distribution == "normal"
    way = Phrase("normal, {n} standard deviations", n=f"{IN_TOLERANCE:g}") if is_normal else phrase("uniform")
    scatter = (
        (each.name, _told(each.value, each.unit, 6), _told(each.tolerance, each.unit, 6)) for each in found.inputs
    )
    given = ", ".join(f"{name} {value} ± {size}" for name, value, size in scatter)
    template = "within tolerances ({way}; {n} machines, seed {seed}): {inputs}"
    yield Phrase(template, way=way, n=found.count, seed=found.seed, inputs=given)
    yield Phrase("  no check fails: {chance}", chance=_chance_told(found.whole))
    unsure = [each for each in found.checks if each.held < each.count]
    width = max((len(each.check) for each in unsure), default=0)
    for each in unsure:
        yield Phrase("  {check}  {chance}", check=each.check.ljust(width), chance=_chance_told(each))
    yield Phrase("  {n} checks hold in all of them", n=len(found.checks) - len(unsure))


def _chance_told(found: ChanceRecord) -> Phrase:
    shares = {"share": found.probability, "low": found.low, "high": found.high}
    percents = {name: localised(f"{100 * value:.4g}") for name, value in shares.items()}
    return Phrase("{share} % (95 %: {low} … {high} %), {n} of {total}", n=found.held, total=found.count, **percents)


def data(
    found: Sequence[Tornado],
    drawn: TolerancesRecord | None = None,
    sizes: Mapping[DesignInput, float] = MappingProxyType({}),
) -> dict[str, Any]:
    """Return the same as plain data, SI; ``sizes`` are the tolerances that were drawn within."""
    return {
        "schema_version": 1,
        "tornados": [
            {"name": each.asked.name, "unit": each.asked.si, "today": each.present, "still": each.still,
             "bars": [*map(_bar, each.bars), *(_bar(bar) | {"reason": why} for bar, why in each.impossible.items())],
             "at_default": each.at_default}
            for each in found
        ],
        "tolerances": drawn and {
            "inputs": {each.asked.path: size for each, size in sizes.items()},
            "distribution": drawn.distribution, "seed": drawn.seed, "count": drawn.count,
            "no_check_fails": _plain(drawn.whole), "checks": [_plain(each) for each in drawn.checks],
        },
    }  # fmt: skip


def _bar(bar: InputEffect) -> dict[str, Any]:
    return {"path": bar.design.asked.path, "unit": bar.design.meta.parsed_unit.si, "lowered": bar.lowered, "raised": bar.raised,
            "low": _known(bar.low), "high": _known(bar.high)}  # fmt: skip


def _plain(found: ChanceRecord) -> dict[str, Any]:
    return {"check": found.check, "held": found.held, "count": found.count, "probability": found.probability,
            "interval": [found.low, found.high]}  # fmt: skip


def page(found: Sequence[Tornado], drawn: TolerancesRecord | None, name: str) -> str:
    """Return the same as one HTML file without scripts or network, with a figure for each number."""
    from diecut_report.report.figures.by_type import render
    from diecut_report.report.model import TornadoFigure
    from diecut_report.report.pages import html as report_html
    from diecut_report.report.text import Catalogue

    parts, words = [], Catalogue(spoken_language())
    for index, (asked, each) in enumerate((each, each.record) for each in found):
        told = say("Influence of inputs on {asked}", asked=each.name)
        drawn_as = TornadoFigure(told, each.today, each.bars)
        figure = render(drawn_as, {}, words, f"tornado-{index}").text if each.bars else ""
        template = "In {unit}; blue: input increased; brown: input decreased; ×: cannot exist; line: present value."
        caption = say(template, unit=pretty(each.unit) or phrase("a fraction"))
        parts += [
            f"<h2>{html.escape(each.name)}</h2>",
            figure,
            f"<p>{html.escape(caption)}</p>",
            _block(_tornado_lines(asked)),
        ]
    parts += [f"<p>{html.escape(said(each))}</p>" for each in _left_out(found, "--defaults")]
    if drawn is not None:
        parts += [f"<h2>{say('Tolerances')}</h2>", _block(_tolerances(drawn))]
    title = html.escape(say("What matters: {file}", file=name))
    faces = report_html._font_faces(tuple(report_html.FACES.items()))
    return PAGE.format(title=title, body="\n".join(parts), faces=faces, version=__version__, language=spoken_language())


def _block(told: Iterable[str]) -> str:
    return f"<pre>{html.escape(chr(10).join(map(said, told)))}</pre>"


# What matters, for a chapter of the report: asked for in its configuration, calculated, and kept among the results.


PLACE = ("report", "influence")
Found = TypeVar("Found")


def influenced(config: Config) -> InfluenceRecord | None:
    """Return what the chapter tells; None where the configuration asks for none.

    UserError with the line where something is named there that this machine does not have.
    """
    asked = config.report.influence
    if asked is None:
        return None
    sizes = _sizes(config, asked)
    for index, name in enumerate(asked.of):
        _asked(config, index, name)
    found = _placed(config, ("of",), lambda: tornados(config, asked.of, asked.by, sizes, defaults=asked.defaults))
    drawn = within_tolerances(config, sizes, asked.distribution, asked.count, asked.seed) if sizes else None
    return InfluenceRecord(by=asked.by, tornados=[each.record for each in found], tolerances=drawn)


def misnamed(config: Config) -> list[Problem]:
    """Return what is wrong with what a configuration asks the chapter for, without calculating."""
    asked, problems = config.report.influence, list[Problem]()

    def judge(find: Callable[..., object], *given: Any) -> None:
        try:
            find(config, *given)
        except UserError as fault:
            problems.extend(fault.problems)

    if asked is not None:
        for name, size in (asked.tolerances or {}).items():
            judge(_tolerance, name, str(size))
        for index, name in enumerate(asked.of):
            judge(_asked, index, name)
        if not problems:
            judge(_sizes, asked)
    return problems


def _sizes(config: Config, asked: InfluenceSettings) -> dict[DesignInput, float]:
    sizes = [_tolerance(config, name, str(size)) for name, size in (asked.tolerances or {}).items()]
    return _placed(config, ("tolerances",), lambda: by_input(sizes))


def _asked(config: Config, index: int, name: str) -> object:
    return _placed(config, ("of", index), partial(quantity, config, name))


def _tolerance(config: Config, name: str, typed: str) -> tuple[DesignInput, float]:
    """An input and how far it scatters."""
    own = ("tolerances", name)
    design = _placed(config, own, lambda: free_input(config, name))
    try:
        size = parse_quantity(typed, design.meta.unit)
    except UnitError as fault:
        raise UserError(_problem(config, own, str(fault))) from None
    if not 0 < size < math.inf:
        raise UserError(_problem(config, own, Phrase("{name}: {size} is not above zero", name=name, size=typed)))
    _placed(config, own, lambda: by_input([(design, size)]))
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
