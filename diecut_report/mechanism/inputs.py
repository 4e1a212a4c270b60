"""Inputs of a mechanism: quantities with unit, bounds and description, as a pydantic model.

Values are SI floats once validated. Defaults and bounds are written in the display unit, as on the method sheet.
"""

from __future__ import annotations

import math
import operator
import reprlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal, get_args, get_origin

import numpy as np
from pydantic import BaseModel, ConfigDict
from pydantic.fields import FieldInfo

from diecut_report.mechanism.curve_inputs import (
    CurveInput,
    FromTable,
    InOtherUnit,
    MechanismInput,
    PhaseInput,
    by_validate,
    is_in,
)
from diecut_report.mechanism.names import SI, DeclaredKey, FromPress, Misdeclared, OneOf, Pending, Text
from diecut_report.quantities.plausible import Plausible, plausible
from diecut_report.quantities.units import Unit, UnitError, number_and_unit, parse_quantity, pretty, to_display, unit
from diecut_report.text.phrases import Phrase, joined, phrase

if TYPE_CHECKING:
    from pydantic._internal._model_construction import ModelMetaclass
else:
    ModelMetaclass = type(BaseModel)  # which pydantic names nowhere

# Hard bounds of a quantity, in the unit that it is declared in.


SAME = 1e-15  # share of a bound by which converting a unit and back may move a number
BOUNDS = (("gt", ">"), ("ge", "≥"), ("lt", "<"), ("le", "≤"))
HELD = (operator.gt, operator.ge, operator.lt, operator.le)


def within(shown: Any, limits: Sequence[float | None]) -> Any:
    """Return whether numbers keep the limits, which stand in the order of BOUNDS, each a number or None."""
    shown = as_typed(shown, limits)
    judged = [held(shown, limit) for limit, held in zip(limits, HELD, strict=True) if limit is not None]
    return np.logical_and.reduce(judged or [shown == shown]) if isinstance(shown, np.ndarray) else all(judged)


def as_typed(shown: Any, limits: Sequence[float | None]) -> Any:
    """Return numbers that are a limit but for the rounding of a unit's factor as that limit: 7 % in SI is not quite 0.07 · 100 %."""
    for limit in limits:
        if limit is not None:
            near = np.abs(shown - limit) <= SAME * abs(limit)
            shown = np.where(near, limit, shown) if isinstance(shown, np.ndarray) else limit if near else shown
    return shown


