"""What the documents on the sources name is there: modules, folders, files, and the order of imports."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from tests.test_architecture import LAYERS, PROGRAM, ROOT

DOCUMENTS = ("ARCHITECTURE.md", "CONTRIBUTING.md", "DECISIONS.md")
ABSENT = {  # what is not in the sources, and why it is named
    "build/types/",  # made by scripts/check.sh
    "diecut_report.extensions",  # a group of entry points
}
PACKAGES = sorted({".".join(name.split(".")[:-1]) for name in PROGRAM if name.count(".")} - {"diecut_report"})
FENCE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)


def text_of(document: str) -> str:
    return (ROOT / document).read_text("utf-8")


def paths(document: str) -> Iterator[str]:
    """What stands between backticks and is a path or a dotted name of the program; words in capitals are placeholders."""
    for token in re.findall(r"`([\w./-]+)`", FENCE.sub("", text_of(document))):
        is_dotted = token.split(".")[0] in {"diecut_report", *(name.split(".")[1] for name in PACKAGES)}
        if ("/" in token or is_dotted) and not re.search(r"[A-Z]{2}|^\.venv", token) and token not in ABSENT:
            yield token


def is_there(token: str) -> bool:
    path = token if "/" in token else token.replace(".", "/")
    places = [ROOT, ROOT / "diecut_report", ROOT / "diecut_report" / "study"]
    known = [place / f"{path.rstrip('/')}{end}" for place in places for end in ("", ".py")]
    return any(place.exists() for place in known) or token in PROGRAM


@pytest.mark.parametrize("document", DOCUMENTS)
def test_what_a_document_names_is_there(document: str) -> None:
    named = set(paths(document))
    assert named and {token for token in named if not is_there(token)} == set()


def picture() -> str:
    """The house of ARCHITECTURE.md: a line for each part of the program, those below it indented."""
    return next(found for found in FENCE.findall(text_of("ARCHITECTURE.md")) if "\nerrors, " in found).replace(
        "```", ""
    )


def test_the_modules_in_the_picture_are_there() -> None:
    modules = {part for name in PROGRAM for part in name.split(".")} | {"check_mechanism"}
    plain = re.sub(r"`[^`]*`|\([^)]*\)", "", picture())
    named = set(re.findall(r"\b[a-z]+_[a-z_]+\b", plain)) | set(re.findall(r"^ *(\w+)/", plain, re.MULTILINE))
    assert len(named) > 30 and named - modules == set()


def in_order(names: list[str]) -> None:
    """Demand that these are all parts of the program, each after what it may import."""
    places = {name: place for place, layer in enumerate(LAYERS) for name in layer - {"", "__main__"}}
    assert sorted(names) == sorted(places)
    assert [places[name] for name in names] == sorted(places.values())


def test_the_picture_shows_the_order_of_imports() -> None:
    lines = re.findall(r"^(\w+(?:, \w+)*)", picture(), re.MULTILINE)
    in_order([name for line in lines for name in line.split(", ")])


def test_the_rules_name_the_order_of_imports() -> None:
    found = re.search(r"\*\*Imports run one way\*\*: ([^.]*)\.", text_of("CONTRIBUTING.md"))
    assert found is not None
    in_order(re.split(r"\s*(?:→|,)\s*", found[1]))
