"""Makes docs/standards.md and docs/plausible-values.md from the data files of the standards: ``python tools/make_standards_page.py``."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import starmap
from pathlib import Path

from diecut_report.quantities.units import pretty
from diecut_report.standards import DATA, standard_ids, standard_series, standard_series_by, standard_table
from diecut_report.standards.ranges import EVERY, SOURCES, range_table
from diecut_report.standards.tables import Column, StandardSeries, StandardTable

PAGE = Path(__file__).parents[1] / "docs" / "standards.md"
RANGES = PAGE.with_name("plausible-values.md")
INTRODUCTION = """\
# Standard series

Made from the files in `diecut_report/standards/data` by `python tools/make_standards_page.py`.

Where a method picks a standard size — the rating of a motor, the length of a belt, the pitch of a chain — it takes
the size from one of the series below. A value stands here only if at least two published tables, independent of each
other, agree on it; the tables are named under *Sources*. What is missing, and why, stands under *Left out*.
"""
CATALOGUES = """\
## Catalogues

Machine elements by their designations, in the same folder: what a method takes where a designation is given, or chooses from.
"""
USE = """\
## Use in a plugin

```python
from diecut_report.api import standard_series, standard_series_by, standard_table

standard_series("iec_60072_ratings").values  # (0.06, 0.09, 0.12, …), in kW
standard_series_by("iso_4184_lengths")["SPA"].values  # (800.0, 900.0, …), in mm
standard_table("vbelt_least_diameter").values["SPA"]  # 90.0, in mm
standard_table("ball_bearings")  # a catalogue: its columns by designation
```

A table may also be read as a series: its different values in ascending order.

## Adding a series

Write `diecut_report/standards/data/ID.json` with `title`, `unit`, `sources` (two tables at least), `left_out` and one of

- `values`: the values in ascending order, with `range`: the first and the last of them, stated again;
- `table`: a value for each name;
- `by`: for each name (such as a belt section) `values` and `range`, and `sources` or `left_out` if they differ from
  those of the file.

A value out of order or given twice, a range that is not met, an unknown unit or fewer than two sources raise a `StandardFault`
that names the series. Type a second source's table into `tests/standards/test_standards.py` and make this page again.
"""
PLAUSIBLE = """\
# Plausible values

Made from `diecut_report/standards/data/ranges.yaml` by `python tools/make_standards_page.py`.

