"""The logo of a DOCX: a PNG as it is, an SVG beside a picture of points, both above the title and within their bounds."""

from __future__ import annotations

import base64
import io
from zipfile import ZipFile

import docx
import pytest

from diecut_report.pictures import natural_size
from diecut_report.report.rendering import Rendering
from tests.report.made_results import typed
from tests.report.office.test_word_file import part, without_figures
from tests.test_pictures import png, svg

A = "{http://schemas.openxmlformats.org/drawingml/2006/main}"
ASVG = "{http://schemas.microsoft.com/office/drawing/2016/SVG/main}"
R = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"
WP = "{http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing}"
DRAWN = svg('<circle cx="2" cy="2" r="2" fill="#0b5c8f"/>')


def word(content: bytes, media_type: str) -> bytes:
    found = without_figures("brief")
    found["mechanisms"]["cylinder"]["figures"] = []
    found["config"]["logo"] = {
        "file": "logo",
        "sha256": "",
        "media_type": media_type,
        "base64": base64.b64encode(content).decode(),
    }
    found["project"]["organisation"] = "Works & Sons $x^2$"
    return Rendering(typed(found)).docx()


def media(file: bytes) -> dict[str, bytes]:
    with ZipFile(io.BytesIO(file)) as archive:
        return {name.rpartition("/")[2]: archive.read(name) for name in archive.namelist() if "/media/" in name}


def named(file: bytes, relation: str) -> bytes:
    """The part of the document that a relation names."""
    return docx.Document(io.BytesIO(file)).part.related_parts[relation].blob


def test_a_png_stands_above_the_title_as_it_is() -> None:
    file = word(png(), "image/png")
    assert list(media(file).values()) == [png()]
    (blip,) = part(file).iter(f"{A}blip")
    assert named(file, blip.attrib[f"{R}embed"]) == png() and len(blip) == 0
    first = docx.Document(io.BytesIO(file)).paragraphs[0]
    assert first._p.xpath(".//wp:docPr/@descr") == ["Works & Sons $x^2$"]


def test_an_svg_stands_beside_a_picture_for_older_programs() -> None:
    file = word(DRAWN, "image/svg+xml")
    (blip,) = part(file).iter(f"{A}blip")
    (vector,) = blip.iter(f"{ASVG}svgBlip")
    assert named(file, vector.attrib[f"{R}embed"]) == DRAWN
    assert named(file, blip.attrib[f"{R}embed"]).startswith(b"\x89PNG")
    with ZipFile(io.BytesIO(file)) as archive:
        assert '"/word/media/logo.svg" ContentType="image/svg+xml"' in archive.read("[Content_Types].xml").decode()
    assert word(DRAWN, "image/svg+xml") == file


@pytest.mark.parametrize(
    ("content", "kind"), [(png(2000, 100), "image/png"), (DRAWN, "image/svg+xml")], ids=["png", "svg"]
)
def test_it_keeps_its_shape_within_its_bounds(content: bytes, kind: str) -> None:
    (extent,) = part(word(content, kind)).iter(f"{WP}extent")
    width, height = (int(extent.attrib[side]) / 12700 for side in ("cx", "cy"))
    wide, high = natural_size(content)
    assert width <= 144.01 and height <= 48.01 and width / height == pytest.approx(wide / high, rel=1e-3)


@pytest.mark.parametrize(("width", "height"), [(1, 200), (3000, 1)])
def test_a_thin_one_is_shown_too(width: int, height: int) -> None:
    thin = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"><rect width="{width}" height="{height}"/></svg>'
    assert set(media(word(thin.encode(), "image/svg+xml"))) >= {"logo.svg"}
