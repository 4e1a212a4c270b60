"""The inputs of a base config by their paths: what a study may vary, and the base with other values in their place."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal, get_args, get_origin

from diecut_report.config import loader
from diecut_report.config.instances import Instance, substituted
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS, PressBlock
from diecut_report.config.parts.keys import WORDS, MachineKeys
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.parts.reading import COORDINATE, MODELS, place_of, typed_value
from diecut_report.config.references import Linker, ordered
from diecut_report.config.validation import ASSUMED, OF_ONE_VALUE, declared, keys_of, validate, value_at
from diecut_report.config.yaml import KeyPath, Scalar, key_of, resolved
from diecut_report.errors import Problem, nearest
from diecut_report.mechanism.chapters import in_form
from diecut_report.mechanism.curve_inputs import CurveInput, MechanismInput, PhaseInput
from diecut_report.mechanism.inputs import Quantity, Referred, fields, list_inputs
from diecut_report.mechanism.names import SI, Pending, Text
from diecut_report.quantities.formatting import as_typed
from diecut_report.text.phrases import MessageError, Phrase, phrase

MECHANISMS = "mechanisms"


class UnknownPath(MessageError, LookupError):
    """Report a path that names no input that can be varied."""


@dataclass(frozen=True, eq=False)
class Input:
    """Hold an input of the base: its path in the file, where it is, and what it declares."""

    path: str
    instance: str
    key: KeyPath
    meta: Quantity | Text
    annotation: Any
    metadata: tuple[Any, ...]

    @property
    def node(self) -> KeyPath:
        """Return its mechanism with its key."""
        return (self.instance, *self.key)

    @property
    def unit(self) -> str | None:
        """Return its SI unit; None for a text, a choice or a yes/no."""
        return self.meta.parsed_unit.si if isinstance(self.meta, Quantity) else None

    @property
    def display(self) -> str:
        """Return the unit that people read it in; empty for what is not a quantity."""
        return self.meta.unit if isinstance(self.meta, Quantity) else ""

    @property
    def is_integer(self) -> bool:
        return isinstance(self.meta, Quantity) and self.meta.integer

    @property
    def declared_as(self) -> Any:
        """Return the annotation of a field that takes the same values, with the same bounds and messages."""
        return Annotated[self.annotation, *self.metadata]


def find_input(base: Config, path: str) -> Input:
    """Return the input that a path names; UnknownPath, with the nearest known one, where it names none."""
    instance, keys = _instance(base, path)
    key = key_of(".".join(keys)) if keys else ()
    meta = declared(instance.model, key) if key else None
    if isinstance(meta, type):
        is_list = ".".join(keys) in list_inputs(instance.model).values()
        first = f"{path}.{'0.' if is_list else ''}{next(iter(meta.model_fields))}"
        raise UnknownPath("is a block or a list; vary one of its values, such as {path}.", path=first)
    if isinstance(meta, PhaseInput | MechanismInput):
        raise UnknownPath("stands for something of another mechanism, which cannot be varied; vary what it is made of.")
    if isinstance(meta, CurveInput):
        raise UnknownPath("is a curve; curves cannot be varied, only numbers, texts and choices.")
    if meta is None:
        raise UnknownPath(_no_input(instance, keys))
    _check_list(instance.data, key)
    single = instance.model.spread.get(str(key[0]), ()) if len(key) == 1 else ()
    if single and all(name in instance.data for name in single):
        template = "is given in the base by its single values; vary one of these: {names}."
        raise UnknownPath(template, names=", ".join(single))
    home = declared(instance.model, key[:-1]) if len(key) > 1 else instance.model
    assert isinstance(home, type)
    field = keys_of(home)[str(key[-1])].field
    own = meta.of_unit(_present_unit(base, instance, key, meta)) if isinstance(meta, Quantity) else meta
    metadata = tuple(own if each is meta else each for each in field.metadata)
    return Input(path, instance.name, key, own, _with_entries(instance, key, field.annotation), metadata)


def _present_unit(base: Config, instance: Instance, key: KeyPath, meta: Quantity) -> str | None:
    """The SI unit of what the base has there: of a quantity that may be given in two kinds of unit the one that it is given in."""
    link = base.links.get((instance.name, *key))
    if link is not None:
        return link.unit
    return meta.other.parsed_unit.si if instance.is_in_other_unit(key, meta) else meta.parsed_unit.si


def varied_input(base: Config, path: str) -> Input:
    """Return the input that a study varies, also a number or text of the parts; UnknownPath where it follows from these."""
    if path.split(".")[0] in WORDS and base.parts is not None:
        return _part_input(base, base.parts, path)
    found = find_input(base, path)
    if base.parts is not None and base.parts.follows(found.node):
        typed = base.parts.typed_at(found.node)
        place = ".".join(str(step) for step in typed or () if step != "value")
        where = Phrase("; vary {path} in its place.", path=place) if typed else "."
        raise UnknownPath("follows from the parts of the machine{where}", where=where)
    return found


def _part_input(base: Config, parts: MachineParts, path: str) -> Input:
    """The number or text that is typed at a place of the parts."""
    data = parts.reader.data
    key = place_of(data, path)
    home = key[:1] if key[0] == "machine" else key[:2]
    own = key[len(home) :]
    if key[0] != "machine" and (len(key) < 2 or key[1] not in (data.get(str(key[0])) or {})):
        names = ", ".join(f"{key[0]}.{name}" for name in data.get(str(key[0])) or {})
        raise UnknownPath("names no part of the machine; known: {names}.", names=names or phrase("none"))
    if key[0] == "machine" and own[:1] == ("frame",) and len(own) == 3 and value_at(data, key) is not None:
        return Input(path, key[0], key[1:], COORDINATE, float, (COORDINATE,))
    if any(isinstance(step, int) and not _has(parts, key[: index + 1]) for index, step in enumerate(key)):
        raise UnknownPath("is not there in the base: its list is shorter.")
    model = MachineKeys if key[0] == "machine" else MODELS[str(key[0])]
    meta = declared(model, own) if own else None
    if isinstance(meta, Quantity | Text):
        block = declared(model, own[:-1]) if len(own) > 1 else model
        assert isinstance(block, type)
        field = keys_of(block)[str(own[-1])].field
        return Input(path, str(key[0]), key[1:], meta, field.annotation, tuple(field.metadata))
    for node in (node for node, there in parts.sources.items() if there == key and len(node) > 1):
        made = find_input(base, ".".join(map(str, (MECHANISMS, *node))))
        return replace(made, path=path, instance=str(key[0]), key=key[1:])
    known = ", ".join(name for name, each in keys_of(model).items() if isinstance(each.meta, Quantity))
    template = "is not a number or text that is typed at a part in the base; give it there first, or vary another one, such as {known}."
    raise UnknownPath(template, known=known)


def _has(parts: MachineParts, key: KeyPath) -> bool:
    """Whether the parts have a place in a list, also in one that is typed as a text."""
    if key[:1] == ("shafts",) and key[2:3] == ("sections",) and len(key) == 4:
        return int(key[3]) < len(parts.shafts[str(key[1])].sections)
    return value_at(parts.reader.data, key) is not None


def is_of_parts(base: Config, asked: Input) -> bool:
    """Return whether the parts of a machine, and what is made of them, follow an input."""
    return base.parts is not None and (asked.instance in WORDS or base.parts.is_made_with(asked.node))


def typed_place(base: Config, asked: Input) -> KeyPath:
    """Return where an input that the parts follow is typed."""
    instance = base.instances.get(asked.instance)
    return (asked.instance, *asked.key) if instance is None else instance.place.stands(asked.key)[1]


def present_value(base: Config, asked: Input) -> float | str | None:
    """Return the value (SI, text) that an input has in the base; None where it has none, or refers."""
    if asked.instance in WORDS and base.parts is not None:
        typed = typed_value(base.parts.reader.tree, (asked.instance, *asked.key))
        return None if typed is None or "${" in str(typed) else number_of(asked, resolved(str(typed)))
    instance = base.instances[asked.instance]
    if instance is None or asked.node in base.links:
        return None
    value = instance.value(asked.key)
    if isinstance(value, bool):
        return str(value).lower()
    return float(value) if isinstance(value, int | float) else value if isinstance(value, str) else None


def typed_data(asked: Input, value: float | str) -> Scalar:
    """Return a value (SI, text) as it is typed in a file."""
    if isinstance(value, str):
        return resolved(value) if isinstance(resolved(value), bool) else value
    return int(value) if asked.is_integer else as_typed(float(value), asked.display or "1")


def number_of(asked: Input, typed: Any) -> float | str | None:
    """Return the value (SI, text) of what is typed; None where it is none that is allowed."""
    if not isinstance(asked.meta, Quantity):
        return str(typed).lower() if isinstance(typed, bool) else str(typed)
    try:
        value = asked.meta.validate(typed)
    except ValueError:
        return None
    return float(value) if isinstance(value, int | float) else None


def _with_entries(instance: Instance, key: KeyPath, annotation: Any) -> Any:
    names = instance.place.named.get(key, ())
    known = [part for part in (annotation, *get_args(annotation)) if get_origin(part) is Literal]
    return Literal[(*(text for part in known for text in get_args(part)), *names)] if names else annotation


def _instance(base: Config, path: str) -> tuple[Instance, list[str]]:
    first, *rest = path.split(".")
    name, *keys = rest if first == MECHANISMS and rest else [first, *rest]
    if name not in base.instances or (name == PRESS) != (first == PRESS) or first not in (MECHANISMS, PRESS):
        raise UnknownPath(_no_instance(base, path))
    instance = base.instances[name]
    if instance is None:
        raise UnknownPath("cannot be varied, as its plugin is broken: {error}", error=base.broken.get(name, "unknown"))
    return instance, keys


def _no_instance(base: Config, path: str) -> Phrase:
    first, *rest = path.split(".")
    names = [name for name in base.instances if name != PRESS]
    if first in names:
        return Phrase("is not a path of an input; write {path}.", path=f"{MECHANISMS}.{path}")
    if first == MECHANISMS and rest:
        template = "there is no mechanism {name}{near}. Known: {names}."
        return Phrase(template, name=repr(rest[0]), near=nearest(rest[0], names), names=", ".join(names))
    if first == "project":
        template = "is in the title block, which cannot be varied; vary fields of {press} and inputs of {mechanisms}."
        return Phrase(template, press=PRESS, mechanisms=MECHANISMS)
    known = [each for name in base.instances for each in known_paths(base, name)]
    alike = next((each for each in known if each.endswith(f".{rest[-1] if rest else first}")), None)
    near = Phrase(" (did you mean {key}?)", key=repr(alike)) if alike else nearest(path, known)
    template = "is not a path of an input{near}; paths are {mechanisms}.NAME.KEY and {press}.KEY. Mechanisms: {names}."
    return Phrase(template, near=near, mechanisms=MECHANISMS, press=PRESS, names=", ".join(names))


def _no_input(instance: Instance, keys: list[str]) -> Phrase:
    name, known = ".".join(keys), _known(instance)
    if not keys:
        return Phrase("names no input; known of {home}: {names}.", home=instance.name, names=", ".join(known))
    if name == "kind":
        return phrase("cannot be varied; a mechanism keeps its kind in all variants.")
    if name in instance.results:
        template = "is an output of {home}; only inputs can be varied{near}."
        return Phrase(template, home=instance.name, near=nearest(name, known))
    place = next((part for part in keys if part.isdigit()), "0")  # of the part that is meant
    near = nearest(name, [key.replace(".0.", f".{place}.") for key in known])
    template = "{name} is not an input of {home}{near}. Known: {names}."
    listed = _known(instance, each_part=True)
    return Phrase(template, name=repr(name), home=instance.name, near=near, names=", ".join(listed))


def known_paths(base: Config, name: str) -> list[str]:
    """Return the paths of all inputs of a mechanism, or of the press; of lists those of the first part."""
    instance = base.instances[name]
    prefix = PRESS if name == PRESS else f"{MECHANISMS}.{name}"
    return [f"{prefix}.{key}" for key in _known(instance)] if instance else []


def _known(instance: Instance, *, each_part: bool = False) -> list[str]:
    """Return the inputs of a mechanism; of lists those of the first part, or with ``each_part`` how the parts are numbered."""
    lists = list_inputs(instance.model)

    def first(home: str) -> str:
        count = len(instance.data.get(home) or ()) if each_part else 1
        return f"{home}.0…{count - 1}" if count > 1 else f"{home}.0"

    names = (name for name, meta in fields(instance.model) if not isinstance(meta, Referred))
    return [f"{first(lists[name])}{name.removeprefix(lists[name])}" if name in lists else name for name in names]


def _check_list(data: Any, key: KeyPath) -> None:
    for part in key:
        if isinstance(part, int) and part >= len(data or ()):
            raise UnknownPath("the list has {n} entries in the base, counted from 0.", n=len(data or ()))
        known = part in data if isinstance(data, dict) else isinstance(data, list)
        data = data[part] if known else None


# --- other values in the base ----------------------------------------------------------------------------------------


def with_values(base: Config, values: Mapping[Input, Any]) -> tuple[Config, list[Problem]]:
    """Return the base with values of these inputs in the place of what stands there (references too), linked anew.

    Also what is wrong with that beside the values themselves: keys that cannot be given together, a block that lacks some.
    """
    instances = {name: _changed(instance, values) for name, instance in base.instances.items()}
    linker = Linker(instances)
    order, loops = ordered(linker)
    changed = replace(base, instances=instances, links=linker.links, order=tuple(order))
    return changed, [*linker.problems, *loops, *_typed_beside(base, values), *_wrong_keys(changed, values)]


def _changed(instance: Instance | None, values: Mapping[Input, Any]) -> Instance | None:
    if instance is None:
        return None
    own = {asked.key: value for asked, value in values.items() if asked.instance == instance.name}
    if not own:
        return copy(instance)  # with what is known of its inputs; the links are its own
    data = substituted(instance, {}, lambda _, __: None)
    for key, value in own.items():
        _put(data, key, value)
    declared_as = instance.mechanism.inputs if instance.mechanism else PressBlock
    former = {key: said for key in own if (said := instance.bases.get(key)) is not None and said.basis in OF_ONE_VALUE}
    place, taken = instance.place, instance.own
    bases = {**instance.bases, **{key: replace(said, basis=ASSUMED) for key, said in former.items()}}
    if not taken.naming.keys().isdisjoint(own):
        taken = taken.anew(declared_as, data, own, place)
        data, place, bases = taken.data, taken.place, {**bases, **taken.bases}
    model = in_form(declared_as, [key for key, value in data.items() if value is not None])
    changed = Instance(instance.name, model, data, place, instance.mechanism, bases, taken)
    changed.derived = instance.derived - {str(key[0]) for key in own}
    literal = (key for key in former if key in instance.by_key and "${" not in str(instance.by_key[key].value))
    changed.founded = {key: instance.value(key) for key in literal}
    return changed


def _put(data: Any, key: KeyPath, value: Any) -> None:
    for part in key[:-1]:
        if isinstance(data, dict) and data.get(part) is None:  # an optional block that the base does not give
            data[part] = {}
        data = data[part]
    data[key[-1]] = value


def _wrong_keys(base: Config, values: Mapping[Input, Any]) -> Iterator[Problem]:
    """Yield what is wrong with the keys that are given, whatever their values are."""
    for name in dict.fromkeys(asked.instance for asked in values):
        instance = base.instances[name]
        assert instance is not None, "an input of a broken plugin is not found"
        known: dict[KeyPath, Any] = {}
        for node, target in base.links.items():
            if node[0] == name and not target.is_default:
                known[node[1:]] = Pending(target.path, target.unit, target.is_curve)
                if declared(instance.model, node[1:]) is None:  # the values of a curve that is a list must be numbers
                    known[node[1:]] = SI(0.0, str(target.unit), target.path)
        own = [asked for asked in values if asked.instance == name and asked.unit]
        known |= {asked.key: Pending(asked.path, asked.unit) for asked in own}
        data = substituted(instance, {}, lambda _, __: None)
        for key, pending in known.items():
            _put(data, key, pending)
        yield from validate(instance.model, data, instance.place, list(known))[1]


def _typed_beside(base: Config, values: Mapping[Input, Any]) -> Iterator[Problem]:
    """Yield what is given in place of what a block that compares others takes from them."""
    for asked in values:
        instance = base.instances[asked.instance]
        if instance and (reference := loader.compared(instance).get(str(asked.key[0]))):
            yield instance.place.problem(asked.key, loader.typed_beside(reference))
