"""JSON Schema (draft 2020-12) of the config, for editors: keys complete by kind, units and ranges stand in the descriptions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args, get_origin

from diecut_report.config.instances import DIMENSIONS
from diecut_report.config.loader import RESERVED
from diecut_report.config.model import PressBlock, Project, ReportSettings
from diecut_report.config.own_tables import MAX_FILES
from diecut_report.config.parts.elements import given_by_parts
from diecut_report.config.parts.keys import MachineKeys
from diecut_report.config.parts.reading import MODELS, TAKEN_APART
from diecut_report.config.validation import BASES, LEAST_REASON, keys_of
from diecut_report.declaration.inputs import NAME
from diecut_report.errors import MAX_CURVE_VALUES, MAX_MECHANISMS, MAX_PARTS, MAX_TEXT
from diecut_report.mechanism.chapters import in_all_units
from diecut_report.mechanism.curve_inputs import CurveInput, MechanismInput, PhaseInput
from diecut_report.mechanism.inputs import Block, Quantity, Varying
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import OneOf, Text
from diecut_report.quantities.units import MAX_UNIT_LENGTH, pretty

Schema = dict[str, Any]
DRAFT = "https://json-schema.org/draft/2020-12/schema"
REFERENCE = r"^\s*\$\{[^${}]+\}\s*$"
EXPRESSION = (  # references, numbers with and without unit, functions, signs; a reference among them
    r"^(?=.*\$\{)\s*(?:(?:\$\{[^${}]+\}|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\d.])(?:\s*(?:1/)?[^\s\d.,+*/()^${}−-][^\s,+()${}−-]*)?"
    r"|(?:abs|max|min|sqrt)\s*\(|[-+*/^(),−])\s*)+$"
)
NUMBER = (
    r"^\s*[-+−]?(?![1-9]\d{0,2},\d{3}(?!\d))(\d+(\.\d*|,\d+)?|\.\d+)([eE][-+]?\d+)?(\s*[^\s\d.,$][^$]*|\s+1/[^$]*)?$"
)
_REFERENCE: Schema = {"type": "string", "pattern": REFERENCE, "description": "A reference such as ${cylinder.radius}."}
BOUNDS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}


def config_schema(mechanisms: Mapping[str, Mechanism], broken: Mapping[str, str]) -> Schema:
    """Schema of a whole config with these kinds; of broken plugins (kind: why) only the kind is known."""
    kinds = {kind: _of_kind(mechanism) for kind, mechanism in mechanisms.items()}
    kinds |= {kind: {"type": "object", "description": f"The plugin is broken: {why}"} for kind, why in broken.items()}
    return {
        "$schema": DRAFT,
        "title": "Press configuration for diecut-report",
        "type": "object",
        "required": ["schema_version", "project", "press", "mechanisms"],
        "additionalProperties": False,
        "properties": {
            "schema_version": {"const": 1, "description": "Version of this form of the file."},
            "project": block_schema(Project, refers=False),
            "report": _report(),
            "press": block_schema(PressBlock),
            "materials": _materials(),
            **_parts(),
            "mechanisms": {
                "type": "object",
                "description": "The mechanisms by their names, which references use: ${NAME.output}.",
                "minProperties": 1,
                "maxProperties": MAX_MECHANISMS,
                "propertyNames": {"pattern": f"^{NAME.pattern}$", "not": {"enum": list(RESERVED)}},
                "additionalProperties": {"$ref": "#/$defs/mechanism"},
            },
        },
        "$defs": {"mechanism": _mechanism(mechanisms, list(kinds))} | kinds,
    }


def kind_schema(mechanism: Mechanism) -> Schema:
    """Schema of one mechanism's block in a config."""
    return {"$schema": DRAFT} | _of_kind(mechanism)


def _report() -> Schema:
    schema = block_schema(ReportSettings, refers=False)
    chosen = {"type": "string", "maxLength": MAX_UNIT_LENGTH}
    units = {
        "type": "object",
        "description": "Units in which quantities are shown: of a dimension, or of one quantity, MECHANISM.QUANTITY.",
        "properties": {name: chosen | {"description": f"A unit such as {si}."} for name, si in DIMENSIONS.items()},
        "patternProperties": {r"^[^.]+\..+$": chosen},
        "additionalProperties": False,
    }
    return schema | {"properties": schema["properties"] | {"units": units}}


