"""The usual spellings of units ("kg·m²", "kg m^2", "Nm", "m/s2") and the one that the program looks up ("kg*m**2")."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

from diecut_report.languages.phrases import Phrase

_CHARACTERS = str.maketrans(
    {"·": "*", "⋅": "*", "×": "*", "∙": "*", "µ": "u", "μ": "u", "−": "-", "∕": "/", "⁄": "/", "º": "°", "^": "**"}
)
_SUPERSCRIPTS = {"⁰": "0", "¹": "1", "²": "2", "³": "3", "⁴": "4", "⁵": "5", "⁶": "6", "⁷": "7", "⁸": "8", "⁹": "9"}
_SUPERSCRIPT = re.compile("(⁻?)([" + "".join(_SUPERSCRIPTS) + "]+)")
_GLUED = re.compile(r"(/?)(?<!\w)((?:[kMm]?N|kg|g)(?=mm|cm|m))(m|mm|cm)(\*\*-?\d+)?(?!\w)")

_CYRILLIC = {
    "хв": "min", "год": "h", "град": "deg", "рад": "rad", "Вт": "W", "кВт": "kW", "Дж": "J", "кДж": "kJ", "Гц": "Hz",
    "с": "s", "мс": "ms", "т": "t", "мкм": "um", "Н": "N", "кН": "kN", "МН": "MN", "Нм": "N*m",
}  # fmt: skip
_LOOKALIKE = str.maketrans("мсгкаПМГН", "mcgkaPMGN")


def normalised(text: str) -> str:
    """Return a unit's text in the one spelling that the table of units and pint know."""
    text = " ".join(text.split())  # a run of blanks would be searched again from each of them
    text = text.translate(_CHARACTERS).replace("°C", "degC").replace("°F", "degF").replace("°", "deg")
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
    text = text.strip().replace("об/хв", "rpm")
    latin = re.sub(r"[^\W\d]+", lambda match: _CYRILLIC.get(match[0], match[0].translate(_LOOKALIKE)), text)
    names, meant = list(known), normalised(latin)
    same_letters = [name for name in names if name.casefold() == meant.casefold()]
    if not same_letters and not re.search(r"\s", text):
        same_letters = difflib.get_close_matches(meant, names, n=1, cutoff=0.6)
    found = meant if meant in same_letters else next(iter(same_letters), "")
    return Phrase(" Did you mean {same_letters}?", same_letters=found) if found else ""