@dataclass(frozen=True)
class Quantity(DeclaredKey):
    """Declare a number with a unit: symbol, display unit, description and bounds (in the display unit, as the default is).

    The validated value is an SI float (an int where ``integer``). ``units`` are other units, each with the key beside which it holds:
    (("mass", "N/m"),).
    ``plausible`` are the least and the greatest size that a machine may have, zero aside, where they are not those of
    the kind of quantity (``quantities.plausible``): ("1 mm", "10 m"). ``words`` are texts that may stand in place of a number,
    and are taken as they are. ``or_unit`` is another kind of unit in which it may be given: it is then an ``InOtherUnit``.
    ``listed`` are the only numbers that are allowed.
    """

    symbol: str
    unit: str
    description: str
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None
    integer: bool = False
    press: FromPress | None = None
    units: tuple[tuple[str, str], ...] = ()
    plausible: tuple[str, str] | None = None
    words: tuple[str, ...] = ()
    or_unit: str = ""
    listed: tuple[float, ...] = ()
    __get_pydantic_core_schema__ = by_validate

    def __post_init__(self) -> None:
        if self.press:  # which stands in
            object.__setattr__(self, "optional", True)

    @property
    def form(self) -> Any:
        """Return what its value is when it is given."""
        return int if self.integer else float

    @cached_property
    def parsed_unit(self) -> Unit:
        """Return the display unit with its factor and kind."""
        return unit(self.unit)

    @property
    def other(self) -> Quantity:
        """Return it as it is in the other kind of unit, in which of its bounds zero alone means the same."""
        bounds: dict[str, Any] = {name: 0 if getattr(self, name) == 0 else None for name, _ in BOUNDS}
        return replace(self, unit=self.or_unit, or_unit="", plausible=None, **bounds)

    def of_unit(self, si: str | None) -> Quantity:
        """Return it as it is where its value has this SI unit: its own, or the other kind of unit; never both."""
        if not self.or_unit:
            return self
        return self.other if si == self.other.parsed_unit.si else replace(self, or_unit="")

    @property
    def allowed(self) -> str:
        """Return the range in words, for example ``> 0 mm, ≤ 80 mm``; empty without bounds."""
        limits = [(sign, getattr(self, name)) for name, sign in BOUNDS]
        shown = pretty(self.unit)
        if self.listed:
            return f"{', '.join(f'{value:g}' for value in self.listed)} {shown}".rstrip()
        return ", ".join(f"{sign} {limit:g} {shown}".rstrip() for sign, limit in limits if limit is not None)

    def validate(self, given: Any) -> Any:
        """Return the SI value of what was given; ValueError in words where it is not allowed."""
        match given:
            case str() if given.strip() in self.words:
                return given.strip()
            case str() if self.or_unit and is_in(given, self.or_unit):
                return InOtherUnit(self.other.validate(given), self.or_unit)
            case Pending(unit=str() as other) if self.or_unit and unit(other).kind == self.other.parsed_unit.kind:
                return given
            case SI(unit=other) if self.or_unit and unit(other).kind == self.other.parsed_unit.kind:
                return InOtherUnit(self.other.validate(given), self.or_unit)
            case None:
                raise ValueError(
                    Phrase("has no value; give a number in {text} or remove the key", text=pretty(self.unit) or 'plain form')
                )  # fmt: skip
            case Pending(unit=None):
                raise ValueError(Phrase("${{path}} is not a number; a quantity in {unit} is needed", path=given.path, unit=self.unit))  # fmt: skip
            case Pending(is_curve=True):
                raise ValueError(Phrase("${{path}} is a curve; a single number is needed here", path=given.path))
            case Pending(unit=str() as other):
                self._same_kind(other, f"${{{given.path}}}")
                return given
            case SI(value=value, unit=other, told=told):
                self._same_kind(other, told)
                if isinstance(value, np.ndarray):  # of many machines: each is judged on its own
                    return value
                origin = Phrase("{to_display} {pretty} (from {told})", to_display=f"{to_display(value, self.unit):.6g}",
                    pretty=pretty(self.unit), told=told)  # fmt: skip
                return self._bounded(value, origin, calculated=True)
            case bool() | list() | dict():
                kind = phrase("a block of keys") if isinstance(given, dict) else str(given).lower()
                kind = phrase("a list") if isinstance(given, list) else kind
                template = "is {kind}; a number or a text such as “{rstrip}” is needed"
                raise ValueError(Phrase(template, kind=kind, rstrip=f"10 {pretty(self.unit)}".rstrip()))
        value = self._parsed(given)
        return self._bounded(value, given if isinstance(given, str) else f"{given} {pretty(self.unit)}")

    def _parsed(self, given: Any) -> float:
        try:
            return parse_quantity(given, self.unit)
        except ValueError as fault:
            others = [*self.words, *([f"10 {pretty(self.or_unit)}"] if self.or_unit else [])]
            if not others:
                raise
            raise ValueError(
                Phrase("{fault} Allowed, too: {others}.", fault=fault.args[0], others=", ".join(others))
            ) from None

    def _same_kind(self, other: str, told: str) -> None:
        if unit(other).kind != self.parsed_unit.kind:
            raise ValueError(Phrase("{told} is in {other}; a quantity in {unit} is needed here", told=told, other=other, unit=self.unit))  # fmt: skip

    def _meant(self, typed: str) -> str:
        """Ask for the key's own unit where the number of a refused quantity would be allowed in it: 105 mm in place of 105 m."""
        try:
            number, own = number_and_unit(typed)
            is_other = bool(own) and unit(own) != self.parsed_unit
        except UnitError:  # of what is not typed: a value with the reference that gives it
            return ""
        if not is_other or not self.holds(np.array(float(number) * self.parsed_unit.factor)):
            return ""
        return Phrase(". Is {quantity} meant?", quantity=f"{number} {pretty(self.unit)}".rstrip())

    def _bounded(self, value: float, told: str, *, calculated: bool = False) -> float | int:
        shown = value / self.parsed_unit.factor
        if not math.isfinite(shown):
            raise ValueError(Phrase("{strip} is not a finite number", strip=told.strip()))
        if not self._within(shown):
            raise ValueError(Phrase("{strip} is out of range; allowed: {allowed}{meant}", strip=told.strip(),
                allowed=self.allowed, meant=self._meant(told)))  # fmt: skip
        if not self.sizes.holds(value, calculated=calculated):
            raise ValueError(Phrase("{strip} is not plausible; {plausible_sizes}{meant}", strip=told.strip(),
                plausible_sizes=self.plausible_sizes, meant=self._meant(told)))  # fmt: skip
        if self.integer and not float(shown).is_integer():
            raise ValueError(Phrase("{strip} is not a whole number", strip=told.strip()))
        return int(shown) if self.integer else value + 0.0  # no minus zero

    def _within(self, shown: Any) -> Any:
        held = within(shown, (self.gt, self.ge, self.lt, self.le))
        return held & np.isin(np.round(np.clip(shown, -1e99, 1e99), 9), self.listed) if self.listed else held

    @cached_property
    def sizes(self) -> Plausible:
        """Return the plausible sizes: those declared, else those of the kind of quantity."""
        own = Plausible(*self.plausible) if self.plausible else None
        return own if own and own.kind == self.parsed_unit.kind else plausible(self.unit)

    @property
    def plausible_sizes(self) -> str:
        """Return the plausible sizes in words, with the zero where the bounds allow it."""
        return Phrase("plausible: {told}", told=self.sizes.told) + (phrase(", or 0") if self._within(0.0) else "")

    def holds(self, values: Any, *, calculated: bool = False) -> Any:
        """Return which numbers (an array, SI) are allowed; what is ``calculated`` may be smaller than what is typed."""
        shown = values / self.parsed_unit.factor
        whole = shown == np.round(shown) if self.integer else True
        return np.isfinite(shown) & self._within(shown) & whole & self.sizes.holds(values, calculated=calculated)


