"""The example configurations: what the program says of them, and their reports."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from diecut_report.config.plugins import Discovery
from diecut_report.design.findings import with_findings
from diecut_report.press import Press
from diecut_report.report.chapters.steps import placed, sketch
from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.style import SizesSize, Svg
from diecut_report.report.scope import letter, parts
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import MechanismRecord
from diecut_report.results.model import ResultsRecord
from tools.site.markup import html
from tools.site.sources import ROOT, Sources

CONFIGS = ROOT / "configs"
SMALL = ("circular_knife",)  # which alone a quick site calculates
FIRST = (
    "circular_knife",
    "platen_press_zppt30",
    "folding_knife",
    "flat_cylinder_press",
)  # where a kind is rather looked for
WORDS = Catalogue("en")


class Example(NamedTuple):
    """An example configuration: its name, its text and what it holds; its results and its report where these were made."""

    name: str
    text: str
    config: Mapping[str, Any]
    results: ResultsRecord | None = None
    report: bytes = b""

    @property
    def title(self) -> str:
        """Return what it is called in its own words."""
        return str(self.config["project"]["title"])


class Shown(NamedTuple):
    """Where a kind of mechanism is shown: the example, the name and the letter of the mechanism there, and its results if there are."""

    example: Example
    kind: str
    name: str
    letter: str
    mechanism: MechanismRecord | None

    @property
    def is_own(self) -> bool:
        """Return whether the configuration has a block for it; a comparison has none."""
        return self.name in self.example.config["mechanisms"]


def configurations() -> list[Path]:
    """Return the files of the example configurations, those first in which a mechanism is rather looked for."""
    found = [file for file in sorted(CONFIGS.glob("*.yaml")) if "mechanisms" in yaml.safe_load(file.read_text("utf-8"))]
    ranks = {name: rank for rank, name in enumerate(FIRST)}
    return sorted(found, key=lambda file: ranks.get(file.stem, len(ranks)))


def examples(*, quick: bool) -> list[Example]:
    """Return all examples with their results and reports; of a quick site the small ones have them alone."""
    return [_example(file, calculated=not quick or file.stem in SMALL) for file in configurations()]


def _example(file: Path, *, calculated: bool) -> Example:
    text = file.read_text(encoding="utf-8")
    plain = Example(file.stem, text, yaml.safe_load(text))
    if not calculated:
        return plain
    with tempfile.TemporaryDirectory() as folder:
        made = with_findings(Press.read(file, Discovery()).calculate()).report(Path(folder), ["html"])
        return plain._replace(results=made.results, report=(Path(folder) / f"{file.stem}.html").read_bytes())


def shown_kinds(found: list[Example]) -> dict[str, Shown]:
    """Return for each kind the first example that has it; comparisons are known where they are calculated."""
    kinds: dict[str, Shown] = {}
    for example in found:
        if example.results is None:
            for name, given in example.config["mechanisms"].items():
                kinds.setdefault(given["kind"], Shown(example, given["kind"], name, "", None))
        else:
            for index, (name, made) in enumerate(parts(example.results)):
                kinds.setdefault(made.kind, Shown(example, made.kind, name, letter(index), made))
    return kinds


def drawn(shown: Shown) -> tuple[Svg, str] | None:
    """Return the sketch of a mechanism, if it has none to scale its first figure, and its caption; None where there is no figure."""
    if shown.mechanism is None:
        return None
    figures = [each for each in placed(shown.letter, shown.mechanism) if not each.figure.error]
    chosen = sketch(figures) or figures[:1]
    if not chosen:
        return None
    figure = chosen[0].figure
    return render(figure, shown.mechanism.curves, WORDS, shown.kind, SizesSize.LOW), figure.caption


def block(shown: Shown) -> str:
    """Return the block of a mechanism as it stands in its configuration, without the comments of what follows it."""
    lines = shown.example.text.splitlines()
    start = next(number for number, line in enumerate(lines) if re.match(rf"  {re.escape(shown.name)}:", line))
    end = next((n for n in range(start + 1, len(lines)) if re.match(r" {0,2}[^ #]", lines[n])), len(lines))
    while not lines[end - 1].strip() or re.match(r" {0,2}#", lines[end - 1]):
        end -= 1
    return "\n".join(["mechanisms:", *lines[start:end]])


# The reports of the examples, as the program writes them, and a page that leads to them.


EXTRA = "_extra"  # what stands in it is part of the site as it is


def add_reports(sources: Sources, examples: list[Example]) -> None:
    """Add the reports that there are, and their list."""
    made = sorted((each for each in examples if each.report), key=lambda each: each.name)
    for example in made:
        sources.add(f"{EXTRA}/reports/{example.name}.html", example.report)
    sources.page("reports.md", _page(made))


def _page(made: list[Example]) -> Iterator[str]:
    yield from ("# Reports of the examples", "")
    yield "What the program writes of the configurations in `configs/`, as it writes them: each is one file, which needs no network."
    yield from html(
        "<ul>",
        *(f'<li><a href="reports/{each.name}.html">{escape(each.title)}</a> {_verdict(each)}</li>' for each in made),
        "</ul>",
    )


def _verdict(example: Example) -> str:
    """The name of the configuration, and the verdict."""
    status = example.results.status if example.results else ""
    return f"<code>configs/{example.name}.yaml</code>: {escape(status)}"