def _materials() -> Schema:
    template = (
        "Files with tables of your own, beside this one or in a folder below: steels, gear_materials, chains, keys."
    )
    name = {"type": "string", "pattern": r"\.ya?ml$", "maxLength": MAX_TEXT}
    return {"description": template, "anyOf": [name, {"type": "array", "items": name, "maxItems": MAX_FILES}]}


def _parts() -> Schema:
    """The parts of the machine; keys that go on to the calculation made of a part are judged there."""
    text: Schema = {"type": ["string", "integer"], "pattern": r"^[\d.]+(/[\d.]+)?$"}
    axis = {"type": "array", "minItems": 2, "maxItems": 2, "description": "An axis: [x, y] in mm."}
    machine = block_schema(MachineKeys)
    machine["properties"]["frame"] = {"type": "object", "additionalProperties": axis}
    found: Schema = {"machine": machine}
    for word, model in MODELS.items():
        block = block_schema(model) | {"additionalProperties": True}
        optional = {name for name in block["required"] if name.endswith(("_1", "_2"))}
        block["required"] = [name for name in block["required"] if name not in optional]
        block["properties"] |= (
            dict.fromkeys(TAKEN_APART, text) if optional else {"sections": {}, "parts": {"type": "array"}}
        )
        described = f"The {word} of the machine, by their names."
        found[word] = {"type": "object", "description": described, "additionalProperties": block}
    return found


def _mechanism(mechanisms: Mapping[str, Mechanism], kinds: list[str]) -> Schema:
    titles = "; ".join(f"{kind}: {mechanism.title}" for kind, mechanism in mechanisms.items())
    return {
        "type": "object",
        "required": ["kind"],
        "properties": {"kind": {"enum": kinds, "description": f"The plugin. {titles}."}},
        "allOf": [
            {"if": {"properties": {"kind": {"const": kind}}, "required": ["kind"]}, "then": {"$ref": f"#/$defs/{kind}"}}
            for kind in kinds
        ],
    }


def _of_kind(mechanism: Mechanism) -> Schema:
    schema = block_schema(mechanism.inputs)
    return schema | {
        "title": mechanism.kind,
        "description": f"{mechanism.title}. {mechanism.summary}",
        "required": ["kind", *(key for key in schema["required"] if key not in given_by_parts(mechanism))],
        "properties": {"kind": {"const": mechanism.kind}} | schema["properties"],
    }


def block_schema(model: type[Block], refers: bool = True) -> Schema:
    """Return the schema of a block of keys; its texts may be references where it ``refers``."""
    groups = [_needed(model, rule) for rule in model.one_of if not rule.optional]
    return {
        "type": "object",
        "required": [name for name, field in model.model_fields.items() if field.is_required()],
        "additionalProperties": False,
        "properties": {name: _key(model, name, refers) for name in model.model_fields},
    } | ({"allOf": groups} if groups else {})


def _needed(model: type[Block], rule: OneOf) -> Schema:
    """Keys of which one group is needed, where the text of the rule is chosen."""
    typed_as = {curve: key for key, curve in model.curve_keys.items()}
    groups = [*rule.groups, *(tuple(typed_as.get(key, key) for key in group) for group in rule.groups)]
    needed: Schema = {"anyOf": [{"required": list(group)} for group in dict.fromkeys(groups)]}
    if not rule.when:
        return needed
    key, _, text = rule.when.partition("=")
    typed = {} if model.model_fields[key].default == text else {"required": [key]}
    return {"if": {"properties": {key: {"const": text}}, **typed}, "then": needed}


def _key(model: type[Block], name: str, refers: bool) -> Schema:
    known = keys_of(model)[name]
    meta, inner, default = known.meta, known.block, known.default
    if inner:
        block = block_schema(inner, refers)
        described = {"description": meta.description if isinstance(meta, Text) else (inner.__doc__ or "")}
        return described | ({"type": "array", "maxItems": MAX_PARTS, "items": block} if known.is_list else block)
    shown = {} if default is None else {"default": default}
    match meta:
        case Quantity():
            quantity = _quantity(meta, default, refers) | shown
            if name in model.curve_keys:
                curve = keys_of(model)[model.curve_keys[name]].meta
                assert isinstance(curve, CurveInput), "the declaration check has seen to it"
                return quantity | {"anyOf": [*quantity["anyOf"], *_curve(curve)["anyOf"]]}
            if name in model.spread:  # or a list of so many
                count = len(model.spread[name])
                values = {"type": "array", "minItems": count, "maxItems": count, "items": {"anyOf": quantity["anyOf"]}}
                return quantity | {"anyOf": [*quantity["anyOf"], values]}
            return quantity
        case CurveInput():
            return _curve(meta)
        case PhaseInput():
            return {"description": f"{meta.description}. A reference to a phase.", "anyOf": [_REFERENCE]}
        case MechanismInput():
            words = f"{meta.description}. The name of a mechanism."
            return {"description": words, "type": "string", "pattern": f"^{NAME.pattern}$"}
    described = {"description": f"{meta.description}."} if meta else {}
    allowed = {"enum": list(meta.options)} if isinstance(meta, Text) and meta.options else _text(known.field.annotation)
    if any(rule.key == name for rule in model.from_tables):
        allowed = {"anyOf": [allowed, {"type": "string", "maxLength": MAX_TEXT}]}  # an entry of a table of the user's
    if isinstance(meta, Text):
        allowed = {"anyOf": [allowed, _stated([allowed])]}
    return described | ({"anyOf": [allowed, _REFERENCE]} if refers else allowed) | shown


