"""Quantities with units: texts such as "21 kN" to SI numbers and back, with the dimension checked.

Everyday units come from `units_table.json`, which `tools/make_units_table.py` makes from pint. Any other unit is
read by pint itself, which is imported only then.
The plane angle counts as a dimension of its own here, so that an angular speed (rpm, rad/s) and a frequency (1/min,
Hz) are different kinds.
"""

from __future__ import annotations

import difflib
import json
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from decimal import Decimal
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from diecut_report.errors import MAX_QUANTITY, latin_letters, lookalikes
from diecut_report.text.phrases import MessageError, Phrase, phrase

# The usual spellings of units ("kg·m²", "kg m^2", "Nm", "m/s2") and the one that the program looks up ("kg*m**2").


_CHARACTERS = str.maketrans(
    {"·": "*", "⋅": "*", "×": "*", "∙": "*", "µ": "u", "μ": "u", "−": "-", "∕": "/", "⁄": "/", "º": "°", "^": "**"}
)
_SUPERSCRIPTS = {"⁰": "0", "¹": "1", "²": "2", "³": "3", "⁴": "4", "⁵": "5", "⁶": "6", "⁷": "7", "⁸": "8", "⁹": "9"}
_SUPERSCRIPT = re.compile("(⁻?)([" + "".join(_SUPERSCRIPTS) + "]+)")
_GLUED = re.compile(r"(/?)(?<!\w)((?:[kMm]?N|kg|g)(?=mm|cm|m))(m|mm|cm)(\*\*-?\d+)?(?!\w)")

_CYRILLIC = {
    "мкм": "um", "мм": "mm", "см": "cm", "дм": "dm", "м": "m", "км": "km", "мг": "mg", "г": "g", "кг": "kg", "т": "t", "мкс": "us",
    "мс": "ms", "с": "s", "хв": "min", "мин": "min", "год": "h", "ч": "h", "мН": "mN", "Н": "N", "кН": "kN", "МН": "MN", "Нм": "N*m",
    "кНм": "kN*m", "кгм": "kg*m", "Па": "Pa", "кПа": "kPa", "МПа": "MPa", "ГПа": "GPa", "мВт": "mW", "Вт": "W", "кВт": "kW", "МВт": "MW", "Дж": "J",
    "кДж": "kJ", "МДж": "MJ", "Гц": "Hz", "кГц": "kHz", "рад": "rad", "мрад": "mrad", "град": "deg", "об": "revolution", "К": "K",
}  # fmt: skip
"""Signs of units in Ukrainian, and those of minute and hour in Russian: whole words, for с is a second and С not."""
_ANY_CASE = {sign.casefold(): latin for sign, latin in _CYRILLIC.items()}
_LETTERS = re.compile("[A-Za-z\u0400-\u04ff]+")


def _latin(text: str) -> str:
    """Return a unit's text with Cyrillic signs (мм, Н·м, об/хв) as the Latin ones; a word that is no such sign stays."""
    if text.isascii():
        return text
    text = text.replace("°С", "°C").replace("об/хв", "rpm").replace("об/мин", "rpm")
    return _LETTERS.sub(lambda match: _CYRILLIC.get(match[0], match[0]), text)


def normalised(text: str) -> str:
    """Return a unit's text in the one spelling that the table of units and pint know."""
    text = " ".join(text.split())  # a run of blanks would be searched again from each of them
    text = _latin(text).translate(_CHARACTERS).replace("°C", "degC").replace("°F", "degF").replace("°", "deg")
    text = _SUPERSCRIPT.sub(_plain_exponent, text)
    text = re.sub(r"\s*(\*\*|[*/()])\s*", r"\1", text.strip())
    text = re.sub(r"\s+|(?<=\))(?=\w)", "*", text)
    text = re.sub(r"(?<=[^\W\d])(-?\d+)(?!\w)", r"**\1", text)
    text = _GLUED.sub(_unglued, text)
    return "1" + text if text.startswith("/") else text


def _plain_exponent(match: re.Match[str]) -> str:
    return "**" + match[1].replace("⁻", "-") + "".join(_SUPERSCRIPTS[digit] for digit in match[2])


