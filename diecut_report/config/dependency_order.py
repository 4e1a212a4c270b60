"""The order in which the values and calculations of a config follow from each other, and the loops in it."""

from __future__ import annotations

from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter

from diecut_report.config.instances import Instance
from diecut_report.config.targets import Node, Target
from diecut_report.errors import Problem
from diecut_report.languages.phrases import Phrase


def ordered(instances: Mapping[str, Instance | None], links: Mapping[Node, Target]) -> tuple[list[Node], list[Problem]]:
    """The nodes in the order in which they can be known; or, for each loop, a problem that shows the whole of it."""
    kept, problems = dict(links), list[Problem]()
    while True:
        sorter: TopologicalSorter[Node] = TopologicalSorter({(name,): () for name in instances})
        for node, target in kept.items():
            sorter.add(node, *(single.node for single in target.single))
            sorter.add(node[:1], node)
        try:
            return list(sorter.static_order()), problems
        except CycleError as error:
            loop: list[Node] = error.args[1][:0:-1]  # each refers to the next
            first = next(index for index, node in enumerate(loop) if node in kept)
            loop = loop[first:] + loop[:first]
            problems.append(_loop_problem(instances, kept, loop))
            del kept[loop[0]]


def _loop_problem(instances: Mapping[str, Instance | None], links: Mapping[Node, Target], loop: list[Node]) -> Problem:
    shown = [".".join(map(str, node)) if len(node) > 1 else _path(links[before], node)
             for before, node in zip([loop[-1], *loop], loop, strict=False)]  # fmt: skip
    instance = instances[str(loop[0][0])]
    assert instance is not None, "a mechanism without a model has no links"
    told = [text for before, text in zip(["", *shown], [*shown, shown[0]], strict=True) if text != before]
    message = Phrase(
        "refers to itself: {told}. Give one of these inputs a value of its own.",
        told=" → ".join(told if len(told) > 1 else 2 * told),
    )
    return instance.place.problem(loop[0][1:], message)


def _path(link: Target, node: Node) -> str:
    """The path by which a link names a calculation."""
    return next(single.path for single in link.single if single.node == node)
