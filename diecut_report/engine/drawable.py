"""What figures and exports may name, and what a fault in one of them costs: that one alone."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.discovery import said
from diecut_report.engine.calculation import Calculation
from diecut_report.languages.phrases import Phrase, phrase

Data = dict[str, Any]
FLOATS = {float, np.float64}


class Undrawable(ValueError):
    """Report that a figure or export asks for what is not there, in words."""


def guarded(make: Callable[[], Data], lost: Data, place: str) -> Data:
    """Return what ``make`` makes, or ``lost`` with what went wrong and where in the plugin."""
    place = Path(place).name
    try:
        made = make()
        _plain(made)
        return made
    except Undrawable as fault:
        return lost | {"error": f"{fault} ({place})"}
    except Exception as cause:
        return lost | {"error": Phrase("{said}, asked for at {place}", said=said(cause), place=place)}


def _plain(made: Data) -> None:
    """Check that it can stand in a results file."""
    if _is_plain(made):
        return
    try:
        json.dumps(made, allow_nan=False)
    except (TypeError, ValueError) as fault:
        raise Undrawable(
            Phrase(
                "it gives something that is not a finite number, text or list of these ({fault}); an absent "
                "number in a line is None",
                fault=fault,
            )
        ) from None


def _is_plain(part: Any) -> bool:
    """Whether a part is seen at once to be text, finite numbers, or lists of these; others are asked of the writer itself."""
    kind = type(part)
    if kind is dict:
        return all(type(key) is str for key in part) and all(map(_is_plain, part.values()))
    if kind is list or kind is tuple:
        return isfinite(sum(part)) if part and set(map(type, part)) <= FLOATS else all(map(_is_plain, part))
    return isfinite(part) if kind in FLOATS else part is None or isinstance(part, str) or kind in (bool, int)


def curve_named(calc: Calculation, name: str, abscissa: str | None = None) -> str:
    """Return a curve's abscissa; refused where the results have no such curve, or not over this abscissa."""
    found = _abscissas(calc).get(name)
    if found is None:
        raise Undrawable(
            Phrase("{name} is {what}; it takes a curve that the results hold", name=repr(name), what=_what(calc, name))
        )
    if abscissa is not None and found != abscissa:
        raise Undrawable(
            Phrase(
                "{name} runs over {found}, not over {abscissa}; both must have one abscissa",
                name=repr(name),
                found=repr(found),
                abscissa=repr(abscissa),
            )
        )
    return found


def _abscissas(calc: Calculation) -> Mapping[str, str]:
    """The abscissa of each curve of the results; an abscissa is its own."""
    own = {name: name for name in calc.domains} | {n: calc.axis[n] for n, step in calc.curves.items() if step.output}
    for spectrum in calc.mechanism.spectra:
        own |= {spectrum.id: spectrum.id} | {line.id: spectrum.id for line in spectrum.lines()}
    return own


def _what(calc: Calculation, name: str) -> str:
    if name in calc.curves:
        return phrase("a curve that is not an output")
    if name in calc.values or name in calc.inputs:
        return phrase("a number or a text, not a curve")
    return phrase("not a quantity of this machine")
