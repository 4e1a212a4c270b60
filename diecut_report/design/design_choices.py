"""The inputs of a configuration that take one of some values: texts, yes and no, and numbers of a list."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal, get_args, get_origin

from diecut_report.config.instances import slots
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.inputs import Block, Quantity, meta_of, nested
from diecut_report.contract.texts import Text
from diecut_report.study.definition.base_inputs import MECHANISMS, Input, UnknownPath, find_input

YES_NO = ("true", "false")


@dataclass(frozen=True, eq=False)
class DesignChoice:
    """Hold an input that takes one of ``options``, each as it is typed; ``typed`` is what stands in the file."""

    asked: Input
    options: tuple[str, ...]
    typed: str
    stands: KeyPath

    @property
    def name(self) -> str:
        """Return what people call it: ``feeder.motion_law``."""
        return self.asked.path.removeprefix(f"{MECHANISMS}.")


def given_choices(config: Config) -> list[DesignChoice]:
    """Return all texts and yes/no of the file that have a few allowed values, in its order."""
    return [found for name in config.instances for found in _of_instance(config, name)]


def options_of(asked: Input) -> tuple[str, ...]:
    """Return the values that an input may have, as they are typed; none where it may have any of a range, or any text."""
    if isinstance(asked.meta, Quantity):
        return tuple(_listed(asked.meta))
    return _texts(asked.meta, asked.annotation)


def texts_of(model: type[Block]) -> dict[str, tuple[str, ...]]:
    """Return the texts that each key of a block may have, where these are a few; keys of blocks in it by their paths."""
    found = dict[str, tuple[str, ...]]()
    for name, field in model.model_fields.items():
        block, meta = nested(field.annotation), meta_of(model, name)
        if block:
            found |= {f"{name}.{path}": texts for path, texts in texts_of(block[0]).items()}
        elif isinstance(meta, Text):
            found[name] = _texts(meta, field.annotation)
    return found


def _texts(meta: Any, annotation: Any) -> tuple[str, ...]:
    return tuple(meta.options) or tuple(_options(annotation))


def _listed(meta: Quantity) -> Iterator[str]:
    own = "" if meta.unit == "1" else f" {meta.unit}"
    yield from (f"{value:.12g}{own}" for value in meta.listed)


def _options(annotation: Any) -> Iterator[str]:
    if annotation is bool:
        yield from YES_NO
    elif get_origin(annotation) is Literal:
        yield from (text for text in get_args(annotation) if isinstance(text, str))
    else:
        for part in get_args(annotation):
            yield from _options(part)


def _of_instance(config: Config, name: str) -> Iterator[DesignChoice]:
    instance = config.instances[name]
    for slot in slots(instance.model, instance.data) if instance else ():
        if not isinstance(slot.meta, Text) or not slot.is_given or (name, *slot.key) in config.links:
            continue
        prefix = "" if name == PRESS else f"{MECHANISMS}."
        try:
            asked = find_input(config, f"{prefix}{'.'.join(map(str, (name, *slot.key)))}")
        except UnknownPath:
            continue
        assert instance is not None
        home, stands = instance.place.stands(asked.key)
        typed, options = config.tree.typed(stands), options_of(asked)
        if home is config.tree and typed is not None and options:
            yield DesignChoice(asked, options, typed, stands)
