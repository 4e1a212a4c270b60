"""A text for messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

from diecut_report.mechanism.steps.base import Over, SilentStep
from diecut_report.mechanism.steps.protocols import SAID, Kinds


@dataclass(frozen=True, eq=False)
class Words(SilentStep):
    """Declare a text made by plain code, for messages (``{id}``): ``function`` takes the numbers (SI) and texts ``takes`` of one machine.

    It is made only where a message or a drawing asks for it. With ``each_part`` the function gives a tuple: a text for each part of a row.
    """

    function: Callable[..., str | tuple[str, ...]]
    takes: tuple[str, ...]
    each_part: bool = field(default=False, kw_only=True)
    output: bool = field(default=True, kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"takes": SAID}
    is_taken: ClassVar[bool] = True
    is_run: ClassVar[bool] = False
    is_made_late: ClassVar[bool] = True

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("text", "")}
