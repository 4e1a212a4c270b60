"""Judges a picture that a user gives, a logo, by what it holds: a PNG that can be unpacked, or an SVG that only draws."""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Mapping, Sequence
from typing import Any
from xml.parsers import expat

from diecut_report.text.phrases import MessageError

MAX_BYTES = 300_000  # bytes of a picture
MAX_PIXELS = 4_000_000
MAX_ELEMENTS = 5_000
MAX_DEPTH = 50
MAX_LETTERS = 500  # of an attribute that the page engine searches for numbers and addresses, again from each letter
LONG = {"d": MAX_BYTES, "points": MAX_BYTES, "style": 2000}  # attributes that may have more
PNG, SVG = "image/png", "image/svg+xml"
SIGNATURE = b"\x89PNG\r\n\x1a\n"
SVG_NAMESPACE = "http://www.w3.org/2000/svg"
XHTML_NAMESPACE = "http://www.w3.org/1999/xhtml"
LINK = "http://www.w3.org/1999/xlink href"
DRAWING = {
    "svg", "g", "defs", "title", "desc", "metadata", "style", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon",
    "linearGradient", "radialGradient", "stop", "clipPath",
}  # fmt: skip
"""Elements that draw, or say what is drawn: none that runs, embeds, repeats, or is set in letters of a font that may be missing."""
OTHERS_DRAWING = re.compile(
    ".*(clippath|filter|gradient|marker|mask|pattern).*|svg|g|style|rect|circle|ellipse|line|poly(line|gon)|path|stop|"
    "a|image|symbol|text(path)?|tspan|tref|use",
    re.IGNORECASE,
)
"""Names that the page engine goes by in whatever name space they stand: no element of an editor has them."""
MAX_DRAWING_STEPS = 200_000  # of drawing: elements times those that a clipping path or a gradient adds to each, or the rules tried on each
_OUTSIDE = re.compile(r"@import|@font-face|url\(\s*['\"]?(?!#)", re.IGNORECASE)
PIXELS = {"": 1.0, "px": 1.0, "pt": 96 / 72, "pc": 16.0, "mm": 96 / 25.4, "cm": 960 / 25.4, "in": 96.0}
"""Of the units of CSS."""
MAX_SIDE = 1e6  # pixels of a side that has a meaning
MIN_SIDE = 1e-6
_SIMPLE = re.compile(r"[\w.#*-]*")  # a selector: element, class, id
_PARTED = re.compile(r"\s*(\d+\.?\d*|\.\d+)(px|pt|pc|mm|cm|in|)\s*")
_LENGTH = re.compile(r"\s*(?:\d+\.?\d*|\.\d+)(?:px|pt|pc|mm|cm|in)?\s*")


class PictureFault(MessageError, ValueError):
    """What is wrong with a picture, in words that follow its name."""


def media_type(content: bytes) -> str:
    """Return what a picture is; PictureFault where it is neither PNG nor SVG, or one that is not taken."""
    if len(content) > MAX_BYTES:
        template = "is too large: {count} kB; at most {most} kB are taken"
        raise PictureFault(template, count=format(len(content) / 1000.0, ".0f"), most=format(MAX_BYTES / 1000.0, "g"))
    if content.startswith(SIGNATURE):
        _judge_png(content)
        return PNG
    if not content.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
        raise PictureFault("is neither a PNG nor an SVG picture, whatever its name ends in")
    _SvgJudge().judge(content)
    return SVG


def natural_size(content: bytes) -> tuple[float, float]:
    """Return width and height of a picture that was judged, in pixels; of an SVG without a size of its own those of its view."""
    if content.startswith(SIGNATURE):
        from PIL import Image

        with Image.open(io.BytesIO(content), formats=["PNG"]) as picture:
            return float(picture.width), float(picture.height)
    found: dict[str, str] = {}
    parser = expat.ParserCreate()
    parser.StartElementHandler = lambda _, given: found or found.update(given)
    parser.Parse(content, True)
    sides = [_pixels(found.get(key, "")) for key in ("width", "height")]
    if None in sides:
        sides = [_number(each) for each in found.get("viewBox", "").replace(",", " ").split()[2:]]
    width, height = (side if side and MIN_SIDE < side < MAX_SIDE else 1.0 for side in (*sides, None, None)[:2])
    return width, height


def _pixels(length: str) -> float | None:
    """A length of CSS; None where it is none."""
    parts = _PARTED.fullmatch(length)
    return float(parts[1]) * PIXELS[parts[2]] if parts else None


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _judge_png(content: bytes) -> None:
    from PIL import Image

    try:
        with warnings.catch_warnings(action="error"), Image.open(io.BytesIO(content), formats=["PNG"]) as picture:
            if picture.width * picture.height > MAX_PIXELS:
                template = "has {width} × {height} pixels; at most {most_pixels} million are taken"
                most = f"{MAX_PIXELS / 1e6:g}"
                raise PictureFault(template, width=picture.width, height=picture.height, most_pixels=most)
            picture.load()
    except PictureFault:
        raise
    except Exception as cause:  # of many kinds, as the library raises them for a damaged file
        raise PictureFault("is a PNG picture that cannot be read: {cause}", cause=cause) from cause


