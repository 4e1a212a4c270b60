"""The page engine's busiest functions made quicker: each gives what its original gives, byte for byte, and asks it wherever a case is not plain.

A report has thousands of boxes of a few hundred styles: what follows from a style alone is found once for it, and kept with it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

from diecut_report.report.quick_texts import begin_layout, line_height, whole_line
from diecut_report.report.surroundings import no_compiler

with no_compiler():
    import pydyf
    from weasyprint import __version__ as VERSION  # noqa: N812
    from weasyprint.css import INHERITED, INITIAL_NOT_COMPUTED, INITIAL_VALUES, ComputedStyle, StyleFor
    from weasyprint.css.computed_values import PHYSICAL_FUNCTIONS
    from weasyprint.css.functions import check_math
    from weasyprint.draw import border
    from weasyprint.draw.color import get_color
    from weasyprint.formatting_structure.boxes import Box
    from weasyprint.layout import background, percent, preferred
    from weasyprint.pdf import tags
    from weasyprint.text import line_break

KNOWN = "70.0", "0.13.0"  # the page engine whose functions these are, and its writer; others are left as they are
ENGINE = "weasyprint", "pydyf"
FLOATED = ("left", "right", "inline-start", "inline-end", "footnote")
IN_FLOW = ("static", "relative", "sticky")
LENGTHS = [f"{part}_{side}" for part in ("margin", "padding") for side in ("left", "right", "top", "bottom")]
LENGTHS += [f"{least}{axis}" for least in ("", "min_", "max_") for axis in ("width", "height")]
CORNERS = [f"border_{corner}_radius" for corner in ("top_left", "top_right", "bottom_right", "bottom_left")]
SHARP = (0, "px")
NOTHING_BEHIND = {**dict.fromkeys(CORNERS, (0, 0)), "background": None}
OWN_RULES = {"float", "display", "position", "page"}  # properties that the engine computes by rules of their own

Function = Callable[..., Any]


def hasten() -> Callable[[], None]:
    """Put the quicker functions in the place of the engine's; return what puts those back."""
    if (VERSION, pydyf.VERSION) != KNOWN:
        return lambda: None
    kept = [(of, name, of.__dict__[name]) for of, name, _ in _METHODS]
    for each in _METHODS:
        setattr(*each)
    for original, quick in _FUNCTIONS.items():
        kept += _exchanged(original, quick)

    def put_back() -> None:
        for each in kept:
            setattr(*each)

    return put_back


def _exchanged(original: Function, quick: Function) -> list[tuple[Any, str, Function]]:
    """Let all modules of the engine call the quick function; return where the original stood."""
    name = original.__name__
    modules = [module for key, module in sys.modules.items() if key.split(".")[0] in ENGINE]
    found = [(module, name, original) for module in modules if module.__dict__.get(name) is original]
    for module, _, _ in found:
        setattr(module, name, quick)
    return found


# styles
_computed = ComputedStyle.__missing__


def _missing(style: Any, key: str) -> Any:
    """Return a property that no rule gives: the parent's, or the initial one."""
    if key in style.cascaded or key in OWN_RULES or key.startswith("text_decoration_") or style.parent_style is None:
        return _computed(style, key)
    if key in PHYSICAL_FUNCTIONS and _has_logical(style):
        return _computed(style, key)
    if key in INHERITED:
        value = style.parent_style[key]
        if check_math(value):
            return _computed(style, key)
    elif key in INITIAL_NOT_COMPUTED or key[:2] == "__":
        return _computed(style, key)
    else:
        value = INITIAL_VALUES[key]
    style[key] = value
    return value


def _has_logical(style: Any) -> bool:
    """Whether a rule gives a property by the direction of writing."""
    if "has_logical" not in style.__dict__:
        style.has_logical = any("block" in key or "inline" in key for key in style.cascaded)
    found: bool = style.has_logical
    return found


_set_styles = StyleFor.set_computed_styles


def _set_computed_styles(
    styles: Any, element: Any, parent: Any, root: Any = None, pseudo_type: str | None = None, base_url: Any = None,
    target_collector: Any = None,
) -> None:  # fmt: skip
    """Set an element's style; parts of elements (``::after``) that have one style and one rule share theirs, as elements do."""
    computed, rules = styles.get_computed_styles(), styles.get_cascaded_styles().get((element, pseudo_type), {})
    key: tuple[object, ...] = ()
    if pseudo_type and not isinstance(element, tuple):  # which a page is
        told = ((name, id(value), weight) for name, (value, weight) in rules.items())
        key = (id(computed[parent, None]), pseudo_type, *told)
    shared = styles.__dict__.setdefault("shared", {})
    if key and key in shared:
        computed[element, pseudo_type] = shared[key]
        return
    _set_styles(styles, element, parent, root, pseudo_type, base_url, target_collector)
    if key:
        shared[key] = computed[element, pseudo_type]