A value outside its usual range is a warning; outside the possible one the file is refused, unless it says why:
`{value: 0.7, beyond: "sintered lining, measured on the test rig"}` ([how](configuration.md#plausible-values)). Zero is left to the bounds of the key.
● marks keys whose value counts as assumed unless it states where it comes from. A row with an expression bounds what that gives;
where it gives nothing, as the designation of a bearing does not tell the mean diameter, the value asks for a basis, too.

| key | usual | possible | source |
| --- | --- | --- | --- |"""
WITHOUT = """
## Keys without a row

Every other number has none, for one of these reasons; the bounds of the key and the sizes of its dimension hold.
Of keys with ● no other value is known to be usual: typed without a basis that can be looked up they are open, whatever the checks say.
"""
CHOICES = """
## Choices that ask where they come from

A text that takes something out of a calculation is open unless it stands as `{value: …, basis: drawing}` or rests on what can be looked up.
"""


def pages() -> dict[Path, str]:
    """The text of each page by its file."""
    ranges = [PLAUSIBLE, *_ranges(), WITHOUT, *_without()]
    return {
        PAGE: "\n".join([INTRODUCTION, *_overview(), "", *_chapters(), CATALOGUES, *_catalogues(), USE]),
        RANGES: "\n".join(ranges),
    }


def _ranges() -> Iterator[str]:
    for row in range_table().ranges:
        keys = "; ".join(f"`{kind}`: {', '.join(starmap(_bounded, own.items()))}" for kind, own in row.keys.items())
        unit = "" if row.unit == "1" else f" {pretty(row.unit)}"
        usual, hard = (f"{low:g} … {high:g}{unit}" for low, high in (row.usual, row.hard))
        yield f"| {keys}{' ●' if row.needs_basis else ''} | {usual} | {hard} | {SOURCES.get(row.by, row.by)} |"


def _bounded(key: str, of: str) -> str:
    return f"`{key}`, as `{of.replace('${', '').replace('}', '')}`" if of else f"`{key}`"


def _without() -> Iterator[str]:
    for group in range_table().without:
        kinds = (f"{'all' if kind == EVERY else f'`{kind}`'}: {', '.join(keys)}" for kind, keys in group.keys.items())
        yield f"- {group.reason[:1].upper()}{group.reason[1:]}{' ●' if group.needs_basis or group.by_reference else ''}. {'; '.join(kinds)}."
    yield CHOICES
    for row in range_table().choices:
        keys = (
            f"`{kind}`: {', '.join(f'`{key}: {text}`' for key, texts in own.items() for text in texts)}"
            for kind, own in row.keys.items()
        )
        yield f"- {row.reason[:1].upper()}{row.reason[1:]}. {'; '.join(keys)}."
    yield ""


def _overview() -> Iterator[str]:
    yield "| id | title | unit | different values | range |"
    yield "| --- | --- | --- | --- | --- |"
    for series in _all_series():
        first, last = series.values[0], series.values[-1]
        size = f"{len(series.values)} | {first:g} … {last:g}"
        yield f"| `{series.id}` | {series.title} | {_unit(series) or '–'} | {size} |"


def _all_series() -> Iterator[StandardSeries]:
    for form in ("values", "table"):
        yield from map(standard_series, standard_ids(form))
    for id in standard_ids("by"):
        yield from standard_series_by(id).values()


def _chapters() -> Iterator[str]:
    for id in standard_ids("values"):
        yield from _chapter(id, standard_series(id))
    for id in standard_ids("table"):
        yield from _chapter(id, standard_table(id))
    for id in standard_ids("by"):
        yield from _chapter(id, *standard_series_by(id).values())


def _chapter(id: str, *parts: StandardSeries | StandardTable) -> Iterator[str]:
    yield f"## {parts[0].title} — `{id}`\n"
    for part in parts:
        if name := part.id.removeprefix(id).removeprefix("."):
            yield f"### {name}\n"
        yield _numbers(part) if isinstance(part, StandardSeries) else "\n".join(_rows(part))
        yield "\nSources:\n"
        yield from (f"- {source}" for source in part.sources)
        yield ""
    if len(parts) > 1:
        yield "### Not in the series\n"
    yield from (f"Left out: {text}\n" for text in dict.fromkeys(part.left_out for part in parts) if text)


def _catalogues() -> Iterator[str]:
    for id in sorted(file.stem for file in DATA.glob("*.yaml") if file.stem != "ranges"):
        table = standard_table(id)
        yield f"### {table.title} — `{id}`\n"
        named = [["name", *table.names]] if table.names else []
        columns = [*named, *([_head(each), *map("{:g}".format, each.values)] for each in table.columns)]
        head, *rows = zip(*columns, strict=True)
        yield from (f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows))
        yield "\nSources:\n"
        yield from (f"- {source}" for source in table.sources)
        yield f"\nLeft out: {table.left_out}\n"


def _head(column: Column) -> str:
    return column.name if column.unit == "1" else f"{column.name}, {pretty(column.unit)}"


def _numbers(series: StandardSeries) -> str:
    """The values on one line; of a very long series the first and last few."""
    shown = [f"{value:g}" for value in series.values]
    text = " · ".join(shown) if len(shown) <= 60 else f"{' · '.join(shown[:6])} … {' · '.join(shown[-4:])}"
    return f"{text} {_unit(series)}".rstrip()


def _rows(table: StandardTable) -> Iterator[str]:
    yield f"| name | value, {_unit(table)} |"
    yield "| --- | --- |"
    yield from (f"| {name} | {value:g} |" for name, value in table.values.items())


def _unit(of: StandardSeries | StandardTable) -> str:
    return "" if of.unit == "1" else pretty(of.unit)


if __name__ == "__main__":
    for file, text in pages().items():
        file.write_text(text, encoding="utf-8")
