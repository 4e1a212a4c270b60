"""What may be named by ``--free`` beside what is free by itself: for messages that say what to do."""

from __future__ import annotations

from collections.abc import Collection

from diecut_report.config.loader import Config
from diecut_report.design.design_choices import given_choices
from diecut_report.design.design_inputs import given_numbers
from diecut_report.languages.phrases import Phrase

NAMED = 12  # inputs that a message names


def nothing_free(config: Config, left_out: Collection[str]) -> Phrase:
    """Return what is to be done where no input is free: the inputs that could be named, but for those paths."""
    numbers = [each.name for each in given_numbers(config) if each.today and each.asked.path not in left_out]
    found = [*(each.name for each in given_choices(config) if each.asked.path not in left_out), *numbers]
    if not found:
        return Phrase("nothing is free to be changed: keep fewer inputs by --keep.")
    words = "nothing is free to be changed: name inputs by --free, such as --free {first}, or keep fewer by --keep; the file has {names}"
    return Phrase(words, first=found[0], names=_listed(found))


def untried(config: Config, instances: Collection[str], known: Collection[str]) -> tuple[str, ...]:
    """Return the texts, yes/no and numbers of parts of mechanisms that are tried only where they are named."""
    choices = [(each.asked, each.name) for each in given_choices(config) if len(each.options) > 1]
    whole = [(each.asked, each.name) for each in given_numbers(config) if each.is_whole and each.today]
    own = [name for asked, name in (*choices, *whole) if asked.instance in instances and asked.path not in known]
    return tuple(dict.fromkeys(own))


def _listed(names: Collection[str]) -> str:
    shown = ", ".join(list(names)[:NAMED])
    return f"{shown} …" if len(names) > NAMED else f"{shown}."
