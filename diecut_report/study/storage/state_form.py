"""The form of study.json: what each of its keys may hold, and in words what is wrong with one that a hand has changed."""

from __future__ import annotations

import reprlib
import shlex
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from diecut_report.config.hidden_letters import printable
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.languages.phrases import Phrase, joined, phrase
from diecut_report.study.storage.description import VARIANT, VERDICT, Kind

MOST = 5  # faults that are told
EARLIER = ("source_sha256", "part_files", "seal")  # what an earlier version of the program did not write
MEND = phrase(
    "Only batch writes this file: put it back as it was, or calculate the study anew in another "
    "folder with `diecut-report batch STUDY -o DIR`."
)
Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Count = Annotated[int, Field(ge=0, le=10**15)]
STATUSES = ("pass", "warn", "fail", "error")


class _Form(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True)


class NotedProgram(_Form):
    """The program that calculated the variants."""

    name: Literal["diecut-report"]
    version: str


class NotedColumn(_Form):
    """A column of the part files; its name is the key."""

    kind: Kind = "float"
    unit: str = "1"
    display: str = ""
    symbol: str = ""
    description: str = ""


class NotedPart(_Form):
    """A part file: the hash of its bytes, and how many variants it holds."""

    sha256: Digest
    variants: Count


class NotedCounts(_Form):
    """How many rows the sample has, how many of them are stored, and of each status."""

    sample: Count
    variants: Count
    dropped: Count
    without_value: Count = 0
    passing: Count = Field(0, alias="pass")
    warn: Count = 0
    fail: Count = 0
    error: Count = 0


class StateForm(_Form):
    """All that stands in study.json."""

    schema_version: Literal[1]  # of the description
    program: NotedProgram
    plugins: dict[str, str]
    source_sha256: dict[str, Digest]
    study: str
    base: str
    tables: list[str]
    sha256: dict[str, Digest]
    rows: Count
    chunk: Annotated[int, Field(ge=1, le=10**6)]
    columns: dict[str, NotedColumn]
    part_files: dict[str, NotedPart]
    state: Literal["running", "complete"]
    seal: Digest
    varied: Annotated[list[str], Field(min_length=1)] | None = None
    objectives: list[dict[Literal["minimise", "maximise"], str]] = []
    design: Literal["saltelli"] | None = None
    n: Count | None = None
    slow: dict[str, str] = {}
    broken: dict[str, str] = {}
    doubtful: dict[str, list[str]] = {}
    seconds: Annotated[float, Field(ge=0)] = 0.0
    libraries: dict[str, list[str]] = {}
    parts: Count | None = None
    counts: NotedCounts | None = None


SEARCHED = "violation"  # the column that only the machines of a search have


def continuing(folder: object, columns: object, study: str = "") -> str:
    """Return the command that goes on with the run of a folder whose results have these columns by name, of a study or of a search."""
    is_search = isinstance(columns, Mapping) and SEARCHED in columns
    return f"diecut-report {'optimise' if is_search else 'batch'} {study}--resume {shlex.quote(printable(f'{folder}'))}"


def check_form(data: Any, file: Path, *, is_final: bool = True) -> None:
    """Refuse what is no study.json: UserError with the file, the key, what was given and what is allowed.

    Without ``is_final`` the keys that a run writes at its end need not agree: it is to be continued.
    """
    if isinstance(data, dict) and not any(key in data for key in EARLIER) and "columns" in data:
        words = phrase(
            "An earlier version of diecut-report wrote these results, without the hashes that prove them "
            "unchanged. Calculate the study anew in another folder with `diecut-report batch STUDY -o DIR`."
        )
        raise UserError(Problem(words, str(file)))
    try:
        found = StateForm.model_validate(data)
    except ValidationError as error:
        raise _told([_of_pydantic(one) for one in error.errors()], file) from None
    if disagreeing := list(_disagreeing(found)):
        raise _told(disagreeing, file)
    if is_final and found.state == "complete" and (faults := list(_incomplete(found))):
        raise _told(
            faults,
            file,
            Phrase("Let the program mend it: {continued}", continued=continuing(file.parent, found.columns)),
        )


def _told(faults: list[tuple[str, str]], file: Path, mend: str = MEND) -> UserError:
    shown = [Problem(joined((words, mend), " "), str(file), path=_short(key)) for key, words in faults[:MOST]]
    more = len(faults) - len(shown)
    return UserError(
        [*shown, *([Problem(Phrase("{more} more keys are wrong.", more=more), str(file))] if more else [])]
    )


