"""The way of the data, as a table of contents: load, validate, resolve, compute, check, render, write."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from diecut_report.config.catalogues import catalogues_for, lacking
from diecut_report.config.loader import Config, examined, in_order, load_config
from diecut_report.config.own_tables import Find
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import Tree
from diecut_report.errors import MAX_PRINTED_MECHANISMS, PluginError, Problem, UserError, nearest
from diecut_report.results.changes import compare_with
from diecut_report.results.conclusion import doubtful
from diecut_report.results.model import ResultsRecord
from diecut_report.results.results_file import encoded, results_text
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues
from diecut_report.text.phrases import Phrase, phrase

if TYPE_CHECKING:
    from diecut_report.report.pages.firm_templates import HouseStyle
    from diecut_report.results.press_run import Run

FORMATS = ("html", "pdf", "docx", "xlsx", "json")
DRAWN = FORMATS[:-1]  # of a report that can be made again from its results

Tell = Callable[[str], None]
Judge = Callable[[Config], list[Problem]]
Source = Path | Tree  # a configuration: its file, or what was read and changed

NO_PANGO = phrase(
    "The PDF cannot be made, because a library of the system is missing: {library}. Install it (Debian, "
    "Ubuntu: apt-get install libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0), or leave the "
    "PDF out with --format html,json."
)


class Lost(NamedTuple):
    """A figure or export that could not be drawn: of which mechanism, its id, and why."""

    what: str
    mechanism: str
    id: str
    words: str


class AskedReport(NamedTuple):
    """How a report is wanted, in place of what its configuration says: language, detail, the mechanisms that alone are shown.

    ``house`` are a firm's own templates for HTML and PDF.
    """

    language: str | None = None
    detail: str | None = None
    only: tuple[str, ...] = ()
    house: HouseStyle | None = None

    def noted(self, results: ResultsRecord) -> ResultsRecord:
        """Return the results, of which alone the report is made, with what is wanted."""
        asked = {"detail": self.detail, "only": list(self.only), "template_sha256": self.house and self.house.sha256}
        language = {"language": self.language} if self.language else {}
        report = results.report.with_(**{key: each for key, each in asked.items() if each})
        return results.with_(project=results.project.with_(**language), report=report)


AS_CONFIGURED = AskedReport()
Places = dict[tuple[str, str], str]  # of a mechanism's name and the id of a figure or export


@dataclass(frozen=True)
class ReportOutcome:
    """What came out: the results document, the files written, and the plugins that broke."""

    results: ResultsRecord
    written: tuple[Path, ...]
    broken: tuple[PluginError, ...]
    warnings: tuple[str, ...] = ()


def validate(config: Source, discovery: Discovery, judge: Judge | None = None) -> tuple[PluginError, ...]:
    """Return the plugins that are broken; UserError with all that is wrong, also with machines that cannot exist, or that ``judge`` tells."""
    made, problems = examined(config, discovery)
    problems += judge(made) if judge and not problems and not made.broken else []
    from diecut_report.results.press_run import impossible  # with the engine

    more, broken = impossible(made, problems)
    if problems or more:
        raise UserError(in_order([*problems, *more]))
    return (*made.broken.values(), *broken)


@dataclass(frozen=True)
class Calculated:
    """A calculated configuration: its results, the plugins that broke, and where figures and exports are declared."""

    source: Source
    config: Config
    results: ResultsRecord
    broken: tuple[PluginError, ...]
    has_broken: bool  # whether mechanisms were not calculated
    places: Places


def calc(
    config: Source, discovery: Discovery, tell: Tell, target: Path | None = None, find: Find | None = None
) -> tuple[ReportOutcome, str]:
    """Return the results document and its text; written to ``target`` if there is one.

    ``find`` says where tables are that the configuration names, where they are not beside it.
    """
    made = calculated(config, discovery, tell, find=find)
    text = results_text(made.results)
    if target is not None:
        _write({target: encoded(text)}, config, through=True)
    written = (target,) if target else ()
    return ReportOutcome(made.results, written, made.broken, tuple(doubtful(made.results, discovery))), text


def report(
    made: Calculated, discovery: Discovery, tell: Tell, folder: Path, formats: Sequence[str], asked: AskedReport = AS_CONFIGURED,
    former: ResultsRecord | None = None,
) -> ReportOutcome:  # fmt: skip
    """Write the report in the asked formats, as ``NAME.html``, ``NAME.pdf`` … in the folder, and the exports beside it.

    ``former`` are the results of a former revision, since which changes are reported and marked.
    """
    results = asked.noted(made.results)
    results = compare_with(former, results) if former else results
    catalogues = catalogues_of(results, discovery, formats)
    contents, undrawn = rendered(results, formats, tell, catalogues, asked.house)
    files_beside, unwritten = exported(results, tell)
    contents |= files_beside
    stem = Path(made.source.name).stem
    files = {folder / f"{stem}.{ending}": content for ending, content in contents.items()}
    _write(files, made.source)
    faults = (*made.broken, *(_broken(results, made.places, lost) for lost in (*undrawn, *unwritten)))
    return ReportOutcome(
        results, tuple(files), faults, (*untranslated(results, catalogues), *doubtful(results, discovery))
    )


def catalogues_of(results: ResultsRecord, discovery: Discovery, formats: Sequence[str], file: str = "") -> Catalogues:
    """Return the catalogues for a report of these results; UserError where the words of one of their mechanisms are not complete."""
    printed = set(DRAWN) & set(formats)
    language = results.project.language
    return catalogues_for(language if printed else SOURCE_LANGUAGE, _kinds(results), discovery, file)


def untranslated(results: ResultsRecord, catalogues: Catalogues) -> list[str]:
    """Return in words which foreign plugins of a report have words that stay English."""
    return lacking(catalogues, _kinds(results))


def _kinds(results: ResultsRecord) -> list[str]:
    return [mechanism.kind for mechanism in results.mechanisms.values()]


def _refuse_many_sheets(config: Config, formats: Sequence[str]) -> None:
    """A PDF's memory grows with its sheets, by 25 to 80 MB for each mechanism; UserError where there are too many."""
    count = len(config.kinds)
    if "pdf" in formats and count > MAX_PRINTED_MECHANISMS:
        words = (
            Phrase("There are {count} mechanisms; the PDF of a report has at most {max_printed_mechanisms}. Leave the PDF out with "
                "--format html,json, or split the configuration.", count=count, max_printed_mechanisms=MAX_PRINTED_MECHANISMS)
        )  # fmt: skip
        raise UserError(Problem(words, config.tree.file))


