"""The results document of a report made once more: from the configuration that it carries and the options that it tells, by this program."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from diecut_report import pipeline
from diecut_report.config import yaml_tree
from diecut_report.config.discovery import Discovery
from diecut_report.config.model import DETAILS
from diecut_report.config.own_tables import Find
from diecut_report.config.yaml_tree import Tree
from diecut_report.errors import PluginError, UserError
from diecut_report.exchange.carried_results import CarriedResults
from diecut_report.exchange.rendering import TEMPLATE, template_of
from diecut_report.exchange.results_form import parsed
from diecut_report.languages.catalogues import languages
from diecut_report.languages.phrases import Phrase, cell, phrase
from diecut_report.results.changes import compare_with
from diecut_report.results.results_file import config_content, encoded, results_text

Data = dict[str, Any]
Found = tuple[str, bool]  # what was found, in words, and whether it is as it should be
SHORT = 12  # of a hash, as in a report
CHANGES = ("changes", "former")


class ReportParts(NamedTuple):
    """What a report tells beyond the results of ``calc``: the weight of what is assumed, the end of all advice, the influence of inputs."""

    weigh: pipeline.Weigh
    follow: pipeline.Follow
    matter: pipeline.Matter


class Recalculation(NamedTuple):
    """Hold the results document as the program makes it now, the plugins that broke, and what was found of the report's options."""

    results: Data
    broken: tuple[PluginError, ...]
    options: tuple[Found, ...]


def recalculated(
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], parts: ReportParts, previous: Data | None
) -> Recalculation:  # fmt: skip
    """Return the results document that this program makes of the configuration and the options in a report.

    ``previous`` are the results of the former revision, where they are given; else they are calculated from what the report carries
    of it. UserError where the configuration cannot be calculated any more.
    """
    given = carried.results
    weigh, follow, matter = parts if _is_report(carried) else (None, None, None)
    with _tables(carried.tables) as find:
        tree = _tree(given["config"], f"{carried.path} (its configuration)")
        outcome, _ = pipeline.calc(tree, discovery, tell, weigh=weigh, find=find, follow=follow, matter=matter)
    results, asked = outcome.results, _asked(given, outcome.results)
    former, lost = _former(carried, discovery, tell, previous)
    options = _options(given, results, asked)
    asked.told(results)
    compare_with(former, results)
    again = parsed(encoded(results_text(results)), "")
    if isinstance(template_of(given), str) and template_of(given):
        again["report"][TEMPLATE] = template_of(given)  # judged with the pages
    if lost:
        again |= {key: given[key] for key in CHANGES if key in given}
    return Recalculation(
        again, outcome.broken, (options, *([lost] if lost else ()), *_other_changes(given, again, previous))
    )


def _is_report(carried: CarriedResults) -> bool:
    """Whether the results are those of a report; a results file without any of its parts is as ``calc`` writes it."""
    summary = carried.results["summary"]
    return carried.form != "json" or "moves" in summary or "advice" in summary or "influence" in carried.results


def _tree(said: Mapping[str, Any], file: str) -> Tree:
    """A configuration in a report; it is called as the report calls it, and problems name the report."""
    tree = yaml_tree.parse(said["source_text"], file)
    return Tree(tree.root, tree.file, tree.text, sha256(config_content({"config": said})).hexdigest(), said["file"])


@contextmanager
def _tables(contents: Mapping[str, bytes]) -> Iterator[Find]:
    """Where the tables are that a configuration names: those that the report carries, and none that lie beside it by chance."""
    with TemporaryDirectory(prefix="diecut-report-") as folder:
        places = {name: Path(folder) / f"{number}" / Path(name).name for number, name in enumerate(contents)}
        for name, path in places.items():
            path.parent.mkdir()
            path.write_bytes(contents[name])
        yield lambda name: places.get(name, Path(folder) / "not carried" / name)


# --- options of the command that the configuration does not tell ------------------------------------------------------


def _asked(given: Data, again: Data) -> pipeline.AskedReport:
    """The options that a report tells, as far as the command takes them; what it does not take differs from what comes out now."""
    asked = given["report"] if isinstance(given.get("report"), dict) else {}
    language, detail, only = given["project"].get("language"), asked.get("detail"), asked.get("only")
    is_only = isinstance(only, list) and all(isinstance(name, str) and name in again["mechanisms"] for name in only)
    return pipeline.AskedReport(
        language if language in languages() else None,
        detail if detail in DETAILS else None,
        tuple(dict.fromkeys(only)) if is_only and only else (),
    )


def _options(given: Data, again: Data, asked: pipeline.AskedReport) -> Found:
    """The options in words: what a report shows by them does not follow from its configuration."""
    told = [
        f"--language {asked.language}" if asked.language not in (None, again["project"]["language"]) else "",
        f"--detail {asked.detail}" if asked.detail not in (None, again["report"]["detail"]) else "",
        f"--only {','.join(asked.only)}" if asked.only else "",
        f"--template (SHA-256 {template_of(given)[:SHORT]})" if template_of(given) else "",
        f"--previous {_former_file(given)}" if "changes" in given else "",
    ]
    named = " ".join(filter(None, told))
    if not named:
        return phrase(
            "none: the report shows what its configuration asks for, and no changes since a former revision"
        ), True
    return Phrase("made with {options}; all else follows from the configuration", options=named), True


def _former_file(given: Data) -> str:
    said = given.get("former")
    return f"{cell(said['file'])} (SHA-256 {said['sha256'][:SHORT]})" if said else "…"


# --- the former revision -----------------------------------------------------------------------------------------------


def _former(
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], previous: Data | None
) -> tuple[Data | None, Found | None]:
    """The results of the former revision, or what keeps the changes since then from being proved."""
    said = carried.results.get("former")
    if previous is not None or "changes" not in carried.results:
        return previous, None
    if not said:
        words = phrase(
            "not proved: the report does not carry the former configuration; --previous FILE names the former report"
        )
        return None, (words, False)
    try:
        with _tables(carried.former_tables) as find:
            tree = _tree(said, f"{carried.path} (its former configuration)")
            outcome, _ = pipeline.calc(tree, discovery, tell, find=find)
    except UserError:
        words = phrase(
            "not proved: the former configuration cannot be calculated any more; --previous FILE names the former report"
        )
        return None, (words, False)
    return parsed(encoded(results_text(outcome.results)), ""), None


def _other_changes(given: Data, again: Data, previous: Data | None) -> Iterator[Found]:
    if previous is None and given.get("changes") != again.get("changes"):
        words = "not those that come of the former configuration in the report; where another program calculated that, --previous FILE proves them"
        yield phrase(words), False
