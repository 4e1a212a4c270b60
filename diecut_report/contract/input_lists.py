"""Inputs that repeat: the lists of parts that a block of inputs declares."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from diecut_report.contract.inputs import Block, fields, meta_of, nested


@cache
def list_inputs(model: type[Block]) -> Mapping[str, str]:
    """Return the paths of the inputs that come in rows, one for each part of a list, each with the path of its list."""
    found: dict[str, str] = {}
    for name, field in model.model_fields.items():
        block = nested(field.annotation)
        if block and block[1]:
            found |= {f"{name}.{path}": name for path, _ in fields(block[0])}
        elif block:
            found |= {f"{name}.{path}": f"{name}.{home}" for path, home in list_inputs(block[0]).items()}
    return found


def list_titles(model: type[Block]) -> dict[str, str]:
    """Return what each list of repeated parts is, by its path."""
    found: dict[str, str] = {}
    for name, field in model.model_fields.items():
        block, meta = nested(field.annotation), meta_of(model, name)
        if block and block[1] and meta is not None:
            found[name] = meta.description
        elif block:
            found |= {f"{name}.{path}": title for path, title in list_titles(block[0]).items()}
    return found