def _refuse_unknown(config: Config, only: Sequence[str]) -> None:
    """UserError where the report is to show what is not a mechanism of the configuration."""
    known = list(config.kinds)
    problems = [
        Problem(
            Phrase("--only {name} is not a mechanism{nearest}; the mechanisms: {known}.", name=repr(name), nearest=nearest(name, known),
                known=', '.join(known)),
            config.tree.file,
        )
        for name in only
        if name not in known
    ]  # fmt: skip
    if problems:
        raise UserError(problems)


def calculated(
    source: Source, discovery: Discovery, tell: Tell, formats: Sequence[str] = (), only: Sequence[str] = (), find: Find | None = None
) -> Calculated:  # fmt: skip
    """Calculate a configuration; UserError with all that is wrong, also where the formats or mechanisms of a report are not possible."""
    tell(phrase("reading the configuration"))
    config = load_config(source, discovery, find=find)
    _refuse_unknown(config, only)
    _refuse_many_sheets(config, formats)
    from diecut_report.results.document import document  # with the engine, which checking alone does not need
    from diecut_report.results.press_run import compute

    run = compute(config, lambda name: tell(Phrase("calculating {name}", name=name)))
    results = document(run)
    broken = (*run.errors.values(), *_failed(results))
    return Calculated(source, config, results, broken, bool(run.errors), _places(run))


