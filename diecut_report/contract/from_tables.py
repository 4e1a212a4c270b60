"""Keys whose text may name an entry in a table of the user's own, beside the configuration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class FromTable:
    """Name a key whose text may be an entry of the user's table ``table``, and the keys that such an entry gives.

    ``gives`` has for each key of the block the key of the entry: {"sigma_h_lim_1": "sigma_h_lim"}. The key itself is left out
    then, or has the text ``stands_for``, by which the steps are chosen. What the block gives itself stays.
    """

    key: str
    table: str
    gives: Mapping[str, str]
    stands_for: str = ""
