"""The contract test of a plugin: rules that hold for each mechanism, tried on its declarations and on an example machine."""

from __future__ import annotations

import ast
import re
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Literal

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery, DuplicateKind, Origin, UnknownKind, catalogues_for, said
from diecut_report.config.validation import declared
from diecut_report.declaration import faults, faults_at_load
from diecut_report.declaration.code import code_texts, template
from diecut_report.declaration.formula_checks import at_place, by_id, doubts, forms, idle_inputs, unbalanced
from diecut_report.declaration.names import short
from diecut_report.declaration.texts import files_around, own_files, parsed, texts
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.files import content, write_all
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.machine.steps.soundness import is_made
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import Quantity, fields, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Interpolated, Lookup, Pick
from diecut_report.quantities.formatting import told
from diecut_report.report.rendering import Rendering
from diecut_report.results.advice import Advisor
from diecut_report.results.checks import applies, check_results, checks_of, holds, is_of_machine, is_sized, judged
from diecut_report.results.document import document
from diecut_report.results.model import ResultsRecord
from diecut_report.results.press_run import Run, compute
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.testing.extreme_inputs import TriedExtremes, input_of
from diecut_report.testing.machines import Keys, MachineCase, configured, one_of, picks, unlike
from diecut_report.testing.new_processes import unlike_again
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues, TextCatalogue, built_in, file_beside, languages
from diecut_report.text.phrases import Counted, Phrase, joined, phrase
from diecut_report.text.po_files import ChangedCatalogue, changed
from diecut_report.time_limit import Overran, limited

RuleStatus = Literal["pass", "note", "not_tried", "fail", "broke"]
WORST_LAST = ("pass", "not_tried", "note", "fail", "broke")
MAX_LISTED = 5  # faults of a rule that a short list tells
TITLES = {
    "declaration": phrase("Declarations"),
    "dimensions": phrase("Dimensions of formulas"),
    "inputs": phrase("Inputs that are used"),
    "doubts": phrase("Doubtful declarations"),
    "example": phrase("Example machine"),
    "alone": phrase("Batch and single calculation agree"),
    "again": phrase("Same results in new processes"),
    "verdicts": phrase("Checks that can fail"),
    "advice": phrase("Advice that helps"),
    "hostile": phrase("Extreme inputs"),
    "figures": phrase("Figures and report"),
    "languages": phrase("Texts in all languages"),
    "speed": phrase("Time of 1000 variants"),
}
"""The rules of the contract, in the order in which they are tried."""


@dataclass(frozen=True)
class TriedRule:
    """Hold a rule of the contract that was tried: what was found in words, and each fault with its place and what to do.

    ``note`` is no fault, but what an author should know; ``broke`` is a plugin that raises where it should not.
    """

    id: str
    status: RuleStatus
    summary: str = ""
    faults: tuple[str, ...] = ()

    @property
    def title(self) -> Phrase:
        """Return what the rule is about."""
        return TITLES[self.id]

    @property
    def short_list(self) -> tuple[str, ...]:
        """Return the first faults, and how many more there are."""
        left = len(self.faults) - MAX_LISTED
        if left <= 0:
            return self.faults
        notes = Counted(left, "{n} more note", "{n} more notes")
        faults = Counted(left, "{n} more fault", "{n} more faults")
        return (*self.faults[:MAX_LISTED], notes if self.status == "note" else faults)


def rule(id: str, summary: str, faults: Iterable[str], otherwise: RuleStatus = "fail") -> TriedRule:
    """Return a rule that passes where there is no fault; of many faults the first thousand."""
    found = tuple(dict.fromkeys(islice(faults, 1000)))
    return TriedRule(id, otherwise if found else "pass", summary, found)


# Checks whose verdict is the same for every machine that was tried: can they fail, or hold, at all?


CONSTANT_VERDICTS_FAR = 1.0  # powers of ten by which a number is made greater or less
AT_ONCE, CONSTANT_VERDICTS_LONGEST = 40, 10.0  # machines calculated together; seconds after which no more are tried