def _unglued(match: re.Match[str]) -> str:
    slash, first, second, power = match.groups(default="")
    return f"/({first}*{second}{power})" if slash else f"{first}*{second}{power}"


def suggestion(text: str, known: Iterable[str]) -> str:
    """Return the unit that may be meant, to append; nothing where none is near, or more than a unit stands there."""
    text = text.strip()
    latin = _LETTERS.sub(lambda match: _ANY_CASE.get(match[0].casefold(), latin_letters(match[0])), text)
    names, meant = list(known), normalised(latin)
    same_letters = [name for name in names if name.casefold() == meant.casefold()]
    if not same_letters and not re.search(r"\s", text):
        same_letters = difflib.get_close_matches(meant, names, n=1, cutoff=0.6)
    found = meant if meant in same_letters else next(iter(same_letters), "")
    if not found:
        return ""
    is_mixed = any(re.search("[A-Za-z]", word) and lookalikes(word) for word in _LETTERS.findall(text))
    if is_mixed:  # мM and the like: to the eye it is the unit
        return Phrase(" Did you mean {unit}? {letters} only looks Latin.", unit=found, letters=lookalikes(text))
    return Phrase(" Did you mean {same_letters}?", same_letters=found)


TABLE_FILE = Path(__file__).with_name("units_table.json")
DIMENSIONS = ("mass", "length", "time", "temperature", "current", "substance", "luminosity", "angle")
BASE_UNITS = ("kg", "m", "s", "K", "A", "mol", "cd", "rad")
MAX_UNIT_LENGTH = 60

Kind = tuple[float, ...]


class UnitError(MessageError, ValueError):
    """A unit or a quantity that cannot be used; the text says why and what to write instead."""


@dataclass(frozen=True)
class Unit:
    """A unit of measure: `text` is its ASCII form that pint reads, `factor` the SI value of one unit.

    `si` is the coherent SI unit as results write it; `kind` the exponents of DIMENSIONS, the angle included.
    """

    text: str
    factor: float
    si: str
    kind: Kind

    def to_si(self, value: float | Decimal) -> float:
        """SI value of `value` units, rounded once: 7.3 um give 7.3e-06 m, not 7.2999999999999996e-06."""
        multiplier, divisor = _ratio(self.factor)
        return float((value if isinstance(value, Decimal) else Decimal(repr(float(value)))) * multiplier / divisor)

    def from_si(self, value: float) -> float:
        """Number of units in an SI value, rounded once."""
        return float(self._number(repr(float(value))))

    def exactly(self, value: float) -> Decimal:
        """Return the number of units with so many digits that `to_si` gives the value again, also where its shortest text is a tie."""
        short = self._number(repr(float(value)))
        return short if self.to_si(short) == value else self._number(value)

    def _number(self, value: str | float) -> Decimal:
        multiplier, divisor = _ratio(self.factor)
        return Decimal(value) * divisor / multiplier


@cache
def _ratio(factor: float) -> tuple[Decimal, Decimal]:
    # 1/60 and 1/3600 have no short decimal form, but their inverse has.
    inverse = round(1.0 / factor) if factor < 1.0 else 0
    return (
        (Decimal(1), Decimal(inverse)) if inverse and 1.0 / inverse == factor else (Decimal(repr(factor)), Decimal(1))
    )


@cache
def _table() -> dict[str, Any]:
    table: dict[str, Any] = json.loads(TABLE_FILE.read_text(encoding="utf-8"))
    return table


_TWO_MEANINGS = {"grad": ("deg", "gon"), "ton": ("t", "short_ton"), "tons": ("t", "short_ton"), "gr": ("g", "grain")}
"""Names that pint reads as a unit which is rarely meant here: a gon is 0.9°, the American ton has 907 kg, a grain 65 mg."""

_FACTOR = r"\(*(?:[^\W\d]\w*|%)(?:\*\*-?[1-9]\d?)?\)*"  # no power of zero: "4O0 mm" is a slip
_GRAMMAR = re.compile(rf"(?:1/)?{_FACTOR}(?:[*/]{_FACTOR})*")