class KeysByAssignment(ModelMetaclass):
    """Let the keys of a block be declared by assignment: what is assigned says what the key takes, and what it is where nobody gives it."""

    def __new__(cls, name: str, bases: tuple[type, ...], attributes: dict[str, Any], **options: Any) -> Any:
        declared = {key: each for key, each in attributes.items() if isinstance(each, DeclaredKey)}
        for key, each in attributes.items():
            if isinstance(each, PLAIN) and not key.startswith("_") and not any(hasattr(base, key) for base in bases):
                _refuse_plain(key, each, attributes)
        if declared:
            attributes.setdefault("__annotations__", {})
        for key, each in declared.items():
            del attributes[key]
            attributes["__annotations__"][key.rstrip("_")] = each.given_as
            if each.otherwise is not ...:
                attributes[key.rstrip("_")] = each.otherwise
        attributes["assigned"] = frozenset(key.rstrip("_") for key in declared)
        return super().__new__(cls, name, bases, attributes, **options)


PLAIN = (str, int, float, tuple, list, dict, type(None), FieldInfo)


def _refuse_plain(key: str, given: Any, attributes: Mapping[str, Any]) -> None:
    """Refuse a plain value among the keys, unless it is the default of one that is annotated."""
    if key not in attributes.get("__annotations__", {}):
        template = '{key} = {given} does not say what the key takes; write {key} = Quantity("SYMBOL", "UNIT", "description"), or Text("description")'
        raise Misdeclared(Phrase(template, key=key, given=reprlib.repr(given)))


