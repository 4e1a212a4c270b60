"""The organisation's logo, which a configuration names (``report: {logo: FILE}``): read from beside it, judged by what it holds."""

from __future__ import annotations

import os
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from diecut_report.config.own_tables import Find, place_fault
from diecut_report.config.validation import ConfigPlace, told
from diecut_report.config.yaml_tree import Tree
from diecut_report.errors import Problem, UserError
from diecut_report.given_files import content
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.pictures import MOST, PictureFault, media_type

KEY = ("report", "logo")


class Logo(NamedTuple):
    """A picture, by the name that the configuration gives it."""

    name: str
    content: bytes
    media_type: str

    @property
    def sha256(self) -> str:
        """The hash of the file."""
        return sha256(self.content).hexdigest()


def logo_of(config: Tree, find: Find | None) -> tuple[Logo | None, list[Problem]]:
    """Return the logo that a configuration names, and what is wrong with it; ``find`` says where a file is, else it is beside it."""
    report = config.data.get(KEY[0]) if isinstance(config.data, dict) else None
    name = report.get(KEY[1]) if isinstance(report, dict) else None
    place = ConfigPlace(config)
    if name is None:
        return None, []
    if fault := logo_fault(name):
        return None, [place.problem(KEY, fault)]
    path = find(name) if find else Path(config.file).parent / name
    if not os.path.exists(path):
        words = Phrase(
            "there is no file {path}. A logo is sought from the configuration's folder; check the name.", path=path
        )
        return None, [place.problem(KEY, words)]
    try:
        found = content(path, MOST, phrase("a PNG or SVG picture"))
        return Logo(name, found, media_type(found)), []
    except UserError as error:
        return None, list(error.problems)
    except PictureFault as fault:
        return None, [place.problem(KEY, Phrase("{name} {fault}", name=told(name), fault=fault))]


def logo_fault(name: object) -> str:
    """Return what is wrong with the name of a logo; "" where it leads to a file beside the configuration or below."""
    if not isinstance(name, str) or not name.strip():
        return Phrase("is {name}; the name of a PNG or SVG file is needed, such as logo.svg", name=told(name))
    return place_fault(name, phrase("a logo lies"))
