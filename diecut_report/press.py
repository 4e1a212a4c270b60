"""The way of a machine from its file to its report: read, validated, calculated, written; all commands and scripts go it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from diecut_report.config.loader import Config, examined, in_order, load_config
from diecut_report.config.own_tables import Find
from diecut_report.config.parts.reading import typed_changes
from diecut_report.config.plugins import Discovery, catalogues_for, lacking
from diecut_report.config.references import rewritten
from diecut_report.config.yaml import KeyPath, Tree, dotted
from diecut_report.errors import MAX_PRINTED_MECHANISMS, PluginError, Problem, UserError, nearest, refusal
from diecut_report.files import write_all
from diecut_report.results.conclusion import doubtful
from diecut_report.results.model import ResultsRecord
from diecut_report.results.results_file import encoded, results_text
from diecut_report.text.catalogues import SOURCE_LANGUAGE
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


def _silent(_: str) -> None:
    """Tell nothing."""


@dataclass(frozen=True)
class Press:
    """Hold a machine with a valid configuration, and the kinds that it may use.

        press = Press.read(Path("press.yaml"), Discovery())
        made = press.calculate()
        made.report(Path("out"), ["html", "pdf"])

    ``tell`` is called with what is being done.
    """

    config: Config
    discovery: Discovery
    tell: Tell = _silent

    @classmethod
    def read(cls, source: Source, discovery: Discovery, tell: Tell = _silent, *, find: Find | None = None) -> Press:
        """Return the press of a configuration; UserError with all that is wrong with it. A broken plugin is kept in ``config.broken``.

        ``find`` says where tables are that the configuration names, where they are not beside it.
        """
        tell(phrase("reading the configuration"))
        return cls(load_config(source, discovery, find=find), discovery, tell)

    @staticmethod
    def validate(source: Source, discovery: Discovery, judge: Judge | None = None) -> tuple[PluginError, ...]:
        """Return the plugins that are broken; UserError with all that is wrong, also with machines that cannot exist, or that ``judge`` tells."""
        config, problems = examined(source, discovery)
        problems += judge(config) if judge and not problems and not config.broken else []
        from diecut_report.results.press_run import impossible  # with the engine

        more, broken = impossible(config, problems)
        if problems or more:
            raise UserError(in_order([*problems, *more]))
        return (*config.broken.values(), *broken)

    def usable(self) -> Press:
        """Return the press; PluginError where one of its plugins is broken."""
        for error in self.config.broken.values():
            raise error
        return self

    def with_values(self, values: Mapping[KeyPath, str], *, over_references: bool = False) -> Press:
        """Return the press with these values typed into its text, by their places; UserError where that is not possible or not allowed."""
        tree, parts = self.config.tree, self.config.parts
        if parts is not None:
            tree = parts.reader.tree  # what follows from the parts is worked out again
            if derived := next((path for path in values if parts.follows(path[1:])), None):
                template = "{path} follows from the parts of the machine; change these in the file."
                raise refusal(template, tree.file, path=dotted(derived[1:]))
            values = {place: str(text) for place, text in typed_changes(tree, values).items()}
        changed = rewritten(tree, values, self.config.units(values), over_references=over_references)
        return replace(self, config=load_config(changed, self.discovery))

    def require_reportable(self, formats: Sequence[str], only: Sequence[str] = ()) -> None:
        """Raise UserError where a report in these formats, or of these mechanisms alone, is not possible."""
        known, file = list(self.config.kinds), self.config.tree.file
        template = "--only {name} is not a mechanism{nearest}; the mechanisms: {known}."
        told = {"known": ", ".join(known)}
        unknown = [
            Phrase(template, told, name=repr(name), nearest=nearest(name, known)) for name in only if name not in known
        ]
        if unknown:
            raise UserError([Problem(each, file) for each in unknown])
        # a PDF's memory grows with its sheets, by 25 to 80 MB for each mechanism
        if "pdf" in formats and len(known) > MAX_PRINTED_MECHANISMS:
            template = (
                "There are {count} mechanisms; the PDF of a report has at most {max_printed_mechanisms}. Leave the PDF out with "
                "--format html,json, or split the configuration."
            )
            raise refusal(template, file, count=len(known), max_printed_mechanisms=MAX_PRINTED_MECHANISMS)

    def calculate(self) -> CalculatedPress:
        """Return the results, with the plugins that broke; UserError with all that is wrong where the machine cannot exist."""
        from diecut_report.results.document import document  # with the engine, which reading alone does not need
        from diecut_report.results.press_run import compute

        run = compute(self.config, lambda name: self.tell(Phrase("calculating {name}", name=name)))
        results = document(run)
        broken = (*run.errors.values(), *_failed(results))
        return CalculatedPress(self, results, broken, bool(run.errors), _places(run))


@dataclass(frozen=True)
class CalculatedPress:
    """Hold a calculated press: its results, the plugins that broke, and where figures and exports are declared."""

    press: Press
    results: ResultsRecord
    broken: tuple[PluginError, ...]
    has_broken: bool  # whether mechanisms were not calculated
    places: Places

    @property
    def warnings(self) -> tuple[str, ...]:
        """Return in words which plugins have faults in their formulas."""
        return tuple(doubtful(self.results, self.press.discovery))

    @property
    def text(self) -> str:
        """Return the results file."""
        return results_text(self.results)

    def save(self, file: Path) -> None:
        """Write the results file; Unwritable in words where that is not possible."""
        write_all({file: encoded(self.text)}, keep=Path(self.press.config.tree.file), through=True)

    def report(
        self, folder: Path, formats: Sequence[str], asked: AskedReport = AS_CONFIGURED, former: ResultsRecord | None = None
    ) -> ReportOutcome:  # fmt: skip
        """Write the report in the asked formats, as ``NAME.html``, ``NAME.pdf`` … in the folder, and the exports beside it.

        ``former`` are the results of a former revision, since which changes are reported and marked.
        """
        tree, tell, discovery = self.press.config.tree, self.press.tell, self.press.discovery
        results = asked.noted(self.results)
        if former:
            from diecut_report.results.changes import compare_with

            results = compare_with(former, results)
        made, (profiles, unwritten) = drawn(results, formats, discovery, tell, asked.house), exported(results, tell)
        stem = Path(tree.name).stem
        files = {folder / f"{stem}.{ending}": content for ending, content in (made.contents | profiles).items()}
        write_all(files, keep=Path(tree.file))
        faults = (*self.broken, *(_broken(results, self.places, lost) for lost in (*made.lost, *unwritten)))
        return ReportOutcome(results, tuple(files), faults, (*made.untranslated, *self.warnings))


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
    message = Phrase("{what} {id} cannot be drawn: {words} ({places})", what=lost.what, id=repr(lost.id), words=lost.words,
        places=places[lost.mechanism, lost.id])  # fmt: skip
    return PluginError(message, mechanism.kind, lost.mechanism)


class Drawn(NamedTuple):
    """A report in its formats, what of it could not be drawn, and in words which foreign plugins have texts that stay English."""

    contents: dict[str, bytes]
    lost: list[Lost]
    untranslated: list[str]


def drawn(
    results: ResultsRecord, formats: Sequence[str], discovery: Discovery, tell: Tell, house: HouseStyle | None = None, file: str = ""
) -> Drawn:  # fmt: skip
    """Return the report of results, complete before anything is written; UserError where the words of one of their mechanisms are not complete."""
    is_drawn, kinds = set(DRAWN) & set(formats), [mechanism.kind for mechanism in results.mechanisms.values()]
    catalogues = catalogues_for(results.project.language if is_drawn else SOURCE_LANGUAGE, kinds, discovery, file)
    lost: list[Lost] = []
    contents = {"json": encoded(results_text(results))} if "json" in formats else {}
    if is_drawn:
        tell(phrase("drawing the report"))
        from diecut_report.report.pages import firm_templates as template_limits
        from diecut_report.report.rendering import Rendering

        rendering = Rendering(results, catalogues, house)
        with template_limits.bounded(house):
            contents |= {"html": encoded(rendering.html())} if "html" in formats else {}
            if "pdf" in formats:
                tell(phrase("typesetting the pages"))
                contents["pdf"] = _pdf(rendering, tell)
        if "docx" in formats:
            tell(phrase("writing the document"))
            contents["docx"] = rendering.docx()
        if "xlsx" in formats:
            contents["xlsx"] = rendering.xlsx()
        lost += [Lost("figure", each.mechanism, each.id, each.words) for each in rendering.faults]
    return Drawn({ending: contents[ending] for ending in formats}, lost, lacking(catalogues, kinds))


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


def _pdf(rendering: Any, tell: Tell) -> bytes:
    from diecut_report.files import room

    with room():  # for the files of fonts: the command line does not wait until the page engine removes them
        try:
            return rendering.pdf(lambda sheet: tell(Phrase("typesetting the pages: sheet {n}", n=sheet)))  # type: ignore[no-any-return]
        except OSError as error:
            if "cannot load library" not in str(error):
                raise
            missing = Phrase(NO_PANGO, library=str(error).split(":")[0].removeprefix("cannot load library "))
            raise UserError(Problem(missing)) from error