class Block(BaseModel, metaclass=KeysByAssignment):
    """Declare a block of inputs inside a mechanism, or one of a list of repeated parts: ``length = Quantity("l", "mm", "Length", gt=0)``.

    A key that is a word of Python has an underscore behind it: ``from_``.
    """

    # arbitrary types are refused by the declaration check
    model_config = ConfigDict(extra="forbid", validate_default=True, frozen=True, arbitrary_types_allowed=True)
    assigned: ClassVar[frozenset[str]] = frozenset()
    """Keys of this class alone that are declared by assignment; those of the program's own files are annotated."""
    one_of: ClassVar[tuple[OneOf, ...]] = ()
    spread: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    """Keys whose value may be a list, each with the single keys that the values of the list stand for, in order."""
    curve_keys: ClassVar[Mapping[str, str]] = {}
    """Keys of numbers whose value may be a curve, each with the key that takes the curve; one of both is needed (``one_of``)."""
    from_tables: ClassVar[tuple[FromTable, ...]] = ()
    """Keys whose text may name an entry of the user's own tables, with the keys that it gives."""


class Inputs(Block):
    """Declare the base of a mechanism's inputs: one key of the config for each attribute."""


def parts(block: type[Block], description: str, *, optional: bool = False) -> Text:
    """Declare a list of repeated parts, each a block; an ``optional`` one may be empty."""
    return Text(description, block=_block(block), many=True, optional=optional)


def block(block: type[Block], description: str, *, suffix: str = "", optional: bool = False, **words: str) -> Text:
    """Declare a block of keys within the inputs.

    Of several of one class each has a ``suffix`` for its symbols (r_a, r_b), and words for the places in its descriptions:
    ``block(Link, "Lower link", suffix="a", link="lower link")`` of a class whose key is "Length of the {link}".
    """
    own = _block(block)
    return Text(description, block=_worded(own, suffix, words) if suffix or words else own, optional=optional)


def _worded(model: type[Block], suffix: str, words: Mapping[str, str]) -> type[Block]:
    keys: dict[str, Any] = {"__module__": model.__module__, "__doc__": model.__doc__}
    for name in model.model_fields:
        meta = meta_of(model, name)
        assert meta is not None, "keys of a block are declared by assignment"
        symbol = f"{meta.symbol}{',' if '_' in meta.symbol else '_'}{suffix}" if suffix and meta.symbol else meta.symbol
        keys[name] = replace(meta, symbol=symbol, description=_with_words(meta.description, words, name))
    made: type[Block] = KeysByAssignment(f"{model.__name__}_{suffix}" if suffix else model.__name__, (model,), keys)
    return made


def _with_words(description: str, words: Mapping[str, str], name: str) -> str:
    try:
        return description.format(**words)
    except KeyError as missing:
        template = "the description of {name} has a place {place}, for which block(…) has no words; write {place}="
        raise Misdeclared(Phrase(template, name=name, place=missing.args[0])) from None


def _block(given: Any) -> type[Block]:
    if isinstance(given, type) and issubclass(given, Block):
        return given
    template = (
        "{given} is not a block of inputs; write class {name}(Block), with a key for each of its numbers and texts"
    )
    raise Misdeclared(Phrase(template, given=repr(given), name=getattr(given, "__name__", "Part")))


@dataclass(frozen=True)
class Samples(Quantity):
    """Declare how many samples of each curve are listed, on which no other number depends."""


def samples(default: int) -> Samples:
    """Declare the key ``n_points``: how many samples of each curve are listed."""
    return Samples("N", "1", phrase("Samples of each curve"), ge=36, le=100_000, integer=True, default=default)


Referred = CurveInput | PhaseInput | MechanismInput
"""What stands for something of another mechanism that is no single number."""

Meta = Quantity | Text | Referred


