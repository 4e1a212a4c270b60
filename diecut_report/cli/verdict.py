"""The verdict on standard error, and the exit code that follows from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

import click

from diecut_report.cli.output import CHECK_FAILED, PASSED, PLUGIN_BROKE, Line, coloured
from diecut_report.config.catalogues import spoken_catalogues
from diecut_report.config.discovery import Discovery
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import said, say, say_counted, spoken_language
from diecut_report.results.conclusion import conclusion, is_open
from diecut_report.results.doubtful_plugins import doubtful_kinds

Data = Mapping[str, Any]
Command = TypeVar("Command", bound=Callable[..., Any])
ORDER = ("fail", "warn", "not_checked")
WORDS = {
    "pass": phrase("pass"),
    "incomplete": phrase("conditional"),
    "warn": phrase("warn"),
    "fail": phrase("fail"),
    "error": phrase("error"),
    "skipped": phrase("skipped"),
    "not_checked": phrase("not checked"),
    "bad": phrase("bad file"),
}


def strict_option(command: Command) -> Command:
    """Give a command the option ``--strict``."""
    words = "Exit with 1 for warnings too, for checks that are not made because a key is not given, and for a plugin with faults."
    return click.option("--strict", is_flag=True, help=words)(command)


def exit_code(results: Data, *, is_broken: bool, is_strict: bool) -> int:
    """Return 3 where something broke, 1 where a check fails or something is skipped, or, strict, where one warns or is not made."""
    if is_broken:
        return PLUGIN_BROKE
    found = results["summary"]
    counted = ORDER if is_strict else ORDER[:1]
    is_whole = not any(data["status"] == "skipped" for data in results["mechanisms"].values())
    is_doubtful = is_strict and doubtful_kinds(results)
    return PASSED if is_whole and not is_doubtful and not any(found[status] for status in counted) else CHECK_FAILED


def told(results: Data, discovery: Discovery | None = None) -> list[Line]:
    """Return the checks that do not pass, in words, the worst first, and the verdict on all; in the language that is spoken.

    ``discovery`` knows where plugins of others have their words.
    """
    results = _translated(results, discovery)
    lines = [*_checks(results, "fail"), *_skipped(results), *_checks(results, "warn"), *_checks(results, "not_checked")]
    note = [results["comparisons_left_out"]["message"]] if "comparisons_left_out" in results else []
    return [*lines, *note, _whole(results)]


def _translated(results: Data, discovery: Discovery | None) -> Data:
    """The results in the language that is spoken."""
    if spoken_language() == SOURCE_LANGUAGE:
        return results
    from diecut_report.report.translated import translated  # with what makes reports, which English does not need

    return translated(results, spoken_catalogues(discovery))


def _checks(results: Data, status: str) -> Iterator[Line]:
    for name, data in results["mechanisms"].items():
        for made in data["checks"]:
            if made["status"] == status and made["class"] != "numerical":
                yield marked(status), f" {name}: {made['title']}. {_message(made)}"


def marked(status: str) -> str:
    """Return a status in words, in its colour."""
    return coloured(said(WORDS.get(status, status)), status)


def _message(made: Data) -> str:
    """A check's message; the line of one that is not made begins with these words."""
    message = str(made["message"]).removeprefix(say("Not checked: "))
    is_key = made["status"] == "not_checked" and message.startswith(made["missing"][0])
    return message if is_key else message[0].upper() + message[1:]


def _skipped(results: Data) -> Iterator[Line]:
    for name, data in results["mechanisms"].items():
        if data["status"] == "skipped":
            yield marked("skipped"), f" {name}: {data['error']}"


def _whole(results: Data) -> Line:
    found = results["summary"]
    state = "fail" if found["fail"] else "warn" if is_open(results) else "pass"
    parts = [coloured(said(conclusion(results)), state)]
    if found["governing"]:
        parts.append(say("Governing: {check}.", check=found["governing"]))
    if held := found["numerical"]["pass"]:
        words = "{n} self-test of the calculation holds.", "{n} self-tests of the calculation hold."
        parts.append(say_counted(held, *words))
    return tuple(part for each in parts for part in (" ", each))[1:]
