"""The results document: what a run gave."""

from __future__ import annotations

import base64
import platform
from collections.abc import Iterable, Mapping, Sequence, Sized
from functools import reduce
from operator import getitem
from typing import Any

import numpy as np
import scipy

from diecut_report import __version__
from diecut_report.config import loader
from diecut_report.config.instances import Instance, Node
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS, PressBlock
from diecut_report.config.own_tables import Logo
from diecut_report.config.source_hashes import plugin_code, program_hash
from diecut_report.config.validation import GIVEN, declared, keys_of
from diecut_report.config.yaml import printable
from diecut_report.errors import MAX_COMPARISONS
from diecut_report.machine.calculation import CurveHandle
from diecut_report.mechanism.curve_inputs import CurveInput, InOtherUnit, TakenWhole
from diecut_report.mechanism.inputs import Block, Extremes, Quantity, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Text
from diecut_report.quantities.formatting import as_given, given_shown
from diecut_report.results.conclusion import counts, governing, shown_alike
from diecut_report.results.drive_line import drive_line
from diecut_report.results.machine_advice import advised
from diecut_report.results.mechanism import worst
from diecut_report.results.mechanism_record import CheckRecord, MechanismRecord, QuantityRecord
from diecut_report.results.model import (
    ConfigRecord,
    LeftOutRecord,
    LogoRecord,
    MaterialsFileRecord,
    PressRecord,
    ProgramRecord,
    ProjectRecord,
    ReportRecord,
    ResultsRecord,
)
from diecut_report.results.open_items import run_summary
from diecut_report.results.origins import Bases
from diecut_report.results.press_run import Found, Run
from diecut_report.results.record import FORM_VERSION, Status
from diecut_report.text.phrases import Phrase

Data = dict[str, Any]
LEFT_OUT = (
    "{count} comparisons are omitted, the first is {first}: at most {most} are made. To obtain one, list its "
    "mechanisms first of their kinds in the configuration, or use a separate configuration."
)


def document(run: Run) -> ResultsRecord:
    """Return all results; the same config gives the same document, byte for byte."""
    config, tree = run.config, run.config.tree
    parts = config.parts.calculations if config.parts else {}
    found = {name: _mechanism_data(run, name) for name in config.instances if name != PRESS}
    mechanisms = _advised(run, {name: data.with_(part=parts.get(name, "")) for name, data in found.items()})
    comparisons = shown_alike({case.name: _comparison_data(run, case) for case in run.cases}, mechanisms)
    mechanisms = shown_alike(mechanisms, mechanisms)
    checks = {name: data.checks for name, data in mechanisms.items()}
    left_out = None
    if comparisons and run.left_out:
        message = Phrase(LEFT_OUT, count=len(run.left_out), first=run.left_out[0], most=MAX_COMPARISONS)
        left_out = LeftOutRecord(message=message, names=run.left_out)
    return ResultsRecord(
        schema_version=1,
        form_version=FORM_VERSION,
        program=_program(config),
        config=ConfigRecord(
            file=printable(tree.name.replace("\\", "/").rsplit("/", 1)[-1]),
            sha256=tree.sha256,
            resolved=resolved(run),
            source_text=tree.text,
            materials=[
                MaterialsFileRecord(file=name, sha256=table.sha256, source_text=table.text)
                for name, table in config.tables.items()
            ],
            logo=_logo(config.logo) if config.logo else None,
        ),
        project=ProjectRecord(**_project(config.project.model_dump())),
        report=ReportRecord(**config.report.model_dump(exclude_none=True)),
        press=_press(run),
        status=verdict((data.status for data in mechanisms.values()), run.errors),
        governing=governing(checks),
        summary=run_summary(run, checks),
        mechanisms=mechanisms,
        comparisons=comparisons,
        comparisons_left_out=left_out,
        drive_line=drive_line(run, checks),
    )


def _advised(run: Run, mechanisms: Mapping[str, MechanismRecord]) -> dict[str, MechanismRecord]:
    """The mechanisms' results, whose failing checks advise what the machine allows."""
    checks = advised(run, {name: data.checks for name, data in mechanisms.items()})
    return {
        name: data.with_(checks=own, warnings=[check.message for check in own if check.status == "warn"]) if (own := checks[name]) else data
        for name, data in mechanisms.items()
    }  # fmt: skip


def verdict(statuses: Iterable[str], errors: Sized) -> Status:
    """Return the verdict on all mechanisms; one that is skipped without an error fails, as what it needs does not hold."""
    return "error" if errors else worst("fail" if each == "skipped" else each for each in statuses)


def _logo(logo: Logo) -> LogoRecord:
    content = base64.b64encode(logo.content).decode()
    return LogoRecord(file=logo.name, sha256=logo.sha256, media_type=logo.media_type, base64=content)


def _program(config: Config) -> ProgramRecord:
    """The program with the hash of its code and of each extension that was run, and by what the numbers were calculated."""
    return ProgramRecord(
        name="diecut-report",
        version=__version__,
        source_sha256=program_hash(),
        libraries={"Python": platform.python_version(), "NumPy": np.__version__, "SciPy": scipy.__version__},
        extensions=dict(config.extensions),
    )


NOTHING: Data = {
    "summary": "", "assumptions": [], "sources": [], "inputs": {}, "lists": {}, "outputs": {}, "values": {}, "curves": {}, "phases": {},
    "phases_absent": {}, "warnings": [], "sections": [], "absent": [], "figures": [], "exports": [], "errata": [],
}  # fmt: skip


