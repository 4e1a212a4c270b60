"""The results document: what a run gave, as plain data."""

from __future__ import annotations

import base64
import platform
from collections.abc import Iterable, Iterator, Sized
from typing import Any

import numpy as np
import scipy

from diecut_report import __version__
from diecut_report.config import loader
from diecut_report.config.instances import Instance, Node
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS, Press
from diecut_report.config.own_tables import Logo
from diecut_report.config.source_hashes import plugin_code, program_hash
from diecut_report.config.validation import GIVEN, declared, keys_of
from diecut_report.config.yaml import KeyPath, printable
from diecut_report.errors import MAX_COMPARISONS
from diecut_report.machine.calculation import CurveHandle
from diecut_report.mechanism.curve_inputs import CurveInput, InOtherUnit, TakenWhole
from diecut_report.mechanism.inputs import Block, Extremes, Quantity, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Text
from diecut_report.quantities.formatting import as_given, given_shown
from diecut_report.results.conclusion import conclusion, counts, governing, summary, told_alike
from diecut_report.results.form import FORM_VERSION, SCHEMA_VERSION
from diecut_report.results.mechanism import worst
from diecut_report.results.origins import Bases, assumed, with_origins
from diecut_report.results.press_run import Found, Run
from diecut_report.text.phrases import Phrase, wordings

Data = dict[str, Any]
LEFT_OUT = (
    "{count} comparisons are left out, the first is {first}: at most {most} are made. "
    "To get one, let its mechanisms be the first of their kinds in the configuration, or put them into one of their own."
)


def document(run: Run) -> Data:
    """Return all results as plain data; the same config gives the same document, byte for byte."""
    config, tree = run.config, run.config.tree
    mechanisms = with_origins({name: _mechanism_data(run, name) for name in config.instances if name != PRESS})
    comparisons = told_alike({case.name: _comparison_data(run, case) for case in run.cases}, mechanisms)
    mechanisms = told_alike(mechanisms, mechanisms)
    made: Data = {
        "schema_version": SCHEMA_VERSION,
        "form_version": FORM_VERSION,
        "program": {"name": "diecut-report", "version": __version__, **_code(config)},
        "config": {
            "file": printable(tree.name.replace("\\", "/").rsplit("/", 1)[-1]),
            "sha256": tree.sha256,
            "resolved": resolved(run),
            "source_text": tree.text,
            **_tables(config),
        },
        "project": _project(config.project.model_dump()),
        "report": config.report.model_dump(exclude_none=True),
        "press": _press(run),
        "status": verdict((data["status"] for data in mechanisms.values()), run.errors),
        "governing": governing(mechanisms),
        "summary": summary(mechanisms) | {"assumed": assumed(config)},
        "mechanisms": mechanisms,
    } | ({"comparisons": comparisons} | _left_out(run) if comparisons else {})
    made["summary"]["conclusion"] = conclusion(made)
    return made | {"wordings": wordings([made["mechanisms"], comparisons, made.get("comparisons_left_out")])}


def verdict(statuses: Iterable[str], errors: Sized) -> str:
    """Return the verdict on all mechanisms; one that is skipped without an error fails, as what it needs does not hold."""
    return "error" if errors else worst("fail" if each == "skipped" else each for each in statuses)


def _tables(config: Config) -> Data:
    """The user's own tables and the logo that the config names, whole: the report can be made again with them."""
    found = [{"file": name, "sha256": tree.sha256, "source_text": tree.text} for name, tree in config.tables.items()]
    return ({"materials": found} if found else {}) | ({"logo": _logo(config.logo)} if config.logo else {})


def _logo(logo: Logo) -> Data:
    content = base64.b64encode(logo.content).decode()
    return {"file": logo.name, "sha256": logo.sha256, "media_type": logo.media_type, "base64": content}


def _left_out(run: Run) -> Data:
    """The comparisons beyond the most that a config gets, with words on how to get them."""
    if not run.left_out:
        return {}
    words = Phrase(LEFT_OUT, count=len(run.left_out), first=run.left_out[0], most=MAX_COMPARISONS)
    return {"comparisons_left_out": {"message": words, "names": run.left_out}}


def _code(config: Config) -> Data:
    """Return the hash of the program's code, and of each extension that was run; and by what the numbers were calculated."""
    libraries = {"Python": platform.python_version(), "NumPy": np.__version__, "SciPy": scipy.__version__}
    extensions = {"extensions": dict(config.extensions)} if config.extensions else {}
    return {"source_sha256": program_hash(), "libraries": libraries} | extensions


