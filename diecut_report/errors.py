"""The errors that a user sees: problems with file, line, column and key path; and how much a configuration may hold."""

from __future__ import annotations

import difflib
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import PurePath
from traceback import extract_tb

from diecut_report.text.phrases import Phrase, joined, message

MAX_SHOWN = 20  # problems of a file that are told, so that the message itself stays short


@dataclass(frozen=True)
class Problem:
    """One thing that a user must fix, and where.

    `message` says in whole sentences what is wrong, what was given, what is allowed and what to do.
    `line` and `column` count from 1; `path` is the key path, such as "mechanisms.drive.crank_speed". `allowed` is the range of
    the key, or its choices, where it has some; `advice` names values with which the machine is possible.
    """

    message: str
    file: str = ""
    line: int | None = None
    column: int | None = None
    path: str = ""
    allowed: str = field(default="", compare=False)
    advice: str = field(default="", compare=False)

    @property
    def key(self) -> str:
        """Return the key path."""
        return self.path

    def __str__(self) -> str:
        """The one-line form that editors and terminals can follow: `press.yaml:12:5: path: message`."""
        file = self.file.replace("\n", r"\n")  # a name that holds lines stays within this one
        place = ":".join(str(part) for part in (file, self.line, self.column) if part not in ("", None))
        words = joined(filter(None, (self.message, self.advice)), " " if self.message.endswith(".") else ". ")
        return "".join(f"{part}: " for part in (place, self.path) if part) + words


class UserError(Exception):
    """Bad input: everything found wrong with it, in the order of reading (exit code 2)."""

    problems: tuple[Problem, ...]

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        self.problems = (problems,) if isinstance(problems, Problem) else tuple(problems)
        if not self.problems:
            raise ValueError("a user error needs at least one problem")
        super().__init__(self.problems)

    def __str__(self) -> str:
        return "\n".join(str(problem) for problem in self.problems)


def refusal(template: str, place: object = "", /, **values: object) -> UserError:
    """Return the error of one problem: the template of its message with the values, and the file or folder it is about."""
    return UserError(Problem(message(template, values), str(place)))


class Unwritable(UserError):
    """What was asked for cannot be written: the disk is full, or standard output is closed (exit code 74)."""


class ConfigError(UserError):
    """What a script gives is wrong: a configuration, a value, a question; or the machine cannot exist."""


class UnknownName(UserError, KeyError, AttributeError):
    """A script asks for what is not there; the words tell the nearest name that is. It is a KeyError and an AttributeError, too."""

    __str__ = UserError.__str__

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        super().__init__(problems)
        self.obj = (
            None  # where it is set, Python 3.12 and newer do not add a "Did you mean" of their own to the traceback
        )


class PluginError(Exception):
    """A plugin broke (exit code 3). Raise it `from` the cause; it names the kind and, where known, the instance."""

    def __init__(self, message: str, kind: str = "", instance: str = "") -> None:
        super().__init__(message, kind, instance)
        self.message, self.kind, self.instance = message, kind, instance

    def __str__(self) -> str:
        where = Phrase("mechanism {name}", name=repr(self.instance)) if self.instance else ""
        plugin = Phrase("plugin {kind}", kind=repr(self.kind)) if self.kind else ""
        whose = joined(filter(None, (where, plugin)), " of ")
        return joined(filter(None, (whose, self.message)), ": ")


def own_fault(fault: Exception) -> Phrase:
    """Return what is told of a fault of the program where it may not end what else is done: what it was, and where in the code."""
    *_, last = extract_tb(fault.__traceback__)
    template = "This is a fault of diecut-report itself ({file}, line {line}: {name}: {text}). Please report it with this configuration."
    return Phrase(
        template, file=PurePath(last.filename).name, line=last.lineno, name=type(fault).__name__, text=str(fault)
    )


def nearest(given: str, known: Iterable[str]) -> str:
    """A suggestion to append, " (did you mean 'crank_speed'?)", or nothing where none is near."""
    found = closest(given, known)
    if not found:
        return ""
    if seeming := lookalikes(given) if found.isascii() else "":
        return Phrase(" (did you mean {key}? {letters} only looks Latin)", key=repr(found), letters=seeming)
    return Phrase(" (did you mean {key}?)", key=repr(found))


_SEEMING = str.maketrans(
    "аеорсухіјѕԁһкмтвнпгАВЕКМНОРСТХІЈЅοαινρυκΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "aeopcyxijsdhkmtbhngABEKMHOPCTXIJSoaivpukABEZHIKMNOPTYX"
)
"""Cyrillic and Greek letters with the Latin ones that they look like, or are typed for."""


def latin_letters(name: str) -> str:
    """Return a name with Latin letters in place of those that only look like them."""
    return name.translate(_SEEMING)


def lookalikes(name: str) -> str:
    """Return the letters of a name that only look Latin, each with its name: “о” (cyrillic small letter o); "" where there are none."""
    strange = dict.fromkeys(letter for letter in name if ord(letter) in _SEEMING)
    return ", ".join(f"“{letter}” ({unicodedata.name(letter).lower()})" for letter in strange)


def seeming_latin(name: str) -> str:
    """Return what is wrong with a name whose letters only look Latin; "" where it has none of them, or others beside."""
    told, meant = lookalikes(name), latin_letters(name)
    template = "“{name}” holds letters that only look Latin: {told}. Write it in Latin letters: {meant}."
    return Phrase(template, name=name, told=told, meant=meant) if told and meant.isascii() else ""


def closest(given: str, known: Iterable[str]) -> str:
    """Return the known name that is nearest to what was typed, or nothing where none is near."""
    return next(iter(difflib.get_close_matches(given[:100], list(known), n=1, cutoff=0.6)), "")


# How much a config may hold: more than a press has, and little enough for time and memory. docs/limits.md tells them.


MAX_TEXT = 500  # characters of a text
MAX_QUANTITY = 200  # characters of a number with its unit
MAX_PARTS = 200  # blocks in a list: revisions, gears, pulleys
MAX_CURVE_VALUES = 10_000  # numbers in a list that gives a curve
MAX_MECHANISMS = 200  # of a config
MAX_PRINTED_MECHANISMS = 80  # of a config whose report is a PDF
MAX_COMPARISONS = 12  # of a config