def meta_of(model: type[Block], name: str) -> Meta | None:
    """Return what a field declares of itself."""
    return next((m for m in model.model_fields[name].metadata if isinstance(m, Quantity | Text | Referred)), None)


def nested(annotation: Any) -> tuple[type[Block], bool] | None:
    """Return the block type behind a field's annotation, and whether the field is a list of it."""
    if isinstance(annotation, type) and issubclass(annotation, Block):
        return annotation, False
    inner = [found for found in map(nested, get_args(annotation)) if found]
    if not inner:
        return None
    return inner[0][0], inner[0][1] or get_origin(annotation) is list


@dataclass(frozen=True)
class Key:
    """Hold an input (or a block of inputs): whether it may be left out, its allowed texts, the list whose parts have it."""

    path: str
    meta: Meta | None = None
    annotation: Any = None
    block: type[Block] | None = None
    is_list: bool = False
    may_be_absent: bool = True
    default: Any = None
    home: str = ""

    @property
    def has_default(self) -> bool:
        """Return whether it has a value where nobody gives one."""
        return self.default is not None

    @cached_property
    def texts(self) -> tuple[str, ...]:
        """Return the texts that it may be, as they stand in tokens; none where it takes any."""
        return allowed(self.annotation, self.meta)


@cache
def keys(model: type[Block]) -> Mapping[str, Key]:
    """Return all inputs and blocks of a model by their paths (``gears.driver_teeth`` for a field of a block or of a list's parts)."""
    return {key.path: key for key in _keys(model)}


def _keys(model: type[Block], prefix: str = "", home: str = "") -> Iterator[Key]:
    for name, declared in model.model_fields.items():
        block, is_list = nested(declared.annotation) or (None, False)
        meta, path = meta_of(model, name), f"{prefix}{name}"
        default = declared.get_default(call_default_factory=True)
        from_press = isinstance(meta, Quantity) and meta.press is not None and not meta.press.optional
        may_be_none = type(None) in get_args(declared.annotation)  # with a default too: a model may put it to None
        absent = not declared.is_required() and (default == [] or may_be_none) and not from_press
        default = None if declared.is_required() or default == [] else default
        yield Key(path, meta, declared.annotation, block, is_list, absent, default, home)
        if block:
            yield from _keys(block, f"{path}.", path if is_list else home)


@cache
def rules(model: type[Block]) -> tuple[tuple[str, OneOf], ...]:
    """Return of which keys one group is needed, each rule with the path of the block that it is for."""
    own = [("", rule) for rule in model.one_of]
    blocks = [(key.path, key.block) for key in keys(model).values() if key.block and not (key.is_list or key.home)]
    return (*own, *((f"{path}.", rule) for path, block in blocks for rule in block.one_of))


def allowed(annotation: Any, meta: Meta | None) -> tuple[str, ...]:
    """Return the texts that an input may be, as they stand in tokens; none where it takes any."""
    if isinstance(meta, Text) and meta.options:
        return tuple(meta.options)
    found: list[str] = []
    for part in (annotation, *get_args(annotation)):
        if get_origin(part) is Literal:
            found += [str(text).lower() if isinstance(text, bool) else str(text) for text in get_args(part)]
        elif part is bool:
            found += ["true", "false"]
    return tuple(found)


@cache
def fields(model: type[Block]) -> tuple[tuple[str, Meta], ...]:
    """Return each declared input by its path, without the blocks."""
    return tuple((key.path, key.meta) for key in keys(model).values() if not key.block and key.meta is not None)


def texts_given(values: Mapping[str, Any]) -> set[str]:
    """Return for each text (or yes/no) input the token ``key=value``, by which steps may be chosen."""
    return {f"{name}={str(value).lower() if isinstance(value, bool) else value}" for name, value in values.items()
            if isinstance(value, str | bool)}  # fmt: skip


