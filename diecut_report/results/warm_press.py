"""A press calculated again and again, as while somebody changes a number: only what depends on the change is calculated anew.

``WarmPress`` remembers the calculations of the last few machines. A mechanism whose inputs, numbers and what others give it
alike, are the same as before is not calculated a second time, and nothing is printed before it is asked for. A curve that it
takes is the same where all that it follows from is, though the mechanism that gives it was calculated anew:

    press = WarmPress()
    run = press.calculate(config)       # UserError in words where the machine is impossible, as of any calculation
    run.summary, run.checks, run.outputs("drive")
    run.curves("drive"), run.figures("drive"), run.sections("drive")
    run.document()                      # all results, as ``results.document`` gives them

``config`` is a file loaded again (``config.loader``), or a base with other values (``study.definition.base_inputs.with_values``).
Whatever is asked for equals what the ordinary way gives for the same configuration, bit for bit; it is shared with later
runs, and must not be changed. Two things are known when they are asked for, and not before: comparisons, which are in
``document`` alone, and what only curves or printing refuse (a formula whose numbers contradict its result), which raises
from ``curves``, ``sections`` or ``outputs``, while ``document`` tells it as the ordinary way does.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from operator import is_
from typing import Any, NamedTuple, TypeVar

from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.machine.calculation import Calculation, ChosenUnits
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import Block, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.results.checks import check_results, verdicts
from diecut_report.results.coherence import PlacedFinding, placed_findings
from diecut_report.results.conclusion import governing
from diecut_report.results.document import document, verdict
from diecut_report.results.drive_line import drive_line
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures, shown_figures
from diecut_report.results.machine_advice import advised
from diecut_report.results.mechanism import (
    Quantities,
    curves,
    key_outputs,
    mechanism_results,
    numbers,
    require_self_tests,
    sections,
    worst,
)
from diecut_report.results.mechanism_record import CheckRecord, CurveRecord, SectionRecord
from diecut_report.results.model import DriveLineRecord, GoverningRecord, ResultsRecord, SummaryRecord
from diecut_report.results.open_items import run_summary
from diecut_report.results.press_run import ReportedRun, Run, Tell, require_possible, same_inputs
from diecut_report.results.usual import Beside, Outside

Data = dict[str, Any]
T = TypeVar("T")
KEPT = 4  # machines of each mechanism that are remembered: the one at the start, to compare with, and the last ones


class Told(NamedTuple):
    """Hold what changes how a calculation is told, and no number of it.

    These are its units, what has no basis, what is beside its inputs, and what is found of the machine's parts.
    """

    units: ChosenUnits
    unfounded: Mapping[tuple[str | int, ...], Any]
    beside: Beside
    findings: tuple[PlacedFinding, ...]


class Remembered:
    """Hold a calculated mechanism with what it was calculated from, and what was made of it so far."""

    def __init__(self, calculation: Calculation, taken: Mapping[str, Any], told: Told) -> None:
        self.calculation, self.taken, self.told = calculation, taken, told
        self._made: dict[Callable[[Calculation], Any], Any] = {}

    def is_of(self, mechanism: Mechanism, taken: Mapping[str, Any], told: Told) -> bool:
        """Return whether it was calculated from these inputs, and is told alike."""
        return self.calculation.mechanism is mechanism and self.told == told and same_inputs(self.taken, taken)

    def of(self, make: Callable[[Calculation], T]) -> T:
        """Return what a function makes of the calculation; made once."""
        if make not in self._made:
            self._made[make] = make(self.calculation)
        made: T = self._made[make]
        return made


class _Judged(NamedTuple):
    """Hold what of a mechanism is outside its usual range, and what that follows from."""

    of: tuple[Mechanism | None, Block, Calculation | None]
    data: Data
    beside: Beside
    found: list[Outside]

    def is_of(self, of: tuple[Mechanism | None, Block, Calculation | None], data: Data, beside: Beside) -> bool:
        return all(map(is_, self.of, of)) and same_inputs((self.data, self.beside), (data, beside))


class WarmPress:
    """Remember the calculations of a press from one run to the next; see above.

    With ``is_advised=False`` failing checks come without advice, which takes longer than all the rest; ``document`` has it all the same,
    and ``advised_checks`` gives it for one mechanism.
    """

    def __init__(self, *, is_advised: bool = True) -> None:
        self.judge = check_results if is_advised else verdicts
        self._known: dict[str, list[Remembered]] = {}
        self.judged: dict[str, tuple[type[Block], Data, Block]] = {}  # for each instance what was found valid last
        self.outside: dict[tuple[str, bool], _Judged] = {}

    def calculate(self, config: Config, tell: Tell = lambda _: None) -> WarmRun:
        """Calculate a configuration; UserError where the machine is impossible.

        ``tell`` is called with the name of each mechanism that is calculated anew.
        """
        return require_possible(WarmRun(config, self, tell))

    def printed(self, config: Config, tell: Tell = lambda _: None) -> WarmRun:
        """Calculate a configuration and print it as the ordinary way does, for ``results.document``; else as ``calculate``."""
        return require_possible(_PrintedRun(config, self, tell))

    def remembered(self, name: str, mechanism: Mechanism, taken: Data, told: Told, tell: Tell) -> Remembered:
        """Return a mechanism calculated from these inputs: remembered, or anew."""
        known = self._known.setdefault(name, [])
        found = next((each for each in known if each.is_of(mechanism, taken, told)), None)
        if found is None:
            tell(name)
            calculation = calculate(mechanism, taken)
            calculation.chosen_units, calculation.unfounded = told.units, told.unfounded
            found = Remembered(calculation, taken, told)
        self._known[name] = [found, *(each for each in known if each is not found)][:KEPT]
        return found


class WarmRun(Run):
    """Hold one run of a warm press: what is not remembered is calculated at once, what is shown when it is asked for."""

    def __init__(self, config: Config, press: WarmPress, tell: Tell) -> None:
        self.press, self._tell = press, tell
        self.remembered: dict[str, Remembered] = {}
        super().__init__(config, lambda _: None)

    def _validated(self, name: str, instance: Instance, data: Data) -> bool:
        """What was found valid is not judged a second time."""
        model, known, block = self.press.judged.get(name, (None, None, None))
        if block is not None and model is instance.model and same_inputs(known, data):
            self.blocks[name] = block
            return True
        is_valid = super()._validated(name, instance, data)
        if is_valid:
            self.press.judged[name] = instance.model, data, self.blocks[name]
        return is_valid

    def _outside(
        self, instance: Instance, block: Block, known: Beside, calculation: Calculation | None = None
    ) -> list[Outside]:
        """What was judged before is not judged a second time."""
        key = instance.name, calculation is None
        given = (instance.mechanism, block, calculation), instance.data, known
        before = self.press.outside.get(key)
        if before is None or not before.is_of(*given):
            before = self.press.outside[key] = _Judged(*given, super()._outside(instance, block, known, calculation))
        return before.found

    def _made(self, instance: Instance, mechanism: Mechanism, block: Block) -> Calculation:
        unfounded = self.bases.unfounded(instance, block)
        findings = placed_findings(self.config.parts, mechanism.kind)
        told = Told(self.chosen_units(instance.name), unfounded, self.beside(instance), findings)
        found = self.press.remembered(instance.name, mechanism, flatten(block), told, self._tell)
        self.remembered[instance.name] = found
        return found.calculation

    def _printed(self, instance: Instance, calculation: Calculation) -> None:
        """Only what tells whether the mechanism may be used at all."""
        require_self_tests(self.remembered[instance.name].of(self.press.judge))

    @cached_property
    def checks(self) -> dict[str, list[CheckRecord]]:
        """Return the checks of each mechanism in the order of the file, as the results hold them."""
        known = {name: self.remembered[name].of(self.press.judge) for name in self.calculations}
        names = [name for name in self.config.instances if name != PRESS]
        own = {name: known.get(name) or self.self_tests.get(name, []) for name in names}
        return advised(self, own) if self.press.judge is check_results else own

    def advised_checks(self, name: str, tell: Tell = lambda _: None) -> list[CheckRecord]:
        """Return the checks of a mechanism, the failing ones with their advice; KeyError as below.

        ``tell`` is called before each value that is tried in the machine; what it raises ends the search.
        """
        return advised(self, {name: self.remembered[name].of(check_results)}, tell)[name]

    @property
    def status(self) -> str:
        """Return the verdict on the whole: pass, warn, fail or error."""
        states = {name: worst(check.status for check in checks) for name, checks in self.checks.items()}
        states |= dict.fromkeys(self.skipped, "skipped")
        return verdict(states.values(), self.errors)

    @property
    def governing(self) -> GoverningRecord | None:
        """Return the check that governs, with its mechanism."""
        return governing(self.checks)

    @cached_property
    def summary(self) -> SummaryRecord:
        """Return the counts of the checks, the governing one, what is open, the verdict and the first line."""
        return run_summary(self, self.checks)

    @cached_property
    def drive_line(self) -> DriveLineRecord | None:
        """Return the parts of the machine as they stand; None where they are not modelled."""
        return drive_line(self, self.checks)

    def outputs(self, name: str) -> Quantities:
        """Return the outputs of a mechanism; KeyError where it is broken or skipped (``errors``, ``skipped``), as below."""
        return self.remembered[name].of(numbers)["outputs"]

    def key_outputs(self, name: str) -> Quantities:
        """Return of the outputs of a mechanism those that tell most: what a page shows without making all others."""
        return self.remembered[name].of(key_outputs)

    def curves(self, name: str) -> dict[str, CurveRecord]:
        """Return the curves of a mechanism."""
        return self.remembered[name].of(curves)

    def figures(self, name: str) -> list[FigureRecord]:
        """Return the figures of a mechanism."""
        return self.remembered[name].of(figures)

    def figure_titles(self, name: str) -> list[str]:
        """Return the titles of the figures whose needs are given, also of charts that turn out empty; no figure is made for it."""
        return [figure.title for figure in shown_figures(self.calculations[name])]

    def sections(self, name: str) -> list[SectionRecord]:
        """Return the printed calculation of a mechanism."""
        return self.remembered[name].of(sections)

    def document(self) -> ResultsRecord:
        """Return all results, comparisons too; printed is what has not been asked for yet. UserError as of any calculation."""
        return document(self.press.printed(self.config, self._tell))


class _PrintedRun(WarmRun, ReportedRun):
    """A run of which everything is printed at once, in the order of the ordinary way."""

    def _printed(self, instance: Instance, calculation: Calculation) -> None:
        of = self.remembered[instance.name].of
        self._store(instance, mechanism_results(calculation, self._provenance(instance), of))