# boxes
def _is_in_normal_flow(box: Any) -> bool:
    return box.style["float"] not in FLOATED and box.style["position"] in IN_FLOW


def _itself(box: Any) -> Any:
    """Return the box that a place-holder stands for."""
    return box.__dict__.get("_box", box)


_percentages = percent.resolve_percentages


def _resolve_percentages(box: Any, containing_block: Any) -> None:
    """Set the lengths of a box: those of its style, where none is a share of something else."""
    kept = box.style.__dict__
    if "lengths" not in kept:
        kept["lengths"] = _lengths(box.style)
    if kept["lengths"] is None:
        _percentages(box, containing_block)
    else:
        _itself(box).__dict__.update(kept["lengths"])


def _lengths(style: Any) -> dict[str, Any] | None:
    """Return the lengths of all boxes of a style; None where they depend on what is around."""
    values = [style[name] for name in LENGTHS]
    if style["border_collapse"] == "collapse" or any(value != "auto" and value[1:] != ("px",) for value in values):
        return None
    any_box = SimpleNamespace(style=style)
    _percentages(any_box, (0, 0))
    del any_box.style
    return vars(any_box)


def _shrink_to_fit(context: Any, box: Any, available: float) -> Any:
    """Return a box's width: what it likes best, where there is room for it, so that its least one need not be known."""
    best = preferred.max_content_width(context, box, outer=False)
    if best <= available:
        return best
    return min(max(preferred.min_content_width(context, box, outer=False), available), best)


# backgrounds and borders
_backgrounds = background.layout_box_backgrounds


def _layout_box_backgrounds(
    page: Any, box: Any, get_image_from_uri: Any, layout_children: bool = True, style: Any = None
) -> None:
    """Set that a box has no background, and sharp corners, where its style says so."""
    if box is page or style is not None or not _is_bare(box.style):
        _backgrounds(page, box, get_image_from_uri, layout_children, style)
        return
    _itself(box).__dict__.update(NOTHING_BEHIND)
    if layout_children:
        for child in box.all_children():
            _layout_box_backgrounds(page, child, get_image_from_uri)


def _is_bare(style: Any) -> bool:
    """Whether boxes of a style have neither background nor round corners."""
    kept = style.__dict__
    if "is_bare" not in kept:
        images = [style["border_image_source"], style["mask_border_source"], *style["background_image"]]
        kept["is_bare"] = (
            all(SHARP in style[corner] for corner in CORNERS)
            and all(kind == "none" for kind, _ in images)
            and not style["box_shadow"]
            and (style["visibility"] == "hidden" or get_color(style, "background_color").alpha == 0)
        )
    found: bool = kept["is_bare"]
    return found


_border = border.draw_border


def _draw_border(stream: Any, box: Any) -> None:
    """Draw nothing where a box has no borders."""
    widths = (box.border_top_width, box.border_right_width, box.border_bottom_width, box.border_left_width)
    if any(widths) or not _is_plain(box.style):
        _border(stream, box)


def _is_plain(style: Any) -> bool:
    """Whether boxes of a style have neither pictures for borders nor rules between columns."""
    kept = style.__dict__
    if "is_plain" not in kept:
        columns = style["column_width"], style["column_count"]
        kept["is_plain"] = columns == ("auto", "auto") and style["border_image_source"][0] == "none"
    found: bool = kept["is_plain"]
    return found


# the file
_slow_bytes = pydyf._to_bytes
_BYTES: dict[type, Callable[[Any], bytes]] = {
    bytes: lambda item: item,
    str: lambda item: item.encode("ascii"),
    int: lambda item: b"%d" % item,
}


def _to_bytes(item: Any) -> bytes:
    """Return what is written of a value."""
    way: Callable[[Any], bytes] = _BYTES.get(type(item), _slow_bytes)
    return way(item)


_tags = tags.add_tags


def _add_tags(pdf: Any, document: Any, version: Any, streams: list[Any]) -> None:
    """Tell the structure of the sheets, and let the boxes of each go as soon as it is told: beside it they would be the memory's peak."""
    _tags(pdf, document, version, _letting_go(document.pages, streams))


def _letting_go(pages: list[Any], streams: list[Any]) -> Iterator[Any]:
    for page, stream in zip(pages, streams, strict=True):
        yield stream
        page._page_box.children = ()


_METHODS: list[tuple[type, str, Function]] = [
    (ComputedStyle, "__missing__", _missing),
    (StyleFor, "set_computed_styles", _set_computed_styles),
    (Box, "is_in_normal_flow", _is_in_normal_flow),
    (line_break.Layout, "setup", begin_layout),
]
_FUNCTIONS: dict[Function, Function] = {
    _percentages: _resolve_percentages,
    preferred.shrink_to_fit: _shrink_to_fit,
    _backgrounds: _layout_box_backgrounds,
    _border: _draw_border,
    line_break.strut: line_height,
    line_break.split_first_line: whole_line,
    _slow_bytes: _to_bytes,
    _tags: _add_tags,
}