def unit(text: str) -> Unit:
    """The unit that a text names, in any usual spelling: "kg*m**2", "kg·m²", "kg m^2", "Nm", "°", "m/s2".

    Raises UnitError, with a suggestion where one is near, for what is not a unit or has no fixed zero (degC).
    """
    found = _unit_or_fault(text)
    if isinstance(found, UnitError):
        raise UnitError(*found.args)
    return found


@lru_cache(maxsize=2048)
def _unit_or_fault(text: str) -> Unit | UnitError:
    """A fault is remembered too: to seek what is near takes as long as a thousand units, and a table may hold ten million."""
    canonical = _canonical(text)
    known = _table()["units"].get(canonical)
    if known is None:
        try:
            return _read_with_pint(canonical, text)
        except UnitError as error:
            return error.with_traceback(None)
    factor, family = known
    entry = _table()["families"][family]
    return Unit(canonical, factor, entry["si"], tuple(entry["kind"]))


def _canonical(text: str) -> str:
    for spelling in (text.strip(), normalised(text)):
        if spelling in _table()["units"]:
            return spelling
        if spelling in _table()["aliases"]:
            return str(_table()["aliases"][spelling])
    return spelling


def _read_with_pint(canonical: str, typed: str) -> Unit:
    for word in re.findall(r"\w+", canonical):
        if meant := _TWO_MEANINGS.get(word):
            template = "{text} may be {one} or {other}; write the one that is meant."
            raise UnitError(template, text=_shortened(typed), one=meant[0], other=meant[1])
    # The grammar also bounds what pint is given: no numbers, no towers of powers.
    readable = len(canonical) <= MAX_UNIT_LENGTH and _GRAMMAR.fullmatch(canonical)
    measured = measure_with_pint(canonical) if readable else None
    if measured is None:
        template = "{text} is not a known unit.{suggestion}"
        raise UnitError(
            template, text=_shortened(typed), suggestion=suggestion(typed[:MAX_UNIT_LENGTH], _table()["units"])
        )
    factor, kind = measured
    return Unit(canonical, factor, si_text(kind), kind)


def _shortened(text: str) -> str:
    return repr(text if len(text) <= MAX_UNIT_LENGTH else text[: MAX_UNIT_LENGTH - 1] + "…")


@cache
def decades(of: Unit) -> tuple[Unit, ...]:
    """Return the everyday units of the same kind that are some powers of ten of a unit, and the SI unit: m, cm, um … for mm."""
    kinds = [tuple(family["kind"]) for family in _table()["families"]]
    alike = [unit(text) for text, (_, family) in _table()["units"].items() if kinds[family] == of.kind]
    shares = [(math.log10(each.factor / of.factor), each) for each in alike]
    powers = [(each, abs(share - round(share)) <= 1e-9) for share, each in shares if share]
    return tuple(each for each, is_power in powers if is_power or each.factor == 1)


def _family(kind: Kind, si: str = "") -> dict[str, Any] | None:
    alike = [family for family in _table()["families"] if tuple(family["kind"]) == kind]
    exact = [family for family in alike if family["si"] == si]
    return next(iter(exact or alike), None)


def times(one: Kind | None, other: Kind | None, power: float = 1) -> Kind | None:
    """Return the kind of a product with a power of the other factor; None, that of zero, where one of them is zero."""
    if one is None or other is None:
        return None
    return tuple(round(a + power * b, 9) for a, b in zip(one, other, strict=True))


def si_text(kind: Kind) -> str:
    """The coherent SI unit of a kind, made of base units where it has no name of its own."""
    if family := _family(kind):
        return str(family["si"])
    powers = [(base, exponent) for base, exponent in zip(BASE_UNITS, kind, strict=True) if exponent]
    above = [_power(base, exponent) for base, exponent in powers if exponent > 0]
    below = [_power(base, -exponent) for base, exponent in powers if exponent < 0]
    return "/".join(["*".join(above) or "1", *below])


def _power(base: str, exponent: float) -> str:
    return base if exponent == 1 else f"{base}**{exponent:g}"


