"""An example of a kind: values with which it can be calculated, and how it is wired to mechanisms of other kinds.

A value is written as in a configuration: a number in the key's display unit, a text such as ``"40 mm"``, a list, a block of keys.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from diecut_report.contract.place import placed

KIND = re.compile(r"<([^<>\s]+)>")


@dataclass(frozen=True)
class Wired:
    """Take a value where a press has the kinds that it names, and ``otherwise`` another one; None leaves the key or the part out.

    ``value`` is written as in a configuration, with ``<KIND>`` in the place of a mechanism's name:
    ``Wired("${<cylinder_sizing>.mass}", otherwise="80 kg")``. ``needs`` are kinds that it does not name itself.
    """

    value: Any
    otherwise: Any = None
    needs: tuple[str, ...] = ()

    @property
    def kinds(self) -> tuple[str, ...]:
        """Return the kinds that must be there, in the order in which they are named."""
        return tuple(dict.fromkeys((*self.needs, *kinds_named(self.value))))


@dataclass(frozen=True)
class ForEach:
    """Declare a part of a list for each mechanism of a kind that a press has: ``ForEach("clutch", {"mechanism": "<clutch>"})``."""

    kind: str
    part: Any


@dataclass(frozen=True, eq=False)
class ExampleBlock:
    """Declare the name and the inputs of an example of a kind, by which ``diecut-report new`` begins a configuration.

    ``press`` are values of the press that the example is made for, by their paths: ``{"productivity": "1200 1/h"}``.
    """

    name: str
    inputs: Mapping[str, Any]
    press: Mapping[str, Any] = field(default_factory=dict)
    at: str = placed()


def kinds_named(value: Any) -> Iterator[str]:
    """Yield the kinds that a value names, without what stands in the wired values in it."""
    match value:
        case str():
            yield from KIND.findall(value)
        case dict():
            for part in value.values():
                yield from kinds_named(part)
        case list() | tuple():
            for part in value:
                yield from kinds_named(part)