def _curve(meta: CurveInput) -> Schema:
    ways = "A reference to a curve" + ("" if meta.referred else ", or its values over a turn")
    values = {"type": "array", "minItems": 4, "maxItems": MAX_CURVE_VALUES, "items": {"type": ["number", "string"]}}
    allowed = [_REFERENCE] if meta.referred else [_REFERENCE, values]
    said = f"{meta.description}. Unit: {in_all_units(meta, _unit)}. {ways}."
    return {"description": said, "anyOf": [*allowed, _stated(allowed)]}


def _stated(allowed: list[Schema]) -> Schema:
    return {
        "type": "object",
        "description": "The value with what it rests on.",
        "required": ["value"],
        "additionalProperties": False,
        "properties": {
            "value": {"anyOf": allowed},
            "basis": {"enum": list(BASES), "description": "What the value rests on."},
            "note": {"type": "string", "maxLength": MAX_TEXT, "description": "Where it comes from; printed beside it."},
            "beyond": {
                "type": "string",
                "minLength": LEAST_REASON,
                "maxLength": MAX_TEXT,
                "description": "Why a value outside the range of all machines is right; it stays a warning.",
            },
        },
    }


def _unit(meta: Quantity | CurveInput) -> str:
    return pretty(meta.unit) or "none (a pure number)"


def _quantity(meta: Quantity, default: Any, refers: bool) -> Schema:
    """A bare number counts in the display unit, so the bounds hold for it as they stand."""
    limits = {BOUNDS[name]: getattr(meta, name) for name in BOUNDS if getattr(meta, name) is not None}
    said = [meta.description, f"Unit: {in_all_units(meta, _unit)}"]
    said += [f"Allowed: {in_all_units(meta, lambda form: form.allowed)}"] if meta.allowed else []
    said += [f"Plausible: {in_all_units(meta, lambda form: form.sizes.told)}"]
    if default is not None:
        shown = in_all_units(
            meta, lambda form: f"{default} {'' if default in form.words else pretty(form.unit)}".rstrip()
        )
        said.append(f"Default: {shown}")
    said += [f"Or in {pretty(meta.or_unit)}"] if meta.or_unit else []
    said += [f"Or: {', '.join(meta.words)}"] if meta.words else []
    said += [f"Default: from {meta.press.path}"] if meta.press else []
    number = {"type": "integer" if meta.integer else "number", **limits}
    text = {"type": "string", "maxLength": MAX_TEXT, "pattern": f"{EXPRESSION}|{NUMBER}" if refers else NUMBER}
    words: list[Schema] = [{"enum": list(meta.words)}] if meta.words else []
    if isinstance(meta, Varying) and meta.extremes:
        ends = {name: {"anyOf": [number, text]} for name in ("min", "max")}
        words.append({"type": "object", "required": [*ends], "additionalProperties": False, "properties": ends})
    if meta.listed:
        number = {"enum": list(meta.listed)}
    ways = [number, *words, text, *([_stated([number, text])] if refers else [])]
    return {"description": ". ".join(said) + ".", "anyOf": ways}


def _text(annotation: Any) -> Schema:
    if get_origin(annotation) is list:
        return {"type": "array", "maxItems": MAX_PARTS, "items": _text(get_args(annotation)[0])}
    options = [part for part in (get_args(annotation) or (annotation,)) if part is not type(None)]
    if options == [bool]:
        return {"type": "boolean"}
    if all(isinstance(option, str) for option in options):
        return {"enum": options}
    return {"type": ["string", "number"], "maxLength": MAX_TEXT}  # a number is taken as it was typed
