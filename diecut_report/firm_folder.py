"""Reads the folder of a firm's templates (``--template DIR``): regular files, of bounded size, judged before anything is calculated."""

from __future__ import annotations

import base64
import os
from importlib import import_module
from pathlib import Path

from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.files import content
from diecut_report.pictures import MAX_BYTES, PictureFault, media_type
from diecut_report.report.pages.firm_templates import CSS, ENDING, HouseStyle, problems
from diecut_report.text.phrases import Phrase, phrase

MOST_TEXT, MOST_FILES = 1_000_000, 100
PICTURES = (".png", ".svg")


def house_style(folder: Path) -> HouseStyle:
    """Return what the folder holds; UserError where it is none, or where a file in it cannot be what it is for."""
    if not folder.is_dir():
        raise refusal("This is not a folder. Give the folder of your templates.", folder)
    files = sorted(path for path in folder.iterdir() if not path.name.startswith("."))
    if len(files) > MOST_FILES:
        template = "The folder has {count} files; at most {most_files} are allowed."
        raise refusal(template, folder, count=len(files), most_files=MOST_FILES)
    if outside := [path for path in files if not Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))]:
        template = "This is a link out of the folder: what lies elsewhere would go into the report. Put the file itself into the folder."
        raise UserError([Problem(phrase(template), str(path)) for path in outside])
    templates = {path.name: _text(path) for path in files if path.name.endswith(ENDING)}
    css = "".join(_text(path) for path in files if path.name == CSS)
    pictures = {path.name: _picture(path) for path in files if path.suffix.lower() in PICTURES}
    made = HouseStyle(str(folder), templates, css, pictures)
    programs = Path(import_module("diecut_report.templates").__path__[0])
    if found := [*_unused(files, made), *_ending_style(made), *problems(made, programs)]:
        raise UserError(found)
    return made


def _text(path: Path) -> str:
    try:
        return content(path, MOST_TEXT, phrase("a text file")).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise refusal("The file is not UTF-8. Save it in this encoding.", path) from error


def _picture(path: Path) -> str:
    found = content(path, MAX_BYTES, phrase("a picture"))
    try:
        media = media_type(found)
    except PictureFault as fault:
        raise refusal("The file {fault}. Give another picture.", path, fault=fault) from fault
    return f"data:{media};base64,{base64.b64encode(found).decode()}"


def _unused(files: list[Path], made: HouseStyle) -> list[Problem]:
    """What would be left unused without a word: another style sheet, another ending of a template."""
    strange = [path for path in files if path.suffix in (".css", ".j2", ".html", ".jpg", ".jpeg", ".gif")]
    wrong = [path for path in strange if path.name not in (*made.templates, CSS)]
    template = (
        "Nothing asks for {name}{nearest}. A folder holds templates (NAME{ending}), {css}, and pictures (PNG, SVG)."
    )
    return [
        Problem(
            Phrase(template, name=repr(each.name), nearest=nearest(each.name, [CSS]), ending=ENDING, css=CSS), str(each)
        )
        for each in wrong
    ]


def _ending_style(made: HouseStyle) -> list[Problem]:
    place = made.css.lower().find("</")
    if place < 0:
        return []
    line = made.css.count("\n", 0, place) + 1
    return [Problem(phrase("'</' would end the style sheet within the page. Leave it out."), made.path(CSS), line)]
