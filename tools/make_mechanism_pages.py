"""Makes docs/mechanisms/KIND.md from what each built-in mechanism declares: ``python tools/make_mechanism_pages.py``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, get_args

from pydantic_core import PydanticUndefined

from diecut_report.config.plugins import Discovery
from diecut_report.mechanism.chapters import in_all_units
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.curve_inputs import CurveInput
from diecut_report.mechanism.figures import SpectrumLine
from diecut_report.mechanism.inputs import Block, Meta, Quantity, meta_of, nested
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import OneOf, Text
from diecut_report.mechanism.steps import Crossings, Reduction, SilentStep, Step
from diecut_report.quantities.units import pretty, unit

PAGES = Path(__file__).parents[1] / "docs" / "mechanisms"


def pages() -> dict[Path, str]:
    """The text of each page by its file."""
    discovery = Discovery()
    mechanisms = [discovery.mechanism(kind) for kind in discovery.origins]
    compared = {c.mechanism.kind: c.mechanism for m in mechanisms for c in m.comparisons}
    return {PAGES / f"{m.kind}.md": "\n".join(page(m)) for m in [*mechanisms, *compared.values()]}


def page(mechanism: Mechanism) -> Iterator[str]:
    """The lines of one mechanism's page."""
    yield f"# {mechanism.title} — `{mechanism.kind}`\n"
    yield f"{mechanism.summary}\n"
    yield "Made from the plugin's declaration by `python tools/make_mechanism_pages.py`.\n"
    yield "## Inputs\n"
    yield from _table("key", "symbol", "unit", "default", "allowed", "meaning")
    for each in input_rows(mechanism.inputs):
        yield f"| `{each.key}` | {each.symbol} | {each.unit} | {each.default} | {each.allowed} | {each.meaning} |"
    yield from (f"\n{rule}" for rule in choices(mechanism.inputs))
    yield "\n## Outputs\n"
    yield "Units are those of the results file. Optional chapters need the inputs named.\n"
    yield from _table("id", "symbol", "unit", "meaning", "source", "needs")
    for out in output_rows(mechanism):
        yield f"| {out.name} | {out.symbol} | {out.unit} | {out.meaning} | {out.source} | {out.needs} |"
    yield "\n## Checks\n"
    yield from _table("id", "class", "demanded", "limited by", "source")
    yield from (
        f"| `{check_id(c)}` | {c.check_class} | {c.demand_label} | {c.limit_label} | {c.source} |"
        for c in mechanism.checks
    )
    yield "\n## Assumptions\n"
    yield from (f"- {text}" for text in mechanism.assumptions)
    yield "\n## Errata of the sources\n"
    yield from (f"- {e.source}: {e.text}" for e in mechanism.errata)
    yield "\n## Sources\n"
    yield from (f"- {s.id}: {s.citation}" for s in mechanism.sources)
    yield ""


def _table(*columns: str) -> Iterator[str]:
    yield f"| {' | '.join(columns)} |"
    yield f"| {' | '.join('---' for _ in columns)} |"


class InputRow(NamedTuple):
    """What a page tells of an input; its texts are Markdown."""

    key: str
    symbol: str
    unit: str
    default: str
    allowed: str
    meaning: str


class OutputRow(NamedTuple):
    """What a page tells of an output; its texts are Markdown."""

    name: str
    symbol: str
    unit: str
    meaning: str
    source: str
    needs: str


def check_id(check: Check) -> str:
    """Return the id of a check; of named parts with NAME for the part's."""
    return check.of_part(0, "NAME").id if check.named_by else check.id


def input_rows(model: type[Block], prefix: str = "") -> Iterator[InputRow]:
    """Yield what is told of each key, those of a block below it (``gears[].driver_teeth`` for a list of blocks)."""
    for name, field in model.model_fields.items():
        meta, inner = meta_of(model, name), nested(field.annotation)
        if meta is not None:
            told = _unit(meta), _default(meta, field.default), _allowed(meta, field.annotation), meta.description
            yield InputRow(f"{prefix}{name}", meta.symbol, *told)
        if inner:
            yield from input_rows(inner[0], f"{prefix}{name}{'[]' if inner[1] else ''}.")


def choices(model: type[Block]) -> Iterator[str]:
    """Yield what must be given of several, in words."""
    for rule in model.one_of:
        key, _, text = rule.when.partition("=")
        yield f"With `{key}: {text}` give {_groups(rule)}." if key else f"Give {_groups(rule)}."


def _groups(rule: OneOf) -> str:
    return ", or ".join(" and ".join(f"`{key}`" for key in group) for group in rule.groups)


def _unit(meta: Meta) -> str:
    return in_all_units(meta, lambda form: pretty(form.unit) or "–") if isinstance(meta, Quantity | CurveInput) else "–"


def _allowed(meta: Meta, annotation: object) -> str:
    if isinstance(meta, Quantity):
        bounds = in_all_units(meta, lambda form: form.allowed) if meta.allowed else ""
        own = f"plausible {meta.sizes.told}" if meta.plausible else ""
        return "; ".join(filter(None, (bounds, own)))
    known = meta.options if isinstance(meta, Text) and meta.options else get_args(annotation)
    return ", ".join(f"`{option}`" for option in known if isinstance(option, str))


def _default(meta: Meta, default: object) -> str:
    if isinstance(meta, Quantity) and meta.press:
        return f"from `{meta.press.path}`" + (", if given there" if meta.press.optional else "")
    if default is PydanticUndefined:
        return "required"
    return "optional" if default is None or default == [] else str(default)


def output_rows(mechanism: Mechanism) -> Iterator[OutputRow]:
    """Yield what is told of each output, and of each curve of a spectrum."""
    seen: set[str] = set()
    for section, step in mechanism.steps:
        if step.output and not isinstance(step, SilentStep) and step.id not in seen:
            seen.add(step.id)
            needs = ", ".join(f"`{n}`" for n in dict.fromkeys((*section.needs, *step.needs)))
            yield _output(_id(step), step, in_all_units(step, _si), needs)
    for spectrum in mechanism.spectra:
        for curve in (spectrum, *spectrum.lines()):
            yield _output(f"`{curve.id}` (a curve)", curve, _si(curve), "")


def _output(name: str, told: Step | SpectrumLine, shown: str, needs: str) -> OutputRow:
    return OutputRow(name, told.symbol, shown, told.description, told.source, needs)


def _si(declared: Step | SpectrumLine) -> str:
    return unit(declared.unit).si


def _id(step: Step) -> str:
    if step.numbered:
        return f"`{step.numbered.format(step.first)}` …"
    if isinstance(step, Crossings):
        return f"`{step.id}_count`, `{step.id}_1` …"
    place = isinstance(step, Reduction) and step.operation in ("max", "min", "abs_max")
    return f"`{step.id}`" + (" (and its place)" if place else "")


if __name__ == "__main__":
    PAGES.mkdir(parents=True, exist_ok=True)
    for file, text in pages().items():
        file.write_text(text, encoding="utf-8")