def flatten(block: Block, prefix: str = "", within_part: bool = False) -> dict[str, Any]:
    """Return the validated inputs by id, SI; the parts of a list as a tuple for each of their fields; absent ones left out.

    A list within the parts of a list (``within_part``) stays one of blocks.
    """
    flat: dict[str, Any] = {}
    for name in type(block).model_fields:
        value = getattr(block, name)
        match value:
            case None | []:
                continue
            case Block():
                flat |= {prefix + name: True} | flatten(value, f"{prefix}{name}.")
            case [str(), *_]:
                flat[prefix + name] = tuple(value)
            case [Block(), *_] if within_part:
                flat[prefix + name] = tuple(value)
            case [Block(), *_]:
                rows = [flatten(part, f"{prefix}{name}.", within_part=True) for part in value]
                keys = dict.fromkeys(key for row in rows for key in row)
                flat |= {prefix + name: True} | {key: tuple(row.get(key) for row in rows) for key in keys}
            case _:
                flat[prefix + name] = value
    return flat


# Inputs that repeat: the lists of parts that a block of inputs declares.


@cache
def list_inputs(model: type[Block]) -> Mapping[str, str]:
    """Return the paths of the inputs that come in rows, one for each part of a list, each with the path of its list."""
    lists = [key.path for key in keys(model).values() if key.is_list and not key.home]
    return {path: home for path, _ in fields(model) for home in lists if path.startswith(f"{home}.")}


def list_titles(model: type[Block]) -> dict[str, str]:
    """Return what each list of repeated parts is, by its path."""
    lists = (key for key in keys(model).values() if key.is_list and not key.home)
    return {key.path: key.meta.description for key in lists if key.meta is not None}


# Inputs that are a number or vary over a cycle: a number, a curve by reference, or extremes alone; a list's parts may differ in it.


@dataclass(frozen=True)
class Extremes:
    """Hold the least and the greatest value of what varies in a way that is not known, SI."""

    low: float
    high: float


@dataclass(frozen=True)
class Varying(Quantity):
    """Declare a quantity that is a number or a curve by reference.

    The validated value is an SI float, the referred curve, with ``extremes`` also ``Extremes`` from a block ``{min, max}``, or one of
    the texts ``words``. Only plain code takes it (``Prepared``).
    """

    extremes: bool = False

    @property
    def form(self) -> Any:
        """Return what its value is when it is given."""
        return Any

    def validate(self, given: Any) -> Any:
        """Return what the plugin's code takes; ValueError in words where it is not allowed."""
        if isinstance(given, Pending) and given.is_curve:
            if given.unit is None or unit(given.unit).kind != self.parsed_unit.kind:
                template = "${{path}} is not a curve in {unit}, but in {own}"
                raise ValueError(Phrase(template, path=given.path, unit=pretty(self.unit), own=given.unit))
            return given
        if isinstance(given, Extremes) or hasattr(given, "curve_id"):
            return given
        if isinstance(given, dict):
            return self._extremes(given)
        try:
            return super().validate(given)
        except ValueError as fault:
            raise ValueError(Phrase("{fault}{ways}", fault=fault, ways=self._ways(given))) from None

    def _ways(self, given: Any) -> str:
        """What else would be allowed, where something else than a number was given."""
        if not isinstance(given, str) or not given[:1].isalpha():
            return ""
        ways = [phrase("a reference to a curve"), *(f"“{word}”" for word in self.words)]
        return Phrase("; or give {ways}", ways=joined(ways, ", or "))

    def _extremes(self, given: dict[Any, Any]) -> Extremes:
        if not self.extremes:
            raise ValueError(phrase("is a block of keys; a number or a reference to a curve is needed"))
        if set(given) != {"min", "max"}:
            raise ValueError(phrase("is a block of keys; as a block it has the keys min and max, and no others"))
        low, high = (super(Varying, self).validate(given[key]) for key in ("min", "max"))
        if not isinstance(low, Pending) and not isinstance(high, Pending) and low > high:
            raise ValueError(phrase("has a min above its max; exchange them"))
        return Extremes(low, high)
