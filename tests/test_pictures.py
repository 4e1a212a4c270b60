"""A logo is judged by what it holds: what only draws is taken, what runs, loads or explodes is not."""

from __future__ import annotations

import io
import struct
import zlib

import pytest
from PIL import Image

from diecut_report.pictures import MAX_BYTES, MAX_ELEMENTS, PictureFault, media_type, natural_size

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4">'
LINKED = HEAD.replace(" viewBox", ' xmlns:xlink="http://www.w3.org/1999/xlink" viewBox')


def svg(body: str, head: str = HEAD) -> bytes:
    return f"{head}{body}</svg>".encode()


def png(width: int = 4, height: int = 3) -> bytes:
    made = io.BytesIO()
    Image.new("RGBA", (width, height), "#0b5c8f80").save(made, "PNG")
    return made.getvalue()


def chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def huge() -> bytes:
    head = struct.pack(">IIBBBBB", 9_000, 9_000, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b"")
    )


DRAWN = [
    svg('<path d="M0 0L4 4" stroke="#000"/>'),
    b"\xef\xbb\xbf" + svg("<title>a</title>"),
    svg(
        '<defs><linearGradient id="a"><stop offset="1"/></linearGradient></defs><rect fill="url(#a)" width="1" height="1"/>'
    ),
    svg(
        "<style>.a, #b ,g.c/* x */{fill:#fff}*{}</style>",
        '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm">',
    ),
    svg(
        '<clipPath id="c"><rect width="1" height="1"/></clipPath><g clip-path="url(#c)"><rect clip-path="url(#c)"/></g>'
    ),
    svg('<x:path-effect xmlns:x="x"/><x:perspective xmlns:x="x"/>'),
    svg(
        '<clipPath id="c">'
        + "<path/>" * 9
        + '</clipPath><linearGradient id="a" spreadMethod="pad">'
        + "<stop/>" * 9
        + "</linearGradient>"
        + "<path/>" * 4000
    ),
    svg('<x:namedview xmlns:x="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" pagecolor="#fff"/>'),
]


@pytest.mark.parametrize("content", DRAWN)
def test_a_drawing_is_taken(content: bytes) -> None:
    assert media_type(content) == "image/svg+xml"


def test_a_png_is_taken() -> None:
    assert media_type(png()) == "image/png"


