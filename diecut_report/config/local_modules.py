"""Modules of plugins that are not installed: those of single files and folders, and those of a package in its project."""

from __future__ import annotations

import hashlib
import re
import sys
from importlib import import_module, util
from pathlib import Path
from types import ModuleType
from typing import Any

from diecut_report.languages.phrases import Phrase, phrase

OF_PROJECTS: dict[str, Path] = {}
"""The packages that were loaded of projects, by their names, each with its first file."""


def module_of_file(file: Path) -> ModuleType:
    """Return the module of a local file; it stands in sys.modules while it runs, or postponed annotations would not resolve."""
    digest = hashlib.sha256(str(file.resolve()).encode()).hexdigest()[:16]
    name = f"diecut_report_local_{digest}_{re.sub(r'[^A-Za-z0-9]', '_', file.stem)}"
    return sys.modules[name] if name in sys.modules else _loaded(name, file)


def module_of_project(file: Path, source: Path) -> ModuleType:
    """Return a module of a package that stands in a folder of its project, under its own name, by which its modules import each other.

    A module that is not in a package stands for itself. ImportError in words where another package of this name is loaded already.
    """
    place = file.parent if file.name == "__init__.py" else file.with_suffix("")
    package, *inner = place.relative_to(source).parts
    whole = source.resolve() / package / "__init__.py"
    if not whole.is_file():
        return module_of_file(file)
    if OF_PROJECTS.get(package) != whole:
        _begin(package, whole)
    return import_module(".".join([package, *inner]))


def _begin(package: str, file: Path) -> None:
    """Load a package, in the place of one of the same name that another project gave."""
    if OF_PROJECTS.pop(package, None):
        _forget(package)
    if package in sys.modules:
        words = "another package {name} is loaded already, {place}; uninstall it, or give this one another name"
        raise ImportError(Phrase(words, name=package, place=getattr(sys.modules[package], "__file__", None)))
    try:
        _loaded(package, file)
    except BaseException:
        _forget(package)
        raise
    OF_PROJECTS[package] = file


def _forget(package: str) -> None:
    for name in [each for each in sys.modules if each == package or each.startswith(f"{package}.")]:
        del sys.modules[name]


def _loaded(name: str, file: Path) -> ModuleType:
    if file.exists() and not file.is_file():
        raise OSError(phrase("it is not a regular file"))  # a pipe would be waited for
    folder = [str(file.parent)] if file.name == "__init__.py" else None
    spec = util.spec_from_file_location(name, file, submodule_search_locations=folder)
    assert spec is not None and spec.loader is not None, file
    module = sys.modules[name] = util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except BaseException:
        sys.modules.pop(name, None)
        raise
    return module


def attribute_of(module: ModuleType, name: str) -> Any:
    """Return what stands under a name in a module; AttributeError in words where there is none."""
    if not hasattr(module, name):
        raise AttributeError(Phrase("there is no {name} in it", name=name))
    return getattr(module, name)
