"""Names of two things: a step that hides an input, or a name that the engine makes itself, as the place of an extreme."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.contract.code_steps import PartTable
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.result_names import ResultName, has_own_names, names_ahead, read
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Breakpoints, Clash, FromCurve, Phase, Require, Step
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault, short
from diecut_report.declaration.world import Key, When, told, world
from diecut_report.languages.phrases import Phrase, phrase

NAMELESS = Breakpoints | Require | Clash | Phase | PartTable  # whose ids nothing takes
MADE = {
    "place": phrase("the place of its extreme"),
    "count": phrase("the number of its crossings"),
    "crossing": phrase("one of its crossings"),
    "part": phrase("one of its parts"),
}


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps that hide an input whose value nothing takes then, and names that the engine makes of another step."""
    inputs = world(mechanism.inputs).keys
    for number, (_, step) in enumerate(mechanism.steps):
        if step.id in inputs and not isinstance(step, NAMELESS):
            yield from _hidden(names, number, step, inputs[step.id])
        for name, place, when in _made_otherwise(names, number, step):
            yield from _made_twice(names, number, step, name, place, when)


def _hidden(names: DeclaredNames, number: int, step: Step, key: Key) -> Iterator[Fault]:
    """The step that has the id of an input, where that is given and no step or check takes ``inputs.ID``, or refuses it."""
    when = names.when(number).with_(When(frozenset((key.path,)) if key.may_be_absent else frozenset()))
    given = names.world.example(when, list(_takers(names, key.path)))
    if given is not None:
        words = (
            "has the id of an input, so that what the user gives for {id} counts nowhere {where}; name the step otherwise, "
            'or let a formula take the input as "inputs.{id}"'
            if (where := told(given, when.needs | when.lacks))
            else "has the id of an input, so that what the user gives for {id} counts nowhere; name the step otherwise, "
            'or let a formula take the input as "inputs.{id}"'
        )
        yield Fault(step.at, Phrase("step {id}", id=step.id), Phrase(words, id=step.id, where=where))


def _takers(names: DeclaredNames, path: str) -> Iterator[When]:
    """When something takes an input itself, not the step of its id."""
    for number, (_, step) in enumerate(names.mechanism.steps):
        own = {getattr(step, "given", "")} | ({step.id} if isinstance(step, FromCurve) else set())
        own |= {name.removeprefix("inputs.") for name in getattr(step, "holds", ()) if name.startswith("inputs.")}
        refuses = isinstance(step, Require) and step.key == path and path in step.needs
        if f"inputs.{path}" in taken(step) or path in own or refuses:
            yield names.when(number)
    for check in names.mechanism.checks:
        if f"inputs.{path}" in check.named:
            yield When(frozenset((*check.needs, *check.only_with)))


def _made_otherwise(names: DeclaredNames, number: int, step: Step) -> Iterator[tuple[ResultName, str, When]]:
    """The names that the engine makes of a step, each with the place and the condition of what is declared under it."""
    made = {each.name: each for each in names_ahead(step) if each.role != "value"}
    if not made:
        return
    for name in sorted(made.keys() & names.world.keys.keys()):
        key = names.world.keys[name]
        yield made[name], "", When(frozenset((key.path,)) if key.may_be_absent else frozenset())
    for other, (_, declared) in enumerate(names.mechanism.steps):
        if declared is step or isinstance(declared, NAMELESS):
            continue
        if declared.id in made:
            yield made[declared.id], declared.at, names.when(other)
        elif other < number:
            yield from ((made[name], declared.at, names.when(other)) for name in _both_make(made, declared))


def _both_make(made: dict[str, ResultName], other: Step) -> list[str]:
    """A name that another step makes too."""
    if has_own_names(other):
        return [name for name in made if (found := read(name, other)) and found.role != "value"][:1]
    return [each.name for each in names_ahead(other) if each.role != "value" and each.name in made][:1]


def _made_twice(
    names: DeclaredNames, number: int, step: Step, made: ResultName, place: str, when: When
) -> Iterator[Fault]:
    given = names.world.example(names.when(number).with_(when))
    if given is None:
        return
    what = Phrase("that of another step (at {place})", place=short(place)) if place else phrase("that of an input")
    words = "gives {name} as {made}, and this name is {what}; name one of them otherwise"
    text = Phrase(words, name=made.name, made=MADE[made.role], what=what)
    yield Fault(step.at, Phrase("step {id}", id=step.id), text)
