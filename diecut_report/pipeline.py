"""The way of the data, as a table of contents: load, validate, resolve, compute, check, render, write."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from diecut_report.config import load_config
from diecut_report.discovery import Discovery
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.yaml_tree import Tree

FORMATS = ("html", "pdf", "json")
ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
LINES_TO_DEPTH = 4  # the results file has a line for each quantity and each curve

Data = dict[str, Any]
Tell = Callable[[str], None]
Source = Path | Tree  # a configuration: its file, or what was read and changed

NO_PANGO = (
    "The PDF cannot be made, because a library of the system is missing: {}. Install it (Debian, Ubuntu: "
    "apt-get install libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0), or leave the PDF out with --format html,json."
)


@dataclass(frozen=True)
class Outcome:
    """What came out: the results document, the files written, and the plugins that broke."""

    results: Data
    written: tuple[Path, ...]
    broken: tuple[PluginError, ...]


def check(config: Path, discovery: Discovery) -> tuple[PluginError, ...]:
    """Load, validate and resolve without calculating; UserError with all problems. Gives the plugins that are broken."""
    return tuple(load_config(config, discovery).broken.values())


def calc(config: Source, discovery: Discovery, tell: Tell, target: Path | None = None) -> tuple[Outcome, str]:
    """The results document and its text; written to ``target`` if there is one."""
    results, broken = _calculated(config, discovery, tell)
    text = results_text(results)
    if target is not None:
        _write({target: text.encode()}, config)
    return Outcome(results, (target,) if target else (), broken), text


def report(
    config: Source, discovery: Discovery, tell: Tell, folder: Path, formats: Sequence[str], language: str | None = None
) -> Outcome:
    """The report in the asked formats, as ``NAME.html``, ``NAME.pdf``, ``NAME.json`` in the folder, and the exports beside it."""
    results, broken = _calculated(config, discovery, tell)
    if language is not None:
        results["project"]["language"] = language
    contents = _rendered(results, formats, tell)
    contents |= _exported(results, tell)
    stem = Path(config.name).stem
    files = {folder / f"{stem}.{ending}": content for ending, content in contents.items()}
    _write(files, config)
    return Outcome(results, tuple(files), broken)


def _calculated(source: Source, discovery: Discovery, tell: Tell) -> tuple[Data, tuple[PluginError, ...]]:
    tell("reading the configuration")
    config = load_config(source, discovery)
    from diecut_report.assembly import document  # with the engine, which checking alone does not need
    from diecut_report.compute import compute

    run = compute(config, lambda name: tell(f"calculating {name}"))
    return document(run), tuple(run.errors.values())


def _rendered(results: Data, formats: Sequence[str], tell: Tell) -> dict[str, bytes]:
    """The content of each format; all are complete before anything is written."""
    contents = {"json": results_text(results).encode()} if "json" in formats else {}
    if {"html", "pdf"} & set(formats):
        tell("drawing the report")
        from diecut_report.report import Rendering

        rendering = Rendering(results)
        if "html" in formats:
            contents["html"] = rendering.html().encode()
        if "pdf" in formats:
            tell("setting the pages")
            contents["pdf"] = _pdf(rendering)
    return {ending: contents[ending] for ending in formats}


def _exported(results: Data, tell: Tell) -> dict[str, bytes]:
    """The profiles of the mechanisms as tables and drawings, by the ending of their file: ``INSTANCE.cam_1.dxf``."""
    calculated = {**results["mechanisms"], **results.get("comparisons", {})}
    if not any(mechanism["exports"] for mechanism in calculated.values()):
        return {}
    tell("drawing the profiles")
    from diecut_report.exports import exports

    return exports(results)


def _pdf(rendering: Any) -> bytes:
    try:
        content: bytes = rendering.pdf()
    except OSError as error:
        if "cannot load library" not in str(error):
            raise
        raise UserError(
            Problem(NO_PANGO.format(str(error).split(":")[0].removeprefix("cannot load library ")))
        ) from error
    return content


def _write(files: dict[Path, bytes], config: Source) -> None:
    from diecut_report.writing import write_all

    write_all(files, keep=Path(config.file) if isinstance(config, Tree) else config)


def results_text(results: Data) -> str:
    """The results file: floats in their shortest exact form, never NaN or Infinity, the same bytes for the same results."""
    return _lines(results, LINES_TO_DEPTH) + "\n"


def _lines(data: Any, depth: int, indent: str = "\n") -> str:
    if depth == 0 or not isinstance(data, dict) or not data:
        return ENCODER.encode(data)
    parts = (
        f"{indent} {json.dumps(key, ensure_ascii=False)}: {_lines(part, depth - 1, indent + ' ')}"
        for key, part in data.items()
    )
    return "{" + ",".join(parts) + indent + "}"
