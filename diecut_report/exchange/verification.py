"""A report judged by calculating it again: the same program, the same plugins, the same numbers, the same pages?"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from diecut_report import pipeline
from diecut_report.config import yaml_tree
from diecut_report.config.discovery import Discovery
from diecut_report.config.own_tables import Find
from diecut_report.config.yaml_tree import Tree
from diecut_report.errors import PluginError
from diecut_report.exchange.agreement import Agreement, agreement
from diecut_report.exchange.carried_results import CarriedResults
from diecut_report.exchange.rendering import document, template_of
from diecut_report.exchange.results_form import parsed
from diecut_report.exchange.signatures import Signature, signatures
from diecut_report.languages.phrases import Counted, Phrase, joined, phrase
from diecut_report.report.house_style import HouseStyle
from diecut_report.results.results_file import encoded

Data = Mapping[str, Any]
Told = tuple[str, bool]  # what was found, in words, and whether it is as it should be
SHORT = 12  # of a hash, as in a report
OF_CODE = ("plugin_version", "plugin_sha256", "plugin_file", "plugin_check")
"""What tells of the code and is held against the program's own apart from the numbers."""
OF_DOCUMENT = ("program", "config", "mechanisms", "comparisons", "report", "changes", "wordings", "form_version")
"""What is compared by itself, or is a choice of the document: how much it shows, and against which former one."""


@dataclass
class Verification:
    """Hold what was found of a report; ``broken`` are plugins that broke while it was calculated again."""

    program: Told
    plugins: list[Told]
    config: Told
    agreement: Agreement
    pages: Told | None
    broken: tuple[PluginError, ...] = field(default=())
    signatures: tuple[Signature, ...] = field(default=())

    @property
    def holds(self) -> bool:
        """Return whether everything agrees."""
        told = [self.program, *self.plugins, self.config, *([self.pages] if self.pages else [])]
        return (
            all(good for _, good in told)
            and all(each.holds for each in self.signatures)
            and not self.agreement.differences
            and not self.broken
        )


def verify(
    carried: CarriedResults, discovery: Discovery, tell: Callable[[str], None], weigh: pipeline.Weigh, *, pages: bool = True,
    trusted: Path | None = None, house: HouseStyle | None = None, follow: pipeline.Follow | None = None, matter: pipeline.Matter | None = None,
) -> Verification:  # fmt: skip
    """Calculate the configuration of a report again and hold the report against that; without ``pages`` its numbers alone.

    ``trusted`` holds the certificates that signatures must lead to; without it anybody's signature holds that is whole.
    UserError where its configuration cannot be calculated any more.
    """
    results = carried.results
    signed = signatures(carried.content, trusted) if carried.form == "pdf" else []
    weighing = weigh if "moves" in results["summary"] else None
    following = follow if "advice" in results["summary"] else None
    mattering = matter if "influence" in results else None
    with _tables(carried) as find:
        outcome, text = pipeline.calc(
            _tree(carried), discovery, tell, weigh=weighing, find=find, follow=following, matter=mattering
        )
    again = parsed(encoded(text), "")
    program = _program(results["program"], again["program"])
    numbers = agreement(_numbers(results), _numbers(again))
    is_same = program[1] and not numbers.differences
    setting = partial(_set_again, carried, tell, house, discovery)
    return Verification(
        program,
        list(_plugins(_calculated(results), _calculated(again))),
        _config(carried),
        numbers,
        _pages(carried, signed, _why_not_compared(carried, house, is_same=is_same), setting)
        if pages and carried.form != "json"
        else None,
        outcome.broken,
        tuple(signed),
    )


def _tree(carried: CarriedResults) -> Tree:
    """The configuration in the report; it is called as the report calls it, and problems name the report."""
    said = carried.results["config"]
    tree = yaml_tree.parse(said["source_text"], f"{carried.path} (its configuration)")
    return Tree(tree.root, tree.file, tree.text, sha256(carried.config_content).hexdigest(), said["file"])


@contextmanager
def _tables(carried: CarriedResults) -> Iterator[Find]:
    """Where the tables are that the configuration names: those that the report carries, and none that lie beside it by chance."""
    with TemporaryDirectory(prefix="diecut-report-") as folder:
        places = {name: Path(folder) / f"{number}" / Path(name).name for number, name in enumerate(carried.tables)}
        for name, path in places.items():
            path.parent.mkdir()
            path.write_bytes(carried.tables[name])
        yield lambda name: places.get(name, Path(folder) / "not carried" / name)


def _calculated(results: Data) -> Data:
    return {**results["mechanisms"], **results.get("comparisons", {})}


def _program(first: Data, again: Data) -> Told:
    named = f"{first['name']} {first['version']}"
    old, new = (str(each.get("source_sha256", "")) for each in (first, again))
    if (first["version"], old, first.get("extensions")) == (again["version"], new, again.get("extensions")):
        return Phrase(
            "{named}, source {old}: the same{others}", named=named, old=old[:SHORT], others=_others(first, again)
        ), True
    if first["version"] != again["version"]:
        return Phrase("{named} made the report, this is {version}", named=named, version=again["version"]), False
    if old != new:
        return Phrase(
            "{named}, but its source is another one ({old} then, {new} now)",
            named=named,
            old=old[:SHORT],
            new=new[:SHORT],
        ), False
    return Phrase("{named}, but its extensions are others", named=named), False


