"""The organisation's logo above the title of a DOCX: a PNG as it is, an SVG beside a picture for programs that show none."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable, Mapping
from typing import Any

from diecut_report.pictures import SVG, natural_size
from diecut_report.report.office.word_body import WordBody

WIDEST, HIGHEST = 144.0, 48.0  # points
POINTS = 0.75  # to a pixel


def logo(body: WordBody, given: Mapping[str, Any], owner: str, embed_svg: Callable[[bytes], str]) -> None:
    """Show the logo of the results; ``embed_svg`` puts an SVG into the file and returns what names it there.

    Word shows the SVG since 2016. Older programs show the picture of points beside it: as nothing here draws an SVG as one,
    it is the owner's name.
    """
    from diecut_report.report.figures.raster import Raster, raster_of_text  # with matplotlib

    content = b64decode(given["base64"])
    told = owner or body.words["logo"]
    width, height = (POINTS * side for side in natural_size(content))
    scale = min(WIDEST / width, HIGHEST / height)
    if given["media_type"] == SVG:
        plain = raster_of_text(told, width * scale, height * scale)
        body.say(body.drawn(plain, told, embed_svg(content)))
    else:
        scale = min(1.0, scale)
        body.say(body.drawn(Raster(content, width * scale, height * scale), told))
