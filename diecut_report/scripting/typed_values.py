"""Values of a script as they are typed into a configuration: numbers, texts with units, quantities of this program, of pint and of NumPy."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from typing import Any

from diecut_report.config.yaml_tree import resolved
from diecut_report.errors import ConfigError, Problem
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.scripting.values import QuantityValue

SIGNS = ",[]{}#:&*!|>'\"%@`\n"  # of YAML, or within its braces
NEEDED = phrase("a number, a text such as `120 mm`, a quantity, true or false is needed")


def linspace(start: Any, stop: Any, count: int) -> dict[str, Any]:
    """Return so many values from ``start`` to ``stop``, both included, in equal steps, for ``sweep``: ``linspace("80 mm", "120 mm", 41)``."""
    return {"from": start, "to": stop, "count": count}


def scalar(given: Any, path: str) -> float | int | bool | str:
    """Return a value of a script as a configuration holds it; ConfigError where it is not a single value."""
    if isinstance(given, bool | str):
        return given
    if isinstance(given, QuantityValue):
        return given.value if given.unit == "1" else f"{given.value!r} {given.unit}"
    if hasattr(given, "magnitude") and hasattr(given, "units"):
        return _of_pint(given, path)
    if hasattr(given, "item") and not _is_array(given):  # a number of NumPy
        given = given.item()
    if isinstance(given, bool | str | int) or (isinstance(given, float) and math.isfinite(given)):
        return given
    words = Phrase("is {kind}; {needed}.", kind=f"{given!r:.60}", needed=NEEDED)
    raise ConfigError(Problem(words, path=path))


def _of_pint(given: Any, path: str) -> float | str:
    """A quantity of pint; its unit in the short form, which is read back as the same one."""
    number = scalar(given.magnitude, path)
    own = f"{given.units:~C}"
    return float(number) if own == "" else f"{number!r} {own}"


def _is_array(given: Any) -> bool:
    return bool(getattr(given, "ndim", False))


def typed(given: Any, path: str) -> str:
    """Return a value as it stands in the file: a text in quotes where it would be read as something else."""
    value = scalar(given, path)
    if isinstance(value, bool):
        return str(value).lower()
    if not isinstance(value, str):
        return repr(value)
    is_plain = value == value.strip() and resolved(value) == value and not any(sign in value for sign in SIGNS)
    return value if is_plain and not value.startswith(("-", "?")) else json.dumps(value, ensure_ascii=False)


def plain(given: Any, path: str) -> Any:
    """Return blocks and lists of a script with each value as a configuration holds it."""
    if isinstance(given, Mapping):
        return {str(key): plain(part, f"{path}.{key}".lstrip(".")) for key, part in given.items()}
    if hasattr(given, "magnitude") and _is_array(given.magnitude):  # an array of pint
        return [plain(part, f"{path}.{index}") for index, part in enumerate(given)]
    if given is None or isinstance(given, str | QuantityValue) or hasattr(given, "magnitude"):
        return None if given is None else scalar(given, path)
    if isinstance(given, Iterable) and (_is_array(given) or not hasattr(given, "ndim")):
        return [plain(part, f"{path}.{index}") for index, part in enumerate(given)]
    return scalar(given, path)
