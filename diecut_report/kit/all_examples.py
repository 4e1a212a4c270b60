"""Tries a plugin on each machine of its kind that is known, not on the first alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path

from diecut_report.kit.example_machines import Machine
from diecut_report.languages.phrases import Counted, Phrase, joined
from diecut_report.testing.contract import ContractTest
from diecut_report.testing.tried_rules import WORST_LAST, TriedRule

ON_EACH = ("example", "alone", "figures")  # the others depend on the plugin alone, or put every input to the test


def tried_on_each(first: ContractTest, others: Sequence[Machine]) -> Iterator[TriedRule]:
    """Yield each rule with what was found on the first machine and, where what is given matters, on each of the others."""
    tests: Iterable[ContractTest] = _tests(first, others)
    for found in first.tried():
        if found.id not in ON_EACH or found.status == "not_tried":
            yield found
            continue
        also = [(test, test.tried_alone(found.id)) for test in tests]
        yield _merged(first, found, also) if also else found
        tests = [test for test, own in also if own.id != "example" or own.status == "pass"]


def _tests(first: ContractTest, others: Sequence[Machine]) -> Iterator[ContractTest]:
    """The tests of the other machines; those of one configuration calculate its press once."""
    latest = first
    for config, name in others:
        test = latest.of(config, name)
        yield test
        latest = test


def _merged(first: ContractTest, found: TriedRule, also: Sequence[tuple[ContractTest, TriedRule]]) -> TriedRule:
    faults = list(found.faults)
    for test, own in also:
        words = "{file}, mechanism {name}: {fault}"
        faults += [
            Phrase(words, file=_file(test), name=test.name, fault=fault)
            for fault in own.faults
            if fault not in found.faults
        ]
    status = max((found, *(own for _, own in also)), key=lambda each: WORST_LAST.index(each.status)).status
    told = _machines([first, *(test for test, _ in also)]) if found.id == "example" and found.told else found.told
    if told and found.id != "example":
        told += Counted(len(also), "; on {n} other machine too", "; on {n} other machines too")
    return replace(found, status=status, told=told, faults=tuple(faults))


def _machines(tests: Sequence[ContractTest]) -> str:
    """Which machines it was tried on, by their files."""
    told = []
    for file, group in groupby(tests, key=_file):
        names = [test.name for test in group]
        words = "{file}, mechanism {name}" if len(names) == 1 else "{file}, mechanisms {name}"
        told.append(Phrase(words, file=file, name=", ".join(names)))
    return joined(told, "; ")


def _file(test: ContractTest) -> Path | str:
    assert test.config is not None
    return test.config.tree.name
