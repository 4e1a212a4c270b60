"""The files of a new mechanism: a plugin that runs, its tests, an example, a study, its Ukrainian words; as a package or as a folder.

What it is made like are the folders of ``files``.
"""

from __future__ import annotations

import keyword
import re
import textwrap
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path

from diecut_report import __version__
from diecut_report.config.plugins import EXTENSION, Discovery
from diecut_report.errors import refusal
from diecut_report.files import write_all
from diecut_report.text.phrases import Phrase

RESERVED = ("press", "study", "kind", "kinds", "project", "report", "diecut_report")
MAX_NAME_LENGTH = 40  # letters of a name, which stands in many files
NAME = re.compile(r"[a-z][a-z0-9_]*")
ENDING = ".txt"  # of the templates here: they are no modules of the program
LIKE = ("parts", "motion", "selection")
"""What a new mechanism may be made like, each a folder of templates; the first one where nothing is said."""
TABLES = {"selection": "sizes.csv"}  # those that have a table beside the plugin


def scaffold(name: str, folder: Path, *, as_package: bool, like: str) -> list[Path]:
    """Write a new mechanism into a folder that is not there yet; UserError in words where the name or the folder cannot be.

    Returns the files, the plugin's module first.
    """
    if words := _wrong(name):
        raise refusal(words)
    if folder.exists() or folder.is_symlink():
        raise refusal("This name already exists and is not overwritten. Name another folder with -o.", folder)
    made = contents(name, as_package=as_package, like=like)
    files = {folder / place: content.encode() for place, content in made.items()}
    write_all(files, keep=folder)
    return list(files)


def _wrong(name: str) -> str:
    """Why a name cannot be that of a kind, and what may; nothing where it can."""
    if not NAME.fullmatch(name) or len(name) > MAX_NAME_LENGTH:
        template = (
            "{name} cannot be the name of a kind: give small letters a to z, digits and underscores, a letter first, "
            "at most {longest} in all, such as gripper_chain."
        )
        return Phrase(template, name=repr(name), longest=MAX_NAME_LENGTH)
    if keyword.iskeyword(name) or name in RESERVED or name.startswith(EXTENSION):
        return Phrase("{name} is reserved and cannot be the name of a kind; choose another one.", name=repr(name))
    known = Discovery().origins.get(name, [])
    if known:
        template = "There is a kind {name} already, from {origin}; choose another name."
        return Phrase(template, name=repr(name), origin=known[0].label)
    return ""


def contents(name: str, *, as_package: bool, like: str = "parts") -> dict[str, str]:
    """Return the files of a new mechanism by their places in its folder, made like one of ``LIKE``."""
    home = f"src/diecut_{name}" if as_package else "plugins"
    option = "" if as_package else " --plugins plugins"
    sources = _sources(name, home, like, as_package=as_package)
    told = {
        "kind": name, "Class": "".join(part.capitalize() for part in name.split("_")), "option": option, "program": __version__,
        "dashed": name.replace("_", "-"), "imports": _imports(name, as_package=as_package),
        "table": next((Path(place).name for place in sources if place.endswith(".csv")), ""),
        "files": "\n".join(f"| `{place}` | {WHAT[Path(source).name]} |" for place, source in sources.items() if source != README),
        "commands": _commands(name, option, as_package=as_package),
    }  # fmt: skip
    typed = {f"{home}/py.typed": ""} if as_package else {}
    return {place: _filled(source, told) for place, source in sources.items()} | typed


README = "README.md"
WHAT = {
    "plugin.py": "the plugin: inputs, calculation, checks, figure, sources",
    "sizes.csv": "its table, with the source of the numbers",
    "uk.po": "its words in Ukrainian; `msgid` is the English text",
    "test.py": "its tests, with a worked example",
    "example.yaml": "a configuration with one machine",
    "study.yaml": "a study of it",
    "pyproject.toml": "the package, which announces the kind to diecut-report",
}


def _sources(name: str, home: str, like: str, *, as_package: bool) -> dict[str, str]:
    table = TABLES.get(like)
    own = {
        f"{home}/__init__.py" if as_package else f"{home}/{name}.py": "plugin.py",
        **({f"{home}/{table}" if as_package else f"{home}/{name}_{table}": table} if table else {}),
        f"{home}/locale/uk.po" if as_package else f"{home}/{name}.uk.po": "uk.po",
        f"tests/test_{name}.py": "test.py",
        f"examples/{name}.yaml": "example.yaml",
        f"examples/{name}_study.yaml": "study.yaml",
    }
    shared = {README: README, **({"pyproject.toml": "pyproject.toml"} if as_package else {})}
    return {place: f"{like}/{source}" for place, source in own.items()} | shared


def _filled(source: str, told: Mapping[str, str]) -> str:
    text = files(__package__).joinpath(f"files/{source}{ENDING}").read_text("utf-8")
    return re.sub(r"@(\w+)@", lambda found: told[found[1]], text)


def _imports(name: str, *, as_package: bool) -> str:
    if as_package:
        return textwrap.dedent(f"""\
            import pytest
            from diecut_{name} import MECHANISM

            from diecut_report.testing import Refused, calculate, check_contract, compare
            """)
    return textwrap.dedent(f"""\
        from pathlib import Path

        import pytest

        from diecut_report.testing import Refused, calculate, check_contract, compare, load

        MECHANISM = load("{name}", Path(__file__).parents[1] / "plugins")
        """)


def _commands(name: str, option: str, *, as_package: bool) -> str:
    shown = [
        *(["pip install --editable ."] if as_package else []),
        f"diecut-report check-plugin {name}{option} -o build/chapter.html",
        "python -m pytest tests",
        f"diecut-report report examples/{name}.yaml{option} -o build",
        f"diecut-report batch examples/{name}_study.yaml{option} -o build/study",
    ]
    return "\n".join(shown)