# --- each key by itself ----------------------------------------------------------------------------------------------

NEEDED = {
    "string_type": phrase("a text is needed"),
    "int_type": phrase("a whole number is needed"),
    "int_from_float": phrase("a whole number is needed"),
    "float_type": phrase("a number is needed"),
    "dict_type": phrase("a block of keys is needed"),
    "model_type": phrase("a block of keys is needed"),
    "list_type": phrase("a list is needed"),
    "too_short": phrase("at least one entry is needed"),
    "finite_number": phrase("a finite number is needed"),
    "string_pattern_mismatch": phrase("a SHA-256 is needed, 64 of the digits 0-9 and a-f"),
    "greater_than_equal": phrase("at least {ge} is needed"),
    "less_than_equal": phrase("at most {le} is allowed"),
    "literal_error": phrase("allowed is {expected}"),
}


def _of_pydantic(found: Mapping[str, Any]) -> tuple[str, str]:
    key = ".".join(str(part) for part in found["loc"] if part != "[key]")
    kind, given = found["type"], _given(found["input"])
    if kind == "missing":
        return key, phrase("This key is missing.")
    if kind == "extra_forbidden":
        known = [field.alias or name for name, field in StateForm.model_fields.items()]
        return key, Phrase("This key is unknown{nearest}.", nearest=nearest(key, known))
    needed = Phrase(NEEDED.get(kind, found["msg"]), {"ge": "", "le": "", "expected": "", **found.get("ctx", {})})
    return key, Phrase("{given} is given; {needed}.", given=given, needed=needed)


def _given(value: Any) -> str:
    """A value of the file, shortened."""
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    if isinstance(value, dict | list):
        return phrase("a block of keys") if isinstance(value, dict) else phrase("a list")
    return reprlib.repr(value)


def _short(key: str) -> str:
    """A key, which a hand may have written too."""
    return key if key.isprintable() and len(key) < 200 else reprlib.repr(key)


# --- keys that must agree --------------------------------------------------------------------------------------------


def _disagreeing(form: StateForm) -> Iterator[tuple[str, str]]:
    """Return the keys that contradict others."""
    names = list(form.columns)
    if names[:1] != [VARIANT.name] or names[-len(VERDICT) :] != [column.name for column in VERDICT]:
        yield (
            "columns",
            Phrase(
                "They begin with variant and end with {verdict}.",
                verdict=", ".join(column.name for column in VERDICT),
            ),
        )
    sources = {"study", "base", *(f"table {number}" for number in range(1, len(form.tables) + 1))}
    yield from _other_keys("sha256", form.sha256, sources)
    for name in (name for name in form.varied or () if name not in form.columns):
        yield (
            "varied",
            Phrase(
                "{given} is given; the name of a column is needed{nearest}.",
                given=_given(name),
                nearest=nearest(name, names),
            ),
        )


def part_name(index: int) -> str:
    """Return the name of a part file."""
    return f"part-{index:05d}.parquet"


def _incomplete(form: StateForm) -> Iterator[tuple[str, str]]:
    """Return what of a study that is called complete does not add up."""
    whole = -(-form.rows // form.chunk)
    first = range(min(whole, len(form.part_files) + 1))  # one that is missing is enough
    yield from _other_keys("part_files", form.part_files, {part_name(index) for index in first})
    if form.parts != whole:
        yield (
            "parts",
            Phrase(
                "{given} is given; {rows} rows in parts of {chunk} make {whole}.",
                given=_given(form.parts),
                rows=form.rows,
                chunk=form.chunk,
                whole=whole,
            ),
        )
    if form.counts is None:
        yield "counts", phrase("This key is missing.")
        return
    stored = sum(part.variants for part in form.part_files.values())
    statuses = form.counts.passing + form.counts.warn + form.counts.fail + form.counts.error
    for name, given, true in (
        ("sample", form.counts.sample, form.rows),
        ("variants", form.counts.variants, stored),
        ("dropped", form.counts.dropped, form.rows - stored),
        (", ".join(STATUSES), statuses, stored),
    ):
        if given != true:
            yield f"counts.{name}", Phrase("{given} is given; the other keys make {true}.", given=given, true=true)


def _other_keys(name: str, given: Mapping[str, Any], needed: set[str]) -> Iterator[tuple[str, str]]:
    for key in sorted(needed - given.keys()):
        yield f"{name}.{key}", phrase("This key is missing.")
    for key in sorted(given.keys() - needed):
        yield f"{name}.{key}", Phrase("This key is unknown{nearest}.", nearest=nearest(key, needed))