_SI_PREFIX = "quetta|ronna|yotta|zetta|exa|peta|tera|giga|mega|kilo|hecto|dec[ai]|deka|centi|milli|micro|nano|pico|femto|atto|zepto|yocto"
_MISTYPED = re.compile(rf"(?:{_SI_PREFIX})(?:minute|hour|day|week|month|year|inch|foot|percent)")  # 1/hh is a slip


@cache
def _pint_registry() -> Any:
    """Pint's own definitions with the radian as a base unit, in exact fractions; to read them takes about half a second."""
    from fractions import Fraction

    import pint

    folder = Path(pint.__file__).parent
    constants = (folder / "constants_en.txt").read_text(encoding="utf-8")
    text = (folder / "default_en.txt").read_text(encoding="utf-8").replace("@import constants_en.txt", constants)
    return pint.UnitRegistry(text.replace("radian = []", "radian = [angle]").splitlines(), non_int_type=Fraction)


def measure_with_pint(text: str) -> tuple[float, Kind] | None:
    """SI factor and kind of a unit by pint; None for what pint does not know, or no float can hold. UnitError for a shifted zero (degC)."""
    registry = _pint_registry()
    try:
        units = registry.parse_units(text)
        one, two = (registry.Quantity(number, units).to_base_units().magnitude for number in (1, 2))
    except Exception:  # pint raises a dozen unrelated types (AssertionError, TokenError, …) for what it cannot read
        return None
    if any(_MISTYPED.fullmatch(name) for name, _ in registry.Quantity(1, units).unit_items()):
        return None
    if two != 2 * one:
        raise UnitError("{text} has no fixed zero; give a temperature difference in K.", text=text)
    exponents = {str(name).strip("[]"): float(power) for name, power in units.dimensionality.items()}
    if not exponents.keys() <= set(DIMENSIONS):
        return None
    try:
        factor = float(one)
    except OverflowError:
        return None
    return (factor, tuple(exponents.get(name, 0.0) for name in DIMENSIONS)) if factor else None


_QUANTITY = re.compile(r"([+-]?(?:[0-9]+(?:\.[0-9]*|,[0-9]+)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)(?!_)(.*)", re.DOTALL)
_GROUPED = re.compile(
    r"([+-]?[1-9][0-9]{0,2}((?!\n)[\s'’,.])[0-9]{3}(?:\2[0-9]{3})*)(?:(?!\2)[.,]([0-9]+))?(?![0-9.,])(.*)", re.DOTALL
)


def parse_quantity(value: int | float | str, unit_text: str) -> float:
    """SI value of a quantity as a user gives it: a bare number counts in `unit_text`, a text may carry its own unit.

    A decimal comma and Cyrillic signs of units are read ("470,7 мм"). Raises UnitError for another dimension, no number, a number
    that may be read in two ways ("1,000 mm"), NaN or infinity.
    """
    if isinstance(value, str):
        return _parse_text(value, unit_text)
    if isinstance(value, bool):
        raise _unfit(str(value).lower(), phrase("is not a quantity"), unit(unit_text))
    try:
        return _finite(unit(unit_text).to_si(float(value)), f"{value:g}" if isinstance(value, float) else phrase("The number"))  # fmt: skip
    except OverflowError:
        raise UnitError("The number is too large to calculate with.") from None


@lru_cache(maxsize=4096)
def _parse_text(text: str, unit_text: str) -> float:
    wanted = unit(unit_text)
    number, own = number_and_unit(text, wanted)
    try:
        given = unit(own) if own else wanted
    except UnitError as error:
        raise UnitError(_and_needed(error, wanted)) from None
    if given.kind != wanted.kind:
        raise _unfit(text.strip(), Phrase("is {kind}", kind=phrase(kind_name(given))), wanted)
    return _finite(given.to_si(number), _shortened(text))


def _unfit(text: str, fault: str, wanted: Unit | None) -> UnitError:
    return UnitError("{text} {fault}; {needed}.", text=text, fault=fault, needed=_needed(wanted))


def _and_needed(fault: object, wanted: Unit | None) -> str:
    return Phrase("{fault} {needed:capital}.", {"fault": fault, "needed:capital": _needed(wanted)})