def _others(first: Data, again: Data) -> str:
    """Which libraries have another version now, where the report tells theirs: it may explain what differs."""
    old, new = first.get("libraries", {}), again["libraries"]
    told = [
        Phrase("{name} {old} then, {new} now", name=name, old=version, new=new.get(name) or phrase("none"))
        for name, version in old.items()
        if new.get(name) != version
    ]
    return "; " + phrase(joined(told, ", ")) if told else ""


def _plugins(first: Data, again: Data) -> Iterator[Told]:
    """One line for all kinds that are the same, one for each other."""
    kinds = {data["kind"]: _code(data) for data in first.values()}
    now = {data["kind"]: _code(data) for data in again.values()}
    same = [kind for kind, code in kinds.items() if now.get(kind) == code]
    if same:
        yield Phrase("{n} of {total} kinds: the same versions and sources", n=len(same), total=len(kinds)), True
    for kind, code in kinds.items():
        if kind not in now:
            yield Phrase("{kind}: not calculated any more", kind=kind), False
        elif now[kind] != code:
            yield (
                Phrase("{kind}: {old} then, {new} now", kind=kind, old=_told(code), new=_told(now[kind])),
                False,
            )
    yield from ((Phrase("{kind}: not in the report", kind=kind), False) for kind in now if kind not in kinds)


def _code(data: Data) -> tuple[str, str]:
    return str(data.get("plugin_version", "")), str(data.get("plugin_sha256", ""))


def _told(code: tuple[str, str]) -> str:
    return Phrase("version {version}, source {digest}", version=code[0], digest=code[1][:SHORT])


def _config(carried: CarriedResults) -> Told:
    """Whether the configuration and its tables are those whose hashes the report names."""
    said = carried.results["config"]
    contents = {said["file"]: carried.config_content} | carried.tables
    hashes = {file["file"]: str(file["sha256"]) for file in (*said.get("materials", ()), *_logo(said), said)}
    for name, content in contents.items():
        found = sha256(content).hexdigest()
        if found != hashes[name]:
            words = Phrase(
                "{name} is not the one that the report names (SHA-256 {hashes}, found {found})",
                name=name,
                hashes=hashes[name][:SHORT],
                found=found[:SHORT],
            )
            return words, False
    told = {"files": ", ".join(contents), "digest": said["sha256"][:SHORT]}
    return Counted(
        len(contents),
        "{files}, SHA-256 {digest}: the one that the report names",
        "{files}, SHA-256 {digest}: the ones that the report names",
        told,
    ), True


def _logo(said: Data) -> list[Data]:
    return [said["logo"]] if "logo" in said else []


def _numbers(results: Data) -> Data:
    """What must come out again: all but what tells of the code and of the file, and what only the document has."""
    kept = {key: part for key, part in results.items() if key not in OF_DOCUMENT}
    kept["project"] = {key: part for key, part in results["project"].items() if key != "language"}
    for group in ("mechanisms", "comparisons"):
        mechanisms = results.get(group, {})
        kept[group] = {name: {k: v for k, v in data.items() if k not in OF_CODE} for name, data in mechanisms.items()}
    return kept | {"config": {"resolved": _resolved(results["config"].get("resolved", {}))}}


def _resolved(data: Data) -> Data:
    """The resolved configuration without its language, which may be chosen for the document."""
    project = {key: part for key, part in data.get("project", {}).items() if key != "language"}
    return {**data, "project": project}


def _why_not_compared(carried: CarriedResults, house: HouseStyle | None, *, is_same: bool) -> str:
    """Why the document cannot be held against what this program makes of the results in it; nothing where it can."""
    if not is_same:
        return phrase("not compared, since the program or the numbers are others")
    asked = template_of(carried.results)
    if asked == (house.sha256 if house else ""):
        return ""
    own = (
        Phrase("templates of their own (SHA-256 {asked})", asked=asked[:SHORT])
        if asked
        else phrase("the program's templates alone")
    )
    return Phrase("not compared, since they are set with {own}; --template DIR names the templates", own=own)


def _set_again(
    carried: CarriedResults, tell: Callable[[str], None], house: HouseStyle | None, discovery: Discovery
) -> bytes:
    """What this program makes of the results in a document, in the document's form."""
    catalogues = pipeline.catalogues_of(carried.results, discovery, [carried.form], str(carried.path))
    contents, _ = document(carried.results, [carried.form], tell, str(carried.path), catalogues, house)
    return contents[carried.form]


def _pages(carried: CarriedResults, signed: list[Signature], reason: str, setting: Callable[[], bytes]) -> Told:
    """Whether the document is what is set again of its results; not where there is a reason against comparing."""
    if reason:
        return reason, True
    made = setting()
    if carried.content == made:
        return phrase("byte for byte what the program makes of these results"), True
    if carried.form == "pdf" and carried.content.startswith(made):
        if signed and all(each.holds for each in signed):
            return phrase("byte for byte what the program makes of these results, and after it the signatures"), True
        more = len(carried.content) - len(made)
        return (
            Phrase(
                "what the program makes of these results, with {more} bytes that were added later (a signature, a note)",
                more=more,
            ),
            False,
        )
    words = phrase(
        "not what the program makes of these results: it was changed or saved by another program, or set with other libraries of "
        "the system. The numbers above are those that it carries; what its pages show may be others"
    )
    return words, False