class _SvgJudge:
    def __init__(self) -> None:
        self.depth = self.count = self.clips = 0  # clips: elements of clipping paths that are open
        self.parts = self.most_parts = self.rules = 0  # elements since the last definition began; rules of styles
        self.style: list[str] | None = None  # the parts of the open style sheet, which a comment may have cut
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.ProcessingInstructionHandler = self._instruction

    def judge(self, content: bytes) -> None:
        """Raise PictureFault where the SVG does more than to draw, or is none."""
        try:
            self.parser.Parse(content, True)
        except expat.ExpatError as error:
            raise PictureFault("is an SVG picture that cannot be read: {error}", error=error) from error
        except PictureFault:
            raise
        except (LookupError, ValueError) as error:  # an encoding that Python does not know, or the parser does not read
            raise PictureFault("is an SVG picture in another encoding than UTF-8; save it as UTF-8") from error
        if self.count * max(self.most_parts, self.rules) > MAX_DRAWING_STEPS:
            template = "takes too long to draw: its clipping paths, gradients or styles have too many parts; give a simpler one"
            raise PictureFault(template)

    def _start(self, tag: str, given: Mapping[str, str]) -> None:
        space, _, name = tag.rpartition(" ")
        self.depth, self.count = self.depth + 1, self.count + 1
        if self.count > MAX_ELEMENTS or self.depth > MAX_DEPTH:
            template = (
                "has more than {most_elements} elements, or more than {deepest} within each other; give a simpler one"
            )
            raise PictureFault(template, most_elements=MAX_ELEMENTS, deepest=MAX_DEPTH)
        if self.depth == 1:
            _judge_root(space, name, given)
        is_drawing = (
            name in DRAWING
            if space == SVG_NAMESPACE
            else not (space in ("", XHTML_NAMESPACE) or OTHERS_DRAWING.fullmatch(name))
        )
        if not is_drawing:
            template = "holds <{name}>; a logo holds shapes alone: save it as plain SVG, with its texts as paths"
            raise PictureFault(template, name=name)
        if self.style is not None:
            raise PictureFault("holds <{name}> within a style", name=name)
        self.style = [] if name == "style" else None
        self.clips += bool(self.clips or name == "clipPath")
        self.parts = 0 if name.endswith("Gradient") or self.clips == 1 else self.parts + 1
        self.most_parts = max(self.most_parts, self.parts * (self.clips > 0 or name == "stop"))
        for key, value in given.items():
            _judge_attribute(key, value)
            if self.clips and "clip-path" in (key, *re.findall(r"[\w-]+", value.lower() if key == "style" else "")):
                raise PictureFault("clips a clipping path, which may never end; combine the paths into one")

    def _end(self, _tag: str) -> None:
        self.depth -= 1
        self.clips = max(self.clips - 1, 0)
        style = "".join(self.style or ())
        _judge_style(style)
        self.rules += _count_of_rules(style)
        self.style = None

    def _text(self, text: str) -> None:
        if self.style is not None:
            self.style.append(text)

    def _doctype(self, *_: object) -> None:
        raise PictureFault("has a document type (<!DOCTYPE …>), which may define entities; remove that line")

    def _instruction(self, *_: object) -> None:
        raise PictureFault("has a processing instruction (<?…?>), which may load a style from outside; remove it")


def _judge_style(text: str) -> None:
    if _OUTSIDE.search(text) or "\\" in text:
        raise PictureFault("has a style that loads something from outside; embed nothing and refer to nothing")
    _judge_repetition(text)
    if "clip-path" in text.lower():
        raise PictureFault("clips by a style sheet; save it with presentation attributes")


def _count_of_rules(style: str) -> int:
    """How many names each element is held against; PictureFault for those of elements within or beside others, all of which may be tried."""
    import tinycss2

    found = tinycss2.parse_stylesheet(style, skip_comments=True)
    selectors = [each for rule in found if rule.type == "qualified-rule" for each in _selectors(rule.prelude)]
    if not all(map(_SIMPLE.fullmatch, selectors)):
        template = "has a style for elements within or beside others, which may never end; name each by its class alone"
        raise PictureFault(template)
    return len(selectors)


def _selectors(tokens: Sequence[Any]) -> list[str]:
    text = "".join("" if token.type == "comment" else token.serialize() for token in tokens)
    return [each.strip() for each in text.split(",")]


def _judge_root(space: str, name: str, given: Mapping[str, str]) -> None:
    if (space, name) != (SVG_NAMESPACE, "svg"):
        template = "is not an SVG picture: its first element is <{name}>, without the name space {space}"
        raise PictureFault(template, name=name, space=SVG_NAMESPACE)
    sized = all(_LENGTH.fullmatch(given.get(key, "")) for key in ("width", "height"))
    if not (_is_view(given["viewBox"]) if "viewBox" in given else sized):
        raise PictureFault("does not say its size; give it a viewBox, or width and height")


def _is_view(text: str) -> bool:
    sides = [_number(each) for each in text.replace(",", " ").split()]
    return len(sides) == 4 and None not in sides


def _judge_repetition(text: str) -> None:
    if re.search(r"\b(repeat|reflect)\b", text, re.IGNORECASE):
        raise PictureFault("repeats a gradient, which may never end; let it run once (spreadMethod pad)")


def _judge_attribute(key: str, value: str) -> None:
    space, _, name = key.rpartition(" ")
    if not space and len(value) > LONG.get(name, MAX_LETTERS):
        template = "has an attribute ({name}) of {count} characters; at most {most} are taken: save it as plain SVG"
        raise PictureFault(template, name=name, count=len(value), most=LONG.get(name, MAX_LETTERS))
    if name == "viewBox" and not _is_view(value):
        raise PictureFault("does not say its size; give it a viewBox, or width and height")
    if name in ("spreadMethod", "style"):
        _judge_repetition(value)
    if name.lower().startswith("on"):
        raise PictureFault("holds a script ({name}); a logo holds shapes alone", name=name)
    if (key == LINK or name.lower() in ("href", "src")) and not value.startswith("#"):
        raise PictureFault("refers to something outside ({name}); embed nothing and refer to nothing", name=name)
    if _OUTSIDE.search(value) or "\\" in value:
        raise PictureFault("refers to something outside ({name}); embed nothing and refer to nothing", name=name)
