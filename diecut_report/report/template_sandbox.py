"""The sandbox in which a firm's templates are filled: they see plain data, and call plain functions of a list.

Jinja's own sandbox forbids names that begin with an underscore; whatever else it can reach it lets a template read and call. Here nothing is
reached but data: an attribute is a field or property of a data class, a value is a number, a text, a container of those or a data class.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property
from types import BuiltinFunctionType, FunctionType, MethodType
from typing import Any

from jinja2.environment import TemplateModule
from jinja2.filters import do_round
from jinja2.runtime import BlockReference, Context, LoopContext, Macro, TemplateReference, Undefined
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import Cycler, Joiner, Namespace

from diecut_report.languages.phrases import phrase
from diecut_report.report.i18n import Catalogue

TEXT = frozenset(
    [
        "capitalize",
        "casefold",
        "count",
        "endswith",
        "find",
        "index",
        "isalnum",
        "isalpha",
        "isascii",
        "isdecimal",
        "isdigit",
        "islower",
        "isnumeric",
        "isspace",
        "istitle",
        "isupper",
        "join",
        "lower",
        "lstrip",
        "partition",
        "removeprefix",
        "removesuffix",
        "replace",
        "rfind",
        "rindex",
        "rpartition",
        "rsplit",
        "rstrip",
        "split",
        "splitlines",
        "startswith",
        "strip",
        "swapcase",
        "title",
        "upper",
    ]
)
METHODS: Mapping[type, frozenset[str]] = {
    str: TEXT,
    dict: frozenset({"get", "items", "keys", "values"}),
    list: frozenset({"count", "index"}),
    tuple: frozenset({"count", "index"}),
    Catalogue: frozenset({"get", "language", "say"}),
    Cycler: frozenset({"current", "next", "reset"}),
    LoopContext: frozenset({"changed", "cycle", "depth", "depth0", "first", "index", "index0", "last", "length", "nextitem",
                            "previtem", "revindex", "revindex0"}),
    BlockReference: frozenset({"super"}),
}  # fmt: skip
"""What may be read of values that are no data classes, by their type."""
GLOBALS = ("cycler", "joiner", "namespace", "range")
"""Jinja's own functions that templates may call."""
LONGEST = 10_000  # bits of a whole number; Python itself prints no longer ones
MOST_DECIMALS = 300  # a float has no more
PLAIN = (str, int, float, bytes, type(None), list, tuple, set, frozenset, Mapping)
OF_JINJA = (Macro, LoopContext, BlockReference, TemplateReference, TemplateModule, Cycler, Joiner, Namespace, Undefined)


class TemplateSandbox(ImmutableSandboxedEnvironment):
    """Fill templates that see plain data; of functions and methods they call those of a list, and Jinja's."""

    intercepted_binops = frozenset({"*", "**", "/", "//", "%"})

    def __init__(self, functions: Collection[Callable[..., Any]], **options: Any) -> None:
        """Take the functions, and methods as they stand in their classes, that templates may call."""
        super().__init__(**options)
        self.functions = frozenset(functions)
        self.filters = {**self.filters, "round": _rounded}
        self.globals = {name: self.globals[name] for name in GLOBALS}
        self.allowed = self.functions | frozenset(self.globals.values())

    def call_binop(self, context: Context, operator: str, left: Any, right: Any) -> Any:
        """Return what an operator makes of two values; ValueError for whole numbers so long that Python would reckon without an end."""
        longest = max(each.bit_length() if isinstance(each, int) else 0 for each in (left, right))
        is_power = operator == "**" and isinstance(left, int) and isinstance(right, int)
        if longest * (abs(right) if is_power else 1) > LONGEST:
            raise ValueError(phrase("a whole number of too many digits"))
        return super().call_binop(context, operator, left, right)

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:
        """Return whether a template may read an attribute."""
        if attr.startswith("_") or isinstance(obj, type):
            return False
        return self._is_readable(obj, attr) and self._is_shown(value)

    def is_safe_callable(self, obj: Any) -> bool:
        """Return whether a template may call an object."""
        if isinstance(
            obj, (Macro, LoopContext, BlockReference, Joiner, Undefined)
        ):  # the last one raises its own message
            return True
        owner = getattr(obj, "__self__", None)
        return self._is_listed(obj) or getattr(obj, "__name__", "") in _names(owner)

    def getattr(self, obj: Any, attribute: str) -> Any:
        """Return an attribute, or an item, where it is plain data."""
        return self._shown(super().getattr(obj, attribute), obj, attribute)

    def getitem(self, obj: Any, argument: Any) -> Any:
        """Return an item, or an attribute, where it is plain data."""
        return self._shown(super().getitem(obj, argument), obj, argument)

    def _shown(self, found: Any, obj: Any, name: Any) -> Any:
        return found if self._is_shown(found) else self.unsafe_undefined(obj, f"{name}")

    def _is_readable(self, obj: Any, attr: str) -> bool:
        if isinstance(obj, (TemplateModule, Namespace)):
            return True  # what the templates themselves define
        of_class = getattr(type(obj), attr, None)
        if attr in _names(obj) or of_class in self.functions:
            return True
        is_record = is_dataclass(obj) or hasattr(type(obj), "_fields")
        return is_record and (attr in _field_names(obj) or isinstance(of_class, property | cached_property))

    def _is_shown(self, value: Any) -> bool:
        shown = isinstance(value, (*PLAIN, *OF_JINJA)) or (is_dataclass(value) and not isinstance(value, type))
        return shown or self.is_safe_callable(value)

    def _is_listed(self, obj: Any) -> bool:
        if not isinstance(obj, FunctionType | BuiltinFunctionType | MethodType | type):
            return False
        return obj in self.allowed or (isinstance(obj, MethodType) and obj.__func__ in self.functions)


def _rounded(value: float, precision: int = 0, method: str = "common") -> float:
    """Return a number rounded by Jinja's filter, which would raise ten to any power."""
    if abs(precision) > MOST_DECIMALS:
        raise ValueError(phrase("a number is rounded to too many decimals"))
    return do_round(value, precision, method)  # type: ignore[arg-type]  # another method raises its own message


def _names(obj: Any) -> frozenset[str]:
    """Return the methods and attributes that may be read of an object that is no data class."""
    return next((names for kind, names in METHODS.items() if isinstance(obj, kind)), frozenset())


def _field_names(obj: Any) -> Collection[str]:
    return [each.name for each in fields(obj)] if is_dataclass(obj) else obj._fields
