"""Letters that no text of a user may hold: they act on a terminal, break a document, or make a text look like another one."""

from __future__ import annotations

import re
import unicodedata

from diecut_report.languages.phrases import Phrase

_BIDI = "\u202a-\u202e\u2066-\u2069"  # they turn the letters after them around

CONTROL = re.compile(f"[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]|[{_BIDI}]")
"""What a file as a whole may not hold."""
INVISIBLE = re.compile(
    "[\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u202a-\u202e\u2060-\u206f\u2800\u3164\ufe00-\ufe0f\ufeff"
    "\uffa0\ufff0-\ufffb\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e0fff]"
)
"""What stands in a text unseen: Default_Ignorable_Code_Point of Unicode, marks of annotations, and the empty Braille pattern."""
HIDDEN = re.compile(f"{CONTROL.pattern}|{INVISIBLE.pattern}|[\x85\u2028\u2029]")
"""What a decoded text may not hold; an escape may bring NEL, and separators that end a line for some readers and not for others."""
HIDDEN_IN_KEY = re.compile(f"{HIDDEN.pattern}|[\t\n\r]")
"""What a decoded key may not hold."""

SEEMING = str.maketrans(
    "аеорсухіјѕԁһкмтвнАВЕКМНОРСТХІЈЅοαινρυκΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "aeopcyxijsdhkmtbhABEKMHOPCTXIJSoaivpukABEZHIKMNOPTYX"
)
"""Cyrillic and Greek letters with the Latin ones that they look like."""


def seeming_latin(name: str) -> str:
    """Return what is told of a name with letters that only look Latin; "" where it has none, or others that do not."""
    strange = [letter for letter in name if ord(letter) in SEEMING]
    meant = name.translate(SEEMING)
    if not strange or not meant.isascii():
        return ""
    told = ", ".join(f"“{letter}” ({unicodedata.name(letter).lower()})" for letter in dict.fromkeys(strange))
    return Phrase(
        "“{name}” holds letters that only look Latin: {told}. Write it in Latin letters: {meant}.",
        name=name,
        told=told,
        meant=meant,
    )


def hidden(text: str) -> str:
    """Return the name of a letter that the text of a value may not hold, such as U+001B; "" where there is none."""
    found = HIDDEN.search(text)
    return f"U+{ord(found[0]):04X}" if found else ""


def printable(name: str) -> str:
    """Return a name without what no document can show: control and invisible characters, and bytes that are not UTF-8."""
    return "".join(
        letter if letter.isprintable() and not INVISIBLE.match(letter) else "\N{REPLACEMENT CHARACTER}"
        for letter in name
    )
