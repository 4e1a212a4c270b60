"""Makes docs/results-file.md from the form of the results file: ``python tools/make_results_page.py``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from diecut_report.results.model import results_schema
from diecut_report.results.record import FORM_VERSION

PAGE = Path(__file__).parents[1] / "docs" / "results-file.md"
ADDED = {  # by the version of the form; a test holds them against its hashes
    "2.0": "a text with values is a [message](#message) where it stands, `wordings` is gone; `advice` of a check",
}
HISTORY = "\n".join(f"| {version} | {told} |" for version, told in ADDED.items())
INTRODUCTION = f"""\
# The results file

Made from the types in `diecut_report/results/model` by `python tools/make_results_page.py`. Form {FORM_VERSION}.

`diecut-report calc press.yaml -o press.json`, `report --format json`, and `results.save("press.json")` of [a script](python.md)
write it; every PDF and HTML report carries it. [What the verdict says](results.md) tells what its checks mean.
`diecut-report schema results` gives the JSON Schema of what stands here.

The form has a version, `form_version` of the file and in the schema's `$id`. Its first number rises when a key changes its name or meaning, or is
not written any more; the second one with each addition: a key, a block, a word that a text may be. A change of numbers or texts alone changes no
version. `schema_version` is that of the contract that scripts rely on. A script that reads the file passes over keys that it does not know.

`render`, `extract`, `verify` and `diff` read files of form 1 too, which kept how texts were made in a block of their own (`wordings`). They refuse
what is not as the program writes it, with both versions where these differ, and end with 2.

| form | what was added |
| --- | --- |
{HISTORY}

A key marked *sometimes* is left out where it has nothing to say. Blocks hold no other keys than these, but for what is called an *open block*.
"""
ROOT = "The whole file"


def pages() -> dict[Path, str]:
    """Return the text of the page by its file."""
    schema = results_schema()
    known = schema["$defs"]
    blocks = {ROOT: schema} | {name: known[name] for name in _in_order(schema)}
    return {
        PAGE: "\n".join(
            [INTRODUCTION, *(line for name, block in blocks.items() for line in _block(name, block, known))]
        )
    }


def _in_order(schema: dict[str, Any]) -> list[str]:
    """The names of the blocks, each behind the first that holds it."""
    found: list[str] = []
    waiting = [schema["properties"]]
    while waiting:
        new = [name for name in _named(waiting.pop(0)) if name not in found]
        found += new
        waiting += [schema["$defs"][name] for name in new]
    return found


def _named(part: Any) -> Iterator[str]:
    if isinstance(part, dict):
        if "$ref" in part:
            yield _name(part)
        yield from (name for value in part.values() for name in _named(value))
    elif isinstance(part, list):
        yield from (name for value in part for name in _named(value))


def _name(part: dict[str, Any]) -> str:
    return str(part["$ref"]).removeprefix("#/$defs/")


def _block(name: str, block: dict[str, Any], known: dict[str, Any]) -> Iterator[str]:
    """A block of keys: what it is, and a table of its keys. Of a key that says no more than its block the words are those of the block."""
    yield f"## {name}\n\n{block['description']}\n\n| key | type | | holds |\n| --- | --- | --- | --- |"
    for key, about in block["properties"].items():
        there = "" if key in block["required"] else "sometimes"
        words = str(about.get("description") or known[_name(about)]["description"]).replace("|", "\\|")
        yield f"| `{key}` | {_type(about)} | {there} | {words} |"
    yield ""


def _type(about: dict[str, Any]) -> str:
    """A type in words, with links to blocks."""
    match about:
        case {"$ref": _}:
            name = _name(about)
            return f"[{name}](#{name.lower()})"
        case {"anyOf": options}:
            return ", ".join(dict.fromkeys(map(_type, options)))
        case {"enum": values}:
            return ", ".join(f"`{value}`" for value in values)
        case {"const": value}:
            return f"`{value}`"
        case {"type": "array", "items": {"type": _} | {"$ref": _} | {"anyOf": _} as items}:
            return f"list of {_type(items)}"
        case {"type": "object", "additionalProperties": {"type": _} | {"$ref": _} | {"anyOf": _} as values}:
            return f"by name: {_type(values)}"
    plain = {
        "object": "open block",
        "array": "list",
        "string": "text",
        "boolean": "true or false",
        "integer": "whole number",
    }
    return plain.get(about["type"], str(about["type"]))


if __name__ == "__main__":
    for file, text in pages().items():
        file.write_text(text, encoding="utf-8")