REFUSED = [
    (svg("<script>alert(1)</script>"), "holds <script>"),
    (svg("<foreignObject/>"), "holds <foreignObject>"),
    (svg('<image href="#a"/>'), "holds <image>"),
    (svg("<text>a</text>"), "texts as paths"),
    (svg('<use href="#a"/>'), "holds <use>"),
    (svg('<p xmlns="http://www.w3.org/1999/xhtml"/>'), "holds <p>"),
    (svg('<path onload="alert(1)"/>'), "holds a script (onload)"),
    (svg('<linearGradient xlink:href="http://x/a"/>', LINKED), "refers to something outside (href)"),
    (svg('<linearGradient href="data:image/png;base64,AA"/>'), "refers to something outside"),
    (svg('<rect fill="url(http://x/a)"/>'), "refers to something outside (fill)"),
    (svg("<rect style=\"fill:url( '//x')\"/>"), "refers to something outside (style)"),
    (svg('<rect style="fill:u\\72l(//x)"/>'), "refers to something outside (style)"),
    (svg("<style>@import 'x';</style>"), "loads something from outside"),
    (svg("<style>a{b:url(//x)}</style>"), "loads something from outside"),
    (svg('<style><title/>@import "http://x/";</style>'), "holds <title> within a style"),
    (svg("<style>@im<!-- -->port 'x';</style>"), "loads something from outside"),
    (svg('<clipPath id="c"><rect clip-path="url(#c)"/></clipPath>'), "clips a clipping path"),
    (svg('<clipPath id="c"><g><rect style="fill:red;Clip-Path:url(#c)"/></g></clipPath>'), "clips a clipping path"),
    (svg('<clipPath id="c" clip-path="url(#c)"/>'), "clips a clipping path"),
    (svg("<style>rect{clip-path:url(#c)}</style>"), "clips by a style sheet"),
    (b'<?xml version="1.0" encoding="utf-7"?>' + svg(""), "another encoding than UTF-8"),
    (b'<?xml version="1.0" encoding="none"?>' + svg(""), "another encoding than UTF-8"),
    (svg('<x:g id="a" xmlns:x="x"><x:use href="#a"/></x:g>'), "holds <g>"),
    (svg('<x:use href="#a" xmlns:x="x"/>'), "holds <use>"),
    (svg('<x:BigMask id="a" xmlns:x="x"/>'), "holds <BigMask>"),
    (svg('<linearGradient spreadMethod="repeat" x2="0.0000001"/>'), "repeats a gradient"),
    (svg('<rect style="spreadMethod: Reflect"/>'), "repeats a gradient"),
    (svg("<style>#a{spreadMethod:repeat}</style>"), "repeats a gradient"),
    (
        svg('<clipPath id="c">' + "<path/>" * 2400 + "</clipPath>" + '<rect clip-path="url(#c)"/>' * 2400),
        "too long to draw",
    ),
    (
        svg('<linearGradient id="a">' + "<stop/>" * 2400 + "</linearGradient>" + '<rect fill="url(#a)"/>' * 400),
        "too long to draw",
    ),
    (svg("<style>" + "rect{}" * 1000 + "</style>" + "<rect/>" * 1000), "too long to draw"),
    (svg("<style>" + "a," * 1000 + "b{}</style>" + "<rect/>" * 1000), "too long to draw"),
    (svg("<style>path~rect~rect~rect~rect~rect{}</style>" + "<rect/>" * 300), "within or beside others"),
    (svg("<style>a{} path/**/ g g rect{}</style>"), "within or beside others"),
    (svg("<style>:nth-last-child(2 of rect){}</style>"), "within or beside others"),
    (svg(f'<rect transform="{600 * "a"}"/>'), "attribute (transform) of 600 characters; at most 500"),
    (svg(f'<rect fill="url(#{600 * "aurl(#"}"/>'), "attribute (fill) of"),
    (svg(f'<rect style="{3000 * "a"}"/>'), "attribute (style) of 3000 characters; at most 2000"),
    (svg('<svg viewBox="a b c d"/>'), "does not say its size"),
    (svg("", '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1">'), "does not say its size"),
    (b'<?xml-stylesheet href="a.css"?>' + svg(""), "processing instruction"),
    (b'<!DOCTYPE svg [<!ENTITY a "b">]>' + svg("&a;"), "document type"),
    (svg("", '<svg xmlns="http://www.w3.org/2000/svg">'), "does not say its size"),
    (svg("", '<svg viewBox="0 0 1 1">'), "is not an SVG picture"),
    (b"<html></html>", "is not an SVG picture"),
    (b"<svg", "cannot be read"),
    (svg("<g/>" * MAX_ELEMENTS), "elements"),
    (svg("<g>" * 60 + "</g>" * 60), "within each other"),
    (b"GIF89a", "neither a PNG nor an SVG"),
    (b"", "neither a PNG nor an SVG"),
    (bytes(MAX_BYTES + 1), "too large: 300 kB"),
    (png()[:40], "cannot be read"),
    (png()[:20] + b"\xff" + png()[21:], "cannot be read"),
    (huge(), "9000 × 9000 pixels"),
]


@pytest.mark.parametrize(("content", "words"), REFUSED, ids=[words for _, words in REFUSED])
def test_what_does_more_than_to_draw_is_refused(content: bytes, words: str) -> None:
    with pytest.raises(PictureFault) as caught:
        media_type(content)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("given", "size"),
    [
        ('width="40mm" height="1in"', (40 * 96 / 25.4, 96)),
        ('width="40" height="30px" viewBox="0 0 1 1"', (40, 30)),
        ('viewBox="0 0 120, 40.5"', (120, 40.5)),
        ('width="100%" height="5" viewBox="-1 -1 3 2"', (3, 2)),
        ('viewBox="0 0 -4 0"', (1, 1)),
        ('viewBox="0 0 1e99 nan"', (1, 1)),
        ('viewBox="0 0 1e-320 1e-320"', (1, 1)),
    ],
)
def test_an_svg_has_a_size(given: str, size: tuple[float, float]) -> None:
    content = f'<svg xmlns="http://www.w3.org/2000/svg" {given}><g width="7"/></svg>'.encode()
    assert media_type(content) == "image/svg+xml"
    assert natural_size(content) == pytest.approx(size)
