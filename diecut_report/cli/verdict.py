"""The verdict on standard error, and the exit code that follows from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

import click

from diecut_report.cli.output import CHECK_FAILED, PASSED, PLUGIN_BROKE, Line, coloured

Data = Mapping[str, Any]
Command = TypeVar("Command", bound=Callable[..., Any])
ORDER = ("fail", "warn", "not_checked")
WORDS = {"not_checked": "not checked"}


def strict_option(command: Command) -> Command:
    """Give a command the option ``--strict``."""
    words = "Exit with 1 for warnings too, and for checks that are not made because a key is not given."
    return click.option("--strict", is_flag=True, help=words)(command)


def exit_code(results: Data, *, is_broken: bool, is_strict: bool) -> int:
    """Return 3 where something broke, 1 where a check fails or something is skipped, or where it is strict and one warns or is not made."""
    if is_broken:
        return PLUGIN_BROKE
    found = results["summary"]
    counted = ORDER if is_strict else ORDER[:1]
    is_whole = not any(data["status"] == "skipped" for data in results["mechanisms"].values())
    return PASSED if is_whole and not any(found[status] for status in counted) else CHECK_FAILED


def told(results: Data) -> list[Line]:
    """Return the checks that do not pass, in words, the worst first, and the verdict on all."""
    lines = [*_checks(results, "fail"), *_skipped(results), *_checks(results, "warn"), *_checks(results, "not_checked")]
    note = [results["comparisons_left_out"]["message"]] if "comparisons_left_out" in results else []
    return [*lines, *note, _whole(results)]


def _checks(results: Data, status: str) -> Iterator[Line]:
    for name, data in results["mechanisms"].items():
        for made in data["checks"]:
            if made["status"] == status and made["class"] != "numerical":
                yield coloured(WORDS.get(status, status), status), f" {name}: {made['title']}. {_message(made)}"


def _message(made: Data) -> str:
    """A check's message; the line of one that is not made begins with these words."""
    message = str(made["message"]).removeprefix("Not checked: ")
    is_key = made["status"] == "not_checked" and message.startswith(made["missing"][0])
    return message if is_key else message[0].upper() + message[1:]


def _skipped(results: Data) -> Iterator[Line]:
    for name, data in results["mechanisms"].items():
        if data["status"] == "skipped":
            yield coloured("skipped", "skipped"), f" {name}: {data['error']}"


def _whole(results: Data) -> Line:
    found = results["summary"]
    count = found["pass"] + found["warn"] + found["fail"]
    held = found["numerical"]["pass"]
    parts = [_failing(results, found["fail"], count, found["not_checked"])]
    if found["warn"]:
        parts.append(f" {found['warn']} with a warning.")
    if found["not_checked"] and found["fail"]:
        parts.append(f" {found['not_checked']} not checked.")
    if found["governing"]:
        parts.append(f" Governing: {found['governing']}.")
    if held:
        parts.append(
            f" {held} self-{'tests' if held > 1 else 'test'} of the calculation hold{'' if held > 1 else 's'}."
        )
    return tuple(parts)


def _failing(results: Data, failed: int, count: int, unchecked: int) -> str:
    """Return how many checks fail; that all pass only where nothing is left unchecked."""
    if failed:
        return f"{failed} of {count} checks fail."
    calculated = [*results["mechanisms"].values(), *results.get("comparisons", {}).values()]
    lost = sum("error" in data for data in calculated)
    if lost:
        what = "mechanisms and comparisons" if "comparisons" in results else "mechanisms"
        return f"{lost} of {len(calculated)} {what} were not calculated."
    if unchecked:
        are = "are" if unchecked > 1 else "is"
        return f"{'No check fails' if count else 'Nothing was checked'}, but {unchecked} {are} not checked."
    return coloured("No check fails.", "pass") if count else "There are no checks."