def _mechanism_data(run: Run, name: str) -> MechanismRecord:
    if name in run.results and name not in run.errors:
        return run.results[name]
    instance = run.config.instances[name]
    mechanism = instance.mechanism if instance else None
    kind = run.config.kinds[name]
    status, text = ("error", str(run.errors[name])) if name in run.errors else ("skipped", run.skipped[name])
    return _failed(kind, mechanism, status, text, run.self_tests.get(name, []))


def _comparison_data(run: Run, case: Found) -> MechanismRecord:
    if case.name in run.comparisons:
        return run.comparisons[case.name]
    mechanism = case.comparison.mechanism
    failed = _failed(mechanism.kind, mechanism, "error", str(run.errors[case.name]))
    return failed.with_(between=list(case.between.values()))


def _failed(
    kind: str, mechanism: Mechanism | None, status: str, error: str, checks: Sequence[CheckRecord] = ()
) -> MechanismRecord:
    """What is known of a mechanism that gives no results."""
    return MechanismRecord.model_validate(
        NOTHING
        | plugin_code(mechanism)
        | {"kind": kind, "title": mechanism.title if mechanism else kind, "status": status, "error": error}
        | {"plugin_version": mechanism.version if mechanism else "", "checks": list(checks), "counts": counts(checks)}
    )


def _project(fields: Data) -> Data:
    """The title block's texts; what is not given is empty, a date null."""
    told: Data = {name: "" if value is None and name != "date" else value for name, value in fields.items()}
    return told | ({"revisions": [_project(line) for line in told["revisions"]]} if "revisions" in told else {})


def _press(run: Run) -> PressRecord:
    press, bases = run.blocks[PRESS], run.bases
    assert isinstance(press, PressBlock)
    found, chosen = [], run.chosen_units(PRESS)
    for name, value in flatten(press).items():
        meta = declared(PressBlock, tuple(name.split(".")))
        if isinstance(meta, Quantity):
            shown = given_shown(value, chosen.of(name, meta.unit) or meta.unit)
            head: dict[str, Any] = {"path": f"{PRESS}.{name}", "description": meta.description, "symbol": meta.symbol}
            node = (PRESS, *name.split("."))
            rests = {"basis": bases.of(node), "note": bases.said(node).note}
            found.append(head | {"value": value, "unit": meta.parsed_unit.si, "display": shown} | rests)
    return PressRecord(name=press.name, fields=[QuantityRecord(**each) for each in found])


def resolved(run: Run) -> Data:
    """Return the config with every reference and default put in: SI values as texts that read back exactly, with what they rest on."""
    config, bases = run.config, run.bases
    mechanisms = {}
    for name, kind in config.kinds.items():
        block, instance = run.blocks.get(name), config.instances[name]
        plain = _plain(block, (name,), instance, bases) if block and instance else {}
        taken = loader.compared(instance) if instance else {}  # which may not be given, and is taken again
        mechanisms[name] = {"kind": kind} | {key: value for key, value in plain.items() if key not in taken}
    press = config.instances[PRESS]
    assert press is not None
    return {"schema_version": 1, "project": config.project.model_dump(exclude_none=True), "report": config.report.model_dump(exclude_none=True),
            PRESS: _plain(run.blocks[PRESS], (PRESS,), press, bases), "mechanisms": mechanisms}  # fmt: skip


def _plain(block: Block, node: Node, instance: Instance, bases: Bases) -> Data:
    values = {name: value for name in type(block).model_fields if (value := getattr(block, name)) is not None}
    idle: set[str] = set()  # defaults that have no use beside what is given: as given keys they would be refused
    for rule in filter(lambda rule: rule.is_asked(values), type(block).one_of):
        fault = rule.fault(values)
        defaults = [name for name in values if name not in block.model_fields_set] if fault else []
        idle |= {name for name in defaults if rule.fault(values.keys() - {name}) != fault}
    return {
        name: _plain_value(block, (*node, name), value, instance, bases)
        for name, value in values.items()
        if name not in idle
    }


def _plain_value(block: Block, node: Node, value: Any, instance: Instance, bases: Bases) -> Any:
    meta = keys_of(type(block))[str(node[-1])].meta
    match value:
        case Block():
            return _plain(value, node, instance, bases)
        case [Block(), *_]:
            return [_plain(part, (*node, index), instance, bases) for index, part in enumerate(value)]
        case CurveHandle(calculation=_):
            written: Any = instance.data
            return reduce(getitem, node[1:], written)
        case Extremes(low=low, high=high) if isinstance(meta, Quantity):
            return {"min": as_given(low, meta.unit), "max": as_given(high, meta.unit)}
        case InOtherUnit(value=number, unit=unit):
            return as_given(number, unit)
        case TakenWhole():
            return str(value)
        case tuple() if isinstance(meta, CurveInput):
            return _resting([as_given(part, meta.unit) for part in value], node, bases)
        case int() | float() if isinstance(meta, Quantity):
            return _resting(as_given(value, meta.unit) if isinstance(value, float) else value, node, bases)
        case str() | bool() if isinstance(meta, Text):
            return _resting(value, node, bases)
    return value


def _resting(value: Any, node: Node, bases: Bases) -> Any:
    """A value, as a block where something is to be said of it."""
    basis, note = bases.of(node), bases.said(node).note
    said = {"basis": basis} if basis not in ("", GIVEN) else {}
    said |= {"note": note} if note else {}
    said |= {"beyond": reason} if (reason := bases.reason(node)) else {}
    return {"value": value} | said if said else value