EMPTY: Data = {
    "summary": "", "assumptions": [], "sources": [], "inputs": {}, "lists": {}, "outputs": {}, "values": {}, "curves": {}, "phases": {},
    "phases_absent": {}, "checks": [],
    "warnings": [], "sections": [], "absent": [], "figures": [], "exports": [],
    "errata": [],
}  # fmt: skip


def _mechanism_data(run: Run, name: str) -> Data:
    if name in run.results and name not in run.errors:
        return run.results[name]
    instance = run.config.instances[name]
    mechanism = instance.mechanism if instance else None
    kind = run.config.kinds[name]
    status, text = ("error", str(run.errors[name])) if name in run.errors else ("skipped", run.skipped[name])
    checks = run.self_tests.get(name, [])
    return (
        _head(kind, mechanism)
        | {"status": status, "error": text}
        | EMPTY
        | {"checks": checks, "counts": counts(checks)}
    )


def _comparison_data(run: Run, case: Found) -> Data:
    if case.name in run.comparisons:
        return run.comparisons[case.name]
    mechanism = case.comparison.mechanism
    failed = {"status": "error", "error": str(run.errors[case.name]), "between": list(case.between.values())}
    return _head(mechanism.kind, mechanism) | failed | EMPTY | {"counts": counts(())}


def _head(kind: str, mechanism: Mechanism | None) -> Data:
    """What is known of a mechanism that gives no results."""
    return {
        "kind": kind,
        "title": mechanism.title if mechanism else kind,
        "plugin_version": mechanism.version if mechanism else "",
        **plugin_code(mechanism),
    }


def _project(fields: Data) -> Data:
    """The title block's texts; what is not given is empty, a date null."""
    told: Data = {name: "" if value is None and name != "date" else value for name, value in fields.items()}
    return told | ({"revisions": [_project(line) for line in told["revisions"]]} if "revisions" in told else {})


def _press(run: Run) -> Data:
    press, bases = run.blocks[PRESS], run.bases
    assert isinstance(press, Press)
    found, chosen = [], run.chosen_units(PRESS)
    for name, value in flatten(press).items():
        meta = declared(Press, tuple(name.split(".")))
        if isinstance(meta, Quantity):
            shown = given_shown(value, chosen.of(name, meta.unit) or meta.unit)
            said_of = {"path": f"{PRESS}.{name}", "description": meta.description, "symbol": meta.symbol}
            node = (PRESS, *name.split("."))
            rests = {"basis": bases.of(node)} | ({"note": note} if (note := bases.said(node).note) else {})
            found.append(said_of | {"value": value, "unit": meta.parsed_unit.si, "display": shown} | rests)
    return {"name": press.name, "fields": found}


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
    values = {name: getattr(block, name) for name in type(block).model_fields}
    values = {name: value for name, value in values.items() if value is not None}
    idle = set(_idle(block, values))
    return {
        name: _plain_value(block, (*node, name), value, instance, bases)
        for name, value in values.items()
        if name not in idle
    }


def _idle(block: Block, values: Data) -> Iterator[str]:
    """Return the defaults that have no use beside what is given: as given keys they would be refused."""
    for rule in filter(lambda rule: rule.is_asked(values), type(block).one_of):
        fault = rule.fault(values)
        defaults = [name for name in values if name not in block.model_fields_set] if fault else []
        yield from (name for name in defaults if rule.fault(values.keys() - {name}) != fault)


def _plain_value(block: Block, node: Node, value: Any, instance: Instance, bases: Bases) -> Any:
    meta = keys_of(type(block))[str(node[-1])].meta
    match value:
        case Block():
            return _plain(value, node, instance, bases)
        case [Block(), *_]:
            return [_plain(part, (*node, index), instance, bases) for index, part in enumerate(value)]
        case CurveHandle(calculation=_):
            return _written(instance.data, node[1:])
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


def _written(data: Any, key: KeyPath) -> Any:
    """What stands in the file at a key."""
    for part in key:
        data = data[part]
    return data


def _resting(value: Any, node: Node, bases: Bases) -> Any:
    """A value, as a block where something is to be said of it."""
    basis, note = bases.of(node), bases.said(node).note
    said = {"basis": basis} if basis not in ("", GIVEN) else {}
    said |= {"note": note} if note else {}
    return {"value": value} | said if said else value
