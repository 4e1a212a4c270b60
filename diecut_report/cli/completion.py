"""What a shell completes beside commands, options and files: kinds, mechanisms and inputs of the configuration that is named before."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import redirect_stderr, redirect_stdout, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.shell_completion import CompletionItem

from diecut_report.config.discovery import Discovery
from diecut_report.config.model import DETAILS, PRESS
from diecut_report.errors import PluginError, UserError
from diecut_report.languages.catalogues import languages
from diecut_report.languages.speech import said

if TYPE_CHECKING:
    from diecut_report.config.loader import Config


def kinds(context: click.Context, _: click.Parameter, begun: str) -> list[CompletionItem]:
    """Complete the name of a kind, with its title where the shell shows that."""
    discovery = _discovery(context)
    return [CompletionItem(kind, help=_title(discovery, kind)) for kind in discovery.origins if kind.startswith(begun)]


def mechanisms(context: click.Context, _: click.Parameter, begun: str) -> list[CompletionItem]:
    """Complete names of mechanisms, parted by commas."""
    before, comma, last = begun.rpartition(",")
    names = (config.kinds for config in _config(context))
    return _items((f"{before}{comma}{name}" for found in names for name in found), f"{before}{comma}{last}")


def inputs(context: click.Context, _: click.Parameter, begun: str) -> list[CompletionItem]:
    """Complete the path of an input that is a number: drive.crank_length."""
    return _items((path for config in _config(context) for path in _numbers(config)), begun)


def spoken(_: click.Context, __: click.Parameter, begun: str) -> list[CompletionItem]:
    """Complete a language."""
    return _items(languages(), begun)


def details(_: click.Context, __: click.Parameter, begun: str) -> list[CompletionItem]:
    """Complete how much a report holds."""
    return _items(DETAILS, begun)


def _items(known: Iterable[str], begun: str) -> list[CompletionItem]:
    return [CompletionItem(text) for text in known if text.startswith(begun)]


def _discovery(context: click.Context) -> Discovery:
    return Discovery(context.params.get("folders") or ())


def _title(discovery: Discovery, kind: str) -> str | None:
    """The title of a kind; nothing where that would mean to run a plugin of another's, or where the plugin is broken."""
    with suppress(PluginError, LookupError):
        if discovery.origins[kind][0].is_own:
            return said(discovery.mechanism(kind).title, kind)
    return None


def _config(context: click.Context) -> Iterator[Config]:
    """The configuration that the command names before, as far as it can be read; nothing where it cannot."""
    from diecut_report.config.loader import examined

    # behind an option without its value, which is being typed, click has not made parameters of the words before
    given = [context.params.get("config"), *context.args]
    file = next((Path(path) for path in given if path and Path(path).is_file()), None)
    if file is None:
        return
    # what a shell completes is no place for messages
    with (
        open(os.devnull, "w") as nowhere,
        redirect_stdout(nowhere),
        redirect_stderr(sys.stderr),
        suppress(UserError, PluginError),
    ):
        yield examined(file, _discovery(context))[0]


def _numbers(config: Config) -> Iterator[str]:
    from diecut_report.contract.inputs import Quantity

    for name, instance in config.instances.items():
        for slot in instance.slots if instance else ():
            if isinstance(slot.meta, Quantity) and (slot.is_given or slot.value is not None):
                home = PRESS if name == PRESS else name
                yield ".".join(map(str, (home, *slot.key)))