def _places(run: Run) -> Places:
    """Where in its plugin each figure and export is declared."""
    made = {name: calc.mechanism for name, calc in run.calculations.items()}
    made |= {case.name: case.comparison.mechanism for case in run.cases}
    figures = {(name, each.id): each.at for name, mechanism in made.items() for each in mechanism.figures}
    exports = {(name, each.id): each.at for name, mechanism in made.items() for each in mechanism.exports}
    return figures | exports


def _failed(results: ResultsRecord) -> Iterator[PluginError]:
    """The figures and exports that could not be made."""
    for name, mechanism in results.calculated.items():
        made = [("figure", each.id, each.error) for each in mechanism.figures]
        made += [("export", each.id, each.error) for each in mechanism.exports]
        yield from (PluginError(f"{what} {id!r}: {error}", mechanism.kind, name) for what, id, error in made if error)


def _broken(results: ResultsRecord, places: Places, lost: Lost) -> PluginError:
    """What showed only in drawing that it cannot be drawn."""
    mechanism = results.calculated[lost.mechanism]
    words = Phrase("{what} {id} cannot be drawn: {words} ({places})", what=lost.what, id=repr(lost.id), words=lost.words,
        places=places[lost.mechanism, lost.id])  # fmt: skip
    return PluginError(words, mechanism.kind, lost.mechanism)


def rendered(
    results: ResultsRecord,
    formats: Sequence[str],
    tell: Tell,
    catalogues: Catalogues | None = None,
    house: HouseStyle | None = None,
) -> tuple[dict[str, bytes], list[Lost]]:
    """Return the content of each format, all complete before anything is written; and the figures that could not be drawn."""
    undrawn: list[Lost] = []
    contents = {"json": encoded(results_text(results))} if "json" in formats else {}
    if set(DRAWN) & set(formats):
        tell(phrase("drawing the report"))
        from diecut_report.report.pages import firm_templates as template_limits
        from diecut_report.report.rendering import Rendering

        rendering = Rendering(results, catalogues, house)
        with template_limits.bounded(house):
            contents |= {"html": encoded(rendering.html())} if "html" in formats else {}
            if "pdf" in formats:
                tell(phrase("typesetting the pages"))
                contents["pdf"] = _pdf(rendering)
        if "docx" in formats:
            tell(phrase("writing the document"))
            contents["docx"] = rendering.docx()
        if "xlsx" in formats:
            contents["xlsx"] = rendering.xlsx()
        undrawn += [Lost("figure", each.mechanism, each.id, each.words) for each in rendering.faults]
    return {ending: contents[ending] for ending in formats}, undrawn


def exported(results: ResultsRecord, tell: Tell) -> tuple[dict[str, bytes], list[Lost]]:
    """Return the profiles of the mechanisms as tables and drawings, by the ending of their file: ``INSTANCE.cam_1.dxf``.

    Beside them those that cannot be written.
    """
    if not any(mechanism.exports for mechanism in results.calculated.values()):
        return {}, []
    tell(phrase("drawing the profiles"))
    from diecut_report.report.profile_files import written

    files, faults = written(results)
    return files, [
        Lost("export", name, export.id, f"{type(cause).__name__}: {cause}") for name, export, cause in faults
    ]


def _pdf(rendering: Any) -> bytes:
    from diecut_report.files import room

    with room():  # for the files of fonts: the command line does not wait until the page engine removes them
        try:
            return rendering.pdf()  # type: ignore[no-any-return]
        except OSError as error:
            if "cannot load library" not in str(error):
                raise
            missing = Phrase(NO_PANGO, library=str(error).split(":")[0].removeprefix("cannot load library "))
            raise UserError(Problem(missing)) from error


def _write(files: dict[Path, bytes], config: Source, *, through: bool = False) -> None:
    from diecut_report.files import write_all

    write_all(files, keep=Path(config.file) if isinstance(config, Tree) else config, through=through)
