"""A closed formula."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from diecut_report.formulas import Array
from diecut_report.mechanism.names import Written, formula_of
from diecut_report.mechanism.steps.base import Over, QuantityStep
from diecut_report.mechanism.steps.protocols import CURVE, Item, Kinds, Names, StepEngine, StepPrinter
from diecut_report.text.phrases import Phrase, joined, named


def answer(symbolic: Any = None, numeric: Any = None, *, held: bool) -> Item:
    """Return yes or no as it is printed, with the condition that says so where there is one."""
    condition = {"condition": symbolic, "condition_substituted": numeric} if symbolic else {}
    result = {"text": "yes" if held else "no", "unit": "1"}
    return {"type": "choice", "words": "", "equation": None, "substituted": None, "result": result} | condition


def mixed_axes(taken: Iterable[str], names: Names) -> Iterator[str]:
    """Yield in words that quantities run over several abscissas or lists."""
    own = {name: names.axes(name) for name in taken}
    sole = {name: next(iter(axes)) for name, axes in own.items() if len(axes) == 1}
    if len(set(sole.values())) > 1:
        told = joined([Phrase("{name} runs over {axis}", name=name, axis=axis) for name, axis in sole.items()], ", ")
        template = "mixes what runs over unlike places: {told}; take a single number of one of them first"
        yield Phrase(template, told=told)


@dataclass(frozen=True, eq=False)
class FormulaStep(QuantityStep):
    """Declare the base of steps that are formulas: a curve where they take a curve, a row where they take a row, else a number.

    ``per_piece`` marks a flag of a curve's smooth pieces (direction of motion, cutting): it is taken at the middle
    of the piece, so that one-sided limits at the piece's ends are well defined.
    """

    per_piece: bool = field(default=False, kw_only=True)
    is_formula = True
    is_shown_at_place = True
    may_be_absent = True

    def takes(self) -> tuple[str, ...]:
        """Return the ids that the formulas take."""
        own = (each.formula for each in self.formulas() if each.field != "exists")
        return tuple(name for formula in own for name in formula_of(formula).parameters)

    @abstractmethod
    def values(self, apply: Callable[[Written], Array]) -> Array:
        """Return what it gives, by a function that computes a formula."""

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return over(*self.takes()) or {("number", "")}

    def runs_over(self, known: Mapping[str, str]) -> str | None:
        own = {known[name] for name in self.takes() if name in known}
        if len(own) > 1:
            raise ValueError(Phrase("{id} mixes {axes}", id=self.id, axes=named(sorted(own), " and ")))
        return own.pop() if own else None

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        yield from mixed_axes(self.takes(), names)
        if self.per_piece and not any(each.step is self and each.kind == "curve" for each in names.givers(self.id)):
            yield Phrase(
                "has per_piece=True, which marks a flag of a curve's smooth pieces, but takes no curve and no abscissa; take it away"
            )

    def run(self, calc: StepEngine) -> None:
        if calc.axis.get(self.id) in calc.domains:
            calc.curves[self.id] = self
        else:
            calc.values[self.id] = calc.existing(self, self.numbers(calc))

    @abstractmethod
    def shown_formula(self, page: StepPrinter, elsewhere: bool) -> Written:
        """Return the formula that is printed."""

    @abstractmethod
    def numbers(self, calc: StepEngine) -> Array:
        """Return its numbers, of all variants."""

    def curve(self, sampler: Any) -> Array:
        if self.per_piece and sampler.mid is not sampler.x:
            found: Array = sampler.of_pieces(self.id)
            return found
        return self.values(sampler.apply)

    def is_same(self, pair: Any) -> bool:
        return bool(pair.holds_all(self))


@dataclass(frozen=True, eq=False)
class Value(FormulaStep):
    """Declare a closed formula: a number, a curve where it takes a curve or an abscissa, a row of numbers over repeated parts.

    ``per_piece`` marks a flag of a curve's smooth pieces (direction of motion, cutting): it is taken at the middle
    of the piece, so that one-sided limits at the piece's ends are well defined.
    """

    formula: Written

    FORMULAS: ClassVar[dict[str, Kinds]] = {"formula": CURVE}

    @property
    def is_condition(self) -> bool:
        return formula_of(self.formula).tree.op in ("cmp", "and", "or", "not")

    def takes_over(self) -> set[str]:
        formula = formula_of(self.formula)
        return {*formula.parameters} if formula.tree.op == "sym" else set()

    def values(self, apply: Callable[[Written], Array]) -> Array:
        return apply(self.formula)

    def shown_formula(self, page: StepPrinter, elsewhere: bool) -> Written:
        return self.formula

    def numbers(self, calc: StepEngine) -> Array:
        return calc.apply(self.formula)

    def items(self, page: StepPrinter) -> list[Item]:
        calc, axis = page.calc, page.calc.axis.get(self.id)
        part = formula_of(self.shown_formula(page, elsewhere=False))
        if self.id in calc.values and calc.values[self.id].dtype == bool:
            held = bool(calc[self.id][0, 0])
            return [self.head() | answer(*page.sides(part, held), held=held)]
        elsewhere, place = page.over_axis(self)
        item = self.head() | {"type": "formula"} | page.formula(self, part, elsewhere) | place
        return [item] if axis is None or axis in calc.domains else page.parts_shown(self, item, self.takes())
