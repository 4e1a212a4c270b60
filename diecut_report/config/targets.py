"""What references stand for."""

from __future__ import annotations

from dataclasses import dataclass

from diecut_report.conditions.arithmetic import Expression
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.expressions import Formula

Node = KeyPath  # (instance,) is its calculation, (instance, key, …) one of its inputs


@dataclass(frozen=True)
class Target:
    """What a reference stands for: an output (``result``) or an input (``key``) of an instance.

    An expression stands for what is calculated from its ``terms``, the targets of its references; ``path`` is its text.
    """

    path: str
    instance: str
    key: KeyPath = ()
    result: str | None = None
    unit: str | None = None
    is_curve: bool = False
    is_default: bool = False  # not written by the user: the press's field that stands in for an absent input
    formula: Formula | None = None
    is_broken: bool = False  # the plugin of what it refers to cannot be loaded
    expression: Expression | None = None
    terms: tuple[Target, ...] = ()
    phase_unit: str | None = None  # of a phase: the SI unit of what it runs over
    is_mechanism: bool = False  # it stands for the mechanism as a whole

    @property
    def node(self) -> Node:
        """What must be known before what a single reference stands for."""
        return (self.instance,) if self.result is not None or self.is_broken else (self.instance, *self.key)

    @property
    def single(self) -> tuple[Target, ...]:
        """The single references: those of an expression, or itself."""
        return self.terms if self.expression else (self,)

    @property
    def told(self) -> str:
        """What messages call it."""
        return f"“{self.path}”" if self.expression else f"${{{self.path}}}"


class Unresolved(LookupError):
    """A reference that stands for nothing, in words."""