def number_and_unit(text: str, wanted: Unit | None = None) -> tuple[Decimal, str]:
    """Split a quantity into its number and its unit, which is "" where it has none ("3", "3 mm", "3 * mm", "3,5 мм").

    The unit has Latin letters. Raises UnitError, which names the `wanted` unit, for a text that does not begin with one finite
    number, or whose number may be read in two ways.
    """
    if len(text) > MAX_QUANTITY:
        template = "{text} has {count} characters; a number with a unit has at most {most}."
        raise UnitError(
            _and_needed(Phrase(template, text=_shortened(text), count=len(text), most=MAX_QUANTITY), wanted)
        )
    text = text.strip().replace("−", "-")
    _refuse_groups(text)
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise _unfit(_shortened(text), phrase("does not begin with a finite number"), wanted)
    own = match[2].strip().removeprefix("*").strip()
    if len(text.splitlines()) > 1 or (re.match(r"[0-9.,+-]", own) and not own.startswith("1/")):
        raise _unfit(_shortened(text), phrase("is not one number and a unit"), wanted)
    digits = match[1].replace(",", ".")
    number = float(digits)
    # all digits count: a share written in percent may need more of them than a float has
    return Decimal(digits if number and math.isfinite(number) else repr(number)), _latin(own)


def _refuse_groups(text: str) -> None:
    """Ask what a number with three digits behind a separator is: 1,000 mm may be a thousand or one."""
    match = _GROUPED.fullmatch(text)
    if match is None or (match[2] == "." and match[3] is None):
        return
    groups, decimals = match[1].split(match[2]), match[3]
    rest = " ".join(["", *match[4].split()])
    whole = "".join(groups) + (f".{decimals}" if decimals else "") + rest
    if len(groups) > 2 or decimals:
        template = "{text} has separators within its number; write {whole}."
        raise UnitError(template, text=_shortened(text), whole=whole)
    template = "{text} may be {whole} or {decimal}; write the one that is meant."
    raise UnitError(template, text=_shortened(text), whole=whole, decimal=f"{groups[0]}.{groups[1]}{rest}")


def with_point(text: str) -> str:
    """Return a quantity as files of the program hold it: "470.7 mm" of "470,7 мм"; UnitError as `number_and_unit`."""
    number, own = number_and_unit(text)
    return text if text.isascii() and "," not in text else f"{number} {own}".strip()


def _finite(value: float, typed: str) -> float:
    if not math.isfinite(value):
        raise UnitError("{typed} is not a finite number, or too large to calculate with.", typed=typed)
    return value


def kind_name(of: Unit) -> str:
    """What a unit measures, with its article: "an angular speed"; "a quantity in kg/s**3" where it has no name."""
    family = _family(of.kind, of.si)
    return str(family["name"]) if family else Phrase("a quantity in {si}", si=of.si)


@lru_cache
def _needed(wanted: Unit | None) -> str:
    if wanted is None:
        return phrase("a number with a unit is needed, for example 90 mm")
    family = _family(wanted.kind, wanted.si)
    typical = float(f"{wanted.from_si(family['example'] if family else wanted.factor):.1g}")
    example = f"{typical:.15g}" + ("" if wanted.text == "1" else f" {wanted.text}")
    return Phrase("{kind_name} is needed, for example {example}", kind_name=phrase(kind_name(wanted)), example=example)


def to_display(value_si: float, unit_text: str) -> float:
    """An SI value as a number of display units."""
    return unit(unit_text).from_si(value_si)


_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_PRINTED_NAMES = {"deg": "°", "um": "µm", "us": "µs", "revolution": "rev", "rpm": "r/min"}


@lru_cache(maxsize=512)
def pretty(unit_text: str) -> str:
    """A unit as a report prints it: "kg·m²", "°/s", "1/h"; nothing for the pure number "1"."""
    text = unit(unit_text).text
    text = re.sub(r"\*\*(-?\d+)", lambda match: match[1].translate(_RAISED), text)
    text = re.sub(r"[A-Za-z_]+", lambda match: _PRINTED_NAMES.get(match[0], match[0]), text)
    return "" if text == "1" else text.replace("*", "·")
