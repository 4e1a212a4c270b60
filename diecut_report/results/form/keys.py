"""What the forms share: keys that are always there and keys that may be left out; numbers as they are printed."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

Status = Literal["pass", "warn", "fail", "error", "skipped"]
CheckStatus = Literal["pass", "warn", "fail", "not_checked"]
CheckClass = Literal["function", "strength", "practice", "numerical"]
Basis = Literal["assumed", "given", "catalogue", "drawing", "standard", "measured"]
Value = float | int | bool | str
Tree = list[Any]  # an expression: [operation, operand, …], each operand a tree, too

ABSENT = object()


class ClosedKeys(BaseModel):
    """Declare a block that holds these keys and no others."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


def always(words: str, alias: str | None = None) -> Any:
    """Return a key that is always there; ``alias`` where its name is a word of Python."""
    return Field(alias=alias, description=words)


def sometimes(words: str, alias: str | None = None) -> Any:
    """Return a key that is left out where it has nothing to say."""
    return Field(default=ABSENT, alias=alias, description=words)


class ShownKeys(ClosedKeys):
    """A number as it is printed."""

    text: str = always("The number as a neutral text (decimal point, `1.2e-05`), or words.")
    unit: str = always("The unit that it is printed in; `1` without one.")


class PlaceKeys(ClosedKeys):
    """A place of an abscissa."""

    symbol: str = always("The symbol of the abscissa.")
    text: str = always("The place, in the unit.")
    unit: str = always("The unit of the text.")
    value: float = sometimes("Of a result's extreme the place as it is calculated, SI.")


class PartOfListKeys(ClosedKeys):
    """Which of repeated parts a quantity is of."""

    family: str = always("The list in the configuration, or what names its parts.")
    index: int = always("Its place, counted from 0.")
    number: int = sometimes("The number in its name, where that holds one.")
    quantity: str = sometimes("What it is of each part.")
