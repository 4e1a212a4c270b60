"""A record of the results: how a class of them is read, written and put into another language."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum, auto
from functools import cache
from typing import Annotated, Any, Literal, Self, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from diecut_report.text.phrases import Phrase, message_data, message_of

SCHEMA_VERSION = 1
"""The first number of the version of the contract; a script that knows it finds the names of the contract."""
FORM_VERSION = "2.0"
"""Its first number rises when a key changes its name or meaning, or is not written any more, its second with each addition."""
WORDINGS = "wordings"
"""In the context of reading a file of form 1: the texts with their templates and values, by the texts."""

Status = Literal["pass", "warn", "fail", "error", "skipped"]
CheckStatus = Literal["pass", "warn", "fail", "not_checked"]
CheckClass = Literal["safety", "function", "strength", "practice", "numerical"]
Verdict = Literal["fail", "conditional", "pass"]
OpenKind = Literal["assumed", "default", "not_rated", "not_checked", "warning"]
Basis = Literal["assumed", "given", "catalogue", "drawing", "standard", "measured"]
Value = float | int | bool | str
Texts = list[str]
Relation = Literal["at_least", "at_most", "equal", "between", "one_of"]
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$", max_length=1000)]
Id = Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_]*$", max_length=200)]
Tree = list[Any]  # an expression: [operation, operand, …], each operand a tree, too
TREE = 'as a tree: `[operation, operand, …]`, `["sym", name]`, `["qty", text, unit]`'

Schema = dict[str, Any]
DRAFT = "https://json-schema.org/draft/2020-12/schema"
SUFFIX = "Record"  # of the classes


class TextRole(Enum):
    """What a text is to a translator."""

    TEXT = auto()  # a sentence or a label
    DRAWN = auto()  # one in a figure that code made: it may be the name of a part
    LABEL = auto()  # one in a figure that its declaration says
    WORD = auto()  # a value: a number, a choice by its key, or a name, which stands as it is
    SOURCE = auto()  # where a formula stands
    PAPER = auto()  # how a work is cited


Change = Callable[[TextRole, str], str]
"""What becomes of a text."""
Changer = Callable[[Any, Change], Any]


class Record(BaseModel):
    """Declare a block of the results that holds these keys and no others."""

    model_config = ConfigDict(
        extra="forbid", strict=True, allow_inf_nan=False, frozen=True, populate_by_name=True, hide_input_in_errors=True
    )

    def with_(self, **changes: Any) -> Self:
        """Return a copy with other values."""
        return self.model_copy(update=changes)

    def data(self) -> dict[str, Any]:
        """Return plain data, as the results file holds it."""
        return self.model_dump(by_alias=True, exclude_defaults=True)

    def with_texts(self, change: Change) -> Self:
        """Return a copy in which each text that is translated has become another one."""
        own = _text_fields(type(self))
        return self.with_(**{name: each(getattr(self, name), change) for name, each in own.items()}) if own else self


def always(meaning: str, alias: str | None = None) -> Any:
    """Return a key that is always there; ``alias`` where its name is a word of Python."""
    return Field(alias=alias, description=meaning)


def sometimes(meaning: str, default: Any = None, alias: str | None = None) -> Any:
    """Return a key that is left out where it has nothing to report; ``alias`` where it is called otherwise."""
    return Field(default=default, alias=alias, description=meaning)


class MessageRecord(Record):
    """A text with values in it, so that it can be given in another language."""

    template: str = always(
        "The text with places `{name}`, as it is translated; of a text that goes with a number its form."
    )
    values: dict[str, str | MessageRecord] = always("What stands at its places.")
    text: str = always("The English text: the template with its values.")
    one: str = sometimes("The form of one, of a text that goes with a number.", "")
    count: int = sometimes("That number.")


class _Translated:
    """Mark a text that is translated; ``is_message``: the file always holds how it was made, ``is_plain``: never."""

    def __init__(self, role: TextRole, *, is_message: bool = False, is_plain: bool = False) -> None:
        self.role, self.is_message, self.is_plain = role, is_message, is_plain

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        form: Any = MessageRecord if self.is_message else str if self.is_plain else str | MessageRecord
        return core_schema.with_info_plain_validator_function(
            self._read,
            serialization=core_schema.plain_serializer_function_ser_schema(self._written),
            json_schema_input_schema=handler.generate_schema(form),
        )

    def _read(self, given: Any, info: ValidationInfo) -> str:
        if isinstance(given, str):
            made: str = info.context[WORDINGS].get(given, given) if info.context else given
            return made
        return message_of(given)

    def _written(self, text: str) -> Any:
        is_made = isinstance(text, Phrase) and bool(text.values)
        return message_data(text) if self.is_message or (is_made and not self.is_plain) else str.__str__(text)


@cache
def _text_fields(model: type[Record]) -> dict[str, Changer]:
    """How the texts of each field of a class are changed; nothing of fields without any."""
    changers = {
        name: _changer(field.annotation, tuple(each for each in field.metadata if isinstance(each, _Translated)))
        for name, field in model.model_fields.items()
    }
    return {name: each for name, each in changers.items() if each is not None}


def _changer(form: Any, marks: tuple[Any, ...] = ()) -> Changer | None:
    """What changes the texts in a value of a type; None where it has none."""
    if found := [mark for mark in marks if isinstance(mark, _Translated)]:
        role = found[0].role
        return lambda value, change: change(role, value) if isinstance(value, str) and value else value
    args = get_args(form)
    if get_origin(form) is Annotated:
        return _changer(args[0], form.__metadata__)
    if isinstance(form, type) and issubclass(form, Record):
        return (lambda value, change: value.with_texts(change)) if _text_fields(form) else None
    inner = next(filter(None, map(_changer, args)), None)
    if inner is None:
        return None
    if get_origin(form) is list:
        return lambda value, change: [inner(each, change) for each in value]
    if get_origin(form) is dict:
        return lambda value, change: {key: inner(each, change) for key, each in value.items()}
    return lambda value, change: value if value is None else inner(value, change)  # of several types one


Text = Annotated[str, _Translated(TextRole.TEXT)]
Message = Annotated[str, _Translated(TextRole.TEXT, is_message=True)]
ErrorText = Annotated[str, _Translated(TextRole.TEXT, is_plain=True)]
DrawnText = Annotated[str, _Translated(TextRole.DRAWN)]
LabelText = Annotated[str, _Translated(TextRole.LABEL)]
DrawnError = Annotated[str, _Translated(TextRole.DRAWN, is_plain=True)]
Word = Annotated[str, _Translated(TextRole.WORD)]
SourceText = Annotated[str, _Translated(TextRole.SOURCE)]
Paper = Annotated[str, _Translated(TextRole.PAPER)]