def constant(machine: MachineCase, count: int, seed: int) -> Iterator[tuple[str, str]]:
    """Yield each check whose verdict never changes over about so many machines, each with one number, or all, far from the example's."""
    found: dict[str, set[bool]] = {}
    began, tried = time.process_time(), 0
    for number in range(-(-count // AT_ONCE)):
        for id, held in _verdicts(machine, AT_ONCE, seed + number):
            found.setdefault(id, set()).update(held)
        tried += AT_ONCE
        if time.process_time() - began > CONSTANT_VERDICTS_LONGEST or all(len(held) == 2 for held in found.values()):
            break
    for id, held in found.items():
        if held == {True}:
            yield id, Phrase("passes in all {n} machines far from the example; make sure that it can fail", n=tried)
        elif held == {False}:
            yield id, Phrase("fails in all {n} machines far from the example; make sure that it can pass", n=tried)


def _verdicts(machine: MachineCase, count: int, seed: int) -> Iterator[tuple[str, set[bool]]]:
    """Each check of the machine with the verdicts that occur; impossible machines have none."""
    calc = calculate(machine.mechanism, {**machine.values, **_varied(machine, count, seed)}, count)
    possible = np.array([i not in calc.flaws for i in range(count)])
    for check in checks_of(calc):
        # the others hold by what the program chose or presumes
        is_free = not (check.presumed or is_sized(calc.given, check))
        if is_free and is_made(calc, check):
            judgement = judged(calc, check)
            rows = judgement.governing(judgement.there) & possible
            # a self-test holds in all machines, but never to the last bit where it compares what was found in two ways
            may_fail = judgement.governing(judgement.held) & (
                is_of_machine(check) | (judgement.governing(judgement.demand) == 0)
            )
            yield check.id, set(may_fail[rows].tolist()) | (set() if is_of_machine(check) else {True})


# Checks whose advised keys help no machine in which they fail.


MACHINES_ADVISED, ADVICE_LONGEST = 3, 10.0  # of each check; seconds after which no more are tried


def unadvised(machine: MachineCase, seed: int) -> Iterator[tuple[str, str]]:
    """Yield each check that names keys to be changed, of which none makes it hold in the machines, far from the example's, where it fails."""
    tried: dict[str, int] = {}
    helped: set[str] = set()
    began = time.process_time()
    for number in range(MACHINES_ADVISED):
        varied = _varied(machine, AT_ONCE, seed + number)
        for check, i in _first_failures(calculate(machine.mechanism, {**machine.values, **varied}, AT_ONCE)):
            if check.id not in helped and time.process_time() - began < ADVICE_LONGEST:
                calc = calculate(machine.mechanism, {**machine.values, **one_of(varied, i)})
                tried[check.id] = tried.get(check.id, 0) + 1
                helped |= {check.id} if Advisor(calc, (), (check,), holds).ways(check) else set()
    for id in tried.keys() - helped:
        template = "no change of the keys that advise names makes it hold, of {n} machines in which it fails; name others, or none"
        yield id, Phrase(template, n=tried[id])


def _first_failures(calc: Calculation) -> Iterator[tuple[Check, int]]:
    """Each check with advice, with the first of many machines in which it fails."""
    possible = np.array([i not in calc.flaws for i in range(AT_ONCE)])
    for check in checks_of(calc):
        if check.advise and is_made(calc, check):
            judgement = judged(calc, check)
            failing = judgement.governing(judgement.there) & ~judgement.governing(judgement.held) & possible
            yield from ((check, int(i)) for i in np.flatnonzero(failing)[:1])


def _strange_partners(mechanism: Mechanism, discovery: Discovery) -> Iterator[Phrase]:
    """Yield what another mechanism is said to be or have and no plugin does: then nothing is taken from it, and checks never apply."""
    beside = [(check.at, kind) for check in mechanism.checks for kind in check.only_beside]
    beside += [
        (partner.at, kind) for partner in mechanism.partners for kind in (*partner.kinds, *partner.unless.values())
    ]
    for at, kind in beside:
        if kind not in discovery.origins:
            yield Phrase("{place}: no plugin has the kind {kind}; look at its name", place=short(at), kind=kind)
    for partner in mechanism.partners:
        known: list[Mechanism] = []
        for kind in partner.kinds:
            with suppress(UnknownKind, DuplicateKind, PluginError):  # told above, or where that kind is used
                known.append(discovery.mechanism(kind))
        for name in (*partner.takes.values(), *partner.unless):
            if known and not any(_has(each, name) for each in known):
                template = "{place}: no partner of kind {kinds} has {name}; look at its name"
                yield Phrase(template, place=short(partner.at), kinds=", ".join(partner.kinds), name=name)


def _has(mechanism: Mechanism, name: str) -> bool:
    """Whether a mechanism has an input or result of a name."""
    return declared(mechanism.inputs, tuple(name.split("."))) is not None or any(
        step.id == name for _, step in mechanism.steps
    )


def signed(calc: Calculation) -> Iterator[tuple[str, str]]:
    """Yield each check that a demand below zero passes though it is beyond the limit in size."""
    template = "passes with {demand}, in size beyond the limit {limit}: if the direction does not count, compare the absolute value (as by abs_max)"
    for check in filter(is_of_machine, checks_of(calc)):
        if check.at_least is None and applies(calc, check):
            judgement = judged(calc, check)
            demand, limit = (float(judgement.governing(side)[0]) for side in (judgement.demand, judgement.limit))
            if 0 < limit < -demand:
                yield check.id, Phrase(template, demand=told(demand, check.unit), limit=told(limit, check.unit))


def _varied(machine: MachineCase, count: int, seed: int) -> dict[str, Array]:
    """The numbers of all machines: each has one, or all, far from the example's, as far as that is allowed."""
    draw, known = np.random.default_rng(seed), dict(fields(machine.mechanism.inputs))
    numbers = {name for name, value in machine.values.items() if isinstance(value, int | float)}
    numbers -= {name for name in numbers if isinstance(machine.values[name], bool) or name == "n_points"}
    metas = [
        (name, meta) for name in machine.values if name in numbers and isinstance(meta := known.get(name), Quantity)
    ]
    chosen = draw.integers(0, len(metas) + 1, count)
    found = {}
    for number, (name, meta) in enumerate(metas):
        value = machine.values[name]
        far = value * 10 ** draw.uniform(-CONSTANT_VERDICTS_FAR, CONSTANT_VERDICTS_FAR, count)
        far = np.round(far) if meta.integer else far
        is_far = ((chosen == number) | (chosen == len(metas))) & meta.holds(far)
        found[name] = np.where(is_far, far, value)
    return found


TOGETHER, ALONE, SEED = 16, 4, 3  # machines at once, and those of them that are calculated alone too
FAR = 400  # machines of which each is far from the example
TIMED, TIMED_ALONE = 1000, 5  # variants whose time is measured; where they are slow, so few
MAX_RULE_SECONDS = 600.0  # seconds of a rule: a plugin may never come back


@dataclass
class ContractTest:
    """Try the rules of the contract on a mechanism and, where there is one, on a machine of a configuration.

    ``page`` is the mechanism's chapter as HTML, once ``figures`` was tried; ``language`` that of the page, which is a part of another one
    where ``is_part`` says so. ``refused`` tells why there is no
    machine, where there are configurations with one that are not sound.
    """

    mechanism: Mechanism
    discovery: Discovery
    config: Config | None = None
    name: str = ""
    language: str = SOURCE_LANGUAGE
    refused: Sequence[Problem] = ()
    is_part: bool = False
    page: str = field(default="", init=False)

    def of(self, config: Config, name: str) -> ContractTest:
        """Return the test of another machine; what is calculated already of the same configuration is not calculated again."""
        other = replace(self, config=config, name=name)
        if config is self.config:
            vars(other).update({key: vars(self)[key] for key in ("run", "results") if key in vars(self)})
        return other

    def tried(self) -> Iterator[TriedRule]:
        """Yield each rule with what was found; what needs a sound declaration or a machine is not tried without."""
        is_tried = True
        for id in TITLES:
            if is_tried:
                found = self.tried_alone(id)
                is_tried = found.status == "pass" or id not in ("declaration", "example")
                yield found
            else:
                yield TriedRule(id, "not_tried", phrase("not run until the rules above are satisfied"))

    def tried_alone(self, id: str) -> TriedRule:
        """Return what one rule finds; where the plugin breaks in it, that is its fault."""
        tried: Callable[[], TriedRule] = getattr(self, id)
        try:
            with limited(MAX_RULE_SECONDS), warnings.catch_warnings():
                warnings.simplefilter("ignore", RuntimeWarning)  # of NumPy: what comes out is judged, not on the way
                return tried()
        except Overran as cause:
            template = "it did not finish within {seconds} s ({said})"
            return rule(id, "", [Phrase(template, seconds=f"{MAX_RULE_SECONDS:g}", said=said(cause))], "broke")
        except UserError as refused:
            return rule(id, "", [str(problem) for problem in refused.problems])
        except (Exception, SystemExit) as cause:
            return rule(id, "", [said(cause)], "broke")

    # --- what is declared --------------------------------------------------------------------------------------------

    def declaration(self) -> TriedRule:
        """Try whether what is declared can be."""
        message = Phrase(
            "steps: {steps}, checks: {checks}, figures: {figures}", steps=len(self.mechanism.steps),
            checks=len(self.mechanism.checks), figures=len(self.mechanism.figures),
        )  # fmt: skip
        own = built_in(self.mechanism.kind)
        is_built_in = own is not None and Path(self.mechanism.at).is_relative_to(own.parent)
        tried = faults if is_built_in else faults_at_load  # what comes with the program imports itself by its name
        return rule("declaration", message, map(str, tried(self.mechanism)))

    def dimensions(self) -> TriedRule:
        """Try whether the dimensions of the formulas balance, in each unit that holds by form."""
        texts = (text for form in forms(self.mechanism) for text in unbalanced(form))
        return rule("dimensions", "", (by_id(self.mechanism, text) for text in texts))

    def inputs(self) -> TriedRule:
        """Try whether something takes each input."""
        return rule("inputs", "", idle_inputs(self.mechanism))

    def doubts(self) -> TriedRule:
        """Note what may be a mistake: units that formulas convert by hand, chapters that nothing depends on."""
        return rule("doubts", "", [*doubts(self.mechanism), *_strange_partners(self.mechanism, self.discovery)], "note")

    # --- what a machine shows ----------------------------------------------------------------------------------------

    def example(self) -> TriedRule:
        """Try whether there is a machine, which calculates and prints; its self-tests hold, and nothing breaks."""
        if self.refused:
            return rule("example", phrase("its configuration is refused"), map(str, self.refused))
        if self.config is None:
            template = (
                "no machine of this kind is available to test the rest; give a configuration that has one with --config"
            )
            return TriedRule("example", "note", faults=(phrase(template),))
        found = self.results.mechanisms.get(self.name)
        if self.name in self.run.errors:
            return rule("example", "", [str(self.run.errors[self.name].message)], "broke")
        skipped = [text for name, text in self.run.skipped.items() if name == self.name]
        message = Phrase("{file}, mechanism {name}", file=self.config.tree.name, name=self.name)
        return rule(
            "example", message, skipped or ([] if found and not found.error else [phrase("it gives no results")])
        )

    @cached_property
    def run(self) -> Run:
        """Return the example's press, calculated."""
        assert self.config is not None
        return compute(self.config, lambda _: None)

    @cached_property
    def results(self) -> ResultsRecord:
        """Return its results, as a report has them."""
        return document(self.run)

    @cached_property
    def case(self) -> MachineCase:
        """Return the example's machine, with fewer samples of its curves."""
        values = flatten(self.run.blocks[self.name])
        return MachineCase(self.mechanism, values | ({"n_points": 72} if "n_points" in values else {}))

    def alone(self) -> TriedRule:
        """Try whether machines that are calculated together are each as alone; one that cannot take arrays is noted."""
        summary = Phrase("{count} machines at once, {alone} of them individually too", count=TOGETHER, alone=ALONE)
        try:
            found = list(unlike(self.case, TOGETHER, ALONE, SEED))
            wide, changing, count = picks(self.case, SEED, TOGETHER)
            if count:
                found += unlike(wide, TOGETHER, ALONE, SEED)
                summary += Phrase("; again where {changing} of {picks} picks change", changing=changing, picks=count)
        except Unproven:
            raise
        except Exception as cause:  # a refusal too, which refuses all for one of them
            template = "does not support arrays, so that a study calculates it variant by variant: {said}"
            return rule("alone", summary, [Phrase(template, said=said(cause))], "note")
        return rule("alone", summary, (at_place(self.mechanism, name, text) for name, text in found))

    def again(self) -> TriedRule:
        """Try whether new processes give the same, in whatever order they calculate."""
        assert self.config is not None
        if not Path(self.config.tree.file).is_file():
            return TriedRule("again", "not_tried", phrase("its configuration is not a file"))
        told = phrase("calculated twice, before another machine and after it")
        found = unlike_again(self.config, self.name, self.discovery)
        return rule("again", told, (at_place(self.mechanism, name, text) for name, text in found))

    def verdicts(self) -> TriedRule:
        """Note the checks whose verdict is the same in all machines that were tried."""
        message = phrase("machines far from the example")
        try:
            found = [*constant(self.case, FAR, SEED), *signed(self.run.calculations[self.name])]
        except Exception:  # a plugin that cannot take arrays, as the rule before has said
            return TriedRule("verdicts", "not_tried", phrase("it cannot calculate many machines at once"))
        places = {check.id: check.at for check in checks_of(self.run.calculations[self.name])}
        texts = (at_place(self.mechanism, id, text, places.get(id, "")) for id, text in found)
        return rule("verdicts", message, texts, "note")

    def advice(self) -> TriedRule:
        """Note the checks whose advised keys help no machine in which they fail."""
        message = phrase("machines in which a check fails, far from the example")
        try:
            found = list(unadvised(self.case, SEED))
        except Exception:  # a plugin that cannot take arrays, as a rule before has said
            return TriedRule("advice", "not_tried", phrase("it cannot calculate many machines at once"))
        places = {check.id: check.at for check in checks_of(self.run.calculations[self.name])}
        return rule(
            "advice", message, (at_place(self.mechanism, id, text, places.get(id, "")) for id, text in found), "note"
        )

    def hostile(self) -> TriedRule:
        """Try whether single extreme values give numbers, or are refused in words."""
        assert self.config is not None
        found = TriedExtremes(self.config, self.name, self.discovery)
        faults = [at_place(self.mechanism, input_of(path), words) for path, words in found.faults()]
        return rule("hostile", found.summary, faults)

    def figures(self) -> TriedRule:
        """Try whether all figures are drawn, and set the chapter."""
        mechanism = self.results.mechanisms[self.name]
        faults = [at_place(self.mechanism, each.id, each.error) for each in mechanism.figures if each.error]
        faults += [at_place(self.mechanism, each.id, each.error) for each in mechanism.exports if each.error]
        told = Counted(len(mechanism.figures), "{n} figure", "{n} figures")
        return rule("figures", told, [*faults, *self._rendered(self.language)])

    def _rendered(self, language: str) -> list[str]:
        """Set the mechanism's chapter alone; what cannot be drawn."""
        report = self.results.report.with_(detail="full", only=[self.name])
        shown = self.results.with_(project=self.results.project.with_(language=language), report=report)
        rendering = Rendering(shown, catalogues_for(language, [self.mechanism.kind], self.discovery))
        page = rendering.html(is_part=self.is_part)
        if language == self.language:
            self.page = page
        own = [each for each in rendering.faults if each.mechanism == self.name]
        return [at_place(self.mechanism, each.id, each.words) for each in own]

    def languages(self) -> TriedRule:
        """Try whether the chapter can be set in each language, and note the texts that have no words in it."""
        others = [language for language in languages() if language != SOURCE_LANGUAGE]
        broken = [fault for language in others for fault in self._rendered(language)]
        if broken:
            return rule("languages", "", broken)
        told = joined([", ".join([SOURCE_LANGUAGE, *others]), *map(self._as_given, others)], "")
        return rule("languages", told, (fault for language in others for fault in self._words_of(language)), "note")

    @cached_property
    def words(self) -> PluginWords:
        """Return the plugin's words in other languages."""
        return PluginWords(self.mechanism, self.discovery)

    def _words_of(self, language: str) -> Iterator[str]:
        for text, of in self.words.untranslated(language):
            yield Phrase("{language}: “{text}” ({of}) is not translated", language=language, text=text, of=of)
        for text in self.words.unused(language):
            template = "{language}: “{text}” is in the catalogue but no longer used; --write-po marks it as obsolete"
            yield Phrase(template, language=language, text=text)

    def _as_given(self, language: str) -> str:
        found = self.words.sources_as_given(language)
        if not found:
            return ""
        more = Counted(len(found) - MAX_LISTED, " and {n} other", " and {n} others") if len(found) > MAX_LISTED else ""
        template = "; sources that stay as they are given: {named}{more}"
        return Phrase(template, named="; ".join(found[:MAX_LISTED]), more=more)

    def speed(self) -> TriedRule:
        """Tell how long a thousand variants take, as far as the mechanism itself is concerned."""
        began, count = time.process_time(), TIMED
        try:
            check_results(self.case.together(TIMED, SEED)[1])
        except Exception:  # of arrays, which another rule tells
            began, count = time.process_time(), TIMED_ALONE
            varied = self.case.varied(count, SEED)
            for i in range(count):
                with suppress(Impossible):  # a machine beside the example may be refused; that takes its time, too
                    calculate(self.mechanism, {**self.case.values, **one_of(varied, i)})
        seconds = (time.process_time() - began) * TIMED / count
        return rule("speed", Phrase("{seconds} s", seconds=f"{seconds:.2g}"), [])


def check_contract(
    mechanism: Mechanism, inputs: Keys, *, press: Keys | None = None, others: Mapping[str, Keys] | None = None,
    plugins: Iterable[str | Path] = (),
) -> None:  # fmt: skip
    """Raise AssertionError with all rules of the contract that a mechanism breaks, tried on the machine of these inputs.

    The inputs are as for ``calculate``: take some that give as much of the mechanism as may be, also its optional inputs.
    """
    made = configured(mechanism, inputs, press, others, plugins)
    test = ContractTest(mechanism, made.discovery, made.config, mechanism.kind)
    broken = [each for each in test.tried() if each.status in ("fail", "broke")]
    assert not broken, "\n".join(f"{each.title}: {fault}" for each in broken for fault in each.short_list)


MAX_CATALOGUE_BYTES = 10_000_000  # bytes of a catalogue


def write_missing(test: ContractTest, origin: Origin) -> dict[Path, ChangedCatalogue]:
    """Write the entries that a plugin's catalogues lack, and mark those as obsolete that nothing says; what was changed, by the file.

    UserError where a catalogue cannot be read; then nothing is written.
    """
    found, words = {}, test.words
    for language in (each for each in languages() if each != SOURCE_LANGUAGE):
        file = file_beside(origin.file(), language)
        there = content(file, MAX_CATALOGUE_BYTES, phrase("a catalogue of texts")) if file.is_file() else None
        if there is not None:
            TextCatalogue(file, language)  # which tells in words what cannot be read
        made = changed(there, language, test.mechanism.kind, words.untranslated(language), words.unused(language))
        if made.content != there:
            found[file] = made
    write_all({file: made.content for file, made in found.items()}, keep=None)
    return found


# The words of a plugin in another language: which its catalogue lacks, which of it nothing says any more, and what stays as it is given.


TABLES = (".csv", ".yaml", ".yml", ".json")
MAX_FILE_BYTES = 1_000_000  # bytes of a table that is looked through
IN_WORDS = re.compile(r"(?<![\w.])[a-z]{3,}")  # neither a standard's number nor an author's name alone


@dataclass(frozen=True)
class PluginWords:
    """Hold a plugin with what knows its catalogues."""

    mechanism: Mechanism
    discovery: Discovery

    def catalogues(self, language: str) -> Catalogues:
        """Return the catalogues of a language."""
        return catalogues_for(language, [], self.discovery)

    def untranslated(self, language: str) -> Iterator[tuple[str, str]]:
        """Yield the texts that neither the plugin's catalogue nor the program's has, each with what it is of."""
        known = self.catalogues(language)
        for text, of in self.said:
            if not any(catalogue.text(text) for catalogue in known.ahead(self.mechanism.kind)):
                yield text, of

    def unused(self, language: str) -> Iterator[str]:
        """Yield the texts of the plugin's own catalogue that stand nowhere in its files, and that the program does not say."""
        known = self.catalogues(language)
        own = known.of(self.mechanism.kind)
        constants, tables = self._written
        said = {*(text for text, _ in self.said), *self._sources, *known.program.english, *constants}
        yield from (text for text in (own.english if own else ()) if text not in said and text not in tables)

    def sources_as_given(self, language: str) -> list[str]:
        """Return the sources that are said in words, and stay so in a report: the plugin's catalogue does not have them as a whole."""
        own = self.catalogues(language).of(self.mechanism.kind)
        if built_in(self.mechanism.kind) is not None:
            return []
        return [text for text in self._sources if IN_WORDS.search(text) and not (own and own.text(text))]

    @cached_property
    def said(self) -> list[tuple[str, str]]:
        """Return the texts that a report shows, those of the code among them."""
        own = [found for file in own_files(self.mechanism) for found in code_texts(file)]
        return list(dict.fromkeys([*texts(self.mechanism), *own]))

    @cached_property
    def _sources(self) -> list[str]:
        steps = [step for _, step in self.mechanism.steps]
        tables = [each for step in steps for each in tables_of(step)]
        said = (*(step.source for step in steps), *(check.source for check in self.mechanism.checks))
        found = [*said, *(source for table in tables for source in table.sources)]
        return [text for text in dict.fromkeys(found) if text]

    @cached_property
    def _written(self) -> tuple[set[str], str]:
        """The texts in the code of the plugin and of what it may import, and what stands in the tables of its folder."""
        home = Path(self.mechanism.at.rpartition(":")[0]).parent
        code = {*files_around(self.mechanism), *home.glob("*.py")}
        found = home.rglob("*") if (home / "__init__.py").is_file() else home.glob("*")
        tables = (each for each in found if each.suffix in TABLES and each.is_file())
        small = (each for each in tables if each.stat().st_size < MAX_FILE_BYTES)
        constants = {text for file in code for text in _constants(parsed(file))}
        return constants, "\n".join(each.read_text("utf-8", "replace") for each in small)


def _constants(module: ast.Module) -> Iterator[str]:
    for node in ast.walk(module):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.JoinedStr):
            yield template(node)


def tables_of(step: object) -> list[StandardTable | StandardSeries]:
    """Return the tables and series of a plugin's own that a step takes from."""
    match step:
        case Lookup(table=StandardTable() as table) | Interpolated(table=table):
            found: list[StandardTable | StandardSeries] = [table]
        case Pick(series=StandardSeries() as series):
            found = [series]
        case Pick(series=Mapping() as several):
            found = list(several.values())
        case _:
            found = []
    return [each for each in found if not each.is_of_the_program]
