"""Which plugins were found sound: by the content of their files, in the user's folder for what can be made again."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from diecut_report import __version__
from diecut_report.code_files import code_of
from diecut_report.contract.binding import Binding, ByText, bound
from diecut_report.contract.inputs import fields
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Step
from diecut_report.declaration.world import world
from diecut_report.files import cache_folder
from diecut_report.standards import StandardSeries, StandardTable

OWN = Path(__file__).parents[1]
FOLDER = "declarations"


def content(mechanism: Mechanism) -> str:
    """Return the SHA-256 of all that the check of a plugin follows from: its files, its allowed texts, and the check itself."""
    found = hashlib.sha256(__version__.encode())
    texts = [(key.path, key.texts) for key in world(mechanism.inputs).keys.values()]
    found.update(repr((mechanism.kind, texts)).encode())
    check = (
        file
        for part in ("declaration", "contract", "expressions", "formula_checks")
        for file in (OWN / part).glob("*.py")
    )
    for file in sorted({*files(mechanism), *check}):
        found.update(str(file).encode() + hashlib.sha256(file.read_bytes()).digest())
    return found.hexdigest()


def is_sound(key: str) -> bool:
    """Return whether a plugin of this content was found sound before."""
    folder = cache_folder(FOLDER)
    return folder is not None and (folder / key).is_file()


def remember(key: str) -> None:
    """Note that a plugin of this content is sound; where it cannot be noted it is judged again the next time."""
    folder = cache_folder(FOLDER)
    if folder is not None:
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            (folder / key).touch()


def files(mechanism: Mechanism) -> Iterator[Path]:
    """Give the files in which anything of a mechanism is declared, and all others of their code."""
    for file in {Path(place.rpartition(":")[0]) for place in _places(mechanism)}:
        if not file.is_file():
            continue
        yield file
        if file.suffix == ".py" and not file.is_relative_to(OWN):
            package = file.with_name("__init__.py")
            yield from (Path(path) for _, path in code_of(package if package.is_file() else file))


def _places(mechanism: Mechanism) -> Iterator[str]:
    declared: Iterable[tuple[object, ...]] = (
        (mechanism,), mechanism.chapters, mechanism.checks, mechanism.figures, mechanism.exports, mechanism.sources,
        mechanism.errata, mechanism.comparisons, mechanism.spectra, tuple(meta for _, meta in fields(mechanism.inputs)),
    )  # fmt: skip
    for parts in declared:
        yield from (str(getattr(part, "at", "")) for part in parts)
    for _, step in mechanism.steps:
        yield step.at
        yield from _tables(step)
        yield from _formulas(step)
    for comparison in mechanism.comparisons:
        yield from _places(comparison.mechanism)


def _tables(step: Step) -> Iterator[str]:
    """The files that a step's tables were read from."""
    taken = getattr(step, "table", None), getattr(step, "series", None)
    yield from (f"{each.file}:" for each in taken if isinstance(each, StandardTable | StandardSeries) and each.file)


def _formulas(step: Step) -> Iterator[str]:
    """The places of a step's formulas."""
    cases = [part for case in getattr(step, "cases", ()) for part in (case.value, case.condition)]
    for part in (*vars(step).values(), *cases):
        options = part.options() if isinstance(part, ByText) else (part,) if isinstance(part, Binding) else ()
        yield from (f"{bound(option).formula.function.__code__.co_filename}:" for option in options)
